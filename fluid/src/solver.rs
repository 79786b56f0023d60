//! The fluid solver: what it is built from and what it shows.

use partita_mesh::Mesh;
use partita_mesh::facet::Facet;
use partita_mesh::motion::{MeshMotion, MotionQuality};
use partita_numerics::newton::FactorLog;
use partita_numerics::phases::PhaseSeconds;
use partita_numerics::{Factor, Method, Part};

#[cfg(doc)]
use partita_numerics::Field;

use crate::assembly::Assembly;
use crate::boundary::{self, Boundaries, Frames};
use crate::error::FluidError;
use crate::kernel::Flow;
use crate::model::{BodyForce, FluidModel, InitialState};
use crate::settings::{FluidSettings, Tangent};
use crate::shared::SharedNodes;
use crate::state::FluidState;
use crate::trial::Trial;

/// Incompressible Navier-Stokes on a moving mesh of triangles (`D = 2`) or tetrahedra (`D = 3`).
///
/// A step is `begin_step`, then any number of rounds of `impose` (new displacement of the interface) and Newton
/// iterations ([`newton::solve`](partita_numerics::newton::solve), or [`advance`](Field::advance)), then `commit` or `rewind`. A round continues
/// from the iterate of the round before.
///
/// ```
/// use std::sync::Arc;
/// use partita_fluid::{BodyForce, BoundaryCondition, Field, FluidModel, FluidSettings, FluidSolver, InitialState};
/// use partita_mesh::generate::{Diagonal, RectangleMesh, rectangle};
/// use partita_numerics::newton::Limit;
///
/// let mesh = rectangle(&RectangleMesh {
///     origin: [0.0, 0.0],
///     size: [1.0, 1.0],
///     divisions: [8, 8],
///     pattern: Diagonal::Crossed,
/// })?;
/// let model = FluidModel {
///     density: 1000.0,
///     viscosity: 1.0,
///     body_force: BodyForce::Constant([0.0, -9.81]),
///     boundary: vec![
///         ("left".into(), BoundaryCondition::Slip),
///         ("right".into(), BoundaryCondition::Slip),
///         ("bottom".into(), BoundaryCondition::NoSlip),
///         ("top".into(), BoundaryCondition::StressFree { backflow: false }),
///     ],
///     initial: InitialState::Rest,
/// };
/// let mut tank = FluidSolver::new(mesh, model, FluidSettings::default())?;
/// tank.begin_step(0.01, 0.01)?;
/// tank.advance(Limit::ToConvergence)?;
/// tank.commit();
/// let weight = tank.force_on("bottom").expect("a group")[1];
/// assert!((weight + 9810.0).abs() < 1e-6);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub struct FluidSolver<const D: usize> {
    pub(crate) mesh: Mesh<D>,
    pub(crate) model: FluidModel<D>,
    pub(crate) settings: FluidSettings,
    pub(crate) boundaries: Boundaries<D>,
    pub(crate) shared: SharedNodes<D>,
    pub(crate) committed: FluidState,
    pub(crate) trial: Trial<D>,
    pub(crate) frames: Frames<D>,
    pub(crate) motion: Option<MeshMotion<D>>,
    pub(crate) assembly: Assembly,
    pub(crate) factor: Factor,
    pub(crate) factor_log: FactorLog,
    /// Whether the mesh has been where it is from the start.
    pub(crate) mesh_is_fixed: bool,
    /// The last Newton increment on all dofs.
    pub(crate) increment: Vec<f64>,
    pub(crate) phases: PhaseSeconds,
    /// Volume defect of the last accepted step.
    pub(crate) last_volume_defect: f64,
    pub(crate) parts: Vec<Part>,
}

impl<const D: usize> FluidSolver<D> {
    /// Checks the problem and prepares everything that does not change from step to step.
    ///
    /// # Errors
    ///
    /// [`FluidError`] for properties out of range, groups without condition or conditions without group, a
    /// pressure without level, or settings of the mesh motion that do not work.
    pub fn new(mesh: Mesh<D>, model: FluidModel<D>, settings: FluidSettings) -> Result<Self, FluidError> {
        const { assert!(D == 2 || D == 3, "fluids have 2 or 3 dimensions") };
        boundary::check(&mesh, &model, &settings)?;
        let boundaries = Boundaries::new(&mesh, &model, &settings)?;
        let assembly = Assembly::new(mesh.cells(), &boundaries.prescribed);
        let factor = Factor::with_threads(Method::NodeBlockLu, &assembly.pattern, settings.threads)?;
        let motion = match &boundaries.mesh_prescribed {
            Some(prescribed) => Some(MeshMotion::new(&mesh, settings.motion, prescribed)?),
            None => None,
        };
        let mut frames = Frames::new(&boundaries.slip, mesh.points().len());
        frames.update(&boundaries.slip, mesh.points());
        let committed = FluidState::start(initial_values(&mesh, &model)?, mesh.points().len() * D);
        let mut trial = Trial::new(&mesh, initial_flow(&model, &settings), &committed);
        if let BodyForce::Constant(b) = model.body_force {
            trial.body_force.chunks_exact_mut(D).for_each(|nodal| nodal.copy_from_slice(&b));
        }
        Ok(Self {
            parts: parts(&boundaries, &frames, &assembly),
            increment: vec![0.0; boundaries.prescribed.len()],
            phases: PhaseSeconds::default(),
            last_volume_defect: 0.0,
            shared: SharedNodes::new(&mesh, &model),
            mesh,
            model,
            settings,
            boundaries,
            committed,
            trial,
            frames,
            mesh_is_fixed: motion.is_none(),
            motion,
            assembly,
            factor,
            factor_log: FactorLog::default(),
        })
    }

    /// The nodes whose displacement [`impose`](Field::impose) takes and whose forces
    /// [`output`](Field::output) gives: those of all interface groups, sorted.
    #[must_use]
    pub fn interface_nodes(&self) -> &[usize] {
        &self.boundaries.interface
    }

    /// The facets of all interface groups, group by group; their nodes are numbered as in the mesh.
    pub fn interface_facets(&self) -> impl Iterator<Item = &Facet<D>> {
        let groups = self.model.boundary.iter().filter(|(_, condition)| condition.is_interface());
        groups.filter_map(|(name, _)| self.mesh.group(name)).flat_map(|group| &group.facets)
    }

    /// The reference mesh.
    #[must_use]
    pub fn mesh(&self) -> &Mesh<D> {
        &self.mesh
    }

    /// The nodes of the moved mesh `[m]`.
    #[must_use]
    pub fn points(&self) -> &[[f64; D]] {
        &self.trial.points
    }

    /// Displacement of the mesh from its reference `[m]`, `node * D + c`.
    #[must_use]
    pub fn displacement(&self) -> &[f64] {
        &self.trial.displacement
    }

    /// Velocity of the mesh in this step `[m/s]`, `node * D + c`.
    #[must_use]
    pub fn mesh_velocity(&self) -> &[f64] {
        &self.trial.mesh_velocity
    }

    /// Size and shape of the moved cells; nothing where no boundary moves.
    #[must_use]
    pub fn mesh_quality(&self) -> Option<MotionQuality> {
        self.motion.as_ref()?.check(&self.trial.displacement).ok()
    }

    /// The settings it was built with.
    #[must_use]
    pub fn settings(&self) -> &FluidSettings {
        &self.settings
    }

    /// How many factorizations since it was built had to be repeated by a slower method, see [`Factor::fallbacks`].
    #[must_use]
    pub fn fallbacks(&self) -> usize {
        self.factor.fallbacks()
    }

    /// Bytes of the factor of a tangent, by far the largest thing in here.
    #[must_use]
    pub fn factor_bytes(&self) -> Option<usize> {
        self.factor.factor_bytes()
    }

    /// The motion of the mesh; nothing where no boundary moves.
    #[must_use]
    pub fn mesh_motion(&self) -> Option<&MeshMotion<D>> {
        self.motion.as_ref()
    }
}

fn initial_flow<const D: usize>(model: &FluidModel<D>, settings: &FluidSettings) -> Flow {
    Flow {
        density: model.density,
        viscosity: model.viscosity,
        inverse_constant: settings.inverse_constant,
        grad_div: settings.grad_div,
        rate: 0.0,
        four_over_dt_squared: 0.0,
        // Without convection this one is the full derivative: all that depends on u is left out.
        tangent: if settings.convection { settings.tangent } else { Tangent::Picard },
    }
}

fn initial_values<const D: usize>(mesh: &Mesh<D>, model: &FluidModel<D>) -> Result<Vec<f64>, FluidError> {
    let mut values = vec![0.0; mesh.points().len() * (D + 1)];
    if let InitialState::Velocity(field) = &model.initial {
        for (node, point) in mesh.points().iter().enumerate() {
            let velocity = boundary::evaluate(field, point, 0.0, "initial velocity", node)?;
            values[node * (D + 1)..node * (D + 1) + D].copy_from_slice(&velocity);
        }
    }
    Ok(values)
}

fn parts<const D: usize>(boundaries: &Boundaries<D>, frames: &Frames<D>, assembly: &Assembly) -> Vec<Part> {
    let is_pressure = |dof: &usize| dof % (D + 1) == D;
    let mut counts: Vec<bool> = boundaries.prescribed.iter().map(|prescribed| !prescribed).collect();
    for node in frames.turned_nodes() {
        counts[node * (D + 1)..node * (D + 1) + D].fill(true);
    }
    let velocity = (0..counts.len()).filter(|dof| counts[*dof] && !is_pressure(dof)).collect();
    let pressure = assembly.dofs.free().iter().copied().filter(is_pressure).collect();
    vec![Part { name: "velocity", dofs: velocity }, Part { name: "pressure", dofs: pressure }]
}
