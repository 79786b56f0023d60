//! Nonlinear elastodynamics: Total Lagrangian solids on one NURBS patch or a Lagrange mesh, generalized-alpha or Newmark
//! in time.
//!
//! ```text
//! rho d_tt = Div P + b,   P = F S,   S = S(E),   E = (F^T F - I)/2
//! ```
//!
//! | module | what it holds |
//! |---|---|
//! | [`material`] | stress and tangent from the displacement gradient |
//! | [`conformance`] | a check for everybody who writes a material |
//! | [`kernel`] | the element: internal force, tangent, mass, energies |
//! | [`space`], [`patch`], [`elements`] | geometry and displacement space; shape functions tabulated once |
//! | `boundary`, `wetted` | names of its parts; their elements and ends |
//! | [`interface`] | interpolation weights of points outside |
//! | [`support`], [`rigid`] | what is held; pieces that still move without deforming |
//! | `assembly`, `factor` | global forces and tangent; its symmetric factor |
//! | [`load`] | body force, interface forces |
//! | [`step`], [`state`] | time integration; what goes from step to step |
//! | [`model`] | properties, supports, settings |
//! | [`solver`], `newton`, `probe` | [`StructureSolver`]: the steps, the nonlinear system, what to read off |
//!
//! Nodes are the control points of a patch, those on a seam joined, or the nodes of a mesh. Fields over them are flat, `node * D + c`; those over
//! the interface `point * D + c`, in the order of [`StructureSolver::interface_points`]. Units are SI; in the plane, forces and energies are per metre
//! of depth.

pub mod body_force;
mod boundary;
pub mod conformance;
pub mod elements;
pub mod error;
pub mod interface;
pub mod kernel;
pub mod load;
pub mod material;
pub mod model;
pub mod patch;
pub mod rigid;
pub mod solver;
pub mod space;
pub mod state;
pub mod step;
pub mod support;

mod assembly;
mod factor;
mod field;
mod modes;
mod newton;
mod probe;
mod tensor;
mod wetted;

pub use body_force::{BodyForce, VectorField};
pub use boundary::Boundary;
pub use error::StructureError;
pub use interface::Segment;
pub use material::{
    AnyMaterial, Constitutive, Law, Material, MaterialError, Plane, PlaneStrain, PlaneStress, Response,
    ResponseError,
};
pub use model::{LineSearch, Rayleigh, StructureModel, StructureSettings};
pub use modes::Mode;
pub use partita_numerics::Field;
pub use patch::Patch;
pub use solver::StructureSolver;
pub use space::Space;
pub use state::StructureState;
pub use step::TimeScheme;
pub use support::Held;
