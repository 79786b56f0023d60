//! Solution with the factors: down the tree with L, up again with U.
#![allow(
    clippy::inline_always,
    reason = "vector code has to be part of the entry point of its instruction set"
)]

use pulp::{Simd, WithSimd};

use super::aligned::Aligned;
use super::layout::{Layout, padded};
use super::numeric::Numeric;
use super::symbolic::{Front, Share, Symbolic, wide};

/// Work vectors of a solution, for the fronts of one share.
pub(super) struct SolveSpace {
    /// The right-hand side in the order of elimination. Of other shares it holds what was copied here.
    permuted: Vec<f64>,
    /// The rows below the pivots of one front.
    below: Aligned,
    /// What the fronts subtract from rows of other shares, where nothing may be changed before its turn.
    outside: Vec<f64>,
}

impl SolveSpace {
    /// Nothing if memory does not suffice.
    pub(super) fn new(symbolic: &Symbolic, share: &Share) -> Option<Self> {
        Some(Self {
            permuted: vec![0.0; symbolic.equations.len()],
            below: Aligned::zeros(symbolic.widest())?,
            outside: vec![0.0; share.outside],
        })
    }

    /// Takes in the right-hand side of a share.
    pub(super) fn load(&mut self, symbolic: &Symbolic, share: &Share, rhs: &[f64]) {
        for pivots in share.fronts(symbolic).map(Front::range) {
            for (value, &equation) in
                self.permuted[pivots.clone()].iter_mut().zip(&symbolic.equations[pivots])
            {
                *value = rhs[equation as usize];
            }
        }
    }

    /// Hands out the solution on all rows.
    pub(super) fn store(&self, symbolic: &Symbolic, solution: &mut [f64]) {
        for (value, &equation) in self.permuted.iter().zip(&symbolic.equations) {
            solution[equation as usize] = *value;
        }
    }

    /// The way down through a front, whose children have to be done.
    pub(super) fn forward(&mut self, symbolic: &Symbolic, numeric: &Numeric, front: &Front) {
        numeric.arch.dispatch(Forward(Sweep { space: self, symbolic, numeric }, front));
    }

    /// The way up, through all fronts of a share. Rows of other shares have to be there.
    pub(super) fn backward(&mut self, symbolic: &Symbolic, numeric: &Numeric, share: &Share) {
        numeric.arch.dispatch(Backward(Sweep { space: self, symbolic, numeric }, share));
    }

    /// Takes over what the way down through a front of another share has left: its own pivots, and what it subtracts.
    pub(super) fn receive(&mut self, symbolic: &Symbolic, front: &Front, other: &Self) {
        self.copy_pivots(front, other);
        let rows = front.rows.start + front.inside..front.rows.end;
        for (row, value) in wide(&rows, &symbolic.rows).zip(&other.outside[front.outside..]) {
            self.permuted[row] -= *value;
        }
    }

    /// Takes over the pivots of a front.
    pub(super) fn copy_pivots(&mut self, front: &Front, other: &Self) {
        self.permuted[front.range()].copy_from_slice(&other.permuted[front.range()]);
    }
}

struct Sweep<'a> {
    space: &'a mut SolveSpace,
    symbolic: &'a Symbolic,
    numeric: &'a Numeric,
}

struct Forward<'a>(Sweep<'a>, &'a Front);

impl WithSimd for Forward<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(mut self, simd: S) {
        self.0.forward(simd, self.1);
    }
}

struct Backward<'a>(Sweep<'a>, &'a Share);

impl WithSimd for Backward<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(mut self, simd: S) {
        for front in self.1.fronts(self.0.symbolic).rev() {
            self.0.backward(simd, front);
        }
    }
}

impl Sweep<'_> {
    /// x := `L_D`^-1 x on the pivots, then x := x - L x on the rows below.
    #[inline(always)]
    fn forward<S: Simd>(&mut self, simd: S, front: &Front) {
        let Layout { pivots, rest } = front.layout;
        let (factor, interchanges) = self.numeric.of(front);
        let parts = front.layout.parts(factor);
        let x = &mut self.space.permuted[front.range()];
        for (pivot, &taken) in interchanges.iter().enumerate() {
            x.swap(pivot, taken as usize);
        }
        for (k, column) in parts.diagonal.chunks_exact(padded(pivots)).enumerate() {
            let pivot = x[k];
            for (x, entry) in x[k + 1..].iter_mut().zip(&column[k + 1..]) {
                *x -= entry * pivot;
            }
        }
        if rest == 0 {
            return;
        }
        let below = &mut self.space.below[..padded(rest)];
        below.fill(0.0);
        add_product(simd, parts.lower, x, below);
        let (inside, outside) = below[..rest].split_at(front.inside);
        for (row, value) in wide(&front.rows, &self.symbolic.rows).zip(inside) {
            self.space.permuted[row] -= *value;
        }
        self.space.outside[front.outside..][..outside.len()].copy_from_slice(outside);
    }

    /// x := `U_D`^-1 (x - U y) on the pivots, with the solution y on the rows below.
    #[inline(always)]
    fn backward<S: Simd>(&mut self, simd: S, front: &Front) {
        let Layout { pivots, rest } = front.layout;
        let (factor, _) = self.numeric.of(front);
        let parts = front.layout.parts(factor);
        let below = &mut self.space.below[..padded(rest)];
        for (row, value) in wide(&front.rows, &self.symbolic.rows).zip(below.iter_mut()) {
            *value = self.space.permuted[row];
        }
        below[rest..].fill(0.0);
        let x = &mut self.space.permuted[front.range()];
        if rest > 0 {
            subtract_transposed_product(simd, parts.upper, below, x);
        }
        for (k, column) in parts.diagonal.chunks_exact(padded(pivots)).enumerate().rev() {
            let solved = x[k] * parts.inverses[k];
            x[k] = solved;
            for (x, entry) in x[..k].iter_mut().zip(column) {
                *x -= entry * solved;
            }
        }
    }
}

/// Columns that are worked on together.
const GROUP: usize = 4;

/// y := y + A x; A by columns as long as y.
#[inline(always)]
fn add_product<S: Simd>(simd: S, a: &[f64], x: &[f64], y: &mut [f64]) {
    let height = y.len();
    let (y, _) = S::as_mut_simd_f64s(y);
    let groups = a.chunks(GROUP * height).zip(x.chunks(GROUP));
    for (columns, x) in groups {
        if let Ok(x) = <[f64; GROUP]>::try_from(x) {
            let x = x.map(|x| simd.splat_f64s(x));
            let columns = split::<S>(columns, height);
            for (i, y) in y.iter_mut().enumerate() {
                for j in 0..GROUP {
                    *y = simd.mul_add_e_f64s(columns[j][i], x[j], *y);
                }
            }
        } else {
            for (column, x) in columns.chunks_exact(height).zip(x) {
                let (column, _) = S::as_simd_f64s(column);
                let x = simd.splat_f64s(*x);
                for (y, entry) in y.iter_mut().zip(column) {
                    *y = simd.mul_add_e_f64s(*entry, x, *y);
                }
            }
        }
    }
}

/// x := x - A^T y; A by columns as long as y.
#[inline(always)]
fn subtract_transposed_product<S: Simd>(simd: S, a: &[f64], y: &[f64], x: &mut [f64]) {
    let height = y.len();
    let (y, _) = S::as_simd_f64s(y);
    for (columns, x) in a.chunks(GROUP * height).zip(x.chunks_mut(GROUP)) {
        if let Ok(x) = <&mut [f64; GROUP]>::try_from(&mut *x) {
            let columns = split::<S>(columns, height);
            let mut sums = [simd.splat_f64s(0.0); GROUP];
            for (i, y) in y.iter().enumerate() {
                for j in 0..GROUP {
                    sums[j] = simd.mul_add_e_f64s(columns[j][i], *y, sums[j]);
                }
            }
            for j in 0..GROUP {
                x[j] -= simd.reduce_sum_f64s(sums[j]);
            }
        } else {
            for (column, x) in columns.chunks_exact(height).zip(x) {
                let (column, _) = S::as_simd_f64s(column);
                let sum = y
                    .iter()
                    .zip(column)
                    .fold(simd.splat_f64s(0.0), |sum, (y, entry)| simd.mul_add_e_f64s(*entry, *y, sum));
                *x -= simd.reduce_sum_f64s(sum);
            }
        }
    }
}

/// The columns of a group as vectors.
#[inline(always)]
fn split<S: Simd>(columns: &[f64], height: usize) -> [&[S::f64s]; GROUP] {
    std::array::from_fn(|j| S::as_simd_f64s(&columns[j * height..(j + 1) * height]).0)
}
