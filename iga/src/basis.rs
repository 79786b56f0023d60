//! Evaluation of basis functions into a reusable workspace.

use crate::nurbs::{self, Gradient, Hessian};
use crate::spline::{MAX_PARAMETERS, Spline};
use crate::{Knots, bspline};

/// How many derivatives to compute beside the values.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Derivatives {
    /// Values only.
    None,
    /// Values and first derivatives.
    First,
    /// Values, first and second derivatives.
    Second,
}

/// Basis functions at one point: the result of [`Spline::basis`] and its workspace.
///
/// Allocated once for a spline (or for all splines of the same degrees) and filled again and again.
///
/// ```
/// use partita_iga::{BasisValues, Derivatives, build};
///
/// let patch = build::rectangle([0.0, 0.0], [3.0, 1.0], [2, 1], [4, 2])?;
/// let mut basis = BasisValues::new(&patch);
/// patch.basis(&[0.4, 0.7], Derivatives::First, &mut basis);
///
/// assert_eq!(basis.active().len(), 3 * 2);
/// assert!((basis.values().iter().sum::<f64>() - 1.0).abs() < 1e-15);
/// let [dx_dxi, dx_deta, _] = basis.first_of(patch.control_points());
/// assert!((dx_dxi[0] - 3.0).abs() < 1e-14 && dx_deta[0].abs() < 1e-14);
/// # Ok::<(), build::BuildError>(())
/// ```
#[derive(Clone, Debug)]
pub struct BasisValues {
    degrees: [usize; MAX_PARAMETERS],
    computed: Derivatives,
    active: Vec<usize>,
    values: Vec<f64>,
    first: Vec<Gradient>,
    second: Vec<Hessian>,
    /// Weights of the active control points.
    weights: Vec<f64>,
    /// For each parameter three rows: values, first and second derivatives.
    tables: [Vec<f64>; MAX_PARAMETERS],
}

impl BasisValues {
    /// Room for the basis functions of a spline.
    #[must_use]
    pub fn new<const D: usize>(spline: &Spline<D>) -> Self {
        let degrees = spline.degrees();
        let count = spline.active_count();
        // A missing parameter counts as one function, constant 1.
        let constant = || vec![1.0, 0.0, 0.0];
        let tables = std::array::from_fn(|i| match degrees[i] {
            0 => constant(),
            degree => vec![0.0; 3 * (degree + 1)],
        });
        Self {
            degrees,
            computed: Derivatives::None,
            active: vec![0; count],
            values: vec![0.0; count],
            first: vec![Gradient::default(); count],
            second: vec![Hessian::default(); count],
            weights: vec![1.0; count],
            tables,
        }
    }

    /// Control points whose functions do not vanish, along the first parameter first.
    #[must_use]
    pub fn active(&self) -> &[usize] {
        &self.active
    }

    /// Values `R_a`, in the order of [`active`](Self::active).
    #[must_use]
    pub fn values(&self) -> &[f64] {
        &self.values
    }

    /// First derivatives: `first()[a][i]` is `dR_a / dxi_i`; zero where there is no parameter `i`.
    ///
    /// # Panics
    /// When they were not asked for.
    #[must_use]
    pub fn first(&self) -> &[Gradient] {
        assert!(self.computed >= Derivatives::First, "first derivatives were not computed");
        &self.first
    }

    /// Second derivatives: `second()[a][i][j]` is `d2R_a / (dxi_i dxi_j)`.
    ///
    /// # Panics
    /// When they were not asked for.
    #[must_use]
    pub fn second(&self) -> &[Hessian] {
        assert!(self.computed == Derivatives::Second, "second derivatives were not computed");
        &self.second
    }

    /// Value `sum_a R_a c_a` of a field given by a coefficient for each control point of the spline.
    #[must_use]
    pub fn value_of<const N: usize>(&self, coefficients: &[[f64; N]]) -> [f64; N] {
        let mut value = [0.0; N];
        for (r, &a) in self.values.iter().zip(&self.active) {
            add_scaled(*r, &coefficients[a], &mut value);
        }
        value
    }

    /// First derivatives of a field by each parameter; zero where there is no such parameter.
    ///
    /// # Panics
    /// When first derivatives were not asked for.
    #[must_use]
    pub fn first_of<const N: usize>(&self, coefficients: &[[f64; N]]) -> [[f64; N]; MAX_PARAMETERS] {
        let mut first = [[0.0; N]; MAX_PARAMETERS];
        for (r, &a) in self.first().iter().zip(&self.active) {
            (0..MAX_PARAMETERS).for_each(|i| add_scaled(r[i], &coefficients[a], &mut first[i]));
        }
        first
    }

    /// Second derivatives of a field by each pair of parameters.
    ///
    /// # Panics
    /// When second derivatives were not asked for.
    #[must_use]
    pub fn second_of<const N: usize>(
        &self,
        coefficients: &[[f64; N]],
    ) -> [[[f64; N]; MAX_PARAMETERS]; MAX_PARAMETERS] {
        let mut second = [[[0.0; N]; MAX_PARAMETERS]; MAX_PARAMETERS];
        for (r, &a) in self.second().iter().zip(&self.active) {
            for i in 0..MAX_PARAMETERS {
                for j in 0..MAX_PARAMETERS {
                    add_scaled(r[i][j], &coefficients[a], &mut second[i][j]);
                }
            }
        }
        second
    }

    /// Fills the tables of one-parameter functions.
    fn tabulate(&mut self, knots: &[Knots], spans: [usize; MAX_PARAMETERS], xi: &[f64]) {
        let order = self.computed as usize;
        for (i, knots) in knots.iter().enumerate() {
            let length = (order + 1) * (knots.degree() + 1);
            bspline::derivatives(knots, spans[i], xi[i], order, &mut self.tables[i][..length]);
        }
    }

    /// Multiplies the one-parameter functions out.
    fn multiply_out(&mut self) {
        let count = self.degrees.map(|degree| degree + 1);
        let (with_first, with_second) =
            (self.computed >= Derivatives::First, self.computed == Derivatives::Second);
        // Value, first and second derivative of function n of parameter i.
        let jet = |i: usize, n: usize| -> [f64; 3] { [0, 1, 2].map(|k| self.tables[i][k * count[i] + n]) };
        let mut a = 0;
        for c in 0..count[2] {
            let z = jet(2, c);
            for b in 0..count[1] {
                let y = jet(1, b);
                for x in (0..count[0]).map(|n| jet(0, n)) {
                    self.values[a] = x[0] * y[0] * z[0];
                    if with_first {
                        self.first[a] = [x[1] * y[0] * z[0], x[0] * y[1] * z[0], x[0] * y[0] * z[1]];
                    }
                    if with_second {
                        let [xy, xz, yz] = [x[1] * y[1] * z[0], x[1] * y[0] * z[1], x[0] * y[1] * z[1]];
                        self.second[a] = [
                            [x[2] * y[0] * z[0], xy, xz],
                            [xy, x[0] * y[2] * z[0], yz],
                            [xz, yz, x[0] * y[0] * z[2]],
                        ];
                    }
                    a += 1;
                }
            }
        }
    }
}

impl<const D: usize> Spline<D> {
    /// Basis functions at the parameters `xi`, with as many derivatives as asked for; allocates nothing.
    ///
    /// At an inner knot the derivatives are those of the element to its right; [`basis_on`](Self::basis_on) gives
    /// the others. At the corners of the patch one value is exactly 1, the others exactly 0.
    ///
    /// # Panics
    /// When `xi` lies outside the domain or has the wrong length, or `basis` was made for other degrees.
    pub fn basis(&self, xi: &[f64], derivatives: Derivatives, basis: &mut BasisValues) {
        self.basis_at(self.spans_at(xi), xi, derivatives, basis);
    }

    /// Basis functions of one element at the parameters `xi` inside it or on its border.
    ///
    /// # Panics
    /// When `xi` lies outside the element or has the wrong length, or `basis` was made for other degrees.
    pub fn basis_on(&self, element: usize, xi: &[f64], derivatives: Derivatives, basis: &mut BasisValues) {
        assert_eq!(xi.len(), self.parameters(), "one number for each parameter");
        let element = self.element(element);
        for (xi, [start, end]) in xi.iter().zip(element.ranges()) {
            assert!(start <= xi && xi <= end, "the parameter {xi} lies outside the element [{start}, {end}]");
        }
        self.basis_at(self.element_spans(element.index()), xi, derivatives, basis);
    }

    fn basis_at(
        &self,
        spans: [usize; MAX_PARAMETERS],
        xi: &[f64],
        derivatives: Derivatives,
        basis: &mut BasisValues,
    ) {
        assert_eq!(basis.degrees, self.degrees(), "the workspace was made for a spline of other degrees");
        basis.computed = derivatives;
        self.fill_active(spans, &mut basis.active);
        basis.tabulate(self.knots(), spans, xi);
        basis.multiply_out();
        if self.is_rational() {
            self.rationalize(basis);
        }
    }

    fn rationalize(&self, basis: &mut BasisValues) {
        for (w, &a) in basis.weights.iter_mut().zip(&basis.active) {
            *w = self.weights()[a];
        }
        let count = basis.active.len();
        let upto = |wanted| if basis.computed >= wanted { count } else { 0 };
        let (first, second) = (upto(Derivatives::First), upto(Derivatives::Second));
        let BasisValues { weights, values, .. } = basis;
        nurbs::rationalize(weights, values, &mut basis.first[..first], &mut basis.second[..second]);
    }
}

fn add_scaled<const N: usize>(factor: f64, x: &[f64; N], y: &mut [f64; N]) {
    for (y, x) in y.iter_mut().zip(x) {
        *y += factor * x;
    }
}
