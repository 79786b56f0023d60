//! Unsymmetric matrices: faer's supernodal LU with partial pivoting.

use faer::dyn_stack::{MemBuffer, MemStack};
use faer::sparse::linalg::SupernodalThreshold;
use faer::sparse::linalg::lu::{self, LuRef, LuSymbolicParams, NumericLu, SymbolicLu};
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
    /// The right-hand side of the trial solve and its solution.
    trial: Vec<f64>,
}

impl Lu {
    pub(super) fn new(pattern: &Pattern) -> Result<Self, FactorError> {
        let n = pattern.size();
        let out_of_memory = FactorError::OutOfMemory { equations: n };
        let columns = SymbolicSparseColMat::new_checked(
            n,
            n,
            pattern.col_ptr().to_vec(),
            None,
            pattern.row_idx().to_vec(),
        );
        let params = LuSymbolicParams {
            supernodal_flop_ratio_threshold: SupernodalThreshold::FORCE_SUPERNODAL,
            ..LuSymbolicParams::default()
        };
        let symbolic =
            lu::factorize_symbolic_lu(columns.as_ref(), params).map_err(|_| out_of_memory.clone())?;
        let needed = symbolic
            .factorize_numeric_lu_scratch::<f64>(Par::Seq, Spec::default())
            .or(symbolic.solve_in_place_scratch::<f64>(1, Par::Seq));
        let scratch = MemBuffer::try_new(needed).map_err(|_| out_of_memory)?;
        Ok(Self { pattern: columns, symbolic, numeric: NumericLu::new(), scratch, trial: vec![0.0; n] })
    }

    pub(super) fn refactor(&mut self, values: &[f64]) -> Result<(), FactorError> {
        let matrix = SparseColMatRef::new(self.pattern.as_ref(), values);
        let stack = MemStack::new(&mut self.scratch);
        self.symbolic
            .factorize_numeric_lu(&mut self.numeric, matrix, Par::Seq, stack, Spec::default())
            .map_err(|error| match error {
                faer::sparse::linalg::LuError::SymbolicSingular { .. } => {
                    FactorError::Singular { equation: None }
                }
                faer::sparse::linalg::LuError::Generic(_) => {
                    FactorError::OutOfMemory { equations: self.trial.len() }
                }
            })?;
        let mut trial = std::mem::take(&mut self.trial);
        trial.fill(1.0);
        self.solve(&mut trial);
        let is_finite = trial.iter().all(|x| x.is_finite());
        self.trial = trial;
        if is_finite { Ok(()) } else { Err(FactorError::Singular { equation: None }) }
    }

    pub(super) fn solve(&mut self, rhs: &mut [f64]) {
        let stack = MemStack::new(&mut self.scratch);
        LuRef::new_unchecked(&self.symbolic, &self.numeric).solve_in_place_with_conj(
            Conj::No,
            ColMut::from_slice_mut(rhs).as_mat_mut(),
            Par::Seq,
            stack,
        );
    }
}
