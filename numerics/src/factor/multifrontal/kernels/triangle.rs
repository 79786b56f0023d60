//! X := X T^-1 for the two triangles of a factored diagonal block.

use faer::linalg::matmul::matmul;
use faer::{Accum, MatMut, MatRef, Par};
use pulp::Simd;

use super::super::layout::padded;
use super::product::{LARGE, Packed, WIDTH, load_tile, store_tile, tile};

/// Columns that are solved for before a large product brings in the next ones.
const BLOCK: usize = 8 * WIDTH;

/// `U_D`, or the transpose of `L_D`: both are upper triangles, so both are solved with from the left to the right.
#[derive(Clone, Copy)]
pub(super) struct Triangle<'a> {
    /// `L_D` and `U_D` in one square by padded columns.
    pub(super) entries: &'a [f64],
    pub(super) size: usize,
    /// Of the diagonal of `U_D`; nothing for `L_D`, whose diagonal is one.
    pub(super) inverses: Option<&'a [f64]>,
}

impl Triangle<'_> {
    /// T (k, j).
    #[inline(always)]
    fn at(&self, k: usize, j: usize) -> f64 {
        let (row, column) = if self.inverses.is_some() { (k, j) } else { (j, k) };
        self.entries[row + column * padded(self.size)]
    }

    /// 1 / T (j, j).
    #[inline(always)]
    fn inverse(&self, j: usize) -> f64 {
        self.inverses.map_or(1.0, |inverses| inverses[j])
    }

    /// Rows `0..first` of the columns `first..end`.
    fn rectangle(&self, first: usize, end: usize) -> MatRef<'_, f64> {
        let square = MatRef::from_column_major_slice_with_stride(
            self.entries,
            self.size,
            self.size,
            padded(self.size),
        );
        let upper = if self.inverses.is_some() { square } else { square.transpose() };
        upper.submatrix(0, first, first, end - first)
    }
}

/// `x` has columns of `height` numbers, one for each column of the triangle.
#[inline(always)]
pub(super) fn solve_right<S: Simd, const M: usize>(
    simd: S,
    x: &mut [f64],
    height: usize,
    triangle: &Triangle,
    packed: &mut [Packed],
) {
    let size = triangle.size;
    if height * BLOCK * size < LARGE {
        solve_columns::<S, M>(simd, x, height, triangle, (0, size), packed);
        return;
    }
    for first in (0..size).step_by(BLOCK) {
        let end = size.min(first + BLOCK);
        let (done, next) = x.split_at_mut(first * height);
        let done = MatRef::from_column_major_slice(done, height, first);
        let next =
            MatMut::from_column_major_slice_mut(&mut next[..(end - first) * height], height, end - first);
        matmul(next, Accum::Add, done, triangle.rectangle(first, end), -1.0, Par::Seq);
        solve_columns::<S, M>(simd, x, height, triangle, (first, end), packed);
    }
}

/// Solves for the columns `first..end`, from which those before `first` are subtracted already.
#[inline(always)]
fn solve_columns<S: Simd, const M: usize>(
    simd: S,
    x: &mut [f64],
    height: usize,
    triangle: &Triangle,
    (first, end): (usize, usize),
    packed: &mut [Packed],
) {
    let vectors = height / S::F64_LANES;
    for start in (first..end).step_by(WIDTH) {
        let width = WIDTH.min(end - start);
        pack(triangle, (first, start, width), packed);
        let (above, corner) = packed.split_at(start - first);
        let mut inverses = [0.0; WIDTH];
        for j in 0..width {
            inverses[j] = triangle.inverse(start + j);
        }
        let (done, columns) = x[first * height..end * height].split_at_mut((start - first) * height);
        let (done, _) = S::as_simd_f64s(done);
        let (columns, _) = S::as_mut_simd_f64s(columns);
        for at in (0..vectors).step_by(M) {
            let mut sums = load_tile::<S, M>(simd, columns, vectors, at, width);
            sums = tile::<S, M>(simd, sums, (done, vectors), at, above);
            for j in 0..WIDTH {
                for k in 0..j {
                    let factor = simd.splat_f64s(corner[k][j]);
                    for i in 0..M {
                        sums[j][i] = simd.negate_mul_add_e_f64s(sums[k][i], factor, sums[j][i]);
                    }
                }
                let inverse = simd.splat_f64s(inverses[j]);
                sums[j] = sums[j].map(|sum| simd.mul_f64s(sum, inverse));
            }
            store_tile::<S, M>(columns, vectors, at, width, &sums);
        }
    }
}

/// The rows of T that a group of columns needs: those above its corner, then the corner.
#[inline(always)]
fn pack(triangle: &Triangle, (first, start, width): (usize, usize, usize), packed: &mut [Packed]) {
    for (k, row) in (first..start + width).zip(packed.iter_mut()) {
        *row = [0.0; WIDTH];
        for j in 0..width {
            if k < start + j {
                row[j] = triangle.at(k, start + j);
            }
        }
    }
    // Beyond a narrow corner there is nothing.
    packed[start - first + width..start - first + WIDTH].fill([0.0; WIDTH]);
}
