//! What can be wrong with a fluid, where, and what to do about it.

use partita_mesh::Place;
use partita_mesh::motion::MotionError;
use partita_numerics::FactorError;
use partita_numerics::field::StateMismatch;
use partita_numerics::time::shown;

/// Why a fluid cannot be set up or advanced.
#[derive(Debug, Clone, PartialEq, thiserror::Error, miette::Diagnostic)]
pub enum FluidError {
    /// A property outside its range.
    #[error("fluid: {name} {value} {unit} is out of range")]
    #[diagnostic(help("{range}"))]
    Property {
        /// Which one.
        name: &'static str,
        /// As given.
        value: f64,
        /// Its unit.
        unit: &'static str,
        /// What it must be.
        range: &'static str,
    },
    /// A condition for a boundary group that the mesh does not have.
    #[error("fluid: the mesh has no boundary group `{group}`")]
    #[diagnostic(help("its groups are {known}"))]
    UnknownGroup {
        /// As given.
        group: String,
        /// The names there are.
        known: String,
    },
    /// Two conditions for one boundary group.
    #[error("fluid: boundary group `{group}` has two conditions")]
    #[diagnostic(help("remove one of them"))]
    TwoConditions {
        /// The group.
        group: String,
    },
    /// A boundary group without condition.
    #[error("fluid: boundary group `{group}` has no condition")]
    #[diagnostic(help("give it one; a boundary where the fluid may leave without stress is `StressFree`"))]
    NoCondition {
        /// The group.
        group: String,
    },
    /// Boundary facets without a group.
    #[error("fluid: {count} boundary facets belong to no group, the first at {place}")]
    #[diagnostic(help("every boundary facet needs a group and each group a condition"))]
    UngroupedBoundary {
        /// How many.
        count: usize,
        /// Centroid of the first one.
        place: Place,
    },
    /// Mesh nodes shall slide along a boundary that moves.
    #[error("fluid: boundary group `{group}` moves, its mesh nodes cannot slide")]
    #[diagnostic(help("let the mesh slide along the walls beside it"))]
    SlidesAndMoves {
        /// The group.
        group: String,
    },
    /// Velocity is prescribed all round: the pressure has no level.
    #[error(
        "fluid: every boundary prescribes the normal velocity, so pressure is known only up to a constant"
    )]
    #[diagnostic(help("pin the pressure of one node, or make one boundary an outflow or a traction"))]
    PressureLevel,
    /// Velocity is prescribed all round, and another field moves the boundary.
    #[error(
        "fluid: boundary group `{group}` moves with a structure, and every boundary prescribes the normal velocity: \
         an incompressible fluid admits only motions that keep its volume, and the iterates of an elastic structure \
         do not"
    )]
    #[diagnostic(help("make one boundary an outflow or a traction"))]
    ClosedAndMoving {
        /// The first group that moves so.
        group: String,
    },
    /// A pressure pin where the pressure has a level.
    #[error(
        "fluid: a pressure pin is given, but boundary group `{group}` already fixes the level of pressure"
    )]
    #[diagnostic(help("remove the pin"))]
    NeedlessPin {
        /// A group with a natural condition.
        group: String,
    },
    /// A pressure pin at a node that does not exist.
    #[error("fluid: pressure pin at node {node}, but there are only {nodes} nodes (counted from 0)")]
    #[diagnostic(help("0 will do"))]
    PinOutOfRange {
        /// As given.
        node: usize,
        /// How many there are.
        nodes: usize,
    },
    /// Prescribed velocities and motions do not keep the volume.
    #[error("t = {} s, fluid: {what} carry a net {net:.3e} m^{dimension}/s out of a closed domain \
         ({gross:.3e} m^{dimension}/s pass its boundary)", shown(*time), what = if *.moves { "moving walls and prescribed velocities" } else { "prescribed velocities" })]
    #[diagnostic(help("make one boundary an outflow or a traction, or {balance}", balance = if *.moves {
            "let the walls enclose the same volume at all times"
        } else {
            "balance inflow and outflow edge by edge"
        }))]
    NetFlux {
        /// When `[s]`.
        time: f64,
        /// Outward flux.
        net: f64,
        /// The sum of the absolute fluxes of the facets.
        gross: f64,
        /// Whether walls move.
        moves: bool,
        /// 2 or 3.
        dimension: usize,
    },
    /// A time step that is not one.
    #[error("fluid: time step {dt} s to t = {} s", shown(*time))]
    #[diagnostic(help("time steps are positive and finite"))]
    TimeStep {
        /// The end of the step `[s]`.
        time: f64,
        /// Its size `[s]`.
        dt: f64,
    },
    /// A prescribed value that is infinite or not a number.
    #[error("t = {} s, fluid: the {what} at node {node}, {place}, is not finite", shown(*time))]
    #[diagnostic(help("check its expression there"))]
    NotFinite {
        /// When `[s]`.
        time: f64,
        /// Which value.
        what: &'static str,
        /// The node.
        node: usize,
        /// Where it is.
        place: Place,
    },
    /// The mesh could not follow its boundary.
    #[error("t = {} s, fluid: {source}", shown(*time))]
    #[diagnostic(forward(source))]
    Motion {
        /// When `[s]`.
        time: f64,
        /// Why.
        source: MotionError,
    },
    /// Mesh motion could not be set up.
    #[error("fluid: {0}")]
    #[diagnostic(transparent)]
    MotionSetup(#[from] MotionError),
    /// The tangent could not be factored.
    #[error("t = {} s, fluid: {source}", shown(*time))]
    #[diagnostic(forward(source))]
    Factorization {
        /// When `[s]`.
        time: f64,
        /// Why.
        source: FactorError,
    },
    /// The pattern of the tangent could not be analysed.
    #[error("fluid: {0}")]
    #[diagnostic(transparent)]
    FactorSetup(#[from] FactorError),
    /// A state of another fluid.
    #[error("fluid: {0}")]
    #[diagnostic(help("states fit only the mesh they were saved from"))]
    StateOfAnotherFluid(#[from] StateMismatch),
}
