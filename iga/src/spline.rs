//! Tensor-product splines.

use crate::knots::{KnotError, Knots};
use crate::side::{End, Side};

/// Largest number of parameters a spline may have.
pub const MAX_PARAMETERS: usize = 3;

/// A B-spline or NURBS of up to three parameters in `D` dimensions.
///
/// ```text
/// x(xi) = sum_a R_a(xi) P_a,    R_a = w_a N_a / sum_b w_b N_b,    N_a = product of one B-spline for each parameter
/// ```
///
/// One parameter makes a curve, two a surface, three a volume; none makes a point, which is what the side of a
/// curve is. Control points are numbered along the first parameter first. Coordinates have whatever unit of length
/// the caller uses.
///
/// ```
/// use partita_iga::{Knots, Side, Spline};
///
/// let linear = Knots::uniform(1, 1)?;
/// let corners = vec![[0.0, 0.0], [2.0, 0.0], [0.0, 1.0], [2.0, 3.0]];
/// let patch = Spline::new(vec![linear.clone(), linear], corners)?;
/// assert_eq!(patch.point(&[0.5, 1.0]), [1.0, 2.0]);
///
/// let (top, control_points) = patch.side(Side::TOP);
/// assert_eq!(control_points, [2, 3]);
/// assert_eq!(top.point(&[0.5]), [1.0, 2.0]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Spline<const D: usize> {
    knots: Vec<Knots>,
    control_points: Vec<[f64; D]>,
    weights: Vec<f64>,
    /// Whether the weights differ: if not, they cancel and are not looked at.
    rational: bool,
}

impl<const D: usize> Spline<D> {
    /// A spline with all weights equal to one.
    ///
    /// # Errors
    /// As for [`rational`](Self::rational).
    pub fn new(knots: Vec<Knots>, control_points: Vec<[f64; D]>) -> Result<Self, SplineError> {
        let weights = vec![1.0; control_points.len()];
        Self::rational(knots, control_points, weights)
    }

    /// A spline with a positive weight for each control point (a NURBS).
    ///
    /// # Errors
    /// When there are more than three parameters, the number of control points or weights is not the product of the
    /// numbers of basis functions, a coordinate is not finite, or a weight is not finite and positive.
    pub fn rational(
        knots: Vec<Knots>,
        control_points: Vec<[f64; D]>,
        weights: Vec<f64>,
    ) -> Result<Self, SplineError> {
        if knots.len() > MAX_PARAMETERS {
            return Err(SplineError::TooManyParameters { found: knots.len() });
        }
        let shape: Vec<usize> = knots.iter().map(Knots::basis_count).collect();
        let needed = shape.iter().product();
        if control_points.len() != needed {
            return Err(SplineError::ControlPoints { found: control_points.len(), needed, shape });
        }
        if weights.len() != needed {
            return Err(SplineError::Weights { found: weights.len(), needed });
        }
        if let Some(index) = control_points.iter().position(|point| point.iter().any(|x| !x.is_finite())) {
            return Err(SplineError::NotFinite { index });
        }
        if let Some(index) = weights.iter().position(|w| !(w.is_finite() && *w > 0.0)) {
            return Err(SplineError::Weight { index, value: weights[index] });
        }
        let rational = differ(&weights);
        Ok(Self { knots, control_points, weights, rational })
    }

    /// The spline with other control points, its knots and weights kept: a deformed patch, say.
    ///
    /// # Errors
    /// When the number of control points differs or a coordinate is not finite.
    pub fn with_control_points(&self, control_points: Vec<[f64; D]>) -> Result<Self, SplineError> {
        Self::rational(self.knots.clone(), control_points, self.weights.clone())
    }

    /// The same shape with parameters that run from 0 to 1, whatever the knots were: the basis functions keep their
    /// values.
    ///
    /// # Errors
    /// The parameter, and what is wrong with its knots, where different knots are too close for that; see
    /// [`Knots::on_unit_interval`].
    pub fn on_unit_parameters(&self) -> Result<Self, (usize, KnotError)> {
        let mapped =
            self.knots.iter().enumerate().map(|(i, knots)| knots.on_unit_interval().map_err(|e| (i, e)));
        Ok(Self { knots: mapped.collect::<Result<_, _>>()?, ..self.clone() })
    }

    /// Number of parameters.
    #[must_use]
    pub fn parameters(&self) -> usize {
        self.knots.len()
    }

    /// Knots of each parameter.
    #[must_use]
    pub fn knots(&self) -> &[Knots] {
        &self.knots
    }

    /// Control points, along the first parameter first.
    #[must_use]
    pub fn control_points(&self) -> &[[f64; D]] {
        &self.control_points
    }

    /// Weights of the control points.
    #[must_use]
    pub fn weights(&self) -> &[f64] {
        &self.weights
    }

    /// Whether the weights differ from one another; if not, the spline is polynomial between its knots.
    #[must_use]
    pub fn is_rational(&self) -> bool {
        self.rational
    }

    /// Whether the spline has this side.
    #[must_use]
    pub fn has_side(&self, side: Side) -> bool {
        side.parameter < self.parameters()
    }

    /// All sides in the order of [`Side::ALL`].
    pub fn sides(&self) -> impl Iterator<Item = Side> + '_ {
        Side::ALL.into_iter().filter(|side| self.has_side(*side))
    }

    /// A side as a spline with one parameter less, and the indices of its control points in this spline.
    ///
    /// The remaining parameters keep their order. The side of a curve is a point: a spline without parameters.
    ///
    /// # Panics
    /// When the spline has no such side; [`has_side`](Self::has_side) tells.
    #[must_use]
    pub fn side(&self, side: Side) -> (Self, Vec<usize>) {
        assert!(self.has_side(side), "a spline of {} parameters has no side `{side}`", self.parameters());
        let indices = self.side_control_points(side);
        let mut knots = self.knots.clone();
        knots.remove(side.parameter);
        let control_points = indices.iter().map(|&a| self.control_points[a]).collect();
        let weights = indices.iter().map(|&a| self.weights[a]).collect();
        let spline =
            Self::rational(knots, control_points, weights).expect("a side of a valid spline is valid");
        (spline, indices)
    }

    fn side_control_points(&self, side: Side) -> Vec<usize> {
        let shape = self.shape();
        let stride: usize = shape[..side.parameter].iter().product();
        let count = shape[side.parameter];
        let held = match side.end {
            End::Start => 0,
            End::End => count - 1,
        };
        (0..self.control_points.len()).filter(|a| a / stride % count == held).collect()
    }

    /// Smallest and largest coordinates of the control points: the spline lies inside this box.
    #[must_use]
    pub fn bounding_box(&self) -> [[f64; D]; 2] {
        let mut bounds = [self.control_points[0]; 2];
        for point in &self.control_points {
            for (c, x) in point.iter().enumerate() {
                bounds[0][c] = bounds[0][c].min(*x);
                bounds[1][c] = bounds[1][c].max(*x);
            }
        }
        bounds
    }

    /// Number of basis functions for each parameter, 1 for missing ones.
    pub(crate) fn shape(&self) -> [usize; MAX_PARAMETERS] {
        let mut shape = [1; MAX_PARAMETERS];
        self.knots.iter().enumerate().for_each(|(i, knots)| shape[i] = knots.basis_count());
        shape
    }

    /// Degree of each parameter, 0 for missing ones.
    pub(crate) fn degrees(&self) -> [usize; MAX_PARAMETERS] {
        let mut degrees = [0; MAX_PARAMETERS];
        self.knots.iter().enumerate().for_each(|(i, knots)| degrees[i] = knots.degree());
        degrees
    }
}

#[allow(clippy::float_cmp, reason = "only weights that are equal to the last bit cancel")]
fn differ(weights: &[f64]) -> bool {
    weights.iter().any(|w| *w != weights[0])
}

/// What is wrong with the data of a spline.
#[derive(Clone, Debug, PartialEq, thiserror::Error, miette::Diagnostic)]
pub enum SplineError {
    /// More parameters than [`MAX_PARAMETERS`].
    #[error("{found} parameters are too many")]
    #[diagnostic(help("curves have 1, surfaces 2, volumes 3"))]
    TooManyParameters {
        /// Number of knot vectors given.
        found: usize,
    },
    /// The number of control points does not fit the knots.
    #[error("{found} control points do not fit {shape:?} basis functions")]
    #[diagnostic(help("give {needed} control points"))]
    ControlPoints {
        /// Number of control points given.
        found: usize,
        /// Number that the knots ask for.
        needed: usize,
        /// Number of basis functions for each parameter.
        shape: Vec<usize>,
    },
    /// The number of weights does not fit the control points.
    #[error("{found} weights do not fit {needed} control points")]
    #[diagnostic(help("give one weight for each control point"))]
    Weights {
        /// Number of weights given.
        found: usize,
        /// Number of control points.
        needed: usize,
    },
    /// A coordinate is infinite or not a number.
    #[error("control point {index} has a coordinate that is not finite")]
    #[diagnostic(help("coordinates are finite numbers"))]
    NotFinite {
        /// Index of the control point.
        index: usize,
    },
    /// A weight is not a positive number.
    #[error("the weight of control point {index} is {value}")]
    #[diagnostic(help("weights are positive, finite numbers"))]
    Weight {
        /// Index of the control point.
        index: usize,
        /// Its weight.
        value: f64,
    },
}
