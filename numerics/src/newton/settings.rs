//! When a Newton loop ends.

use super::Bound;

/// Where the loop compares the residual with its bound.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Check {
    /// Before each solve: a call that enters converged costs no iteration.
    #[default]
    Before,
    /// After each solve, on the residual from before that solve: a call that enters converged costs one
    /// iteration, and every call one more than it needs.
    Lagged,
}

/// The rules of a Newton loop, the same for every call.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Settings {
    /// The bound of the residual.
    pub bound: Bound,
    /// Where the residual is compared with it.
    pub check: Check,
    /// After so many iterations [`Limit::ToConvergence`] gives up.
    pub max_iterations: usize,
    /// The loop has diverged once the residual exceeds this many times the larger of the entry residual and
    /// its scale.
    ///
    /// Far above one: the first iteration of a slender structure may well raise the residual by orders of
    /// magnitude before it falls.
    pub divergence_factor: f64,
    /// Chord Newton: the factor of an earlier tangent serves as long as each iteration brings the residual, as the bound
    /// measures it and in itself, below this part of what it was, between 0 and 1; across calls and steps, too, where the
    /// problem [keeps](super::Problem::reusable_factor) its factor. A step with it that raises the residual is taken back.
    /// `None` factors in every iteration. The factor of a linear problem serves anyway.
    pub reuse_factor: Option<f64>,
}

impl Default for Settings {
    /// Relative bound 1e-10, checked before each solve, at most 50 iterations, diverged at 1e10, no factor used twice.
    fn default() -> Self {
        Self {
            bound: Bound::Relative(1e-10),
            check: Check::Before,
            max_iterations: 50,
            divergence_factor: 1e10,
            reuse_factor: None,
        }
    }
}

/// How far one call may go.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Limit {
    /// At most so many iterations; to reach the limit is not an error.
    AtMost(usize),
    /// Until the bound is met; to miss it is an error.
    ToConvergence,
}
