//! What is solved: properties, loads, boundary conditions and initial state of a fluid, as data.

use std::fmt;
use std::sync::Arc;

/// A vector field of place `[m]` and time `[s]`.
pub type VectorField<const D: usize> = Arc<dyn Fn(&[f64; D], f64) -> [f64; D] + Send + Sync>;

/// An incompressible Newtonian fluid and what acts on it.
#[derive(Debug, Clone)]
pub struct FluidModel<const D: usize> {
    /// rho `[kg/m^3]`, positive.
    pub density: f64,
    /// mu `[Pa s]`, not negative; positive for a steady flow.
    pub viscosity: f64,
    /// b `[m/s^2]`.
    pub body_force: BodyForce<D>,
    /// One condition for each boundary group of the mesh, by its name.
    ///
    /// At a node between groups the condition that holds more wins: interface, wall motion, no-slip,
    /// prescribed velocity, slip, and last the natural conditions. Walls win over an inflow, so a profile need
    /// not vanish at their corner. Among equals the one listed first wins.
    pub boundary: Vec<(String, BoundaryCondition<D>)>,
    /// Velocity at t = 0.
    pub initial: InitialState<D>,
}

impl<const D: usize> FluidModel<D> {
    /// A fluid at rest under no force, of a density `[kg/m^3]` and a viscosity `[Pa s]`, with a condition for each boundary
    /// group.
    #[must_use]
    pub fn new<'a>(
        density: f64,
        viscosity: f64,
        boundary: impl IntoIterator<Item = (&'a str, BoundaryCondition<D>)>,
    ) -> Self {
        let boundary = boundary.into_iter().map(|(group, condition)| (group.to_owned(), condition)).collect();
        let body_force = BodyForce::Constant([0.0; D]);
        Self { density, viscosity, body_force, boundary, initial: InitialState::Rest }
    }
}

/// A force per mass `[m/s^2]`.
#[derive(Clone)]
pub enum BodyForce<const D: usize> {
    /// The same everywhere and always: gravity.
    Constant([f64; D]),
    /// A field, interpolated at the nodes where they are.
    Field(VectorField<D>),
}

/// Where a fluid starts.
#[derive(Clone)]
pub enum InitialState<const D: usize> {
    /// Zero velocity and pressure.
    Rest,
    /// This velocity `[m/s]` at t = 0, and zero pressure.
    Velocity(VectorField<D>),
}

/// What holds on one boundary group. `w` is the velocity of the mesh.
#[derive(Clone)]
pub enum BoundaryCondition<const D: usize> {
    /// u given `[m/s]`, evaluated where the node is.
    Velocity(VectorField<D>),
    /// u = w. On a group whose mesh nodes slide, the wall stands still and u = 0.
    NoSlip,
    /// A wall with a given displacement from the reference mesh `[m]`, evaluated at the reference point; u = w. Where no
    /// boundary lets the fluid out, u differs from w by what keeps the balance of volume, O(dt^order), and the motion must
    /// keep the volume.
    WallMotion(VectorField<D>),
    /// u.n = w.n and no tangential stress, on walls of any direction: the unknowns of a node are turned into
    /// normal and tangents, with the normal `sum over facets of (N_a, n)` of the present mesh. Where facets
    /// meet at an angle above [`SLIP_CORNER`], each side holds its own normal component.
    Slip,
    /// (-p I + mu (grad u + grad u^T)) n = h `[Pa]` given, evaluated where the node is.
    Traction(VectorField<D>),
    /// -p n + mu (grad u) n = 0: a developed channel flow leaves undisturbed.
    DoNothing {
        /// Take out the energy that enters where the flow returns.
        backflow: bool,
    },
    /// (-p I + mu (grad u + grad u^T)) n = 0.
    StressFree {
        /// Take out the energy that enters where the flow returns.
        backflow: bool,
    },
    /// A boundary whose displacement another field gives, see
    /// [`FluidSolver::impose`](partita_numerics::Field::impose); u = w.
    Interface,
    /// A wall that stands still whose forces another field is given, so that nothing comes back from there; u = 0.
    RigidInterface,
}

/// Facets of slip walls whose normals differ by more than this angle `[rad]` form a corner: 40 degrees, between
/// the facets of a coarsely meshed curve and the corners of a body.
pub const SLIP_CORNER: f64 = 40.0 * std::f64::consts::PI / 180.0;

impl<const D: usize> BoundaryCondition<D> {
    /// The order of precedence at a node between groups.
    pub(crate) fn rank(&self) -> u8 {
        match self {
            Self::Interface | Self::RigidInterface => 5,
            Self::WallMotion(_) => 4,
            Self::NoSlip => 3,
            Self::Velocity(_) => 2,
            Self::Slip => 1,
            Self::Traction(_) | Self::DoNothing { .. } | Self::StressFree { .. } => 0,
        }
    }

    /// Whether the normal velocity is left to the flow, so that the pressure level is not.
    pub(crate) fn is_natural(&self) -> bool {
        self.rank() == 0
    }

    /// Whether another field is on the other side.
    pub(crate) fn is_interface(&self) -> bool {
        matches!(self, Self::Interface | Self::RigidInterface)
    }

    /// Whether the condition moves the boundary.
    pub(crate) fn moves(&self) -> bool {
        matches!(self, Self::Interface | Self::WallMotion(_))
    }
}

impl<const D: usize> fmt::Debug for BoundaryCondition<D> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Velocity(_) => f.write_str("Velocity(..)"),
            Self::NoSlip => f.write_str("NoSlip"),
            Self::WallMotion(_) => f.write_str("WallMotion(..)"),
            Self::Slip => f.write_str("Slip"),
            Self::Traction(_) => f.write_str("Traction(..)"),
            Self::DoNothing { backflow } => write!(f, "DoNothing {{ backflow: {backflow} }}"),
            Self::StressFree { backflow } => write!(f, "StressFree {{ backflow: {backflow} }}"),
            Self::Interface => f.write_str("Interface"),
            Self::RigidInterface => f.write_str("RigidInterface"),
        }
    }
}

impl<const D: usize> fmt::Debug for BodyForce<D> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Constant(b) => write!(f, "Constant({b:?})"),
            Self::Field(_) => f.write_str("Field(..)"),
        }
    }
}

impl<const D: usize> fmt::Debug for InitialState<D> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Rest => f.write_str("Rest"),
            Self::Velocity(_) => f.write_str("Velocity(..)"),
        }
    }
}
