//! How many Newton iterations the next calls may run: the question this workspace is built round.

use serde::{Deserialize, Serialize};

use crate::criterion::Criterion;
use crate::participant::NewtonLimit;
use crate::record::StepHistory;
use crate::setup::SetupError;

/// The limits of the two calls of one coupling iteration.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Limits {
    /// Limit of the first participant's call.
    pub first: NewtonLimit,
    /// Limit of the second participant's call.
    pub second: NewtonLimit,
}

impl Limits {
    /// The same limit for both.
    #[must_use]
    pub fn both(limit: NewtonLimit) -> Self {
        Self { first: limit, second: limit }
    }
}

/// The policies a scene can name.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Policy {
    /// The same limits in every iteration: (N^f, N^s).
    Fixed {
        /// Limit of the first participant.
        first: NewtonLimit,
        /// Limit of the second participant.
        second: NewtonLimit,
    },
    /// Nm-CC: `at_most` Newton iterations a call until every change of the last coupling iteration is below
    /// `tolerance`, then to convergence; back to `at_most` when a change grows again.
    UntilCoupled {
        /// The limit m while the coupling is open.
        at_most: usize,
        /// Bound of the relative changes, commonly that of the coupling criterion.
        tolerance: f64,
    },
    /// Newton iterations until the field's output changes by less than `tolerance` in one of them.
    ConvergedInterfaceData {
        /// Bound of the relative change of the output.
        tolerance: f64,
    },
}

impl Policy {
    /// Checks the ranges.
    ///
    /// # Errors
    /// When a limit is zero or a tolerance is not positive.
    pub fn validate(&self) -> Result<(), SetupError> {
        match self {
            Self::Fixed { first, second } => [first, second].into_iter().try_for_each(|limit| match limit {
                NewtonLimit::AtMost(count) => check_count(*count),
                NewtonLimit::ToConvergence => Ok(()),
                NewtonLimit::UntilOutputSettles { tolerance } => check_tolerance(*tolerance),
            }),
            Self::UntilCoupled { at_most, tolerance } => {
                check_count(*at_most)?;
                check_tolerance(*tolerance)
            }
            Self::ConvergedInterfaceData { tolerance } => check_tolerance(*tolerance),
        }
    }

    /// The limits of the iteration that follows the last one of `history`. They follow from the step's own history alone.
    #[must_use]
    pub fn limits(&self, history: &StepHistory) -> Limits {
        match *self {
            Self::Fixed { first, second } => Limits { first, second },
            Self::UntilCoupled { at_most, tolerance } => {
                let coupled = Criterion::Changes { tolerance }.holds(history);
                Limits::both(if coupled { NewtonLimit::ToConvergence } else { NewtonLimit::AtMost(at_most) })
            }
            Self::ConvergedInterfaceData { tolerance } => {
                Limits::both(NewtonLimit::UntilOutputSettles { tolerance })
            }
        }
    }
}

fn check_count(count: usize) -> Result<(), SetupError> {
    if count > 0 {
        return Ok(());
    }
    Err(SetupError::setting("Newton limit", count, "allow at least one Newton iteration a call"))
}

fn check_tolerance(tolerance: f64) -> Result<(), SetupError> {
    if tolerance > 0.0 && tolerance.is_finite() {
        return Ok(());
    }
    Err(SetupError::setting("Newton policy tolerance", tolerance, "take a positive number"))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::participant::Step;
    use crate::record::samples::history;

    fn empty() -> StepHistory {
        StepHistory::new(Step { index: 1, time: 0.1, dt: 0.1 })
    }

    #[test]
    fn fixed_limits_never_change() {
        let (first, second) = (NewtonLimit::AtMost(2), NewtonLimit::ToConvergence);
        let policy = Policy::Fixed { first, second };
        for history in [empty(), history([0.0, 0.0], true, true), history([1.0, 1.0], false, false)] {
            assert_eq!(policy.limits(&history), Limits { first, second });
        }
    }

    #[test]
    fn until_coupled_opens_the_limit_when_all_changes_are_small_and_closes_it_again() {
        let policy = Policy::UntilCoupled { at_most: 3, tolerance: 1e-5 };
        let (closed, open) = (Limits::both(NewtonLimit::AtMost(3)), Limits::both(NewtonLimit::ToConvergence));
        assert_eq!(policy.limits(&empty()), closed);
        // Whether the fields meet their own bounds does not matter: that is what the open limit is for.
        let mut course = history([1e-6, 1e-6], false, false);
        assert_eq!(policy.limits(&course), open);
        course.iterations.push(history([1e-6, 1e-4], false, true).iterations.remove(0));
        assert_eq!(policy.limits(&course), closed);
    }

    #[test]
    fn converged_interface_data_watches_the_output() {
        let policy = Policy::ConvergedInterfaceData { tolerance: 1e-4 };
        let expected = Limits::both(NewtonLimit::UntilOutputSettles { tolerance: 1e-4 });
        assert_eq!(policy.limits(&empty()), expected);
        assert_eq!(policy.limits(&history([0.0, 0.0], true, true)), expected);
    }
}
