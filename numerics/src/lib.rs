//! What the fields of Partita share, and nothing that knows a field.
//!
//! A solver of one field builds these once and keeps them for the run:
//!
//! ```text
//! elements ── Connectivity ─┐
//!                           ├─ Pattern ── Scatter      element matrices -> value slots
//! conditions ── DofMap ─────┘      └───── Factor       symbolic once, refactor and solve in place
//! ```
//!
//! Each Newton iteration then fills the values through [`Scatter`], refactors, solves and adds the
//! increment through [`DofMap`]; [`newton::solve`] is the loop around it. None of these steps allocates
//! (the one exception is named in [`Factor`]).
//!
//! | module | what it holds |
//! |---|---|
//! | [`connectivity`] | which dofs each element touches |
//! | [`dofs`] | free and prescribed dofs |
//! | [`pattern`] | the sparsity pattern of the free equations |
//! | [`scatter`] | element matrices and vectors into global ones |
//! | [`factor`] | sparse LU, Cholesky and LDL^T behind one type |
//! | [`newton`] | the Newton loop, its settings, its report |
//! | [`field`] | what every field can do, step after step |
//! | [`time`] | coefficients of BDF1, BDF2, generalized-alpha and Newmark |
//! | [`gauss`] | quadrature on lines, triangles and tetrahedra |
//! | [`lanes`] | formulas for several numbers side by side |
//! | [`small`] | algebra of 1x1, 2x2 and 3x3 matrices |
//! | [`norms`] | norms and relative changes |
//! | [`phases`] | seconds per phase of a solver call |
//! | [`rates`] | fitted orders of convergence |
//!
//! Conventions: indices are `usize`, scalars `f64`, units SI wherever a quantity has one. A slice of the
//! wrong length is a developer's error and panics; a numerical failure is an `Err` that names its place.

pub mod connectivity;
pub mod dofs;
pub mod factor;
pub mod field;
pub mod gauss;
pub mod lanes;
pub mod newton;
pub mod norms;
pub mod pattern;
pub mod phases;
mod place;
pub mod rates;
pub mod scatter;
pub mod small;
pub mod time;

pub use connectivity::Connectivity;
pub use dofs::DofMap;
pub use factor::{Factor, FactorError, Method};
pub use field::{Field, Part};
pub use pattern::Pattern;
pub use phases::PhaseSeconds;
pub use place::Place;
pub use scatter::Scatter;
