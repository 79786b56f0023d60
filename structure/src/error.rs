//! How a structure fails.

use partita_iga::Side;
use partita_numerics::FactorError;
use partita_numerics::field::StateMismatch;
use partita_numerics::time::{self, NewmarkError, SpectralRadiusError};

use crate::material::ResponseError;

/// A place with six digits a coordinate: `(0.333333, 0) m`.
pub(crate) fn shown(place: &[f64]) -> String {
    let short = |x: &f64| format!("{x:.5e}").parse().unwrap_or(*x).to_string();
    format!("({}) m", place.iter().map(short).collect::<Vec<_>>().join(", "))
}

/// A structure that cannot be built, solved or restored.
#[derive(Debug, Clone, PartialEq, thiserror::Error, miette::Diagnostic)]
pub enum StructureError {
    /// The density is not a positive number.
    #[error("the density is {value} kg/m^3")]
    #[diagnostic(help("it must be positive and finite"))]
    Density {
        /// The value given.
        value: f64,
    },
    /// A damping factor is negative or not finite.
    #[error("the Rayleigh factors are {mass} 1/s and {stiffness} s")]
    #[diagnostic(help("both must be finite and not negative"))]
    Damping {
        /// Factor of the mass `[1/s]`.
        mass: f64,
        /// Factor of the stiffness `[s]`.
        stiffness: f64,
    },
    /// The settings of the line search make no search.
    #[error("a line search with tolerance {tolerance} and at most {max_evaluations} evaluations cannot work")]
    #[diagnostic(help(
        "the tolerance lies between 0 and 1 (0.8 is common), and one evaluation is the least"
    ))]
    LineSearch {
        /// The tolerance given.
        tolerance: f64,
        /// The number of evaluations given.
        max_evaluations: usize,
    },
    /// The spectral radius of generalized-alpha is out of range.
    #[error(transparent)]
    #[diagnostic(transparent)]
    SpectralRadius(#[from] SpectralRadiusError),
    /// The parameters of Newmark's method are not stable at every step size.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Newmark(#[from] NewmarkError),
    /// Plane stress was asked for in three dimensions.
    #[error("plane stress has no meaning in three dimensions")]
    #[diagnostic(help("leave the plane assumption at `strain`"))]
    PlaneStressInSpace,
    /// A material cannot say what stress it has where nothing is deformed.
    #[error("material `{material}`: it has no stress at rest: {source}")]
    #[diagnostic(help(
        "at rest every law must have a stress and a tangent; `partita_structure::conformance::check_material` looks at both"
    ))]
    NoStressAtRest {
        /// Its name.
        material: String,
        /// What it says.
        source: ResponseError,
    },
    /// The patch does not fill the space it lies in.
    #[error("a patch of {parameters} parameters is no solid in {dimensions} dimensions")]
    #[diagnostic(help("a plane solid is a surface, a solid in space a volume"))]
    NotASolid {
        /// Parameters of the patch.
        parameters: usize,
        /// Dimensions of the space.
        dimensions: usize,
    },
    /// A side was named that the patch does not have.
    #[error("the patch has no side `{side}`")]
    #[diagnostic(help("a plane patch has left, right, bottom and top"))]
    NoSuchSide {
        /// The side asked for.
        side: Side,
    },
    /// A side was named that is not on the boundary: the patch is closed there.
    #[error(
        "the sides `{side}` and `{partner}` of the patch lie on each other and are joined, so that `{side}` is no part of \
         the boundary"
    )]
    #[diagnostic(help("name a side that is, or leave a gap between the two"))]
    JoinedSide {
        /// The side asked for.
        side: Side,
        /// The side it is joined with.
        partner: Side,
    },
    /// A boundary group was named that the mesh does not have.
    #[error("the mesh has no boundary group `{group}`")]
    #[diagnostic(help("it has {known}"))]
    NoSuchGroup {
        /// The group asked for.
        group: String,
        /// Names of all groups.
        known: String,
    },
    /// A boundary group was asked of a patch.
    #[error("a patch has no boundary group `{group}`")]
    #[diagnostic(help("it has sides: left, right, bottom and top"))]
    GroupOfPatch {
        /// The group asked for.
        group: String,
    },
    /// A side was asked of a mesh.
    #[error("a mesh has no side `{side}`")]
    #[diagnostic(help("it has boundary groups: {known}"))]
    SideOfMesh {
        /// The side asked for.
        side: Side,
        /// Names of all groups.
        known: String,
    },
    /// A point cannot be tied to the wetted sides of the patch.
    #[error(transparent)]
    #[diagnostic(transparent)]
    OffPatch(#[from] partita_iga::transfer::TransferError),
    /// A point cannot be tied to the wetted groups of the mesh.
    #[error(transparent)]
    #[diagnostic(transparent)]
    OffMesh(#[from] partita_mesh::solid::transfer::TransferError),
    /// The reference configuration is folded or degenerate at a quadrature point.
    #[error("element {element} is inverted near {place:?} m: the determinant of its map is {determinant:e}")]
    #[diagnostic(help(
        "the parameters of a patch are right-handed and its control points do not cross over"
    ))]
    Inverted {
        /// The element, the first parameter runs fastest.
        element: usize,
        /// The quadrature point `[m]`.
        place: Vec<f64>,
        /// Determinant of dx/dxi there.
        determinant: f64,
    },
    /// The material has no stress for the deformation at a quadrature point.
    #[error("element {element} is deformed too far near {place:?} m (undeformed): {source}")]
    #[diagnostic(help("take smaller steps in time or load, switch the line search on, or refine there"))]
    DeformedTooFar {
        /// The element.
        element: usize,
        /// The quadrature point in the reference configuration `[m]`.
        place: Vec<f64>,
        /// What is wrong there.
        source: ResponseError,
    },
    /// A converged deformation turns matter inside out, which the material law does not notice.
    #[error("element {element} near {} is turned inside out: det F = {determinant:.3e}", shown(place))]
    #[diagnostic(help(
        "the load is too large for this material, or for one step; St. Venant-Kirchhoff gives way under strong \
         compression"
    ))]
    Folded {
        /// The element, the first parameter runs fastest.
        element: usize,
        /// The quadrature point in the reference configuration `[m]`.
        place: Vec<f64>,
        /// Determinant of the deformation gradient there.
        determinant: f64,
    },
    /// Nothing is left to move.
    #[error("every node is held in all directions")]
    #[diagnostic(help("leave a part of the boundary free, or refine the patch or mesh"))]
    NothingFree,
    /// The tangent could not be factored.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Factor(#[from] FactorError),
    /// A saved state belongs to another structure.
    #[error("{0}")]
    #[diagnostic(help(
        "continue a run with the patch or mesh and the parts of its boundary it was started with"
    ))]
    StateOfAnotherStructure(#[from] StateMismatch),
    /// A time step that is not one.
    #[error("time step {dt} s to t = {} s", time::shown(*time))]
    #[diagnostic(help("time steps are positive and finite"))]
    TimeStep {
        /// The end of the step `[s]`.
        time: f64,
        /// Its size `[s]`.
        dt: f64,
    },
}
