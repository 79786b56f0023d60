//! Circles and what has circles for its sides.

use std::f64::consts::{FRAC_1_SQRT_2, FRAC_PI_2, FRAC_PI_3, TAU};

use super::{BuildError, check_extent, ruled};
use crate::knots::Knots;
use crate::spline::Spline;

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
    check_sweep(sweep)?;
    // Never more than a quarter an element, but not five elements for a full turn that is one bit too long.
    let elements = (1..4_usize).find(|&n| sweep.abs() <= n as f64 * FRAC_PI_2).unwrap_or(4);
    let joints: Vec<f64> = (0..=elements).map(|e| e as f64 / elements as f64).collect();
    pieces(center, radius, start, sweep, &joints)
}

/// An arc of conic pieces, each less than half a turn; `joints` are their ends as shares of the sweep and as knots.
fn pieces(
    center: [f64; 2],
    radius: f64,
    start: f64,
    sweep: f64,
    joints: &[f64],
) -> Result<Spline<2>, BuildError> {
    let mut control_points = vec![];
    let mut weights = vec![];
    let mut place = |share: f64, weight: f64| {
        let (sin, cos) = (start + sweep * share).sin_cos();
        control_points.push([center[0] + radius / weight * cos, center[1] + radius / weight * sin]);
        weights.push(weight);
    };
    place(joints[0], 1.0);
    for ends in joints.windows(2) {
        // The tangents at both ends of a piece meet beyond its middle.
        place(0.5 * (ends[0] + ends[1]), (0.5 * sweep * (ends[1] - ends[0])).cos());
        place(ends[1], 1.0);
    }
    let inner = joints[1..joints.len() - 1].iter().flat_map(|joint| [*joint; 2]);
    let knots = [0.0; 3].into_iter().chain(inner).chain([1.0; 3]).collect();
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

/// Longest piece of an [`annular_sector`], in rad: at a third of a turn the parameter runs at most a third faster in the
/// middle of a piece than at its ends, and at half a turn the conic breaks down.
const LONGEST_PIECE: f64 = 2.0 * FRAC_PI_3;

/// A curved beam: the sector of a ring between two radii, as an exact NURBS patch.
///
/// `radii` are the inner and the outer one. The first parameter runs along the arc from the angle `start` through the
/// angle `sweep` (both in rad, counter-clockwise where positive), the second to the left of it across the thickness:
/// outwards where the sweep is clockwise (`bottom` is the inner arc, as in an arch from left to right), inwards where it
/// is counter-clockwise (`bottom` is the outer arc). So the patch is never mirrored. Both parameters run from 0 to 1.
///
/// `degree` and `elements` are given along the arc and across. Element ends are the multiples of `1 / elements`. One
/// conic piece reaches through up to 120 degrees; a longer arc consists of several, which join at ends of elements, so
/// that there are as many elements as were asked for, with as equal shares of the arc as the pieces allow. The patch is
/// smooth inside a piece (`degree - 1` times continuously differentiable); where two join, the basis is continuous.
/// (Piegl and Tiller, *The NURBS Book*, section 7.5.)
///
/// # Errors
/// When a radius or the thickness is not positive and finite, the sweep is zero or more than a full turn, the degree
/// along the arc is below 2, another degree or number of elements zero, there are fewer elements along than pieces, or
/// the center or the start is not finite.
///
/// ```
/// use std::f64::consts::PI;
/// use partita_iga::{Side, build};
///
/// // An arch from (-1, 0) over (0, 1) to (1, 0), 0.1 thick.
/// let arch = build::annular_sector([0.0, 0.0], [0.95, 1.05], PI, -PI, [2, 2], [10, 1])?;
/// assert_eq!(arch.element_count(), 10);
/// let [x, y] = arch.point(&[0.37, 0.5]);
/// assert!((x.hypot(y) - 1.0).abs() < 1e-15);
/// let (outer, _) = arch.side(Side::TOP);
/// assert!((outer.point(&[0.5])[1] - 1.05).abs() < 1e-15);
/// # Ok::<(), build::BuildError>(())
/// ```
pub fn annular_sector(
    center: [f64; 2],
    radii: [f64; 2],
    start: f64,
    sweep: f64,
    degree: [usize; 2],
    elements: [usize; 2],
) -> Result<Spline<2>, BuildError> {
    let [inner, outer] = radii;
    check_extent(inner)?;
    check_extent(outer)?;
    check_extent(outer - inner)?;
    check_sweep(sweep)?;
    let elevation = degree[0].checked_sub(2).ok_or(BuildError::ArcDegree { degree: degree[0] })?;
    let joints = joints(sweep, elements[0])?;
    let [bottom, top] = if sweep > 0.0 { [outer, inner] } else { [inner, outer] };
    let side = |radius| pieces(center, radius, start, sweep, &joints);
    let coarse = ruled(&side(bottom)?, &side(top)?)?.elevate_degree(0, elevation);
    let ends = (1..elements[0]).map(|e| e as f64 / elements[0] as f64);
    let cuts: Vec<f64> = ends.filter(|end| !joints.contains(end)).collect();
    super::refined_across(&coarse.insert_knots(0, &cuts)?, degree[1], elements[1])
}

/// Ends of the conic pieces, each a whole number of `elements` equal elements, as shares of the whole.
fn joints(sweep: f64, elements: usize) -> Result<Vec<f64>, BuildError> {
    // Not one piece more for a sweep that is one bit too long.
    let reach = LONGEST_PIECE / sweep.abs() * (1.0 + 4.0 * f64::EPSILON);
    let needed = (1..3_usize).find(|&pieces| 1.0 <= pieces as f64 * reach).unwrap_or(3);
    if elements < needed {
        return Err(BuildError::TooFewElements { found: elements, needed });
    }
    let longest = (1..=elements).rev().find(|&n| n as f64 <= elements as f64 * reach).unwrap_or(1);
    let pieces = elements.div_ceil(longest);
    // Differences of these whole numbers are at most `longest`.
    let joint = |piece: usize| (piece * elements).div_ceil(pieces);
    Ok((0..=pieces).map(|piece| joint(piece) as f64 / elements as f64).collect())
}

fn check_sweep(sweep: f64) -> Result<(), BuildError> {
    if 0.0 < sweep.abs() && sweep.abs() <= TAU { Ok(()) } else { Err(BuildError::Sweep { sweep }) }
}
