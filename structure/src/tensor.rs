//! The few operations on D x D tensors, beside those of [`partita_numerics::small`], that materials and kernel need.

pub(crate) use partita_numerics::small::{apply, dot, identity, multiply, trace};

/// A second-order tensor, row by row.
pub(crate) type Tensor<const D: usize> = [[f64; D]; D];

/// The tensor with the entries `entry(i, j)`.
#[inline]
pub(crate) fn build<const D: usize>(entry: impl Fn(usize, usize) -> f64) -> Tensor<D> {
    std::array::from_fn(|i| std::array::from_fn(|j| entry(i, j)))
}

/// sum += factor A
#[inline]
pub(crate) fn add_scaled<const D: usize>(factor: f64, a: &Tensor<D>, sum: &mut Tensor<D>) {
    for (sum, a) in sum.as_flattened_mut().iter_mut().zip(a.as_flattened()) {
        *sum += factor * a;
    }
}

/// A B^T
#[inline]
pub(crate) fn multiply_transposed<const D: usize>(a: &Tensor<D>, b: &Tensor<D>) -> Tensor<D> {
    build(|i, j| dot(&a[i], &b[j]))
}

/// A : B
#[inline]
pub(crate) fn contract<const D: usize>(a: &Tensor<D>, b: &Tensor<D>) -> f64 {
    (0..D).map(|i| dot(&a[i], &b[i])).sum()
}
