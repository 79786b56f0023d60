//! Univariate B-spline basis functions and their derivatives.
//!
//! On one span `i` only the functions `N_{i-degree}, ..., N_i` differ from zero; all slices here hold these
//! `degree + 1` values in order. Derivatives at a knot are those of the span that is named, so both one-sided
//! limits are at hand.

use crate::knots::Knots;

/// Values of the basis functions that live on a span.
///
/// Cox-de Boor recursion (Piegl and Tiller, *The NURBS Book*, eq. 2.5 and Algorithm A2.2):
///
/// ```text
/// N_{a,q}(xi) = (xi - xi_a)/(xi_{a+q} - xi_a) N_{a,q-1} + (xi_{a+q+1} - xi)/(xi_{a+q+1} - xi_{a+1}) N_{a+1,q-1}
/// ```
///
/// At the first and the last knot one value is exactly 1 and the others exactly 0.
///
/// # Panics
/// When `values` does not hold `degree + 1` numbers.
///
/// ```
/// use partita_iga::{Knots, bspline};
///
/// let knots = Knots::uniform(2, 1)?; // a single span: Bernstein polynomials
/// let mut values = [0.0; 3];
/// bspline::basis(&knots, knots.span_at(0.5), 0.5, &mut values);
/// assert_eq!(values, [0.25, 0.5, 0.25]);
/// # Ok::<(), partita_iga::KnotError>(())
/// ```
pub fn basis(knots: &Knots, span: usize, xi: f64, values: &mut [f64]) {
    derivatives(knots, span, xi, 0, values);
}

/// Values and derivatives up to `order` of the basis functions that live on a span.
///
/// Row `k` of `table`, `degree + 1` numbers long, holds the `k`-th derivatives. They follow from the values of
/// degree `degree - k` by applying `k` times (eq. 2.7)
///
/// ```text
/// N'_{a,q} = q N_{a,q-1}/(xi_{a+q} - xi_a) - q N_{a+1,q-1}/(xi_{a+q+1} - xi_{a+1})
/// ```
///
/// which is what Algorithm A2.3 does, without its tables. Derivatives beyond the degree are zero.
///
/// # Panics
/// When `table` does not hold `(order + 1) * (degree + 1)` numbers.
pub fn derivatives(knots: &Knots, span: usize, xi: f64, order: usize, table: &mut [f64]) {
    let (degree, knots) = (knots.degree(), knots.values());
    let width = degree + 1;
    assert_eq!(table.len(), (order + 1) * width, "the table of basis functions has the wrong length");
    let (values, rows) = table.split_at_mut(width);
    rows.fill(0.0);

    values[0] = 1.0;
    for q in 1..=degree {
        let k = degree + 1 - q;
        if k <= order {
            rows[(k - 1) * width..][..q].copy_from_slice(&values[..q]);
        }
        raise(knots, span, q, xi, values);
    }
    for (row, k) in rows.chunks_exact_mut(width).zip(1..=degree) {
        for q in degree + 1 - k..=degree {
            differentiate(knots, span, q, row);
        }
    }
}

/// Blossoms `N_a[xi_1, ..., xi_degree]` of the basis functions that live on a span.
///
/// The blossom of a polynomial of degree `p` is the one symmetric function of `p` arguments, affine in each, that
/// equals the polynomial where all arguments are equal: Cox-de Boor with another argument at each step.
/// With the arguments `t_{i+1}, ..., t_{i+p}`, consecutive knots of a finer vector, and the span that holds `t_i`,
/// the results are the coefficients of the Oslo algorithm: not negative, and one in sum.
///
/// # Panics
/// When `arguments` does not hold `degree` or `values` not `degree + 1` numbers.
pub fn blossom(knots: &Knots, span: usize, arguments: &[f64], values: &mut [f64]) {
    assert_eq!(arguments.len(), knots.degree(), "a blossom has as many arguments as the degree");
    assert_eq!(values.len(), knots.degree() + 1, "a span has degree + 1 basis functions");
    blossom_on(knots.values(), span, arguments, values);
}

/// The same on any ascending knots, `arguments.len()` of them on either side of the span.
pub(crate) fn blossom_on(knots: &[f64], span: usize, arguments: &[f64], values: &mut [f64]) {
    values[0] = 1.0;
    for (q, xi) in (1..).zip(arguments) {
        raise(knots, span, q, *xi, values);
    }
}

/// Turns the values of degree `q - 1` into those of degree `q`, in place.
fn raise(knots: &[f64], span: usize, q: usize, xi: f64, values: &mut [f64]) {
    let mut carried = 0.0;
    for r in 0..q {
        let (left, right) = (knots[span + 1 + r - q], knots[span + 1 + r]);
        let value = values[r];
        // Two quotients, not one inverse: each is exactly 1 or 0 where xi is a clamped end.
        values[r] = carried + (right - xi) / (right - left) * value;
        carried = (xi - left) / (right - left) * value;
    }
    values[q] = carried;
}

/// Turns values (or derivatives) of degree `q - 1` into first (or next) derivatives of degree `q`, in place.
fn differentiate(knots: &[f64], span: usize, q: usize, row: &mut [f64]) {
    let mut carried = 0.0;
    for r in 0..q {
        let slope = q as f64 * row[r] / (knots[span + 1 + r] - knots[span + 1 + r - q]);
        row[r] = carried - slope;
        carried = slope;
    }
    row[q] = carried;
}
