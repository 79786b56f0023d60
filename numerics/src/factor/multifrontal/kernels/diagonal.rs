//! D := L U of a square block, with threshold pivoting among its rows.

use faer::linalg::matmul::matmul;
use faer::{Accum, MatMut, MatRef, Par};
use pulp::Simd;

use super::super::layout::{PADDING, padded};
use super::super::symbolic::narrow;
use super::product::{LARGE, Packed, WIDTH, load_tile, store_tile, tile};
use super::{NoPivot, load, store};

/// A diagonal entry stays pivot unless it is this much smaller than the largest one below it.
const THRESHOLD: f64 = 0.1;

/// Columns that are eliminated before a product brings the others up to date; a multiple of the padding.
const PANEL: usize = 4 * PADDING;

pub(super) struct Diagonal<'a> {
    /// By padded columns.
    pub(super) entries: &'a mut [f64],
    pub(super) pivots: usize,
    pub(super) interchanges: &'a mut [u32],
    pub(super) inverses: &'a mut [f64],
}

/// The rows of a piece of eight that are eliminated by the pivot in row `k` of it.
const BELOW: [[f64; PADDING]; PADDING] = {
    let mut below = [[0.0; PADDING]; PADDING];
    let mut k = 0;
    while k < PADDING {
        let mut row = k + 1;
        while row < PADDING {
            below[k][row] = 1.0;
            row += 1;
        }
        k += 1;
    }
    below
};

#[inline(always)]
pub(super) fn factor_diagonal<S: Simd, const M: usize>(
    simd: S,
    block: &mut Diagonal,
    packed: &mut [Packed],
) -> Result<(), NoPivot> {
    let (size, height) = (block.pivots, padded(block.pivots));
    for first in (0..size).step_by(PANEL) {
        let end = size.min(first + PANEL);
        for k in first..end {
            choose_pivot(block, k)?;
            let (column, others) = block.entries[k * height..].split_at_mut(height);
            eliminate::<S, M>(simd, column, &mut others[..(end - k - 1) * height], k, block.inverses[k]);
        }
        if end < size {
            update::<S, M>(simd, block, (first, end), packed);
        }
    }
    Ok(())
}

/// Finds the pivot of column `k`, and swaps its row into place in all columns.
#[inline(always)]
fn choose_pivot(block: &mut Diagonal, k: usize) -> Result<(), NoPivot> {
    let height = padded(block.pivots);
    let candidates = &block.entries[k * height..][k..block.pivots];
    let largest = candidates.iter().fold(0.0, |a: f64, b| if b.abs() > a { b.abs() } else { a });
    let mut taken = k;
    if candidates[0].abs() < THRESHOLD * largest {
        taken = k + candidates.iter().position(|entry| entry.abs() >= largest).ok_or(NoPivot(k))?;
        for column in block.entries.chunks_exact_mut(height) {
            column.swap(k, taken);
        }
    }
    let pivot = block.entries[k * height + k];
    if pivot == 0.0 {
        return Err(NoPivot(k));
    }
    block.interchanges[k] = narrow(taken);
    block.inverses[k] = 1.0 / pivot;
    Ok(())
}

/// Divides the column below row `k` by the pivot, and eliminates that row from the `others`.
#[inline(always)]
fn eliminate<S: Simd, const M: usize>(
    simd: S,
    column: &mut [f64],
    others: &mut [f64],
    k: usize,
    inverse: f64,
) {
    let piece = k / PADDING * M;
    let (below, _) = S::as_simd_f64s(&BELOW[k % PADDING]);
    let below: [S::f64s; M] = load::<S, M>(below, 0);
    let height = column.len() / S::F64_LANES;
    let inverse = simd.splat_f64s(inverse);
    let (column, _) = S::as_mut_simd_f64s(column);
    // The piece with the pivot: above and at the pivot nothing changes.
    let values = load::<S, M>(column, piece);
    let first: [S::f64s; M] =
        std::array::from_fn(|i| simd.mul_f64s(simd.mul_f64s(values[i], inverse), below[i]));
    let kept: [S::f64s; M] =
        std::array::from_fn(|i| simd.negate_mul_add_e_f64s(values[i], below[i], values[i]));
    store::<S, M>(column, piece, std::array::from_fn(|i| simd.add_f64s(kept[i], first[i])));
    for value in &mut column[piece + M..] {
        *value = simd.mul_f64s(*value, inverse);
    }
    for other in others.chunks_exact_mut(height * S::F64_LANES) {
        subtract_multiple::<S, M>(simd, (column, &first), other, piece, k);
    }
}

/// other := other - column * (entry of the other in row `k`), for the rows below `k`, whose piece is `first`.
#[inline(always)]
fn subtract_multiple<S: Simd, const M: usize>(
    simd: S,
    (column, first): (&[S::f64s], &[S::f64s; M]),
    other: &mut [f64],
    piece: usize,
    k: usize,
) {
    let factor = simd.splat_f64s(other[k]);
    let (other, _) = S::as_mut_simd_f64s(other);
    let head = load::<S, M>(other, piece);
    store::<S, M>(
        other,
        piece,
        std::array::from_fn(|i| simd.negate_mul_add_e_f64s(first[i], factor, head[i])),
    );
    for (value, multiplier) in other[piece + M..].iter_mut().zip(&column[piece + M..]) {
        *value = simd.negate_mul_add_e_f64s(*multiplier, factor, *value);
    }
}

/// Brings the columns behind a panel up to date: U := L^-1 U beside it, then the square below minus L U.
#[inline(always)]
fn update<S: Simd, const M: usize>(
    simd: S,
    block: &mut Diagonal,
    (first, end): (usize, usize),
    packed: &mut [Packed],
) {
    let (size, height) = (block.pivots, padded(block.pivots));
    let (panel, behind) = block.entries.split_at_mut(end * height);
    let panel = &panel[first * height..];
    // Pieces are eight rows and panels whole pieces, so that the rows of the panel end with a piece.
    let top = end * M / PADDING;
    for k in first..end {
        let (column, _) = S::as_simd_f64s(&panel[(k - first) * height..][..height]);
        let (below, _) = S::as_simd_f64s(&BELOW[k % PADDING]);
        let piece = k / PADDING * M;
        let values = load::<S, M>(column, piece);
        let head: [S::f64s; M] = std::array::from_fn(|i| simd.mul_f64s(values[i], below[i]));
        for other in behind.chunks_exact_mut(height) {
            let other = &mut other[..top * S::F64_LANES];
            subtract_multiple::<S, M>(simd, (&column[..top], &head), other, piece, k);
        }
    }
    let (count, depth) = (size - end, end - first);
    if count * count * depth >= LARGE {
        let lower = MatRef::from_column_major_slice(panel, height, depth);
        let square = MatMut::from_column_major_slice_mut(behind, height, count);
        let (upper, square) = square.split_at_row_mut(end);
        let upper = upper.as_ref().subrows(first, depth);
        matmul(square, Accum::Add, lower.subrows(end, height - end), upper, -1.0, Par::Seq);
        return;
    }
    let (lower, _) = S::as_simd_f64s(panel);
    let vectors = height / S::F64_LANES;
    for columns in behind.chunks_mut(WIDTH * height) {
        let width = columns.len() / height;
        for (k, row) in (first..end).zip(packed.iter_mut()) {
            for j in 0..width {
                row[j] = columns[k + j * height];
            }
        }
        let (columns, _) = S::as_mut_simd_f64s(columns);
        for at in (top..vectors).step_by(M) {
            let sums = load_tile::<S, M>(simd, columns, vectors, at, width);
            let sums = tile::<S, M>(simd, sums, (lower, vectors), at, &packed[..depth]);
            store_tile::<S, M>(columns, vectors, at, width, &sums);
        }
    }
}
