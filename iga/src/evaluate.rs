//! Points and tangents of a spline.

use crate::basis::{BasisValues, Derivatives};
use crate::spline::Spline;

impl<const D: usize> Spline<D> {
    /// Point at the parameters `xi`. Allocates; loops use [`basis`](Self::basis) with a [`BasisValues`].
    ///
    /// # Panics
    /// When `xi` lies outside the domain or has the wrong length.
    #[must_use]
    pub fn point(&self, xi: &[f64]) -> [f64; D] {
        let mut basis = BasisValues::new(self);
        self.basis(xi, Derivatives::None, &mut basis);
        basis.value_of(self.control_points())
    }

    /// Derivative of the point by one parameter at `xi`. Allocates, as [`point`](Self::point) does.
    ///
    /// # Panics
    /// When `xi` lies outside the domain or has the wrong length, or there is no such parameter.
    #[must_use]
    pub fn tangent(&self, xi: &[f64], parameter: usize) -> [f64; D] {
        assert!(parameter < self.parameters(), "the spline has no parameter {parameter}");
        let mut basis = BasisValues::new(self);
        self.basis(xi, Derivatives::First, &mut basis);
        basis.first_of(self.control_points())[parameter]
    }
}
