//! Splines for simple shapes.

use std::f64::consts::{FRAC_1_SQRT_2, FRAC_PI_2, TAU};

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

/// An arc of a circle in the plane as an exact NURBS of degree 2, with one element for each quarter or part of one.
///
/// It starts at the angle `start`, in rad, from the x axis and runs through the angle `sweep`, in rad, counter-clockwise
/// where that is positive. (Piegl and Tiller, *The NURBS Book*, section 7.5.)
///
/// # Errors
/// When the radius is not positive and finite, the sweep is zero or more than a full turn, or the center or the
/// start is not finite.
///
/// ```
/// use partita_iga::build;
///
/// let arc = build::arc([1.0, 0.0], 2.0, 0.0, std::f64::consts::PI)?;
/// let [x, y] = arc.point(&[0.37]);
/// assert!(((x - 1.0).hypot(y) - 2.0).abs() < 1e-15);
/// # Ok::<(), build::BuildError>(())
/// ```
pub fn arc(center: [f64; 2], radius: f64, start: f64, sweep: f64) -> Result<Spline<2>, BuildError> {
    check_extent(radius)?;
    if !(0.0 < sweep.abs() && sweep.abs() <= TAU) {
        return Err(BuildError::Sweep { sweep });
    }
    // Never more than a quarter an element, but not five elements for a full turn that is one bit too long.
    let elements = (1..4).find(|&n| sweep.abs() <= f64::from(n) * FRAC_PI_2).unwrap_or(4);
    let half = 0.5 * sweep / f64::from(elements);
    // Even points lie on the circle; odd ones are where the tangents meet.
    let place = |i: i32| {
        let (sin, cos) = (start + half * f64::from(i)).sin_cos();
        let reach = if i % 2 == 0 { radius } else { radius / half.cos() };
        [center[0] + reach * cos, center[1] + reach * sin]
    };
    let control_points = (0..=2 * elements).map(place).collect();
    let weights = (0..=2 * elements).map(|i| if i % 2 == 0 { 1.0 } else { half.cos() }).collect();
    let joints = (1..elements).flat_map(|e| [f64::from(e) / f64::from(elements); 2]);
    let knots = [0.0; 3].into_iter().chain(joints).chain([1.0; 3]).collect();
    Ok(Spline::rational(vec![Knots::new(2, knots)?], control_points, weights)?)
}

/// Corners and middles of the edges of the square round the unit circle, counter-clockwise.
#[rustfmt::skip]
const SQUARE: [[f64; 2]; 9] = [
    [1.0, 0.0], [1.0, 1.0], [0.0, 1.0], [-1.0, 1.0], [-1.0, 0.0], [-1.0, -1.0], [0.0, -1.0], [1.0, -1.0], [1.0, 0.0],
];

/// A full circle as an exact NURBS of degree 2, counter-clockwise from its rightmost point, closed to the last bit.
///
/// # Errors
/// When the radius is not positive and finite, or the center is not finite.
pub fn circle(center: [f64; 2], radius: f64) -> Result<Spline<2>, BuildError> {
    check_extent(radius)?;
    let control_points =
        SQUARE.iter().map(|[x, y]| [center[0] + radius * x, center[1] + radius * y]).collect();
    let weights = (0..9).map(|i| if i % 2 == 0 { 1.0 } else { FRAC_1_SQRT_2 }).collect();
    let knots = [0.0, 0.0, 0.0, 0.25, 0.25, 0.5, 0.5, 0.75, 0.75, 1.0, 1.0, 1.0];
    Ok(Spline::rational(vec![Knots::new(2, knots.to_vec())?], control_points, weights)?)
}

/// A quarter of a ring about the origin, in the first quadrant, as one exact NURBS element.
///
/// The first parameter runs outwards (`left` is the inner arc, `right` the outer one) and is linear, the second runs
/// counter-clockwise from the x axis (`bottom`) to the y axis (`top`) and is quadratic.
///
/// # Errors
/// When the inner radius or the thickness is not positive and finite.
///
/// ```
/// use partita_iga::{Side, build};
///
/// let ring = build::quarter_annulus(1.0, 1.5)?.elevate_degree(0, 1).subdivide(1, 8)?;
/// let (outer, _) = ring.side(Side::RIGHT);
/// let [x, y] = outer.point(&[0.3]);
/// assert!((x.hypot(y) - 1.5).abs() < 1e-15);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn quarter_annulus(inner: f64, outer: f64) -> Result<Spline<2>, BuildError> {
    check_extent(inner)?;
    check_extent(outer - inner)?;
    let (a, b) = (inner, outer);
    let control_points = vec![[a, 0.0], [b, 0.0], [a, a], [b, b], [0.0, a], [0.0, b]];
    let weights = vec![1.0, 1.0, FRAC_1_SQRT_2, FRAC_1_SQRT_2, 1.0, 1.0];
    let knots = vec![Knots::uniform(1, 1)?, Knots::uniform(2, 1)?];
    Ok(Spline::rational(knots, control_points, weights)?)
}

fn check_extent(extent: f64) -> Result<(), BuildError> {
    if extent.is_finite() && extent > 0.0 { Ok(()) } else { Err(BuildError::Extent { extent }) }
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
    /// An arc that is empty or overlaps itself.
    #[error(
        "an arc cannot sweep {sweep} rad\nhint: take an angle up to a full turn, 2 pi rad, other than zero"
    )]
    Sweep {
        /// The angle given, in rad.
        sweep: f64,
    },
    /// The degree or the number of elements does not make a knot vector.
    #[error(transparent)]
    Knots(#[from] KnotError),
    /// A position is not finite.
    #[error(transparent)]
    Spline(#[from] SplineError),
}
