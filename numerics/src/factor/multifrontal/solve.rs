//! Solution with the factors: down the tree with L, up again with U.
#![allow(
    clippy::inline_always,
    reason = "vector code has to be part of the entry point of its instruction set"
)]

use pulp::{Simd, WithSimd};

use super::aligned::Aligned;
use super::layout::{Layout, padded};
use super::numeric::Numeric;
use super::symbolic::{Front, Symbolic, wide};

/// Work vectors of a solution.
pub(super) struct SolveSpace {
    /// The right-hand side in the order of elimination.
    permuted: Vec<f64>,
    /// The rows below the pivots of one front.
    below: Aligned,
}

impl SolveSpace {
    /// Nothing if memory does not suffice.
    pub(super) fn new(symbolic: &Symbolic) -> Option<Self> {
        Some(Self {
            permuted: vec![0.0; symbolic.equations.len()],
            below: Aligned::zeros(symbolic.widest())?,
        })
    }

    /// Takes in a right-hand side.
    pub(super) fn load(&mut self, symbolic: &Symbolic, rhs: &[f64]) {
        for (value, &equation) in self.permuted.iter_mut().zip(&symbolic.equations) {
            *value = rhs[equation as usize];
        }
    }

    /// Hands out the solution.
    pub(super) fn store(&self, symbolic: &Symbolic, solution: &mut [f64]) {
        for (value, &equation) in self.permuted.iter().zip(&symbolic.equations) {
            solution[equation as usize] = *value;
        }
    }

    /// The way down, through these fronts; those before them have to be done.
    pub(super) fn forward(&mut self, symbolic: &Symbolic, numeric: &Numeric, fronts: &[Front]) {
        numeric.arch.dispatch(Forward(Sweep { space: self, symbolic, numeric }, fronts));
    }

    /// The way up, through all fronts.
    pub(super) fn backward(&mut self, symbolic: &Symbolic, numeric: &Numeric) {
        numeric.arch.dispatch(Backward(Sweep { space: self, symbolic, numeric }));
    }
}

struct Sweep<'a> {
    space: &'a mut SolveSpace,
    symbolic: &'a Symbolic,
    numeric: &'a Numeric,
}

struct Forward<'a>(Sweep<'a>, &'a [Front]);

impl WithSimd for Forward<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(mut self, simd: S) {
        for front in self.1 {
            self.0.forward(simd, front);
        }
    }
}

struct Backward<'a>(Sweep<'a>);

impl WithSimd for Backward<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(mut self, simd: S) {
        for front in self.0.symbolic.fronts.iter().rev() {
            self.0.backward(simd, front);
        }
    }
}

impl Sweep<'_> {
    /// x := `L_D`^-1 x on the pivots, then x := x - L x on the rows below.
    #[inline(always)]
    fn forward<S: Simd>(&mut self, simd: S, front: &Front) {
        let Layout { pivots, rest } = front.layout;
        let factor = &self.numeric.factors[front.factor..front.factor + front.layout.factor_len()];
        let parts = front.layout.parts(factor);
        let x = &mut self.space.permuted[front.first..front.first + pivots];
        for (pivot, &taken) in self.numeric.interchanges[front.first..][..pivots].iter().enumerate() {
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
        for (row, value) in wide(&front.rows, &self.symbolic.rows).zip(below) {
            self.space.permuted[row] -= *value;
        }
    }

    /// x := `U_D`^-1 (x - U y) on the pivots, with the solution y on the rows below.
    #[inline(always)]
    fn backward<S: Simd>(&mut self, simd: S, front: &Front) {
        let Layout { pivots, rest } = front.layout;
        let factor = &self.numeric.factors[front.factor..front.factor + front.layout.factor_len()];
        let parts = front.layout.parts(factor);
        let below = &mut self.space.below[..padded(rest)];
        for (row, value) in wide(&front.rows, &self.symbolic.rows).zip(below.iter_mut()) {
            *value = self.space.permuted[row];
        }
        below[rest..].fill(0.0);
        let x = &mut self.space.permuted[front.first..front.first + pivots];
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
