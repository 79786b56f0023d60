//! B-splines and NURBS of any number of parameters.
//!
//! One type, [`Spline<D>`](Spline), is a curve, a surface or a volume in `D` dimensions: the tensor product of
//! validated [`Knots`], control points and positive weights. Its [`side`](Spline::side) is a `Spline<D>` with one
//! parameter less, so whatever works on a surface works on its edges.
//!
//! ```
//! use partita_iga::{BasisValues, Derivatives, build};
//!
//! // A plate of 2 m x 0.1 m: quadratic, 8 elements along, 1 across.
//! let plate = build::rectangle([0.0, 0.0], [2.0, 0.1], [2, 2], [8, 1])?;
//! assert_eq!(plate.control_points().len(), 10 * 3);
//!
//! // Basis functions and their derivatives go into a workspace that is allocated once.
//! let mut basis = BasisValues::new(&plate);
//! for element in plate.elements() {
//!     let xi = element.at([0.5, 0.5]);
//!     plate.basis(&xi, Derivatives::First, &mut basis);
//!     assert_eq!(basis.active(), plate.active_on(element.index()));
//! }
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod basis;
pub mod bspline;
pub mod build;
mod element;
mod evaluate;
pub mod file;
pub mod fit;
mod knots;
mod nearest;
pub mod nurbs;
pub mod orientation;
pub mod project;
mod refine;
pub mod seam;
mod side;
mod spline;
pub mod transfer;

pub use basis::{BasisValues, Derivatives};
pub use element::Element;
pub use knots::{KnotError, Knots};
pub use side::{End, Side, UnknownSide};
pub use spline::{MAX_PARAMETERS, Spline, SplineError};

/// Runs the example of the README.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
