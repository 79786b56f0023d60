//! How a front lies in memory.

/// Columns are padded to a multiple of this, with zeros that every operation keeps, so that kernels see whole vectors
/// of 2, 4 or 8 numbers only.
pub(super) const PADDING: usize = 8;

/// Rounds up to whole vectors.
pub(super) const fn padded(len: usize) -> usize {
    len.next_multiple_of(PADDING)
}

/// Shapes of a front with p pivots and q rows below them, cut into four parts:
///
/// ```text
/// [ D  U ]    D  p x p  becomes L_D and U_D        L := L U_D^-1
/// [ L  C ]    L  q x p, U  p x q, C  q x q         U := L_D^-1 U,    C - L U  for the parent
/// ```
///
/// D, L and the **transpose** of U stand by columns in the factor, one after the other, followed by one over the
/// diagonal of `U_D`. So L and U are treated alike, and all long loops run down columns.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Layout {
    pub(super) pivots: usize,
    pub(super) rest: usize,
}

/// The parts of a front's factor.
pub(super) struct Parts<T> {
    pub(super) diagonal: T,
    pub(super) lower: T,
    pub(super) upper: T,
    /// 1 / `U_ii`.
    pub(super) inverses: T,
}

impl Layout {
    /// Numbers in D.
    const fn diagonal_len(self) -> usize {
        padded(self.pivots) * self.pivots
    }

    /// Numbers in L, and in the transpose of U.
    const fn lower_len(self) -> usize {
        padded(self.rest) * self.pivots
    }

    pub(super) const fn factor_len(self) -> usize {
        self.diagonal_len() + 2 * self.lower_len() + padded(self.pivots)
    }

    pub(super) const fn contribution_len(self) -> usize {
        padded(self.rest) * self.rest
    }

    /// Where D (row, column) stands in the factor.
    pub(super) const fn diagonal(self, row: usize, column: usize) -> usize {
        row + column * padded(self.pivots)
    }

    /// Where L (row, column) stands in the factor.
    pub(super) const fn lower(self, row: usize, column: usize) -> usize {
        self.diagonal_len() + row + column * padded(self.rest)
    }

    /// Where U (row, column) stands in the factor.
    pub(super) const fn upper(self, row: usize, column: usize) -> usize {
        self.diagonal_len() + self.lower_len() + column + row * padded(self.rest)
    }

    pub(super) fn parts(self, factor: &[f64]) -> Parts<&[f64]> {
        let (diagonal, others) = factor.split_at(self.diagonal_len());
        let (lower, others) = others.split_at(self.lower_len());
        let (upper, inverses) = others.split_at(self.lower_len());
        Parts { diagonal, lower, upper, inverses }
    }

    pub(super) fn parts_mut(self, factor: &mut [f64]) -> Parts<&mut [f64]> {
        let (diagonal, others) = factor.split_at_mut(self.diagonal_len());
        let (lower, others) = others.split_at_mut(self.lower_len());
        let (upper, inverses) = others.split_at_mut(self.lower_len());
        Parts { diagonal, lower, upper, inverses }
    }
}
