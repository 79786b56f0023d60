//! Curves through given points.

mod closed;

use crate::bspline;
use crate::knots::{KnotError, Knots};
use crate::spline::{Spline, SplineError};

pub use closed::closed;

/// The B-spline curve of `degree` through `points`, in their order.
///
/// The parameter of a point is its share of the length of the polygon through all points, `t_0 = 0` to `t_n = 1`;
/// inner knots are means of `degree` consecutive parameters (Piegl and Tiller, *The NURBS Book*, eqs. 9.5, 9.8).
/// The curve begins and ends in the first and the last point to the last bit.
///
/// # Errors
/// When there are not more points than the degree, two neighbours coincide, a coordinate is not finite, or the degree
/// is zero.
///
/// ```
/// use partita_iga::fit;
///
/// let points = [[0.0, 0.0], [1.0, 0.8], [2.0, 0.9], [3.0, 0.1]];
/// let (curve, parameters) = fit::through(&points, 3)?;
/// for (point, xi) in points.iter().zip(parameters) {
///     let [x, y] = curve.point(&[xi]);
///     assert!((x - point[0]).hypot(y - point[1]) < 1e-15);
/// }
/// # Ok::<(), fit::FitError>(())
/// ```
pub fn through<const D: usize>(
    points: &[[f64; D]],
    degree: usize,
) -> Result<(Spline<D>, Vec<f64>), FitError> {
    if points.len() <= degree {
        return Err(FitError::TooFewPoints { found: points.len(), degree });
    }
    let parameters = chord_lengths(points)?;
    let knots = averaged_knots(&parameters, degree)?;
    Ok((at_parameters(knots, &parameters, points)?, parameters))
}

/// The B-spline curve on given knots that passes `points[i]` at `parameters[i]`.
///
/// Solves `sum_a N_a(t_i) P_a = x_i`, a banded system, by elimination without pivoting: the matrix is totally positive
/// (de Boor, *A Practical Guide to Splines*, ch. XIII). The parameters must ascend.
///
/// # Errors
/// When a parameter lies outside the support of its basis function (the condition of Schoenberg and Whitney; it also
/// fails when parameters do not ascend) or a coordinate is not finite.
///
/// # Panics
/// When there are not as many parameters and points as basis functions.
pub fn at_parameters<const D: usize>(
    knots: Knots,
    parameters: &[f64],
    points: &[[f64; D]],
) -> Result<Spline<D>, FitError> {
    assert_eq!(parameters.len(), knots.basis_count(), "one parameter for each basis function");
    assert_eq!(points.len(), knots.basis_count(), "one point for each basis function");
    check_parameters(&knots, parameters)?;
    let mut control_points = points.to_vec();
    Band::collocation(&knots, parameters).solve(&mut control_points);
    Ok(Spline::new(vec![knots], control_points)?)
}

fn chord_lengths<const D: usize>(points: &[[f64; D]]) -> Result<Vec<f64>, FitError> {
    let mut lengths = vec![0.0];
    for (i, pair) in points.windows(2).enumerate() {
        let chord = (0..D).map(|c| (pair[1][c] - pair[0][c]).powi(2)).sum::<f64>().sqrt();
        if chord == 0.0 {
            return Err(FitError::Coincident { index: i });
        }
        lengths.push(lengths[i] + chord);
    }
    let total = lengths[points.len() - 1];
    Ok(lengths.into_iter().map(|length| length / total).collect())
}

fn averaged_knots(parameters: &[f64], degree: usize) -> Result<Knots, KnotError> {
    let inner = parameters.len() - degree - 1;
    let mean = |j: usize| parameters[j..j + degree].iter().sum::<f64>() / degree as f64;
    let start = std::iter::repeat_n(0.0, degree + 1);
    let end = std::iter::repeat_n(1.0, degree + 1);
    Knots::new(degree, start.chain((1..=inner).map(mean)).chain(end).collect())
}

/// Ascending, and `N_i(t_i) > 0`.
fn check_parameters(knots: &Knots, parameters: &[f64]) -> Result<(), FitError> {
    let [start, end] = knots.domain();
    for (i, &t) in parameters.iter().enumerate() {
        let (left, right) = (knots.values()[i], knots.values()[i + knots.degree() + 1]);
        let supported =
            left < t && t < right || i == 0 && t <= start || i + 1 == parameters.len() && t >= end;
        let ascends = i == 0 || parameters[i - 1] < t;
        if !(supported && ascends && (start..=end).contains(&t)) {
            return Err(FitError::Parameter { index: i, value: t, left, right });
        }
    }
    Ok(())
}

/// A square matrix with `degree` diagonals on either side of the main one, row by row.
struct Band {
    degree: usize,
    rows: Vec<f64>,
}

impl Band {
    fn collocation(knots: &Knots, parameters: &[f64]) -> Self {
        let degree = knots.degree();
        let mut band = Self { degree, rows: vec![0.0; parameters.len() * (2 * degree + 1)] };
        let mut values = vec![0.0; degree + 1];
        for (i, &t) in parameters.iter().enumerate() {
            let span = knots.span_at(t);
            bspline::basis(knots, span, t, &mut values);
            for (column, value) in (span - degree..=span).zip(&values) {
                // Values outside the band vanish: the parameter lies in the support of function i.
                if column.abs_diff(i) <= degree {
                    *band.at(i, column) = *value;
                }
            }
        }
        band
    }

    fn at(&mut self, row: usize, column: usize) -> &mut f64 {
        &mut self.rows[row * (2 * self.degree + 1) + self.degree + column - row]
    }

    /// Gaussian elimination, each right-hand side a column of `x`.
    fn solve<const D: usize>(mut self, x: &mut [[f64; D]]) {
        let n = x.len();
        let degree = self.degree;
        for pivot in 0..n {
            let last = (pivot + degree).min(n - 1);
            for row in pivot + 1..=last {
                let factor = *self.at(row, pivot) / *self.at(pivot, pivot);
                if factor != 0.0 {
                    for column in pivot..=last {
                        let above = *self.at(pivot, column);
                        *self.at(row, column) -= factor * above;
                    }
                    x[row] = std::array::from_fn(|c| x[row][c] - factor * x[pivot][c]);
                }
            }
        }
        for row in (0..n).rev() {
            for column in row + 1..=(row + degree).min(n - 1) {
                let entry = *self.at(row, column);
                x[row] = std::array::from_fn(|c| x[row][c] - entry * x[column][c]);
            }
            let diagonal = *self.at(row, row);
            x[row] = x[row].map(|value| value / diagonal);
        }
    }
}

/// Why no curve can be drawn through the points.
#[derive(Clone, Debug, PartialEq, thiserror::Error, miette::Diagnostic)]
pub enum FitError {
    /// A curve of this degree needs more points.
    #[error("{found} points are too few for a curve of degree {degree}")]
    #[diagnostic(help("give more points or lower the degree"))]
    TooFewPoints {
        /// Number of points given.
        found: usize,
        /// Degree asked for.
        degree: usize,
    },
    /// Two neighbours are the same point, so they would have the same parameter.
    #[error("points {index} and {} coincide", index + 1)]
    #[diagnostic(help("leave one of them out"))]
    Coincident {
        /// Index of the first of them.
        index: usize,
    },
    /// A parameter does not belong to its basis function.
    #[error("parameter {index} is {value}")]
    #[diagnostic(help(
        "the parameters ascend, and this one lies in the support of basis function \
         {index}, from {left} to {right}"
    ))]
    Parameter {
        /// Its index.
        index: usize,
        /// The parameter given.
        value: f64,
        /// Start of the support.
        left: f64,
        /// End of the support.
        right: f64,
    },
    /// The knots are not valid.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Knots(#[from] KnotError),
    /// The points are not valid.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Spline(#[from] SplineError),
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_curve_through_points_of_a_spline_is_that_spline() {
        let knots = Knots::new(3, vec![0.0, 0.0, 0.0, 0.0, 0.3, 0.3, 0.45, 1.0, 1.0, 1.0, 1.0]).unwrap();
        let control_points: Vec<_> = (0..7).map(|a| [f64::from(a), f64::from(a * a % 5)]).collect();
        let spline = Spline::new(vec![knots.clone()], control_points).unwrap();
        let parameters = knots.greville();
        let points: Vec<_> = parameters.iter().map(|&t| spline.point(&[t])).collect();
        let fitted = at_parameters(knots, &parameters, &points).unwrap();
        for (fitted, original) in fitted.control_points().iter().zip(spline.control_points()) {
            assert!((fitted[0] - original[0]).abs() < 1e-13 && (fitted[1] - original[1]).abs() < 1e-13);
        }
    }

    #[test]
    fn interpolation_of_a_sine_converges_with_degree_plus_one() {
        for degree in 1..=4 {
            let error = |n: u32| {
                let knots = Knots::uniform(degree, n as usize).unwrap();
                let t = knots.greville();
                let samples: Vec<_> = t.iter().map(|t| [(3.0 * t).sin()]).collect();
                let curve = at_parameters(knots, &t, &samples).unwrap();
                let miss = |xi: f64| (curve.point(&[xi])[0] - (3.0 * xi).sin()).abs();
                (0..=1000).map(|i| miss(f64::from(i) / 1000.0)).fold(0.0, f64::max)
            };
            let order = (error(20) / error(40)).log2();
            assert!((order - (degree as f64 + 1.0)).abs() < 0.25, "degree {degree}: order {order}");
        }
    }

    /// Piegl and Tiller, example 9.1.
    #[test]
    fn parameters_and_knots_are_those_of_the_textbook() {
        let points = [[0.0, 0.0], [3.0, 4.0], [-1.0, 4.0], [-4.0, 0.0], [-4.0, -3.0]];
        let (curve, parameters) = through(&points, 3).unwrap();
        for (found, exact) in parameters.iter().zip([0.0, 5.0, 9.0, 14.0, 17.0]) {
            assert!((found - exact / 17.0).abs() < 1e-15);
        }
        assert!((curve.knots()[0].values()[4] - 28.0 / 51.0).abs() < 1e-15);
    }

    #[test]
    fn ends_are_the_first_and_the_last_point_to_the_last_bit() {
        let points = [[0.1, 0.7], [0.2, 0.9], [0.4, 0.8], [0.7, 0.3], [0.9, 0.35]];
        let (curve, _) = through(&points, 3).unwrap();
        assert_eq!((curve.point(&[0.0]), curve.point(&[1.0])), (points[0], points[4]));
    }

    #[test]
    fn impossible_points_and_parameters_are_refused() {
        assert_eq!(through(&[[0.0], [1.0]], 2), Err(FitError::TooFewPoints { found: 2, degree: 2 }));
        assert_eq!(through(&[[0.0], [1.0], [1.0]], 2), Err(FitError::Coincident { index: 1 }));
        assert_eq!(through(&[[0.0], [1.0]], 0), Err(FitError::Knots(KnotError::DegreeZero)));
        let nan = through(&[[0.0], [f64::NAN], [1.0]], 2);
        assert!(nan.is_err(), "{nan:?}");
        let knots = Knots::uniform(1, 3).unwrap();
        let points = [[0.0]; 4];
        let refused = |t: &[f64]| at_parameters(knots.clone(), t, &points).unwrap_err();
        assert!(matches!(refused(&[0.0, 0.1, 0.2, 1.0]), FitError::Parameter { index: 2, .. }));
        assert!(matches!(refused(&[0.0, 0.6, 0.5, 1.0]), FitError::Parameter { index: 2, .. }));
        assert!(matches!(refused(&[0.0, 0.3, 0.5, 1.1]), FitError::Parameter { index: 3, .. }));
    }
}
