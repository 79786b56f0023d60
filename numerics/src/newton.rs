//! The Newton loop that every field runs.
//!
//! A field implements [`Problem`] and calls [`solve`]; how many iterations a call may take is the caller's
//! [`Limit`], and a callback after each iteration may stop it early.

#[cfg(test)]
mod chord_tests;
mod failure;
mod norm;
mod reuse;
#[cfg(test)]
mod round_off_tests;
mod run;
mod settings;
#[cfg(test)]
mod tests;

pub use failure::Failure;
pub use norm::{Bound, ResidualNorm};
pub use reuse::{Coefficients, FactorLog, ReusableFactor, ReusableTangent};
pub use run::solve;
pub use settings::{Check, Limit, Settings};

/// A nonlinear system R(s) = 0 together with its current iterate s.
pub trait Problem {
    /// What may go wrong in an assembly or a linear solve.
    type Error;

    /// Evaluates the residual at the current iterate, and its tangent dR/ds where `with_tangent` says so.
    ///
    /// # Errors
    ///
    /// If the residual cannot be evaluated, for instance in an inverted element.
    fn assemble(&mut self, with_tangent: bool) -> Result<ResidualNorm, Self::Error>;

    /// The residual of the last assembly in units of what round-off leaves of it: of several blocks, the largest number
    /// counts. At 1 and below, no iteration can be asked to make it smaller.
    ///
    /// The unit is made from the sizes of the assembled terms, before they cancel; a problem that does not know them is
    /// always above.
    fn round_offs(&mut self) -> f64 {
        f64::INFINITY
    }

    /// Factors the tangent of the last assembly, solves (dR/ds) ds = -R and adds ds to the iterate.
    ///
    /// # Errors
    ///
    /// If the tangent is singular.
    fn solve_and_update(&mut self) -> Result<(), Self::Error>;

    /// What the factor of the last [`solve_and_update`](Self::solve_and_update) is worth now. Unless a problem says
    /// otherwise it keeps none.
    fn reusable_factor(&self) -> ReusableFactor {
        ReusableFactor::Missing
    }

    /// Solves K ds = -R with the kept factor of K and adds ds to the iterate.
    ///
    /// # Errors
    ///
    /// As [`solve_and_update`](Self::solve_and_update), which it is where no factor is kept.
    fn solve_reusing_factor(&mut self) -> Result<(), Self::Error> {
        self.solve_and_update()
    }

    /// Takes the step of the last [`solve_reusing_factor`](Self::solve_reusing_factor) back: the iterate is what it was
    /// before, at least to round-off.
    fn take_back(&mut self) {}

    /// The kept factor has turned out to be of no use: [`reusable_factor`](Self::reusable_factor) is now `Missing`.
    fn drop_factor(&mut self) {}
}

/// What a callback wants after an iteration.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Verdict {
    /// Go on if the loop would.
    Continue,
    /// Leave the loop at this iterate.
    Stop,
}

/// One finished iteration, as a callback sees it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Iteration {
    /// The number of the iteration within this call, from 1.
    pub index: usize,
    /// The residual before its solve.
    pub before: ResidualNorm,
    /// The residual at the new iterate.
    pub after: ResidualNorm,
}

/// What a call of [`solve`] cost and reached.
#[expect(clippy::struct_excessive_bools, reason = "independent facts, each with its own name")]
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Report {
    /// Newton iterations: linear solves that moved the iterate.
    pub iterations: usize,
    /// Residual evaluations, the one at the exit included.
    pub assemblies: usize,
    /// Those of them that evaluated the tangent, too.
    pub tangents: usize,
    /// Numeric factorizations of the tangent.
    pub factorizations: usize,
    /// Linear solves; those with a kept factor whose step was taken back are no iterations.
    pub solves: usize,
    /// The residual at the first iterate, evaluated in this call.
    pub entry: ResidualNorm,
    /// The residual at the last iterate, evaluated there.
    pub exit: ResidualNorm,
    /// Whether the residual at the entry met the bound, or was at round-off.
    pub entry_converged: bool,
    /// Whether the bound was met where [`Check`] looks, or the residual was [at round-off](Problem::round_offs).
    pub converged: bool,
    /// Whether it converged because its residual was round-off, above the bound.
    pub at_round_off: bool,
    /// Whether the callback ended the loop.
    pub stopped_by_callback: bool,
    /// Whether the residual stood still above its bound, and above its round-off.
    pub stagnated: bool,
}
