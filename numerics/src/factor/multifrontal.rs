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
//! Separate subtrees can be eliminated at the same time. Which thread gets which is decided with the rest, and every sum is
//! taken in one order, so that the numbers are those of one thread, bit for bit.
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
mod numbering;
mod numeric;
mod ordering;
mod solve;
mod split;
mod symbolic;
#[cfg(test)]
mod tests;
mod tree;
mod worker;

use super::FactorError;
use crate::Pattern;
use blocks::Blocks;
use split::Split;
use symbolic::Symbolic;
use worker::{Stuck, Worker};

/// Symbolic factor, and numeric factors with the work space of both phases.
pub(super) struct Multifrontal {
    symbolic: Symbolic,
    /// One for each share of the tree, the top last.
    workers: Vec<Worker>,
}

impl Multifrontal {
    /// The number of threads decides who does what, and nothing about the numbers.
    pub(super) fn new(pattern: &Pattern, threads: usize) -> Result<Self, FactorError> {
        let out_of_memory = || FactorError::OutOfMemory { equations: pattern.size() };
        // Indices of the hot loops have 32 bits.
        u32::try_from(pattern.nonzeros()).map_err(|_| out_of_memory())?;
        let blocks = Blocks::new(pattern);
        let tree = ordering::tree(&blocks, pattern.size()).ok_or_else(out_of_memory)?;
        let split = Split::new(&tree.parent, &tree.operations, threads);
        let symbolic = Symbolic::new(pattern, &blocks, &tree, &split);
        let workers = symbolic.shares.iter().map(|share| Worker::new(&symbolic, share));
        let workers = workers.collect::<Option<_>>().ok_or_else(out_of_memory)?;
        Ok(Self { symbolic, workers })
    }

    /// Factors the matrix with these values and replaces `rhs` by the solution, or names an equation whose block has no
    /// pivot left.
    pub(super) fn refactor_and_solve(&mut self, values: &[f64], rhs: &mut [f64]) -> Result<(), FactorError> {
        let Self { symbolic, workers } = self;
        worker::refactor_and_solve(symbolic, workers, values, rhs).map_err(|Stuck(pivot)| {
            FactorError::Singular { equation: Some(symbolic.equations[pivot] as usize) }
        })
    }

    pub(super) fn factor_bytes(&self) -> usize {
        self.workers.iter().map(Worker::factor_bytes).sum()
    }

    pub(super) fn solve(&mut self, rhs: &mut [f64]) {
        worker::solve(&self.symbolic, &mut self.workers, rhs);
    }
}
