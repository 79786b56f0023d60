//! Boundary conditions sorted out by nodes and facets, once.

mod check;
mod closed;
mod natural;
mod slip;

use partita_mesh::motion::prescribed_dofs;
use partita_mesh::{Mesh, Place};

pub(crate) use check::check;
pub(crate) use closed::ClosedWalls;
pub(crate) use natural::{Natural, NaturalFacet};
pub(crate) use slip::{Frames, SlipNode};

use crate::error::FluidError;
use crate::model::{BoundaryCondition, FluidModel, VectorField};
use crate::settings::FluidSettings;

/// What holds the velocity of a node in all directions.
#[derive(Clone, Copy)]
enum Hold {
    /// u = w.
    Wall,
    /// u = 0 on a wall along which the mesh slides.
    Still,
    /// u given by the condition with this index.
    Field(usize),
}

/// The conditions of a model on one mesh.
pub(crate) struct Boundaries<const D: usize> {
    /// Which dofs `node * (D + 1) + c` are prescribed; on slip nodes c counts in the turned frame.
    pub(crate) prescribed: Vec<bool>,
    /// Nodes of interface groups, rigid ones too, sorted.
    pub(crate) interface: Vec<usize>,
    /// Those of them that another field moves.
    pub(crate) moved_interface: Vec<usize>,
    /// Nodes of moving walls, and the condition that moves them.
    pub(crate) wall_motion: Vec<(usize, usize)>,
    pub(crate) natural: Vec<NaturalFacet<D>>,
    pub(crate) slip: Vec<SlipNode<D>>,
    /// Which displacements `node * D + c` of the mesh are given; nothing where no boundary moves.
    pub(crate) mesh_prescribed: Option<Vec<bool>>,
    /// Whether velocity is prescribed all round.
    pub(crate) is_closed: bool,
    /// Its moving walls, if it is.
    pub(crate) closed_walls: Option<ClosedWalls<D>>,
    /// Nodes held in all directions, ascending.
    holds: Vec<(usize, Hold)>,
}

impl<const D: usize> Boundaries<D> {
    /// Sorts the conditions of a model that passed [`check`].
    pub(crate) fn new(
        mesh: &Mesh<D>,
        model: &FluidModel<D>,
        settings: &FluidSettings,
    ) -> Result<Self, FluidError> {
        let owners = holding_conditions(mesh, model);
        let mut boundaries = Self {
            prescribed: vec![false; mesh.points().len() * (D + 1)],
            interface: Vec::new(),
            moved_interface: Vec::new(),
            wall_motion: Vec::new(),
            natural: natural::facets(mesh, model),
            slip: Vec::new(),
            mesh_prescribed: mesh_prescribed(mesh, model, settings)?,
            is_closed: !model.boundary.iter().any(|(_, condition)| condition.is_natural()),
            closed_walls: None,
            holds: Vec::new(),
        };
        for (node, owner) in owners.iter().enumerate() {
            if let Some(owner) = *owner {
                boundaries.hold(node, owner, model, settings);
            }
        }
        if boundaries.is_closed {
            let nodes = boundaries.wall_motion.iter().map(|(node, _)| *node);
            boundaries.closed_walls = ClosedWalls::new(mesh, nodes);
        }
        boundaries.slip = slip::nodes(mesh, model, |node| owners[node]);
        for slip in &boundaries.slip {
            for row in slip.held_rows() {
                boundaries.prescribed[slip.node * (D + 1) + row] = true;
            }
        }
        if let Some(pin) = settings.pressure_pin {
            boundaries.prescribed[pin.node * (D + 1) + D] = true;
        }
        Ok(boundaries)
    }

    fn hold(&mut self, node: usize, owner: usize, model: &FluidModel<D>, settings: &FluidSettings) {
        let (group, condition) = &model.boundary[owner];
        let hold = match condition {
            BoundaryCondition::Interface => {
                self.interface.push(node);
                self.moved_interface.push(node);
                Hold::Wall
            }
            BoundaryCondition::RigidInterface => {
                self.interface.push(node);
                Hold::Wall
            }
            BoundaryCondition::WallMotion(_) => {
                self.wall_motion.push((node, owner));
                Hold::Wall
            }
            BoundaryCondition::NoSlip if settings.mesh_slide.contains(group) => Hold::Still,
            BoundaryCondition::NoSlip => Hold::Wall,
            BoundaryCondition::Velocity(_) => Hold::Field(owner),
            BoundaryCondition::Slip
            | BoundaryCondition::Traction(_)
            | BoundaryCondition::DoNothing { .. }
            | BoundaryCondition::StressFree { .. } => return,
        };
        self.holds.push((node, hold));
        self.prescribed[node * (D + 1)..node * (D + 1) + D].fill(true);
    }

    /// The velocity at which the conditions hold a node while no boundary moves; `None` where they leave a direction free.
    pub(crate) fn held_at_rest(
        &self,
        model: &FluidModel<D>,
        node: usize,
        point: &[f64; D],
        time: f64,
    ) -> Option<[f64; D]> {
        let at = self.holds.binary_search_by_key(&node, |&(held, _)| held).ok()?;
        match self.holds[at].1 {
            Hold::Wall | Hold::Still => Some([0.0; D]),
            Hold::Field(owner) => match &model.boundary[owner].1 {
                BoundaryCondition::Velocity(field) => Some(field(point, time)),
                other => unreachable!("{other:?} holds no velocity field"),
            },
        }
    }

    /// Sets the prescribed entries of `values` at `time`, on the mesh with these `points` and velocities `w`.
    /// The frames of slip nodes are those of the same mesh.
    pub(crate) fn impose(
        &self,
        model: &FluidModel<D>,
        mesh: &MovedMesh<D>,
        frames: &Frames<D>,
        values: &mut [f64],
    ) -> Result<(), FluidError> {
        for &(node, hold) in &self.holds {
            let velocity = match hold {
                Hold::Wall => self.wall_velocity(mesh, node),
                Hold::Still => [0.0; D],
                Hold::Field(owner) => match &model.boundary[owner].1 {
                    BoundaryCondition::Velocity(field) => {
                        mesh.evaluate(field, node, "prescribed velocity")?
                    }
                    other => unreachable!("{other:?} holds no velocity field"),
                },
            };
            values[node * (D + 1)..node * (D + 1) + D].copy_from_slice(&velocity);
        }
        for (k, slip) in self.slip.iter().enumerate() {
            let velocity = &mut values[slip.node * (D + 1)..slip.node * (D + 1) + D];
            slip.impose(frames.rotation(k), &mesh.velocity_of(slip.node), velocity);
        }
        Ok(())
    }

    /// w, in a closed domain with the normal part that keeps the balance of volume.
    fn wall_velocity(&self, mesh: &MovedMesh<D>, node: usize) -> [f64; D] {
        let w = mesh.velocity_of(node);
        let Some(walls) = &self.closed_walls else { return w };
        let correction = walls.correction(node);
        std::array::from_fn(|c| w[c] + correction[c])
    }
}

/// The mesh at the end of a step.
pub(crate) struct MovedMesh<'a, const D: usize> {
    pub(crate) time: f64,
    pub(crate) points: &'a [[f64; D]],
    /// w, `node * D + c`.
    pub(crate) velocity: &'a [f64],
}

impl<const D: usize> MovedMesh<'_, D> {
    fn velocity_of(&self, node: usize) -> [f64; D] {
        std::array::from_fn(|c| self.velocity[node * D + c])
    }

    /// A field where a node is.
    pub(crate) fn evaluate(
        &self,
        field: &VectorField<D>,
        node: usize,
        what: &'static str,
    ) -> Result<[f64; D], FluidError> {
        evaluate(field, &self.points[node], self.time, what, node)
    }
}

/// A field at a point, refused where it is not finite.
pub(crate) fn evaluate<const D: usize>(
    field: &VectorField<D>,
    point: &[f64; D],
    time: f64,
    what: &'static str,
    node: usize,
) -> Result<[f64; D], FluidError> {
    let value = field(point, time);
    if value.iter().all(|x| x.is_finite()) {
        Ok(value)
    } else {
        Err(FluidError::NotFinite { time, what, node, place: Place::from(*point) })
    }
}

/// For each node the condition that holds it, by its place in the model's list: of the highest rank (see
/// [`FluidModel::boundary`]), among equals the first listed. Groups that the mesh does not have are passed over.
#[must_use]
pub fn holding_conditions<const D: usize>(mesh: &Mesh<D>, model: &FluidModel<D>) -> Vec<Option<usize>> {
    let mut owners: Vec<Option<usize>> = vec![None; mesh.points().len()];
    let rank = |index: usize| model.boundary[index].1.rank();
    for (index, (group, _)) in model.boundary.iter().enumerate() {
        for node in mesh.group_nodes(group).unwrap_or_default() {
            if owners[node].is_none_or(|owner| rank(index) > rank(owner)) {
                owners[node] = Some(index);
            }
        }
    }
    owners
}

fn mesh_prescribed<const D: usize>(
    mesh: &Mesh<D>,
    model: &FluidModel<D>,
    settings: &FluidSettings,
) -> Result<Option<Vec<bool>>, FluidError> {
    if !model.boundary.iter().any(|(_, condition)| condition.moves()) {
        return Ok(None);
    }
    let slide: Vec<&str> = settings.mesh_slide.iter().map(String::as_str).collect();
    Ok(Some(prescribed_dofs(mesh, &slide)?))
}
