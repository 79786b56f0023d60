//! Whether a patch keeps its orientation: the sign of its Jacobian.

use crate::basis::{BasisValues, Derivatives};
use crate::spline::Spline;

/// Below this sine of the angle between the parameter lines (in 3D, the volume of their unit vectors) a patch counts as
/// degenerate: far below any angle that means something, far above round-off.
const FLAT: f64 = 1e-10;
/// Below this share of the patch's size, the parameter line through an element counts as a point.
const SHORT: f64 = 1e-13;

/// The scaled Jacobian of a patch at one place.
///
/// ```text
/// s = det(t_1, ..., t_D),    t_i = dx/dxi_i / |dx/dxi_i|
/// ```
///
/// It is 1 where the parameter lines meet at right angles, 0 where the patch is degenerate and negative where it is
/// inverted; neither the parameters' scale nor the shape of an element, long or short, changes it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ScaledJacobian<const D: usize> {
    /// Its value, from -1 to 1.
    pub value: f64,
    /// Number of the element.
    pub element: usize,
    /// Parameters of the place.
    pub parameters: [f64; D],
    /// The place.
    pub place: [f64; D],
}

/// Refuses a patch whose map is inverted or degenerate somewhere; returns the place where it comes nearest to that.
///
/// Each element is looked at in `degree + 2` points a parameter, the roots of a Chebyshev polynomial. They lie closer to
/// the borders than the Gauss points of a rule with as many points or fewer, but not on them: a patch may have a side
/// that is a point, like the centre of a disk. The check is as good as its samples. It does not see a patch that
/// overlaps itself without folding, like a ring of more than a turn.
///
/// # Errors
/// When the patch is not of one parameter for each dimension, or the scaled Jacobian is not positive everywhere.
///
/// ```
/// use partita_iga::{Knots, Spline, build, orientation};
///
/// let ring = build::quarter_annulus(1.0, 1.5)?;
/// let worst = orientation::check(&ring)?;
/// assert!((worst.value - 1.0).abs() < 1e-14);
///
/// // One corner of a square drawn over the opposite side.
/// let linear = Knots::uniform(1, 1)?;
/// let corners = vec![[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [0.3, 0.3]];
/// let error = orientation::check(&Spline::new(vec![linear.clone(), linear], corners)?).unwrap_err();
/// assert!(error.to_string().starts_with("the patch folds over itself in element 0"));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn check<const D: usize>(patch: &Spline<D>) -> Result<ScaledJacobian<D>, OrientationError> {
    if patch.parameters() != D {
        return Err(OrientationError::Parameters { found: patch.parameters(), dimension: D });
    }
    let units = std::array::from_fn(|i| chebyshev(patch.knots()[i].degree() + 2));
    let [least, most] = extremes(patch, &units);
    let at = Place::from(least);
    if most.value < -FLAT {
        Err(OrientationError::Mirrored { at })
    } else if least.value < -FLAT {
        Err(OrientationError::Folded { at, scaled_jacobian: least.value })
    } else if least.value <= FLAT {
        Err(OrientationError::Degenerate { at })
    } else {
        Ok(least)
    }
}

/// Roots of the Chebyshev polynomial of the given degree, ascending, on [0, 1].
pub(crate) fn chebyshev(count: usize) -> Vec<f64> {
    let angle = |i: usize| std::f64::consts::PI * (i as f64 + 0.5) / count as f64;
    (0..count).map(|i| 0.5 - 0.5 * angle(i).cos()).collect()
}

/// The places of least and greatest scaled Jacobian among `units`, points of the unit interval for each parameter, in all
/// elements of a patch of `D` parameters.
pub(crate) fn extremes<const D: usize>(patch: &Spline<D>, units: &[Vec<f64>; D]) -> [ScaledJacobian<D>; 2] {
    let [low, high] = patch.bounding_box();
    let size = length(&std::array::from_fn::<_, D, _>(|c| high[c] - low[c]));
    let mut basis = BasisValues::new(patch);
    let mut found: Option<[ScaledJacobian<D>; 2]> = None;
    for element in patch.elements() {
        for index in 0..units.iter().map(Vec::len).product() {
            let xi = element.at(unit_at(index, units));
            patch.basis_on(element.index(), &xi, Derivatives::First, &mut basis);
            let along = basis.first_of(patch.control_points());
            let spans: [f64; D] = std::array::from_fn(|i| element.ranges()[i][1] - element.ranges()[i][0]);
            let sample = ScaledJacobian {
                value: scaled(std::array::from_fn(|i| along[i]), &spans, SHORT * size),
                element: element.index(),
                parameters: xi,
                place: basis.value_of(patch.control_points()),
            };
            let [least, most] = found.get_or_insert([sample; 2]);
            if sample.value < least.value {
                *least = sample;
            }
            if sample.value > most.value {
                *most = sample;
            }
        }
    }
    found.expect("a spline has an element, and there are points in it")
}

/// Point `index` of a tensor product.
fn unit_at<const D: usize>(mut index: usize, units: &[Vec<f64>; D]) -> [f64; D] {
    std::array::from_fn(|i| {
        let unit = units[i][index % units[i].len()];
        index /= units[i].len();
        unit
    })
}

/// Determinant of the unit vectors along the parameter lines; zero where one of them, across an element whose parameters
/// span `spans`, is no longer than `short`.
fn scaled<const D: usize>(mut tangents: [[f64; D]; D], spans: &[f64; D], short: f64) -> f64 {
    for (tangent, span) in tangents.iter_mut().zip(spans) {
        let speed = length(tangent);
        if speed.is_nan() || speed * span <= short {
            return 0.0;
        }
        *tangent = tangent.map(|x| x / speed);
    }
    let value = determinant(tangents);
    if value.is_nan() { 0.0 } else { value }
}

/// By elimination with the largest pivot of each column.
fn determinant<const D: usize>(mut m: [[f64; D]; D]) -> f64 {
    let mut product = 1.0;
    for k in 0..D {
        let pivot = (k..D).max_by(|&i, &j| m[i][k].abs().total_cmp(&m[j][k].abs())).unwrap_or(k);
        if m[pivot][k] == 0.0 {
            return 0.0;
        }
        if pivot != k {
            m.swap(pivot, k);
            product = -product;
        }
        product *= m[k][k];
        for i in k + 1..D {
            let factor = m[i][k] / m[k][k];
            for j in k..D {
                m[i][j] -= factor * m[k][j];
            }
        }
    }
    product
}

fn length<const D: usize>(x: &[f64; D]) -> f64 {
    x.iter().map(|x| x * x).sum::<f64>().sqrt()
}

/// Where a patch is at fault.
#[derive(Clone, Debug, PartialEq)]
pub struct Place {
    /// Number of the element.
    pub element: usize,
    /// Parameters in the patch.
    pub parameters: Vec<f64>,
    /// Coordinates.
    pub place: Vec<f64>,
}

impl<const D: usize> From<ScaledJacobian<D>> for Place {
    fn from(sample: ScaledJacobian<D>) -> Self {
        Self { element: sample.element, parameters: sample.parameters.to_vec(), place: sample.place.to_vec() }
    }
}

impl std::fmt::Display for Place {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Self { element, parameters, place } = self;
        write!(f, "element {element} at the parameters {parameters:.4?}, near {place:.6?}")
    }
}

/// Why a patch cannot carry a computation.
#[derive(Clone, Debug, PartialEq, thiserror::Error, miette::Diagnostic)]
pub enum OrientationError {
    /// A curve in the plane, a surface in space.
    #[error("a spline of {found} parameters fills nothing in {dimension} dimensions")]
    #[diagnostic(help("give a spline of {dimension} parameters"))]
    Parameters {
        /// Number of parameters.
        found: usize,
        /// Number of dimensions.
        dimension: usize,
    },
    /// Inverted everywhere.
    #[error("the patch is mirrored, its Jacobian is negative everywhere, for instance in {at}")]
    #[diagnostic(help(
        "run one parameter the other way: its control points and weights in reverse order, its knots mirrored"
    ))]
    Mirrored {
        /// The place where it is most negative.
        at: Place,
    },
    /// Inverted here and not there.
    #[error("the patch folds over itself in {at}, where its scaled Jacobian is {scaled_jacobian:.2e}")]
    #[diagnostic(help(
        "look at the control points near there: one may lie beyond its neighbours or in another's place"
    ))]
    Folded {
        /// The place where it is most negative.
        at: Place,
        /// Its value there.
        scaled_jacobian: f64,
    },
    /// Flat.
    #[error("the patch is degenerate in {at}, where its Jacobian vanishes")]
    #[diagnostic(help("look at the control points near there: some may coincide or lie on one line"))]
    Degenerate {
        /// The place.
        at: Place,
    },
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn determinants_are_those_of_the_rule_of_sarrus() {
        assert!((determinant([[0.0, 2.0], [3.0, 4.0]]) + 6.0).abs() < 1e-14);
        let d = determinant([[1.0, 2.0, 3.0], [4.0, 5.0, 6.0], [7.0, 8.0, 10.0]]);
        assert!((d + 3.0).abs() < 1e-14, "{d}");
        assert!(determinant([[1.0, 2.0], [2.0, 4.0]]).abs() < 1e-15);
    }

    #[test]
    fn samples_are_the_roots_of_the_chebyshev_polynomial() {
        for x in chebyshev(5).into_iter().map(|x| 2.0 * x - 1.0) {
            assert!((16.0 * x.powi(5) - 20.0 * x.powi(3) + 5.0 * x).abs() < 1e-14);
        }
    }
}
