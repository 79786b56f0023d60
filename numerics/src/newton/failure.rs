//! How a Newton loop fails.

use std::fmt;

use miette::Diagnostic;

use super::{Bound, ResidualNorm};

/// Where a residual came from before it was lost.
fn way(before: Option<&(ResidualNorm, ResidualNorm)>) -> String {
    before.map_or_else(String::new, |(entry, last)| format!(", from {entry} at the entry and {last} before"))
}

/// A Newton loop that ended without a usable iterate.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum Failure<E> {
    /// The field could not assemble or solve.
    #[error("Newton iteration {iteration}: the system could not be assembled or solved")]
    Problem {
        /// The iteration, from 1; 0 is the evaluation at the entry.
        iteration: usize,
        /// What the field reports.
        source: E,
    },
    /// The residual is infinite or not a number.
    #[error("Newton iteration {iteration}: the residual is not finite: {residual}{}", way(before.as_ref()))]
    NotFinite {
        /// The iteration, from 1; 0 is the evaluation at the entry.
        iteration: usize,
        /// The residual there.
        residual: ResidualNorm,
        /// The residual at the entry and the last one that was finite; nothing at the entry itself.
        before: Option<(ResidualNorm, ResidualNorm)>,
    },
    /// The residual exploded.
    #[error("Newton iteration {iteration}: the residual grew from {entry} to {residual}")]
    Diverged {
        /// The iteration, from 1.
        iteration: usize,
        /// The residual at the entry.
        entry: ResidualNorm,
        /// The residual at this iteration.
        residual: ResidualNorm,
    },
    /// The bound was not met within the allowed iterations.
    #[error("residual {residual} after {iterations} Newton iterations, from {entry}; the bound is {bound}")]
    TooManyIterations {
        /// The iterations done.
        iterations: usize,
        /// The residual at the entry.
        entry: ResidualNorm,
        /// The residual at the last iterate.
        residual: ResidualNorm,
        /// The bound that was missed.
        bound: Bound,
    },
    /// The residual stands still above its bound, and above its round-off.
    #[error("Newton iteration {iteration}: the residual stands still at {residual}{}; the bound is {bound}", compared(*round_offs))]
    Stagnated {
        /// The iteration, from 1.
        iteration: usize,
        /// The residual there.
        residual: ResidualNorm,
        /// The bound that cannot be met.
        bound: Bound,
        /// The residual in units of the round-off of its terms, infinite where that is not known.
        round_offs: f64,
    },
}

/// By hand, because the derive macro does not bound `E`.
impl<E: Diagnostic + 'static> Diagnostic for Failure<E> {
    fn help<'a>(&'a self) -> Option<Box<dyn fmt::Display + 'a>> {
        let advice = match self {
            Self::Problem { source, .. } => return source.help(),
            Self::NotFinite { .. } => "check the input of this call, or take a smaller time step",
            Self::Diverged { .. } => "take a smaller time step or load step, or start from a better guess",
            Self::TooManyIterations { .. } => {
                "a residual that still falls needs more iterations, one that does not a smaller time step"
            }
            Self::Stagnated { .. } => {
                "the tangent may be nearly singular, or the bound may ask for more than the arithmetic can give"
            }
        };
        Some(Box::new(advice))
    }
}

fn compared(round_offs: f64) -> String {
    if round_offs.is_finite() {
        format!(", {round_offs:.1} times the round-off of its terms")
    } else {
        String::new()
    }
}
