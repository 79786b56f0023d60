//! A strip along a curve.

use super::{BuildError, check_extent, refined_across, ruled};
use crate::basis::{BasisValues, Derivatives};
use crate::fit;
use crate::knots::{KnotError, Knots};
use crate::orientation;
use crate::spline::Spline;

/// A curve whose unit tangents on both sides of a knot differ by more than this has a corner there.
const CORNER: f64 = 1e-8;
/// A tangent shorter than this share of the curve's size, times the length of the domain, has no direction.
const STANDSTILL: f64 = 1e-12;
/// Steps that narrow down where a bend is sharpest, each by a third, until half the digits of its place are found: then a
/// minimum itself has all of them.
const SEARCH_STEPS: usize = 40;

/// Which line of a strip its curve is.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Alignment {
    /// The side `bottom`: the strip lies left of the curve.
    Bottom,
    /// The line halfway between the sides.
    #[default]
    Middle,
    /// The side `top`: the strip lies right of the curve.
    Top,
}

impl Alignment {
    /// Distances of both sides from the curve, to its left, for a unit of thickness.
    fn offsets(self) -> [f64; 2] {
        match self {
            Self::Bottom => [0.0, 1.0],
            Self::Middle => [-0.5, 0.5],
            Self::Top => [-1.0, 0.0],
        }
    }
}

/// A strip of constant thickness along a plane curve, [fitted](fit::through) to points or not.
///
/// The first parameter is that of the curve, the second runs from 0 to 1 to the left of it, across the thickness. Both
/// sides interpolate the curve's offsets, with `n` the unit normal to its left,
///
/// ```text
/// x_bottom(xi) = x(xi) + a n(xi),    x_top(xi) = x(xi) + b n(xi),    b - a = thickness,
/// ```
///
/// at the Greville abscissae of the strip's knots; straight lines run between them. `degree` and `elements` are given along
/// the curve and across.
///
/// The curve's knots are ends of elements. The other elements are dealt out so that all cover similar ranges of the
/// parameter, which after [`fit::through`] are similar lengths. An offset has one continuous derivative less than its curve,
/// and at a knot of the curve the strip has as many as the offset, `degree - 1` at most. Thus the sides miss the offsets by
/// `O(h^(degree + 1))`, whatever the curve; and a polynomial curve of the strip's degree or less is the strip's line of
/// [`Alignment`] to round-off, through all points it was fitted to. A strip as smooth as its degree allows comes from a
/// curve with one degree more than the strip.
///
/// # Errors
/// When the thickness is not positive and finite, a degree or a number of elements is zero, the spline is no curve, has
/// more elements than the strip should have, has a corner or stands still, or when its radius of curvature on the inner
/// side of a bend is not larger than the strip's extent there, so that the strip would fold over itself.
///
/// ```
/// use partita_iga::build::{self, Alignment};
/// use partita_iga::{Side, fit};
///
/// let points = [[0.0, 0.0], [1.0, 0.3], [2.0, 0.1], [3.0, -0.3], [4.0, 0.0]];
/// let (curve, parameters) = fit::through(&points, 3)?;
/// let strip = build::strip(&curve, 0.1, Alignment::Middle, [3, 2], [20, 1])?;
/// for (point, xi) in points.iter().zip(parameters) {
///     let [x, y] = strip.point(&[xi, 0.5]);
///     assert!((x - point[0]).hypot(y - point[1]) < 1e-14);
///     let ([x, y], [u, v]) = (strip.point(&[xi, 0.0]), strip.point(&[xi, 1.0]));
///     assert!(((x - u).hypot(y - v) - 0.1).abs() < 1e-5);
/// }
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn strip(
    curve: &Spline<2>,
    thickness: f64,
    alignment: Alignment,
    degree: [usize; 2],
    elements: [usize; 2],
) -> Result<Spline<2>, BuildError> {
    check_extent(thickness)?;
    if curve.parameters() != 1 {
        return Err(BuildError::NotACurve { parameters: curve.parameters() });
    }
    let offsets = alignment.offsets().map(|share| share * thickness);
    let mut frame = Frame::new(curve);
    frame.check_corners()?;
    frame.check_bends(offsets, thickness)?;

    let knots = strip_knots(&curve.knots()[0], degree[0], elements[0])?;
    let greville = knots.greville();
    let mut sides = [vec![], vec![]];
    for &xi in &greville {
        let Local { place, normal, .. } = frame.at(curve.knots()[0].element_at(xi), xi)?;
        for (side, offset) in sides.iter_mut().zip(offsets) {
            side.push([place[0] + offset * normal[0], place[1] + offset * normal[1]]);
        }
    }
    let [bottom, top] = sides.map(|points| fit::at_parameters(knots.clone(), &greville, &points));
    let patch = ruled(&bottom?, &top?)?;
    frame.check_patch(&patch, thickness)?;
    refined_across(&patch, degree[1], elements[1])
}

/// Knots along the strip: those of the curve, and the ends of the other elements.
fn strip_knots(curve: &Knots, degree: usize, elements: usize) -> Result<Knots, BuildError> {
    if degree == 0 {
        return Err(KnotError::DegreeZero.into());
    }
    let needed = curve.element_count();
    if elements < needed {
        return Err(BuildError::TooFewElements { found: elements, needed });
    }
    let ranges: Vec<[f64; 2]> = (0..needed).map(|e| curve.element(e)).collect();
    let parts = deal(&ranges, elements);
    let [first, last] = curve.domain();
    let mut values = vec![first; degree + 1];
    for (&[start, end], &parts) in ranges.iter().zip(&parts) {
        values.extend((1..parts).map(|i| start + (end - start) * i as f64 / parts as f64));
        if end < last {
            // The curve has `degree - multiplicity` continuous derivatives there, and its offset one less.
            let multiplicity = (degree + 1 + curve.multiplicity(end)).saturating_sub(curve.degree());
            values.extend(std::iter::repeat_n(end, multiplicity.clamp(1, degree)));
        }
    }
    values.extend(std::iter::repeat_n(last, degree + 1));
    Ok(Knots::new(degree, values)?)
}

/// How many of the `elements` each range gets: one at first, then one more wherever they are longest.
fn deal(ranges: &[[f64; 2]], elements: usize) -> Vec<usize> {
    let mut parts = vec![1; ranges.len()];
    for _ in ranges.len()..elements {
        let length = |i: usize| (ranges[i][1] - ranges[i][0]) / parts[i] as f64;
        let longest = (1..parts.len()).fold(0, |best, i| if length(i) > length(best) { i } else { best });
        parts[longest] += 1;
    }
    parts
}

/// Point, unit tangent and unit normal of a curve, with room for its basis functions.
struct Frame<'a> {
    curve: &'a Spline<2>,
    basis: BasisValues,
    /// Speed below which there is no direction.
    standstill: f64,
}

/// What a curve is like at one parameter.
struct Local {
    place: [f64; 2],
    tangent: [f64; 2],
    /// The tangent turned left.
    normal: [f64; 2],
    /// `x' cross x'' / |x'|^3`: positive in a bend to the left.
    curvature: f64,
}

/// A place of a curve, and the least share of the curve's speed that an offset has there.
struct Bend {
    share: f64,
    parameter: f64,
    local: Local,
}

impl<'a> Frame<'a> {
    fn new(curve: &'a Spline<2>) -> Self {
        let [low, high] = curve.bounding_box();
        let size = (high[0] - low[0]).hypot(high[1] - low[1]);
        let [start, end] = curve.knots()[0].domain();
        Self { curve, basis: BasisValues::new(curve), standstill: STANDSTILL * size / (end - start) }
    }

    fn at(&mut self, element: usize, xi: f64) -> Result<Local, BuildError> {
        self.curve.basis_on(element, &[xi], Derivatives::Second, &mut self.basis);
        let points = self.curve.control_points();
        let place = self.basis.value_of(points);
        let [[u, v], ..] = self.basis.first_of(points);
        let [[[du, dv], ..], ..] = self.basis.second_of(points);
        let speed = u.hypot(v);
        if speed <= self.standstill {
            return Err(BuildError::NoDirection { parameter: xi, place });
        }
        let tangent = [u / speed, v / speed];
        let curvature = (tangent[0] * dv - tangent[1] * du) / (speed * speed);
        Ok(Local { place, tangent, normal: [-tangent[1], tangent[0]], curvature })
    }

    /// The direction is the same on both sides of each inner knot.
    fn check_corners(&mut self) -> Result<(), BuildError> {
        let knots = &self.curve.knots()[0];
        for element in 1..knots.element_count() {
            let parameter = knots.element(element)[0];
            let (before, after) = (self.at(element - 1, parameter)?, self.at(element, parameter)?);
            let turn = [0, 1].map(|c| after.tangent[c] - before.tangent[c]);
            if turn[0].hypot(turn[1]) > CORNER {
                return Err(BuildError::NoDirection { parameter, place: after.place });
            }
        }
        Ok(())
    }

    /// No offset turns back: it runs at `1 - offset * curvature` times the speed of the curve.
    fn check_bends(&mut self, offsets: [f64; 2], thickness: f64) -> Result<(), BuildError> {
        for element in 0..self.curve.element_count() {
            let Bend { share, parameter, local } = self.sharpest_bend(element, offsets)?;
            if share <= 0.0 {
                let radius = 1.0 / local.curvature.abs();
                return Err(BuildError::Folded { thickness, parameter, place: local.place, radius });
            }
        }
        Ok(())
    }

    /// Where in an element an offset is slowest: the slowest of some samples, and what lies between its neighbours.
    fn sharpest_bend(&mut self, element: usize, offsets: [f64; 2]) -> Result<Bend, BuildError> {
        let knots = &self.curve.knots()[0];
        let [start, end] = knots.element(element);
        let units = closed(4 * (knots.degree() + 1));
        let mut at = |unit: f64| {
            let parameter = (1.0 - unit) * start + unit * end;
            let local = self.at(element, parameter)?;
            let share = offsets.map(|a| 1.0 - a * local.curvature).into_iter().fold(1.0, f64::min);
            Ok::<_, BuildError>(Bend { share, parameter, local })
        };
        let (mut least, mut sample) = (0, at(units[0])?);
        for (i, unit) in units.iter().enumerate() {
            let bend = at(*unit)?;
            if bend.share < sample.share {
                (least, sample) = (i, bend);
            }
        }
        let mut bracket = [units[least.saturating_sub(1)], units[(least + 1).min(units.len() - 1)]];
        for _ in 0..SEARCH_STEPS {
            let third = (bracket[1] - bracket[0]) / 3.0;
            let inner = [bracket[0] + third, bracket[1] - third];
            let left = at(inner[0])?.share < at(inner[1])?.share;
            bracket = if left { [bracket[0], inner[1]] } else { [inner[0], bracket[1]] };
        }
        let found = at(bracket[0])?;
        Ok(if found.share < sample.share { found } else { sample })
    }

    /// What was fitted does not fold either. Between both sides the Jacobian is linear, so the sides are enough.
    fn check_patch(&mut self, patch: &Spline<2>, thickness: f64) -> Result<(), BuildError> {
        let along = closed(patch.knots()[0].degree() + 2);
        let [worst, _] = orientation::extremes(patch, &[along, vec![0.0, 1.0]]);
        if worst.value > 0.0 {
            return Ok(());
        }
        let parameter = worst.parameters[0];
        let Local { place, curvature, .. } =
            self.at(self.curve.knots()[0].element_at(parameter), parameter)?;
        Err(BuildError::Folded { thickness, parameter, place, radius: 1.0 / curvature.abs() })
    }
}

/// Points of the unit interval with both of its ends.
fn closed(inner: usize) -> Vec<f64> {
    [vec![0.0], orientation::chebyshev(inner), vec![1.0]].concat()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn elements_are_dealt_out_by_length_and_none_is_left_without() {
        assert_eq!(deal(&[[0.0, 1.0], [1.0, 4.0], [4.0, 4.1]], 8), [2, 5, 1]);
        assert_eq!(deal(&[[0.0, 1.0], [1.0, 2.0]], 6), [3, 3]);
    }

    #[test]
    fn knots_are_as_smooth_as_the_offset() {
        let cubic = Knots::new(3, vec![0.0, 0.0, 0.0, 0.0, 0.5, 1.0, 1.0, 1.0, 1.0]).unwrap();
        let multiplicity = |curve: &Knots, degree| strip_knots(curve, degree, 4).unwrap().multiplicity(0.5);
        assert_eq!([1, 2, 3, 4].map(|degree| multiplicity(&cubic, degree)), [1, 1, 2, 3]);
        let conic = Knots::new(2, vec![0.0, 0.0, 0.0, 0.5, 0.5, 1.0, 1.0, 1.0]).unwrap();
        assert_eq!([1, 2, 3].map(|degree| multiplicity(&conic, degree)), [1, 2, 3]);
        assert_eq!(strip_knots(&cubic, 2, 4).unwrap().element_count(), 4);
    }
}
