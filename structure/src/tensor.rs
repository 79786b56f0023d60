//! The few operations on D x D tensors, beside those of [`partita_numerics::small`], that materials and kernel need.

pub(crate) use partita_numerics::small::{apply, dot, identity, multiply, trace};

/// A second-order tensor, row by row.
pub(crate) type Tensor<const D: usize> = [[f64; D]; D];

/// The tensor with the entries `entry(i, j)`.
#[inline]
pub(crate) fn build<const D: usize>(entry: impl Fn(usize, usize) -> f64) -> Tensor<D> {
    array(|i| array(|j| entry(i, j)))
}

/// The array with the entries `entry(i)`.
#[inline]
pub(crate) fn array<T, const D: usize>(entry: impl Fn(usize) -> T) -> [T; D] {
    std::array::from_fn(entry)
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
