//! Dense elimination of one front, on the widest vectors the machine has.
//!
//! The instruction set is chosen when the program runs. Every function here is inlined into the entry point of its
//! instruction set, because vector code that is called from outside of it would fall back to scalars. Columns are whole
//! vectors (see [`PADDING`](super::layout::PADDING)), `M` of them in a piece of eight rows.
#![allow(
    clippy::inline_always,
    reason = "vector code has to be part of the entry point of its instruction set"
)]

mod diagonal;
mod product;
mod triangle;

use pulp::{Arch, Simd, WithSimd};

use super::layout::{Layout, Parts, padded};
use diagonal::{Diagonal, factor_diagonal};
use product::negative_outer;
use triangle::{Triangle, solve_right};

/// A pivot block without any usable pivot in this column.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct NoPivot(pub(super) usize);

/// Numbers the kernels rearrange their factors in.
pub(super) struct Scratch {
    packed: Vec<[f64; product::WIDTH]>,
}

impl Scratch {
    /// For fronts whose columns have at most this many numbers.
    pub(super) fn new(widest: usize) -> Self {
        Self { packed: vec![[0.0; product::WIDTH]; widest + product::WIDTH] }
    }
}

/// D, L and U hold the assembled values, and afterwards the factors; C becomes what the elimination adds to it, so that
/// nobody has to fill it with zeros before.
pub(super) struct Eliminate<'a> {
    pub(super) layout: Layout,
    pub(super) factor: &'a mut [f64],
    pub(super) contribution: &'a mut [f64],
    /// For each pivot, the row of D that was taken for it.
    pub(super) interchanges: &'a mut [u32],
    pub(super) scratch: &'a mut Scratch,
}

impl Eliminate<'_> {
    pub(super) fn run(self, arch: Arch) -> Result<(), NoPivot> {
        arch.dispatch(self)
    }

    /// D := `L_D` `U_D` with interchanges; U := `L_D`^-1 U;  L := L `U_D`^-1;  C := -L U.
    #[inline(always)]
    fn eliminate<S: Simd, const M: usize>(self, simd: S) -> Result<(), NoPivot> {
        let Layout { pivots, rest } = self.layout;
        let Parts { diagonal, lower, upper, inverses } = self.layout.parts_mut(self.factor);
        let packed = &mut self.scratch.packed[..];
        let height = padded(rest);
        let mut block = Diagonal { entries: diagonal, pivots, interchanges: self.interchanges, inverses };
        factor_diagonal::<S, M>(simd, &mut block, packed)?;
        if rest == 0 {
            return Ok(());
        }
        // The columns of U's transpose are the rows of U.
        for (pivot, &taken) in self.interchanges.iter().enumerate() {
            swap_columns(upper, height, pivot, taken as usize);
        }
        let upper_triangle = Triangle { entries: diagonal, size: pivots, inverses: Some(inverses) };
        solve_right::<S, M>(simd, lower, height, &upper_triangle, packed);
        let lower_triangle = Triangle { inverses: None, ..upper_triangle };
        solve_right::<S, M>(simd, upper, height, &lower_triangle, packed);
        negative_outer::<S, M>(simd, self.contribution, (lower, upper), (rest, pivots), packed);
        Ok(())
    }
}

impl WithSimd for Eliminate<'_> {
    type Output = Result<(), NoPivot>;

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> Self::Output {
        match S::F64_LANES {
            8 => self.eliminate::<S, 1>(simd),
            4 => self.eliminate::<S, 2>(simd),
            2 => self.eliminate::<S, 4>(simd),
            _ => self.eliminate::<S, 8>(simd),
        }
    }
}

fn swap_columns(matrix: &mut [f64], height: usize, a: usize, b: usize) {
    if a < b {
        let (left, right) = matrix.split_at_mut(b * height);
        left[a * height..(a + 1) * height].swap_with_slice(&mut right[..height]);
    }
}

/// `M` vectors from position `at`.
#[inline(always)]
fn load<S: Simd, const M: usize>(column: &[S::f64s], at: usize) -> [S::f64s; M] {
    *column[at..].first_chunk().expect("columns are padded to whole pieces")
}

#[inline(always)]
fn store<S: Simd, const M: usize>(column: &mut [S::f64s], at: usize, piece: [S::f64s; M]) {
    *column[at..].first_chunk_mut().expect("columns are padded to whole pieces") = piece;
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Factor and contribution of a front of numbers without a pattern, its diagonal weak enough for interchanges.
    fn eliminated(arch: Arch, layout: Layout) -> Vec<f64> {
        let mut factor = vec![0.0; layout.factor_len()];
        let number = |k: usize| ((1.3 + 7.7 * k as f64).sin() * 1e4).fract();
        for column in 0..layout.pivots {
            for row in 0..layout.pivots {
                factor[layout.diagonal(row, column)] = number(row + 1000 * column);
            }
            for row in 0..layout.rest {
                factor[layout.lower(row, column)] = number(row + 1000 * column + 500);
                factor[layout.upper(column, row)] = number(row + 1000 * column + 750);
            }
        }
        let mut contribution = vec![f64::NAN; layout.contribution_len()];
        let mut interchanges = vec![0; layout.pivots];
        let scratch = &mut Scratch::new(padded(layout.pivots.max(layout.rest)));
        let front = Eliminate {
            layout,
            factor: &mut factor,
            contribution: &mut contribution,
            interchanges: &mut interchanges,
            scratch,
        };
        front.run(arch).expect("pivots");
        factor.extend(contribution);
        factor.extend(interchanges.into_iter().map(f64::from));
        factor
    }

    /// The integration tests check the widest vectors against faer; the scalars have to agree with those.
    #[test]
    fn instruction_sets_agree() {
        for pivots in [1, 2, 3, 6, 7, 8, 9, 31, 32, 33, 70] {
            for rest in [0, 1, 3, 8, 13, 40, 90] {
                let layout = Layout { pivots, rest };
                let [scalar, vector] = [Arch::Scalar, Arch::new()].map(|arch| eliminated(arch, layout));
                let largest = scalar.iter().fold(0.0, |a: f64, b| a.max(b.abs()));
                for (a, b) in scalar.iter().zip(&vector) {
                    assert!((a - b).abs() < 1e-10 * largest, "{pivots} pivots, {rest} below: {a} and {b}");
                }
            }
        }
    }
}
