//! Algebra of 1x1, 2x2 and 3x3 matrices as plain arrays, rows first: `a[i][j]`.
//!
//! What kernels on [`lanes`] need is written for any [`Real`].
#![allow(
    clippy::inline_always,
    reason = "vector code has to be part of the entry point of its instruction set"
)]

use crate::lanes::{self, Real};

/// det(a) for D = 1, 2 or 3.
///
/// ```
/// use partita_numerics::small::determinant;
///
/// assert_eq!(determinant(&[[2.0, 1.0], [3.0, 4.0]]), 5.0);
/// ```
///
/// # Panics
///
/// If D is not 1, 2 or 3.
#[inline(always)]
#[must_use]
pub fn determinant<const D: usize, R: Real>(a: &[[R; D]; D]) -> R {
    match D {
        1 => a[0][0],
        2 => a[0][0] * a[1][1] - a[0][1] * a[1][0],
        3 => lanes::sum::<D, R>(
            #[inline(always)]
            |j| a[0][j] * cofactor(a, 0, j),
        ),
        _ => panic!("determinant of a {D}x{D} matrix"),
    }
}

/// The inverse of `a` and its determinant, or `None` where the determinant is zero or not finite, in any lane.
///
/// ```
/// use partita_numerics::small::inverse;
///
/// let (inverse, determinant) = inverse(&[[2.0, 0.0], [1.0, 4.0]]).unwrap();
/// assert_eq!(inverse, [[0.5, 0.0], [-0.125, 0.25]]);
/// assert_eq!(determinant, 8.0);
/// ```
///
/// # Panics
///
/// If D is not 1, 2 or 3.
#[inline(always)]
#[must_use]
pub fn inverse<const D: usize, R: Real>(a: &[[R; D]; D]) -> Option<([[R; D]; D], R)> {
    let determinant = determinant(a);
    if determinant.lanes().iter().any(|determinant| *determinant == 0.0 || !determinant.is_finite()) {
        return None;
    }
    let mut inverse = *a;
    for i in 0..D {
        for j in 0..D {
            inverse[j][i] = cofactor(a, i, j) / determinant;
        }
    }
    Some((inverse, determinant))
}

/// (-1)^(i+j) times the determinant of `a` without row i and column j.
#[inline(always)]
fn cofactor<const D: usize, R: Real>(a: &[[R; D]; D], i: usize, j: usize) -> R {
    match D {
        1 => a[0][0].like(1.0),
        2 if i == j => a[1 - i][1 - j],
        2 => -a[1 - i][1 - j],
        // Cyclic indices carry the sign.
        3 => {
            let (i1, i2, j1, j2) = ((i + 1) % D, (i + 2) % D, (j + 1) % D, (j + 2) % D);
            a[i1][j1] * a[i2][j2] - a[i1][j2] * a[i2][j1]
        }
        _ => panic!("cofactor of a {D}x{D} matrix"),
    }
}

/// a b, for an M x K matrix and a K x N matrix.
#[inline]
#[must_use]
pub fn multiply<const M: usize, const K: usize, const N: usize>(
    a: &[[f64; K]; M],
    b: &[[f64; N]; K],
) -> [[f64; N]; M] {
    let mut product = [[0.0; N]; M];
    for i in 0..M {
        for k in 0..K {
            for j in 0..N {
                product[i][j] += a[i][k] * b[k][j];
            }
        }
    }
    product
}

/// a^T b, for a K x M matrix and a K x N matrix.
///
/// ```
/// use partita_numerics::small::transpose_multiply;
///
/// // The right Cauchy-Green tensor C = F^T F of a shear.
/// let f = [[1.0, 0.5], [0.0, 1.0]];
/// assert_eq!(transpose_multiply(&f, &f), [[1.0, 0.5], [0.5, 1.25]]);
/// ```
#[inline]
#[must_use]
pub fn transpose_multiply<const K: usize, const M: usize, const N: usize>(
    a: &[[f64; M]; K],
    b: &[[f64; N]; K],
) -> [[f64; N]; M] {
    let mut product = [[0.0; N]; M];
    for k in 0..K {
        for i in 0..M {
            for j in 0..N {
                product[i][j] += a[k][i] * b[k][j];
            }
        }
    }
    product
}

/// a x, for an M x N matrix.
#[inline]
#[must_use]
pub fn apply<const M: usize, const N: usize>(a: &[[f64; N]; M], x: &[f64; N]) -> [f64; M] {
    std::array::from_fn(|i| dot(&a[i], x))
}

/// a^T x, for an M x N matrix.
#[inline]
#[must_use]
pub fn transpose_apply<const M: usize, const N: usize>(a: &[[f64; N]; M], x: &[f64; M]) -> [f64; N] {
    std::array::from_fn(|j| (0..M).map(|i| a[i][j] * x[i]).sum())
}

/// The scalar product of two vectors.
#[inline(always)]
#[must_use]
pub fn dot<const D: usize, R: Real>(x: &[R; D], y: &[R; D]) -> R {
    lanes::sum::<D, R>(
        #[inline(always)]
        |i| x[i] * y[i],
    )
}

/// The unit matrix.
#[inline]
#[must_use]
pub fn identity<const D: usize>() -> [[f64; D]; D] {
    std::array::from_fn(|i| std::array::from_fn(|j| f64::from(u8::from(i == j))))
}

/// The sum of the diagonal.
#[inline(always)]
#[must_use]
pub fn trace<const D: usize, R: Real>(a: &[[R; D]; D]) -> R {
    lanes::sum::<D, R>(
        #[inline(always)]
        |i| a[i][i],
    )
}

#[cfg(test)]
#[allow(clippy::float_cmp, reason = "these values are exact")]
mod tests {
    use super::*;
    use approx::assert_relative_eq;
    use nalgebra::SMatrix;
    use proptest::prelude::*;

    /// `nalgebra` fills by columns, so this is the matrix itself only after a transposition.
    fn dense<const M: usize, const N: usize>(a: &[[f64; N]; M]) -> SMatrix<f64, M, N> {
        SMatrix::from_fn(|i, j| a[i][j])
    }

    fn agrees_with_dense_algebra<const D: usize>(a: &[[f64; D]; D], b: &[[f64; D]; D], x: &[f64; D]) {
        let dense_x = SMatrix::<f64, D, 1>::from_fn(|i, _| x[i]);
        let near = |left: SMatrix<f64, D, D>, right| assert_relative_eq!(left, right, epsilon = 1e-13);
        near(dense(&multiply(a, b)), dense(a) * dense(b));
        near(dense(&transpose_multiply(a, b)), dense(a).transpose() * dense(b));
        let columns = |x: [f64; D]| SMatrix::<f64, D, 1>::from_fn(|i, _| x[i]);
        assert_relative_eq!(columns(apply(a, x)), dense(a) * dense_x, epsilon = 1e-13);
        assert_relative_eq!(columns(transpose_apply(a, x)), dense(a).transpose() * dense_x, epsilon = 1e-13);
        assert_relative_eq!(trace(a), dense(a).trace(), epsilon = 1e-13);
        let (inverse, determinant) = inverse(a).expect("a random matrix is regular");
        assert_relative_eq!(determinant, super::determinant(a));
        let error = dense(&multiply(a, &inverse)) - dense(&identity::<D>());
        assert!(error.norm() <= 1e-13 * dense(a).norm() * dense(&inverse).norm());
    }

    fn entries<const D: usize>() -> impl Strategy<Value = [[f64; D]; D]> {
        prop::collection::vec(-1.0..1.0, D * D)
            .prop_map(|v| std::array::from_fn(|i| std::array::from_fn(|j| v[i * D + j])))
    }

    proptest! {
        #[test]
        fn one_by_one_agrees(a in entries::<1>(), b in entries::<1>()) {
            prop_assume!(a[0][0].abs() > 1e-6);
            prop_assert_eq!(determinant(&a), a[0][0]);
            agrees_with_dense_algebra(&a, &b, &b[0]);
        }

        #[test]
        fn two_by_two_agrees(a in entries::<2>(), b in entries::<2>()) {
            prop_assume!(determinant(&a).abs() > 1e-6);
            prop_assert!((determinant(&a) - dense(&a).determinant()).abs() < 1e-14);
            agrees_with_dense_algebra(&a, &b, &b[0]);
        }

        #[test]
        fn three_by_three_agrees(a in entries::<3>(), b in entries::<3>()) {
            prop_assume!(determinant(&a).abs() > 1e-6);
            prop_assert!((determinant(&a) - dense(&a).determinant()).abs() < 1e-14);
            agrees_with_dense_algebra(&a, &b, &b[0]);
        }
    }

    #[test]
    fn rectangular_products_have_the_right_shape() {
        // Gradients of the three shape functions of a triangle against themselves.
        let gradients = [[-1.0, 1.0, 0.0], [-1.0, 0.0, 1.0]];
        let stiffness = transpose_multiply(&gradients, &gradients);
        assert_eq!(stiffness, [[2.0, -1.0, -1.0], [-1.0, 1.0, 0.0], [-1.0, 0.0, 1.0]]);
        assert_eq!(multiply(&gradients, &stiffness)[1], [-3.0, 1.0, 2.0]);
    }

    #[test]
    fn singular_and_broken_matrices_have_no_inverse() {
        assert_eq!(inverse(&[[1.0, 2.0], [2.0, 4.0]]), None);
        assert_eq!(inverse(&[[f64::NAN]]), None);
        assert_eq!(inverse(&[[0.0; 3]; 3]), None);
    }
}
