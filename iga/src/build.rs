//! Splines for simple shapes.

use crate::knots::{KnotError, Knots};
use crate::spline::{Spline, SplineError};

/// A rectangle with its sides along the axes, as a plane patch.
///
/// `origin` is the corner at the start of both parameters, `size` the extent along x and y, `degree` and `elements`
/// are given for each direction. The parameters run from 0 to 1 and the map from them is affine.
///
/// # Errors
/// When the origin is not finite, an extent not positive and finite, or a degree or a number of elements is zero.
///
/// ```
/// use partita_iga::build;
///
/// let patch = build::rectangle([1.0, 0.0], [2.0, 0.5], [3, 2], [10, 2])?;
/// assert_eq!(patch.element_count(), 20);
/// let [x, y] = patch.point(&[0.25, 0.5]);
/// assert!((x - 1.5).abs() < 1e-15 && (y - 0.25).abs() < 1e-15);
/// # Ok::<(), build::BuildError>(())
/// ```
pub fn rectangle(
    origin: [f64; 2],
    size: [f64; 2],
    degree: [usize; 2],
    elements: [usize; 2],
) -> Result<Spline<2>, BuildError> {
    if let Some(&extent) = size.iter().find(|extent| !(extent.is_finite() && **extent > 0.0)) {
        return Err(BuildError::Extent { extent });
    }
    let knots = [Knots::uniform(degree[0], elements[0])?, Knots::uniform(degree[1], elements[1])?];
    let [along, across] = [knots[0].greville(), knots[1].greville()];
    let place = |eta: f64, xi: f64| [origin[0] + xi * size[0], origin[1] + eta * size[1]];
    let control_points = across.iter().flat_map(|&eta| along.iter().map(move |&xi| place(eta, xi))).collect();
    Ok(Spline::new(knots.to_vec(), control_points)?)
}

/// Why a shape cannot be built.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum BuildError {
    /// A length, radius or thickness is not positive.
    #[error(
        "a shape of extent {extent} does not exist\nhint: lengths and radii are positive, finite numbers"
    )]
    Extent {
        /// The length given.
        extent: f64,
    },
    /// The degree or the number of elements does not make a knot vector.
    #[error(transparent)]
    Knots(#[from] KnotError),
    /// A position is not finite.
    #[error(transparent)]
    Spline(#[from] SplineError),
}
