//! Splines for simple shapes.

mod round;
mod ruled;
mod strip;

pub use round::{annular_sector, arc, circle, quarter_annulus};
pub use ruled::ruled;
pub use strip::{Alignment, strip};

use crate::fit::FitError;
use crate::knots::{KnotError, Knots};
use crate::spline::{Spline, SplineError};

/// A straight line from `start` to `end`, run through at constant speed by a parameter from 0 to 1.
///
/// # Errors
/// When a coordinate is not finite, or the degree or the number of elements is zero.
///
/// ```
/// let line = partita_iga::build::line([0.0, 1.0, 0.0], [4.0, 1.0, 2.0], 3, 5)?;
/// assert_eq!(line.point(&[1.0]), [4.0, 1.0, 2.0]);
/// # Ok::<(), partita_iga::build::BuildError>(())
/// ```
pub fn line<const D: usize>(
    start: [f64; D],
    end: [f64; D],
    degree: usize,
    elements: usize,
) -> Result<Spline<D>, BuildError> {
    let knots = Knots::uniform(degree, elements)?;
    let place = |xi: f64| std::array::from_fn(|c| (1.0 - xi) * start[c] + xi * end[c]);
    let control_points = knots.greville().into_iter().map(place).collect();
    Ok(Spline::new(vec![knots], control_points)?)
}

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
    block(origin, size, degree, elements)
}

/// A cuboid with its edges along the axes: [`rectangle`] with one direction more.
///
/// # Errors
/// As for [`rectangle`].
pub fn cuboid(
    origin: [f64; 3],
    size: [f64; 3],
    degree: [usize; 3],
    elements: [usize; 3],
) -> Result<Spline<3>, BuildError> {
    block(origin, size, degree, elements)
}

/// A box in `D` dimensions; control points at the Greville abscissae make the map affine.
fn block<const D: usize>(
    origin: [f64; D],
    size: [f64; D],
    degree: [usize; D],
    elements: [usize; D],
) -> Result<Spline<D>, BuildError> {
    size.into_iter().try_for_each(check_extent)?;
    let mut knots = Vec::with_capacity(D);
    let mut control_points = vec![origin];
    for c in 0..D {
        let along = Knots::uniform(degree[c], elements[c])?;
        let place = |xi: f64, mut point: [f64; D]| {
            point[c] += xi * size[c];
            point
        };
        let greville = along.greville();
        control_points =
            greville.iter().flat_map(|&xi| control_points.iter().map(move |&p| place(xi, p))).collect();
        knots.push(along);
    }
    Ok(Spline::new(knots, control_points)?)
}

/// A patch that is linear in its second parameter, with another degree and more elements there.
fn refined_across(patch: &Spline<2>, degree: usize, elements: usize) -> Result<Spline<2>, BuildError> {
    let elevation = degree.checked_sub(1).ok_or(KnotError::DegreeZero)?;
    Ok(patch.elevate_degree(1, elevation).subdivide(1, elements)?)
}

fn check_extent(extent: f64) -> Result<(), BuildError> {
    if extent.is_finite() && extent > 0.0 { Ok(()) } else { Err(BuildError::Extent { extent }) }
}

/// Why a shape cannot be built.
#[derive(Clone, Debug, PartialEq, thiserror::Error, miette::Diagnostic)]
pub enum BuildError {
    /// A length, radius or thickness is not positive.
    #[error("a shape of extent {extent} does not exist")]
    #[diagnostic(help("lengths and radii are positive, finite numbers"))]
    Extent {
        /// The length given.
        extent: f64,
    },
    /// An arc that is empty or overlaps itself.
    #[error("an arc cannot sweep {sweep} rad")]
    #[diagnostic(help("take an angle up to a full turn, 2 pi rad, other than zero"))]
    Sweep {
        /// The angle given, in rad.
        sweep: f64,
    },
    /// A degree below that of a circle.
    #[error("an arc of degree {degree} is not round")]
    #[diagnostic(help("a circle needs a degree of at least 2 along the arc"))]
    ArcDegree {
        /// The degree given.
        degree: usize,
    },
    /// Fewer elements than the shape has pieces.
    #[error("{found} elements are too few along this shape")]
    #[diagnostic(help(
        "take {needed} or more, because each joint of its pieces is \
         the end of an element; a curve through fewer points has fewer joints"
    ))]
    TooFewElements {
        /// Number of elements asked for.
        found: usize,
        /// Least number.
        needed: usize,
    },
    /// Two splines that do not run alike.
    #[error("a ruled spline needs sides with the same knots, and those of parameter {parameter} differ")]
    #[diagnostic(help(
        "bring the sides to the same degree with `elevate_degree` and to the same knots with `insert_knots`"
    ))]
    Unlike {
        /// The first parameter in which they differ.
        parameter: usize,
    },
    /// Not a curve.
    #[error("a strip runs along a curve, and this spline has {parameters} parameters")]
    #[diagnostic(help("give a curve"))]
    NotACurve {
        /// Number of parameters found.
        parameters: usize,
    },
    /// A curve that stands still, turns back or has a corner.
    #[error("the curve has no direction at its parameter {parameter}, near {place:?}")]
    #[diagnostic(help(
        "a strip needs a curve without \
         corners, cusps and points where it stands still"
    ))]
    NoDirection {
        /// The parameter.
        parameter: f64,
        /// The point there.
        place: [f64; 2],
    },
    /// A strip thicker than its curve is curved.
    #[error(
        "a strip of thickness {thickness} folds over itself at the parameter {parameter} of its curve, near {place:?}, \
         where the radius of curvature is {radius}"
    )]
    #[diagnostic(help(
        "make the strip thinner, lay it on the outer side of the bend, \
         or bend the curve less; where the radius is not small, take more elements"
    ))]
    Folded {
        /// Thickness asked for.
        thickness: f64,
        /// Parameter of the curve where the patch is worst.
        parameter: f64,
        /// Point of the curve there.
        place: [f64; 2],
        /// Radius of curvature there.
        radius: f64,
    },
    /// The side curves cannot be fitted.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Fit(#[from] FitError),
    /// The degree or the number of elements does not make a knot vector.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Knots(#[from] KnotError),
    /// A position is not finite.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Spline(#[from] SplineError),
}
