//! The solver of a structure: built once, then step after step.

use partita_iga::Spline;
#[cfg(doc)]
use partita_numerics::newton;
use partita_numerics::newton::FactorLog;
use partita_numerics::{DofMap, Field, Part, PhaseSeconds};

use crate::assembly::{Assembly, Forces, Local, Motion};
use crate::error::StructureError;
use crate::factor::TangentFactor;
use crate::load::Loads;
use crate::model::{StructureModel, StructureSettings};
use crate::space::Space;
use crate::state::StructureState;
use crate::step::{Scheme, Step};

/// Nonlinear elastodynamics on one space.
///
/// The unknown of a step is `d_{n+1}`; velocity and acceleration follow from it by Newmark's relations. Its residual
///
/// ```text
/// R = M a_{n+1-alpha_m} + C v_{n+1-alpha_f} + f_int(d_{n+1-alpha_f}) - f_ext_{n+1-alpha_f}
/// ```
///
/// is kept on all dofs, those of supports included: there it holds the reactions. A step starts from
/// `d_n`. The caller composes it from [`begin_step`](Field::begin_step), [`impose`](Field::impose),
/// [`newton::solve`] and [`commit`](Field::commit) or [`rewind`](Field::rewind); a structure alone takes
/// [`step_alone`](Field::step_alone).
///
/// ```
/// use partita_iga::{Side, build};
/// use partita_structure::*;
///
/// // A cantilever of 1 m x 0.1 m under its own weight.
/// let patch = build::rectangle([0.0, 0.0], [1.0, 0.1], [2, 2], [10, 1])?;
/// let model = StructureModel {
///     density: 1000.0,
///     material: Material::new(Law::StVenantKirchhoff, 1e7, 0.3, Plane::Strain)?.into(),
///     body_force: BodyForce::Constant([0.0, -9.81e3]),
///     clamped: Side::LEFT.into(),
///     held: Vec::new(),
///     wetted: Boundary::NONE,
/// };
/// let settings = StructureSettings { time: TimeScheme::QuasiStatic, ..Default::default() };
/// let mut cantilever = StructureSolver::new(patch.into(), model, settings)?;
/// let report = cantilever.step_alone(1.0, 1.0)?;
/// assert!(report.converged);
///
/// let [_, deflection] = cantilever.displacement_at(&[1.0, 0.5]);
/// let beam_theory = -9.81e3 * 0.1 / (8.0 * 1e7 / (1.0 - 0.3 * 0.3) * 0.1_f64.powi(3) / 12.0);
/// assert!((deflection / beam_theory - 1.0).abs() < 0.03);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub struct StructureSolver<const D: usize> {
    pub(crate) space: Space<D>,
    pub(crate) model: StructureModel<D>,
    pub(crate) settings: StructureSettings,
    pub(crate) scheme: Scheme,
    pub(crate) assembly: Assembly<D>,
    pub(crate) factor: TangentFactor,
    pub(crate) factor_log: FactorLog,
    pub(crate) loads: Loads<D>,
    pub(crate) parts: [Part; 1],
    pub(crate) committed: StructureState,
    pub(crate) trial: StructureState,
    pub(crate) step: Option<Step>,
    pub(crate) work: Work<D>,
    pub(crate) phases: PhaseSeconds,
}

/// Vectors that live as long as the solver and carry nothing from one assembly to the next.
pub(crate) struct Work<const D: usize> {
    pub(crate) motion: Motion,
    pub(crate) forces: Forces,
    /// `f_ext` at `n+1-alpha_f`, on all dofs.
    pub(crate) external: Vec<f64>,
    /// R on all dofs.
    pub(crate) residual: Vec<f64>,
    /// Values of the tangent on the pattern.
    pub(crate) tangent: Vec<f64>,
    /// Newton increment on the free dofs.
    pub(crate) increment: Vec<f64>,
    /// Displacement before the last Newton increment: where a line search starts, and where a chord goes back to.
    pub(crate) start: Vec<f64>,
    pub(crate) local: Local<D>,
}

impl<const D: usize> StructureSolver<D> {
    /// Tabulates the space, analyses the pattern and starts at rest without loads at t = 0.
    ///
    /// # Errors
    /// When a property or setting is out of range, the geometry is folded, or a side or group does not exist.
    pub fn new(
        space: Space<D>,
        model: StructureModel<D>,
        settings: StructureSettings,
    ) -> Result<Self, StructureError> {
        model.check()?;
        settings.check()?;
        let scheme = settings.time.coefficients()?;
        let held = space.held_dofs(&model.clamped, &model.held)?;
        let mut interface_points = space.nodes_of(&model.wetted)?;
        interface_points.retain(|point| !held[point * D..][..D].iter().all(|held| *held));
        let elements = space.elements()?;

        let dofs = DofMap::new(&held);
        if dofs.free_count() == 0 {
            return Err(StructureError::NothingFree);
        }
        let parts = [Part { name: "displacement", dofs: dofs.free().to_vec() }];
        let mut assembly = Assembly::new(elements, dofs, model.density, model.material.clone());
        let has_inertia = scheme != Scheme::QuasiStatic;
        if has_inertia || settings.rayleigh.is_some() {
            assembly = assembly.with_mass();
        }
        if !has_inertia {
            assembly = assembly.without_inertia();
        }
        if let Some(rayleigh) = settings.rayleigh {
            assembly = assembly.with_damping(rayleigh);
        }
        let state = StructureState::at_rest(space.node_count() * D, interface_points.len() * D);
        Ok(Self {
            factor: TangentFactor::new(assembly.pattern())?,
            factor_log: FactorLog::default(),
            loads: Loads::new(model.body_force.clone(), &assembly, interface_points),
            work: Work::new(&assembly),
            committed: state.clone(),
            trial: state,
            step: None,
            phases: PhaseSeconds::default(),
            space,
            model,
            settings,
            scheme,
            assembly,
            parts,
        })
    }

    /// Nodes on the wetted parts that can move in a direction at least, ascending, those at corners once. A component
    /// that is held stays zero.
    #[must_use]
    pub fn interface_points(&self) -> &[usize] {
        self.loads.interface_points()
    }

    /// Makes the committed state one of dynamic equilibrium under the loads of `time` `[s]`: sets `F_0` to the body force
    /// (and the interface force of the state), and `a_0` by
    ///
    /// ```text
    /// M a_0 = F_0 - f_int(d_0) - C v_0
    /// ```
    ///
    /// A structure alone starts so, for otherwise a load that is there from the start leaves a velocity of order
    /// dt F/M behind. A coupled run does not call this: it starts with `a_0 = 0` and `F_0 = 0`. Without inertia only
    /// `F_0` is set.
    ///
    /// # Errors
    /// When the mass matrix cannot be factored, or the material has no stress for `d_0`.
    pub fn start_from_equilibrium(&mut self, time: f64) -> Result<(), StructureError> {
        self.trial.copy_from(&self.committed);
        self.set_time(time);
        self.trial.acceleration.fill(0.0);
        if self.scheme != Scheme::QuasiStatic {
            self.solve_for_acceleration()?;
        }
        self.commit();
        Ok(())
    }

    /// Moves the trial state to another displacement before a Newton iteration: a guess from a predictor, say. What is
    /// held stays where it is.
    ///
    /// # Panics
    /// When `displacement` does not have one value a dof.
    pub fn guess(&mut self, displacement: &[f64]) {
        assert_eq!(displacement.len(), self.trial.displacement.len(), "the guess has the wrong length");
        for &dof in self.assembly.dofs().free() {
            self.trial.displacement[dof] = displacement[dof];
        }
        self.update_rates();
    }

    /// The residual R `[N, in 2D N/m]` of the last assembly on all dofs; in the rows of supports it holds the reactions.
    #[must_use]
    pub fn residual(&self) -> &[f64] {
        &self.work.residual
    }

    /// The trial state: `t_{n+1}` between [`begin_step`](Field::begin_step) and [`commit`](Field::commit).
    #[must_use]
    pub fn trial(&self) -> &StructureState {
        &self.trial
    }

    /// Geometry and displacement space in the reference configuration.
    #[must_use]
    pub fn space(&self) -> &Space<D> {
        &self.space
    }

    /// The patch in its reference configuration.
    ///
    /// # Panics
    /// When the structure lives on a mesh: [`space`](Self::space) tells.
    #[must_use]
    pub fn spline(&self) -> &Spline<D> {
        match &self.space {
            Space::Patch(patch) => patch.spline(),
            Space::Lagrange(_) => panic!("the structure lives on a mesh, not on a patch"),
        }
    }

    /// Whether a support keeps this component of a node at zero.
    ///
    /// # Panics
    /// When there is no such node or component.
    #[must_use]
    pub fn is_held(&self, node: usize, component: usize) -> bool {
        assert!(component < D, "there is no component {component} in {D} dimensions");
        !self.assembly.dofs().is_free(node * D + component)
    }

    /// Properties, loads and supports.
    #[must_use]
    pub fn model(&self) -> &StructureModel<D> {
        &self.model
    }

    /// How many tangents were not positive definite since the solver was built: past a buckling load, say.
    #[must_use]
    pub fn indefinite_tangents(&self) -> usize {
        self.factor.indefinite_count()
    }

    pub(crate) fn has_inertia(&self) -> bool {
        self.scheme != Scheme::QuasiStatic
    }

    /// A step of this size `[s]`, without starting it.
    pub(crate) fn step_of(&self, dt: f64) -> Step {
        Step::new(self.scheme, dt)
    }

    pub(crate) fn step(&self) -> &Step {
        self.step.as_ref().expect("`begin_step` comes before the first assembly")
    }

    /// Velocity and acceleration after a change of the trial displacement.
    pub(crate) fn update_rates(&mut self) {
        let step = *self.step();
        step.follow(&self.committed, &mut self.trial);
    }

    pub(crate) fn set_time(&mut self, time: f64) {
        self.trial.time = time;
        self.loads.set_time(time, &self.assembly);
        self.update_external_force();
    }

    pub(crate) fn update_external_force(&mut self) {
        let StructureState { interface_force, external_force, .. } = &mut self.trial;
        self.loads.external_force(interface_force, external_force);
    }

    fn solve_for_acceleration(&mut self) -> Result<(), StructureError> {
        let Work { motion, forces, residual, increment, local, .. } = &mut self.work;
        motion.displacement.copy_from_slice(&self.trial.displacement);
        motion.velocity.copy_from_slice(&self.trial.velocity);
        motion.acceleration.fill(0.0);
        self.assembly.evaluate(motion, None, local, forces)?;
        for dof in 0..residual.len() {
            residual[dof] = self.trial.external_force[dof] - forces.internal[dof] - forces.damping[dof];
        }
        self.assembly.dofs().gather(residual, increment);
        self.factor_log.forget();
        self.factor.refactor(self.assembly.pattern(), self.assembly.mass())?;
        self.factor.solve(increment);
        self.assembly.dofs().add_scaled(1.0, increment, &mut self.trial.acceleration);
        Ok(())
    }
}

impl<const D: usize> Work<D> {
    fn new(assembly: &Assembly<D>) -> Self {
        let dofs = assembly.dofs().total();
        Self {
            motion: Motion::new(dofs),
            forces: Forces::new(dofs),
            external: vec![0.0; dofs],
            residual: vec![0.0; dofs],
            tangent: vec![0.0; assembly.pattern().nonzeros()],
            increment: vec![0.0; assembly.dofs().free_count()],
            start: vec![0.0; dofs],
            local: assembly.local(),
        }
    }
}
