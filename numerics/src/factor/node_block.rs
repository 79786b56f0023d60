//! The fast LU with the safe one behind it.

use super::FactorError;
use super::lu::Lu;
use super::multifrontal::Multifrontal;
use crate::Pattern;

/// A multifrontal factor, and faer's LU from the first time on that it is needed.
pub(super) struct NodeBlockLu {
    fast: Multifrontal,
    safe: Option<Box<Lu>>,
    /// Whether the last factor is the safe one.
    fell_back: bool,
    fallbacks: usize,
}

/// From here on two threads save a fifth of an iteration of the fluid or more; the start of threads takes up what they could save of
/// much smaller systems.
const SPLIT_ABOVE: usize = 10_000;

/// More threads would wait for the top of the tree, and each takes room.
const MOST_THREADS: usize = 16;

impl NodeBlockLu {
    pub(super) fn new(pattern: &Pattern, threads: usize) -> Result<Self, FactorError> {
        let threads = if pattern.size() > SPLIT_ABOVE { threads.min(MOST_THREADS) } else { 1 };
        Ok(Self { fast: Multifrontal::new(pattern, threads)?, safe: None, fell_back: false, fallbacks: 0 })
    }

    /// Tries the fast way, whatever happened before: the outcome must not depend on earlier matrices.
    pub(super) fn refactor_and_solve(&mut self, values: &[f64], rhs: &mut [f64]) -> Result<(), FactorError> {
        self.fell_back = false;
        self.fast.refactor_and_solve(values, rhs)
    }

    /// Factors the same matrix the safe way.
    pub(super) fn fall_back(&mut self, pattern: &Pattern, values: &[f64]) -> Result<(), FactorError> {
        self.fell_back = true;
        self.fallbacks += 1;
        let safe = match &mut self.safe {
            Some(safe) => safe,
            None => self.safe.insert(Box::new(Lu::new(pattern)?)),
        };
        safe.refactor(values)
    }

    pub(super) fn fallbacks(&self) -> usize {
        self.fallbacks
    }

    /// Of the fast factor; what the safe one takes is unknown.
    pub(super) fn factor_bytes(&self) -> usize {
        self.fast.factor_bytes()
    }

    pub(super) fn solve(&mut self, rhs: &mut [f64]) {
        match &mut self.safe {
            Some(safe) if self.fell_back => safe.solve(rhs),
            _ => self.fast.solve(rhs),
        }
    }
}
