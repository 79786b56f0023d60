//! From B-spline to NURBS basis functions: the quotient rule.

use crate::spline::MAX_PARAMETERS;

/// First derivatives of one function by each parameter; entries of missing parameters are zero.
pub type Gradient = [f64; MAX_PARAMETERS];
/// Second derivatives of one function by each pair of parameters.
pub type Hessian = [[f64; MAX_PARAMETERS]; MAX_PARAMETERS];

/// Turns the tensor-product functions `N_a` and their derivatives into rational ones, in place.
///
/// With `W = sum_b w_b N_b` (Piegl and Tiller, *The NURBS Book*, section 4.3)
///
/// ```text
/// R_a    =  w_a N_a / W
/// R_a,i  = (w_a N_a,i  - R_a W_,i) / W
/// R_a,ij = (w_a N_a,ij - R_a,i W_,j - R_a,j W_,i - R_a W_,ij) / W
/// ```
///
/// `first` and `second` may be empty: the derivatives are then left out.
///
/// # Panics
/// When there are not as many weights as values, or second derivatives without first ones.
pub fn rationalize(weights: &[f64], values: &mut [f64], first: &mut [Gradient], second: &mut [Hessian]) {
    assert_eq!(weights.len(), values.len(), "one weight for each basis function");
    assert!(second.len() <= first.len(), "second derivatives of a quotient need the first ones");

    let sum: f64 = weights.iter().zip(&*values).map(|(w, n)| w * n).sum();
    let mut sum_first = Gradient::default();
    for (w, n) in weights.iter().zip(&*first) {
        (0..MAX_PARAMETERS).for_each(|i| sum_first[i] += w * n[i]);
    }
    let mut sum_second = Hessian::default();
    for (w, n) in weights.iter().zip(&*second) {
        each_pair(|i, j| sum_second[i][j] += w * n[i][j]);
    }

    for (r, w) in values.iter_mut().zip(weights) {
        *r *= w / sum;
    }
    for ((r_i, w), r) in first.iter_mut().zip(weights).zip(&*values) {
        (0..MAX_PARAMETERS).for_each(|i| r_i[i] = (w * r_i[i] - r * sum_first[i]) / sum);
    }
    for (((r_ij, w), r), r_i) in second.iter_mut().zip(weights).zip(&*values).zip(&*first) {
        each_pair(|i, j| {
            let products = r_i[i] * sum_first[j] + r_i[j] * sum_first[i] + r * sum_second[i][j];
            r_ij[i][j] = (w * r_ij[i][j] - products) / sum;
        });
    }
}

fn each_pair(mut f: impl FnMut(usize, usize)) {
    for i in 0..MAX_PARAMETERS {
        for j in 0..MAX_PARAMETERS {
            f(i, j);
        }
    }
}
