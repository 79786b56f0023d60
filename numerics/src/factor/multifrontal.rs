//! Unsymmetric matrices over symmetric patterns: a static node-block multifrontal LU.
//!
//! The pattern never changes, so everything that can be is decided once:
//!
//! ```text
//! pattern ── blocks ── ordering ── tree ── symbolic     once
//!                                             │
//! values ──────────────────────────────── numeric       refactor: fronts, from the leaves to the roots
//! right-hand side ─────────────────────── solve         down and up the same tree
//! ```
//!
//! Pivots are exchanged only inside the diagonal block of a front, where the largest growth would come from; this keeps
//! the structure static. It is enough for stabilized flow and elasticity. It is not for every matrix, so that
//! whoever uses this has to look at the outcome.
//!
//! Sources: Duff, Reid, *The multifrontal solution of indefinite sparse symmetric linear systems* (1983); Liu, *The
//! multifrontal method for sparse matrix solution* (1992); for the relaxed supernodes Ashcraft, Grimes, *The influence of
//! relaxed supernode partitions on the multifrontal method* (1989).

mod aligned;
mod blocks;
mod kernels;
mod layout;
mod numeric;
mod ordering;
mod solve;
mod symbolic;
mod tree;

use std::slice;

use super::FactorError;
use crate::Pattern;
use blocks::Blocks;
use kernels::NoPivot;
use numeric::Numeric;
use solve::SolveSpace;
use symbolic::Symbolic;

/// Symbolic and numeric factor with the work space of both phases.
pub(super) struct Multifrontal {
    symbolic: Symbolic,
    numeric: Numeric,
    space: SolveSpace,
}

impl Multifrontal {
    pub(super) fn new(pattern: &Pattern) -> Result<Self, FactorError> {
        let out_of_memory = || FactorError::OutOfMemory { equations: pattern.size() };
        // Indices of the hot loops have 32 bits.
        u32::try_from(pattern.nonzeros()).map_err(|_| out_of_memory())?;
        let blocks = Blocks::new(pattern);
        let tree = ordering::tree(&blocks, pattern.size()).ok_or_else(out_of_memory)?;
        let symbolic = Symbolic::new(pattern, &blocks, &tree);
        let numeric = Numeric::new(&symbolic).ok_or_else(out_of_memory)?;
        let space = SolveSpace::new(&symbolic).ok_or_else(out_of_memory)?;
        Ok(Self { symbolic, numeric, space })
    }

    /// Factors the matrix with these values and replaces `rhs` by the solution, or names an equation whose block has no
    /// pivot left.
    pub(super) fn refactor_and_solve(&mut self, values: &[f64], rhs: &mut [f64]) -> Result<(), FactorError> {
        let Self { symbolic, numeric, space } = self;
        space.load(symbolic, rhs);
        for front in &symbolic.fronts {
            numeric.eliminate(symbolic, front, values).map_err(|NoPivot(column)| FactorError::Singular {
                equation: Some(symbolic.equations[front.first + column] as usize),
            })?;
            // The sweep down the tree reads L while it is in the cache.
            space.forward(symbolic, numeric, slice::from_ref(front));
        }
        space.backward(symbolic, numeric);
        space.store(symbolic, rhs);
        Ok(())
    }

    pub(super) fn factor_bytes(&self) -> usize {
        size_of_val(&*self.numeric.factors) + size_of_val(&*self.numeric.interchanges)
    }

    pub(super) fn solve(&mut self, rhs: &mut [f64]) {
        let Self { symbolic, numeric, space } = self;
        space.load(symbolic, rhs);
        space.forward(symbolic, numeric, &symbolic.fronts);
        space.backward(symbolic, numeric);
        space.store(symbolic, rhs);
    }
}
