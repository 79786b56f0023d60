//! What can go wrong in a step, where, and what to try.

use std::fmt;

use miette::Diagnostic;
use thiserror::Error;

use crate::divergence::Growth;
use crate::participant::{ParticipantError, Step};
use crate::record::StepHistory;

/// A step could not be finished. Both fields are back at the committed state, so it can be tried again.
#[derive(Error, Diagnostic)]
#[diagnostic(forward(cause))]
#[error("step {} (t = {} s), {}{cause}", step.index, short(step.time), place(*iteration, *coupled))]
pub struct StepError {
    /// The step that failed.
    pub step: Step,
    /// The coupling iteration, counted from 1; 0 while the step was being opened.
    pub iteration: usize,
    /// Whether there are two fields that iterate; if not, no message speaks of coupling.
    pub coupled: bool,
    /// What went wrong.
    #[source]
    pub cause: Box<StepFailure>,
    /// The finished iterations of the step.
    pub history: Box<StepHistory>,
}

/// Without the history's contents, which may be long.
impl fmt::Debug for StepError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("StepError")
            .field("step", &self.step)
            .field("iteration", &self.iteration)
            .field("coupled", &self.coupled)
            .field("cause", &self.cause)
            .field("history", &format_args!("{} iterations", self.history.iterations.len()))
            .finish()
    }
}

/// Twelve digits: times are products, and their last bits are noise to a reader. (The same as `time::shown` of the numerics,
/// which this crate does not know.)
#[must_use]
pub fn short(time: f64) -> f64 {
    format!("{time:.11e}").parse().unwrap_or(time)
}

fn place(iteration: usize, coupled: bool) -> String {
    if iteration == 0 || !coupled { String::new() } else { format!("coupling iteration {iteration}, ") }
}

/// Why a step failed.
#[derive(Debug, Error, Diagnostic)]
pub enum StepFailure {
    /// A field gave up.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Participant(#[from] ParticipantError),
    /// A number at the interface is not finite.
    #[error("{origin}: {value:e} at {place}")]
    #[diagnostic(help(
        "the coupling iteration diverges or a field returned garbage; try a smaller relaxation factor, a quasi-Newton method or another time step"
    ))]
    NotFinite {
        /// Who produced it: a field's name or the acceleration.
        origin: String,
        /// Interface, point and component.
        place: String,
        /// The value.
        value: f64,
    },
    /// The interface residual grows, see [`divergence`](crate::divergence).
    #[error("{}the coupling iteration diverges: |r| grew from {:.3e} m in iteration {} to {:.3e} m in iteration {}", lead(field.as_deref()), growth.from, growth.since, growth.to, growth.at)]
    #[diagnostic(help(
        "take a smaller relaxation factor, Aitken relaxation or a quasi-Newton method, and with one a small `unseen_relaxation`; a smaller time step does not help against the added mass of an incompressible fluid"
    ))]
    Diverges {
        /// How far it grew.
        growth: Growth,
        /// The error of the field that gave up under what the iteration proposed, if one did.
        #[source]
        field: Option<Box<ParticipantError>>,
    },
    /// The iteration bound was reached without convergence.
    #[error(
        "the step is not converged after {iterations} coupling iterations: |r| = {residual:.3e} m ({relative_residual:.3e} of the interface displacement), largest change {largest_change:.3e}, {open}{}", outlook(*stands_since, idle, *hardly_moves)
    )]
    #[diagnostic(help("{}", advice(*stands_since, idle, *hardly_moves)))]
    TooManyIterations {
        /// The bound.
        iterations: usize,
        /// Norm of the interface residual in the last iteration.
        residual: f64,
        /// The same relative to the interface displacement.
        relative_residual: f64,
        /// Largest relative change of any part of any field in the last iteration.
        largest_change: f64,
        /// The fields that miss their own bound, in words.
        open: String,
        /// The iteration of the smallest residual, where many iterations since then have not found a smaller one.
        stands_since: Option<usize>,
        /// The fields that have not moved lately although the interface has.
        idle: Vec<IdleField>,
        /// The norm of the interface displacement \[m\], where it is hardly more than round-off of the structure's size.
        hardly_moves: Option<f64>,
    },
}

/// A field whose residual stays below its own bound whatever the coupling does, so that it does not answer.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct IdleField {
    /// The field.
    pub name: String,
    /// The last coupling iteration in which it made a Newton iteration; 0 if there is none.
    pub moved_last: usize,
}

impl fmt::Display for IdleField {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.moved_last {
            0 => write!(f, "the {} made no Newton iteration in this step", self.name),
            last => write!(f, "the {} made no Newton iteration after coupling iteration {last}", self.name),
        }
    }
}

/// What the field that gave up said, before what the iteration did.
fn lead(field: Option<&ParticipantError>) -> String {
    field.map_or_else(|| "interface: ".to_owned(), |error| format!("{}: {}; ", error.field, error.message))
}

/// What the iterations of the step have in common.
fn outlook(stands_since: Option<usize>, idle: &[IdleField], hardly_moves: Option<f64>) -> String {
    let since = stands_since
        .map_or_else(String::new, |iteration| format!("; |r| has not fallen since iteration {iteration}"));
    if let Some(displacement) = hardly_moves {
        return format!(
            "{since}; the interface moves by {displacement:.1e} m in all, hardly more than round-off of its size"
        );
    }
    if idle.is_empty() { since } else { format!("{since}; {}", list(idle, ToString::to_string, ", ")) }
}

/// Whether more iterations would help, and what would.
fn advice(stands_since: Option<usize>, idle: &[IdleField], hardly_moves: Option<f64>) -> String {
    if hardly_moves.is_some() {
        return "judge such a step by an absolute bound: \
                `coupling.convergence = { interface_residual = { absolute = ... } }` in metres"
            .to_owned();
    }
    if !idle.is_empty() {
        return format!(
            "its residual stays below its own bound, which is too loose for the coupling: lower {}",
            list(idle, |field| format!("`{}.newton.tolerance`", field.name), " and "),
        );
    }
    let advice = match stands_since {
        None => {
            "raise the iteration bound, use a quasi-Newton method, or check that the tolerances can be met"
        }
        Some(_) => {
            "more iterations will not help; take a smaller relaxation factor, Aitken relaxation or a quasi-Newton method, \
             or check that the tolerances can be met"
        }
    };
    advice.to_owned()
}

fn list(fields: &[IdleField], part: fn(&IdleField) -> String, and: &str) -> String {
    fields.iter().map(part).collect::<Vec<_>>().join(and)
}

#[cfg(test)]
mod tests {
    use std::error::Error as _;

    use super::*;

    #[test]
    fn step_error_names_step_iteration_field_and_remedy() {
        let source = std::io::Error::other("element 7 is inverted");
        let cause = ParticipantError::new("fluid", "mesh motion failed at (0.1, 0.2) m")
            .with_hint("use a smaller time step")
            .with_source(source);
        let step = Step { index: 12, time: 0.12, dt: 0.01 };
        let error = StepError {
            step,
            iteration: 7,
            coupled: true,
            cause: Box::new(cause.into()),
            history: Box::new(StepHistory::new(step)),
        };
        assert_eq!(
            error.to_string(),
            "step 12 (t = 0.12 s), coupling iteration 7, fluid: mesh motion failed at (0.1, 0.2) m"
        );
        assert_eq!(error.help().expect("a remedy").to_string(), "use a smaller time step");
        let cause = error.source().expect("the cause is kept");
        assert_eq!(
            cause.source().expect("the field's own error is kept").to_string(),
            "element 7 is inverted"
        );
    }
}
