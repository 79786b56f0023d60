//! A plain text for splines, to be written by a person or another program: the spline file.
//!
//! A spline file is TOML. It holds one spline of up to three parameters:
//!
//! ```toml
//! format = "partita-spline"
//! version = 1
//! dimension = 2                     # coordinates of a control point
//! degrees = [1, 2]                  # one for each parameter
//! knots = [
//!     [0.0, 0.0, 1.0, 1.0],         # one open knot vector for each parameter
//!     [0.0, 0.0, 0.0, 1.0, 1.0, 1.0],
//! ]
//! control_points = [                # along the first parameter first
//!     [1.0, 0.0], [1.5, 0.0],
//!     [1.0, 1.0], [1.5, 1.5],
//!     [0.0, 1.0], [0.0, 1.5],
//! ]
//! weights = [1.0, 1.0, 0.7071, 0.7071, 1.0, 1.0]
//! ```
//!
//! | key              | what                                                                                        |
//! |------------------|---------------------------------------------------------------------------------------------|
//! | `format`         | always `"partita-spline"`                                                                   |
//! | `version`        | of the format: 1                                                                            |
//! | `dimension`      | number of coordinates of a control point                                                    |
//! | `degrees`        | of each parameter, at least 1                                                               |
//! | `knots`          | of each parameter, as [`Knots`](crate::Knots) wants them: both ends `degree + 1` times      |
//! | `control_points` | product of the numbers of basis functions, those along the first parameter next to each other |
//! | `weights`        | in the order of the control points; may be left out where all are 1                         |
//!
//! A parameter of degree `p` with `k` knots has `n = k - p - 1` basis functions. With `n_0, n_1, n_2` of them, control
//! point `(i, j, k)` stands at place `i + n_0 (j + n_1 k)`. Coordinates have whatever unit of length their user means;
//! Partita's scenes mean m.
//!
//! The module works on text; opening files is the caller's business. What [`to_toml`] writes [`from_toml`] reads back to
//! the last bit.

mod error;
mod format;
mod read;
mod write;

pub use error::{Fault, FileError};
pub use format::{FORMAT, VERSION};

use crate::spline::Spline;

/// The text of a spline's file.
///
/// Weights are written where one of them is not 1.
///
/// ```
/// use partita_iga::{build, file};
///
/// let ring = build::quarter_annulus(1.0, 1.5)?;
/// let text = file::to_toml(&ring);
/// assert!(text.contains("degrees = [1, 2]"));
/// assert_eq!(file::from_toml(&text)?, ring);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[must_use]
pub fn to_toml<const D: usize>(spline: &Spline<D>) -> String {
    write::spline(spline)
}

/// The spline in the text of a file.
///
/// A byte order mark at the start and line ends of either kind are fine. Nothing that is read is as large as the text
/// says: sizes follow from what is there.
///
/// # Errors
/// When the text is not TOML, has another format or version, lacks a key or has one too many, holds a spline in another
/// dimension than `D`, or one that [`Knots`](crate::Knots) or [`Spline`] refuses. The error knows its place in the text.
///
/// ```
/// use miette::Diagnostic;
/// use partita_iga::file;
///
/// let text = "\
///     format = 'partita-spline'\n\
///     version = 1\n\
///     dimension = 2\n\
///     degrees = [1]\n\
///     knots = [[0.0, 0.0, 0.5, 0.4, 1.0, 1.0]]\n\
///     control_points = [[0, 0], [1, 0], [2, 0], [3, 1]]\n";
/// let error = file::from_toml::<2>(text).unwrap_err();
/// assert_eq!(error.line(), 5);
/// assert_eq!(&text[error.span()], "0.4");
/// assert_eq!(error.to_string(), "line 5, knots[0]: knot 3 is 0.4, smaller than 0.5 before it");
/// assert_eq!(error.help().unwrap().to_string(), "list the knots in ascending order");
/// ```
pub fn from_toml<const D: usize>(text: &str) -> Result<Spline<D>, FileError> {
    read::spline(text)
}
