//! Symmetric matrices: faer's supernodal L L^T and L D L^T on an approximate minimum degree ordering.

use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::cholesky::ldlt::factor::{LdltError, LdltRegularization};
use faer::linalg::cholesky::llt::factor::{LltError, LltRegularization};
use faer::sparse::linalg::SupernodalThreshold;
use faer::sparse::linalg::cholesky::supernodal::{self, SymbolicSupernodalCholesky};
use faer::sparse::linalg::cholesky::{
    CholeskySymbolicParams, LdltRef, LltRef, SymbolicCholesky, SymbolicCholeskyRaw, SymmetricOrdering,
    factorize_symbolic_cholesky,
};
use faer::sparse::{SparseColMatRef, SymbolicSparseColMat, SymbolicSparseColMatRef};
use faer::{ColMut, Conj, Par, Side, Spec};

use super::FactorError;
use crate::Pattern;

/// Always supernodal. faer's `FORCE_SUPERNODAL` is zero and lets a diagonal matrix fall through to the
/// simplicial path, because its elimination takes no operation.
const ALWAYS_SUPERNODAL: SupernodalThreshold = SupernodalThreshold(-1.0);

/// L L^T or L D L^T.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Kind {
    Llt,
    Ldlt,
}

/// Symbolic and numeric factor with the work space of both phases.
pub(super) struct Cholesky {
    kind: Kind,
    symbolic: SymbolicCholesky<usize>,
    /// The pattern of the lower triangle of the permuted matrix.
    triangle: SymbolicSparseColMat<usize>,
    /// For each entry of the triangle, its slot in the full pattern.
    slots: Vec<usize>,
    triangle_values: Vec<f64>,
    factor_values: Vec<f64>,
    scratch: MemBuffer,
}

impl Cholesky {
    pub(super) fn new(kind: Kind, pattern: &Pattern) -> Result<Self, FactorError> {
        let out_of_memory = FactorError::OutOfMemory { equations: pattern.size() };
        let symbolic = analyse(pattern).ok_or_else(|| out_of_memory.clone())?;
        let (triangle, slots) = permuted_triangle(pattern, &symbolic);
        let needed = match kind {
            Kind::Llt => symbolic.factorize_numeric_llt_scratch::<f64>(Par::Seq, Spec::default()),
            Kind::Ldlt => symbolic.factorize_numeric_ldlt_scratch::<f64>(Par::Seq, Spec::default()),
        };
        let needed = needed.or(symbolic.solve_in_place_scratch::<f64>(1, Par::Seq));
        let scratch = MemBuffer::try_new(needed).map_err(|_| out_of_memory)?;
        let triangle_values = vec![0.0; slots.len()];
        let factor_values = vec![0.0; symbolic.len_val()];
        Ok(Self { kind, symbolic, triangle, slots, triangle_values, factor_values, scratch })
    }

    pub(super) fn factor_bytes(&self) -> usize {
        size_of_val(&*self.factor_values)
    }

    pub(super) fn refactor(&mut self, values: &[f64]) -> Result<(), FactorError> {
        for (entry, &slot) in self.triangle_values.iter_mut().zip(&self.slots) {
            *entry = values[slot];
        }
        match self.kind {
            Kind::Llt => self.factor_llt(),
            Kind::Ldlt => self.factor_ldlt(),
        }
    }

    fn factor_llt(&mut self) -> Result<(), FactorError> {
        supernodal::factorize_supernodal_numeric_llt(
            &mut self.factor_values,
            SparseColMatRef::new(self.triangle.as_ref(), &self.triangle_values),
            LltRegularization::default(),
            supernodes(&self.symbolic),
            Par::Seq,
            MemStack::new(&mut self.scratch),
            Spec::default(),
        )
        .map(|_| ())
        .map_err(|LltError::NonPositivePivot { index }| FactorError::NotPositiveDefinite {
            equation: self.equation(index),
        })
    }

    fn factor_ldlt(&mut self) -> Result<(), FactorError> {
        supernodal::factorize_supernodal_numeric_ldlt(
            &mut self.factor_values,
            SparseColMatRef::new(self.triangle.as_ref(), &self.triangle_values),
            LdltRegularization::default(),
            supernodes(&self.symbolic),
            Par::Seq,
            MemStack::new(&mut self.scratch),
            Spec::default(),
        )
        .map(|_| ())
        .map_err(|LdltError::ZeroPivot { index }| FactorError::Singular {
            equation: Some(self.equation(index)),
        })
    }

    /// The equation behind a pivot of the permuted matrix.
    fn equation(&self, pivot: usize) -> usize {
        self.symbolic.perm().map_or(pivot, |permutation| permutation.arrays().0[pivot])
    }

    pub(super) fn solve(&mut self, rhs: &mut [f64]) {
        let rhs = ColMut::from_slice_mut(rhs).as_mat_mut();
        let stack = MemStack::new(&mut self.scratch);
        match self.kind {
            Kind::Llt => LltRef::new(&self.symbolic, &self.factor_values).solve_in_place_with_conj(
                Conj::No,
                rhs,
                Par::Seq,
                stack,
            ),
            Kind::Ldlt => LdltRef::new(&self.symbolic, &self.factor_values).solve_in_place_with_conj(
                Conj::No,
                rhs,
                Par::Seq,
                stack,
            ),
        }
    }
}

fn analyse(pattern: &Pattern) -> Option<SymbolicCholesky<usize>> {
    let n = pattern.size();
    let full = SymbolicSparseColMatRef::new_checked(n, n, pattern.col_ptr(), None, pattern.row_idx());
    let params = CholeskySymbolicParams {
        supernodal_flop_ratio_threshold: ALWAYS_SUPERNODAL,
        ..CholeskySymbolicParams::default()
    };
    factorize_symbolic_cholesky(full, Side::Lower, SymmetricOrdering::Amd, params).ok()
}

fn supernodes(symbolic: &SymbolicCholesky<usize>) -> &SymbolicSupernodalCholesky<usize> {
    match symbolic.raw() {
        SymbolicCholeskyRaw::Supernodal(supernodes) => supernodes,
        SymbolicCholeskyRaw::Simplicial(_) => unreachable!("the threshold leaves no simplicial factor"),
    }
}

/// The lower triangle of the permuted matrix: its pattern, and the slot of each entry in the full pattern.
fn permuted_triangle(
    pattern: &Pattern,
    symbolic: &SymbolicCholesky<usize>,
) -> (SymbolicSparseColMat<usize>, Vec<usize>) {
    let n = pattern.size();
    let permutation = symbolic.perm().expect("the ordering is a permutation");
    let (old, new) = permutation.arrays();
    let (mut col_ptr, mut row_idx, mut slots) = (vec![0], Vec::new(), Vec::new());
    let mut entries = Vec::new();
    for column in 0..n {
        let range = pattern.col_ptr()[old[column]]..pattern.col_ptr()[old[column] + 1];
        entries.clear();
        entries
            .extend(range.map(|slot| (new[pattern.row_idx()[slot]], slot)).filter(|&(row, _)| row >= column));
        entries.sort_unstable();
        row_idx.extend(entries.iter().map(|&(row, _)| row));
        slots.extend(entries.iter().map(|&(_, slot)| slot));
        col_ptr.push(row_idx.len());
    }
    (SymbolicSparseColMat::new_checked(n, n, col_ptr, None, row_idx), slots)
}
