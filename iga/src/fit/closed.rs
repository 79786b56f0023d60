//! Closed curves through given points.

use super::{FitError, chord_lengths};
use crate::bspline;
use crate::knots::{KnotError, Knots};
use crate::spline::Spline;

/// Inner knots this close to an end of the period are the end itself.
const AT_END: f64 = 1e-9;

/// The B-spline curve of `degree` through `points` that closes as smoothly as it runs everywhere else; the last point
/// stands for the first.
///
/// As for [`through`](super::through), the parameter of a point is its share of the length of the polygon, and knots are
/// means of `degree` consecutive parameters, here of the periodic sequence `t_{i+n} = t_i + 1`. With the control points
/// periodic, too, the conditions `x(t_i) = x_i` are a cyclic system.
///
/// # Errors
/// When there are not more points than the degree even without the last one, two neighbours coincide, a coordinate is
/// not finite, or the degree is zero.
///
/// # Panics
/// Never: the knots give every basis function an element to live on.
///
/// ```
/// use partita_iga::fit;
///
/// let points = [[1.0, 0.0], [0.0, 1.0], [-1.0, 0.0], [0.0, -1.0], [1.0, 0.0]];
/// let (curve, _) = fit::closed(&points, 3)?;
/// let [start, end] = [0.0, 1.0].map(|xi| curve.tangent(&[xi], 0));
/// assert!((start[0] - end[0]).abs() < 1e-13 && (start[1] - end[1]).abs() < 1e-13);
/// # Ok::<(), fit::FitError>(())
/// ```
pub fn closed<const D: usize>(points: &[[f64; D]], degree: usize) -> Result<(Spline<D>, Vec<f64>), FitError> {
    let count = points.len().saturating_sub(1);
    if degree == 0 {
        return Err(KnotError::DegreeZero.into());
    }
    if count <= degree {
        return Err(FitError::TooFewPoints { found: count, degree });
    }
    let parameters = chord_lengths(points)?;
    let basis = Periodic { parameters: &parameters[..count], degree };
    let mut control_points = points[..count].to_vec();
    solve(basis.collocation(), &mut control_points);
    let knots = basis.clamped_knots()?;
    let mut clamped: Vec<[f64; D]> = basis.clamped(&knots, &control_points);
    // Both ends are the first point up to round-off; without it, they are one place.
    clamped[0] = points[0];
    let last = clamped.len() - 1;
    clamped[last] = points[0];
    Ok((Spline::new(vec![knots], clamped)?, parameters))
}

/// Periodic B-splines of period 1 whose knots are means of parameters.
struct Periodic<'a> {
    parameters: &'a [f64],
    degree: usize,
}

/// Turns before the first parameter, so that indices need no sign.
const TURNS_BEFORE: usize = 2;

impl Periodic<'_> {
    fn count(&self) -> usize {
        self.parameters.len()
    }

    /// `t_i`, where index `TURNS_BEFORE count` is that of `t_0 = 0`.
    fn parameter(&self, index: usize) -> f64 {
        let turns = (index / self.count()) as f64 - TURNS_BEFORE as f64;
        self.parameters[index % self.count()] + turns
    }

    fn knot(&self, index: usize) -> f64 {
        (index..index + self.degree).map(|i| self.parameter(i)).sum::<f64>() / self.degree as f64
    }

    /// The span with `knot(span) <= xi < knot(span + 1)`, for `xi` from 0 to 1.
    fn span(&self, xi: f64) -> usize {
        let mut span = self.degree;
        while self.knot(span + 1) <= xi {
            span += 1;
        }
        span
    }

    /// Blossoms of the basis functions `span - degree ..= span`, whose polynomials are those of `span`.
    fn blossom(&self, span: usize, arguments: &[f64]) -> Vec<f64> {
        let knots: Vec<f64> = (span + 1 - self.degree..=span + self.degree).map(|i| self.knot(i)).collect();
        let mut values = vec![0.0; self.degree + 1];
        bspline::blossom_on(&knots, self.degree - 1, arguments, &mut values);
        values
    }

    fn control_point(&self, span: usize, a: usize) -> usize {
        (span - self.degree + a) % self.count()
    }

    /// `N_a(t_i)`, one row a point.
    fn collocation(&self) -> Vec<Vec<f64>> {
        let row = |&t: &f64| {
            let mut row = vec![0.0; self.parameters.len()];
            let span = self.span(t);
            for (a, value) in self.blossom(span, &vec![t; self.degree]).into_iter().enumerate() {
                row[self.control_point(span, a)] += value;
            }
            row
        };
        self.parameters.iter().map(row).collect()
    }

    /// The knots between 0 and 1, and both ends as often as a clamped vector has them.
    fn clamped_knots(&self) -> Result<Knots, KnotError> {
        let inside = |knot: &f64| *knot > AT_END && *knot < 1.0 - AT_END;
        let end = |knot| std::iter::repeat_n(knot, self.degree + 1);
        let turns = TURNS_BEFORE + 2;
        let inner = (0..turns * self.count()).map(|i| self.knot(i)).filter(inside);
        Knots::new(self.degree, end(0.0).chain(inner).chain(end(1.0)).collect())
    }

    /// The curve of periodic control points on clamped knots: control point `a` is the blossom at the knots `a + 1` to
    /// `a + degree`.
    fn clamped<const D: usize>(&self, knots: &Knots, control_points: &[[f64; D]]) -> Vec<[f64; D]> {
        let point = |a: usize| {
            let of_span = (0..knots.element_count()).find(|e| knots.active(*e).contains(&a));
            let [start, end] = knots.element(of_span.expect("a basis function lives on an element"));
            let span = self.span(0.5 * (start + end));
            let weights = self.blossom(span, &knots.values()[a + 1..=a + self.degree]);
            let mut point = [0.0; D];
            for (b, weight) in weights.into_iter().enumerate() {
                let from = &control_points[self.control_point(span, b)];
                (0..D).for_each(|c| point[c] += weight * from[c]);
            }
            point
        };
        (0..knots.basis_count()).map(point).collect()
    }
}

/// Gaussian elimination with partial pivoting, each right-hand side a column of `x`.
fn solve<const D: usize>(mut matrix: Vec<Vec<f64>>, x: &mut [[f64; D]]) {
    let n = x.len();
    for pivot in 0..n {
        let largest = (pivot..n).max_by(|&i, &j| matrix[i][pivot].abs().total_cmp(&matrix[j][pivot].abs()));
        let largest = largest.expect("a row is left");
        matrix.swap(pivot, largest);
        x.swap(pivot, largest);
        let above = matrix[pivot].clone();
        for row in pivot + 1..n {
            let factor = matrix[row][pivot] / above[pivot];
            if factor != 0.0 {
                (pivot..n).for_each(|column| matrix[row][column] -= factor * above[column]);
                x[row] = std::array::from_fn(|c| x[row][c] - factor * x[pivot][c]);
            }
        }
    }
    for row in (0..n).rev() {
        for column in row + 1..n {
            x[row] = std::array::from_fn(|c| x[row][c] - matrix[row][column] * x[column][c]);
        }
        x[row] = x[row].map(|value| value / matrix[row][row]);
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use super::*;

    /// Points of an ellipse, unevenly spread.
    fn ellipse(count: u32) -> Vec<[f64; 2]> {
        let angle = |i: u32| {
            let share = f64::from(i % count) / f64::from(count);
            TAU * (share + 0.03 * (TAU * share).sin())
        };
        (0..=count).map(|i| [2.0 * angle(i).cos(), angle(i).sin()]).collect()
    }

    #[test]
    #[allow(clippy::float_cmp, reason = "both ends are the first point")]
    fn a_closed_curve_passes_its_points_and_is_as_smooth_at_its_ends_as_elsewhere() {
        for degree in 1..=5 {
            let points = ellipse(9);
            let (curve, parameters) = closed(&points, degree).unwrap();
            for (point, xi) in points.iter().zip(&parameters) {
                let [x, y] = curve.point(&[*xi]);
                assert!((x - point[0]).hypot(y - point[1]) < 1e-12, "degree {degree}: {point:?} at {xi}");
            }
            assert_eq!(curve.point(&[0.0]), curve.point(&[1.0]));
            if degree > 1 {
                let [[u, v], [p, q]] = [0.0, 1.0].map(|xi| curve.tangent(&[xi], 0));
                assert!((u - p).hypot(v - q) < 1e-11 * u.hypot(v), "degree {degree}");
            }
        }
    }

    #[test]
    fn closed_curves_converge_to_an_ellipse() {
        let miss = |count: u32| {
            let (curve, _) = closed(&ellipse(count), 3).unwrap();
            let off = |i: u32| {
                let [x, y] = curve.point(&[f64::from(i) / 997.0]);
                ((0.5 * x).hypot(y) - 1.0).abs()
            };
            (0..=997).map(off).fold(0.0, f64::max)
        };
        let order = (miss(20) / miss(40)).log2();
        assert!(order > 3.5, "order {order}, {:e}", miss(40));
    }

    #[test]
    fn too_few_points_are_refused() {
        assert!(matches!(closed(&ellipse(3), 3), Err(FitError::TooFewPoints { found: 3, degree: 3 })));
        assert!(matches!(closed::<2>(&[], 1), Err(FitError::TooFewPoints { found: 0, .. })));
        assert!(matches!(closed(&[[0.0], [0.0], [1.0], [0.0]], 1), Err(FitError::Coincident { index: 0 })));
    }
}
