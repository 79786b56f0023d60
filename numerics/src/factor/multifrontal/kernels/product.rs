//! Products with tiles of the result in registers.

use faer::linalg::matmul::matmul;
use faer::{Accum, MatMut, MatRef, Par};
use pulp::Simd;

use super::super::layout::padded;
use super::{load, store};

/// Columns of a tile.
pub(in super::super) const WIDTH: usize = 6;

/// Above this many multiplications faer's product is faster, which rearranges both factors.
pub(super) const LARGE: usize = 1 << 17;

/// A group of columns of B, row by row, zeros where the group is narrower.
pub(super) type Packed = [f64; WIDTH];

/// Tile - sum of `a_k` `b_kj`: `a` has one column of `height` vectors for each row of `b`; the tile's rows start at vector
/// `at`.
#[inline(always)]
pub(super) fn tile<S: Simd, const M: usize>(
    simd: S,
    mut sums: [[S::f64s; M]; WIDTH],
    (a, height): (&[S::f64s], usize),
    at: usize,
    b: &[Packed],
) -> [[S::f64s; M]; WIDTH] {
    for (column, factors) in a.chunks_exact(height).zip(b) {
        let column: [S::f64s; M] = load::<S, M>(column, at);
        for j in 0..WIDTH {
            let factor = simd.splat_f64s(factors[j]);
            for i in 0..M {
                sums[j][i] = simd.negate_mul_add_e_f64s(column[i], factor, sums[j][i]);
            }
        }
    }
    sums
}

/// C := -L U for C q x q by padded columns, L q x p, and U as its transpose q x p. Whatever C held before is lost.
#[inline(always)]
pub(super) fn negative_outer<S: Simd, const M: usize>(
    simd: S,
    c: &mut [f64],
    (lower, upper): (&[f64], &[f64]),
    (rest, pivots): (usize, usize),
    packed: &mut [Packed],
) {
    let height = padded(rest);
    if rest * rest * pivots >= LARGE {
        let l = MatRef::from_column_major_slice(lower, height, pivots);
        let u = MatRef::from_column_major_slice_with_stride(upper, rest, pivots, height);
        let c = MatMut::from_column_major_slice_mut(c, height, rest);
        matmul(c, Accum::Replace, l, u.transpose(), -1.0, Par::Seq);
        return;
    }
    let (lower, _) = S::as_simd_f64s(lower);
    let vectors = height / S::F64_LANES;
    for (group, columns) in c.chunks_mut(WIDTH * height).enumerate() {
        let first = group * WIDTH;
        let width = WIDTH.min(rest - first);
        for (row, column) in packed.iter_mut().zip(upper.chunks_exact(height)) {
            row[..width].copy_from_slice(&column[first..first + width]);
        }
        let (columns, _) = S::as_mut_simd_f64s(columns);
        for at in (0..vectors).step_by(M) {
            let zeros = [[simd.splat_f64s(0.0); M]; WIDTH];
            let sums = tile::<S, M>(simd, zeros, (lower, vectors), at, &packed[..pivots]);
            store_tile::<S, M>(columns, vectors, at, width, &sums);
        }
    }
}

/// `M` vectors of each of `width` columns, zeros beyond.
#[inline(always)]
pub(super) fn load_tile<S: Simd, const M: usize>(
    simd: S,
    columns: &[S::f64s],
    height: usize,
    at: usize,
    width: usize,
) -> [[S::f64s; M]; WIDTH] {
    let mut tile = [[simd.splat_f64s(0.0); M]; WIDTH];
    for j in 0..WIDTH {
        if j < width {
            tile[j] = load::<S, M>(columns, j * height + at);
        }
    }
    tile
}

#[inline(always)]
pub(super) fn store_tile<S: Simd, const M: usize>(
    columns: &mut [S::f64s],
    height: usize,
    at: usize,
    width: usize,
    tile: &[[S::f64s; M]; WIDTH],
) {
    for j in 0..WIDTH {
        if j < width {
            store::<S, M>(columns, j * height + at, tile[j]);
        }
    }
}
