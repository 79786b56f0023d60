//! Unsymmetric matrices: faer's supernodal LU with partial pivoting, columns ordered by COLAMD.

use faer::dyn_stack::{MemBuffer, MemStack};
use faer::sparse::linalg::lu::{LuRef, LuSymbolicParams, NumericLu, SymbolicLu, factorize_symbolic_lu};
use faer::sparse::linalg::{LuError, SupernodalThreshold};
use faer::sparse::{SparseColMatRef, SymbolicSparseColMat};
use faer::{ColMut, Conj, Par, Spec};

use super::FactorError;
use crate::Pattern;

/// Symbolic and numeric LU with the work space of both phases.
pub(super) struct Lu {
    pattern: SymbolicSparseColMat<usize>,
    symbolic: SymbolicLu<usize>,
    numeric: NumericLu<usize, f64>,
    scratch: MemBuffer,
}

impl Lu {
    pub(super) fn new(pattern: &Pattern) -> Result<Self, FactorError> {
        let n = pattern.size();
        let out_of_memory = FactorError::OutOfMemory { equations: n };
        let (col_ptr, row_idx) = (pattern.col_ptr().to_vec(), pattern.row_idx().to_vec());
        let pattern = SymbolicSparseColMat::new_checked(n, n, col_ptr, None, row_idx);
        // Left to itself, faer takes the simplicial path for small systems, which is five times slower.
        let params = LuSymbolicParams {
            supernodal_flop_ratio_threshold: SupernodalThreshold::FORCE_SUPERNODAL,
            ..LuSymbolicParams::default()
        };
        let symbolic = factorize_symbolic_lu(pattern.as_ref(), params).map_err(|_| out_of_memory.clone())?;
        let needed = symbolic
            .factorize_numeric_lu_scratch::<f64>(Par::Seq, Spec::default())
            .or(symbolic.solve_in_place_scratch::<f64>(1, Par::Seq));
        let scratch = MemBuffer::try_new(needed).map_err(|_| out_of_memory)?;
        Ok(Self { pattern, symbolic, numeric: NumericLu::new(), scratch })
    }

    pub(super) fn refactor(&mut self, values: &[f64]) -> Result<(), FactorError> {
        let matrix = SparseColMatRef::new(self.pattern.as_ref(), values);
        let stack = MemStack::new(&mut self.scratch);
        self.symbolic
            .factorize_numeric_lu(&mut self.numeric, matrix, Par::Seq, stack, Spec::default())
            .map(|_| ())
            .map_err(|error| match error {
                LuError::SymbolicSingular { .. } => FactorError::Singular { equation: None },
                LuError::Generic(_) => FactorError::OutOfMemory { equations: self.symbolic.nrows() },
            })
    }

    pub(super) fn solve(&mut self, rhs: &mut [f64]) {
        LuRef::new_unchecked(&self.symbolic, &self.numeric).solve_in_place_with_conj(
            Conj::No,
            ColMut::from_slice_mut(rhs).as_mat_mut(),
            Par::Seq,
            MemStack::new(&mut self.scratch),
        );
    }
}
