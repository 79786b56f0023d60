//! When a step is done.

use serde::{Deserialize, Serialize};

use crate::record::{FieldRecord, IterationRecord, StepHistory};
use crate::setup::SetupError;

/// A bound, relative or absolute.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Bound {
    /// Relative to the natural scale of the quantity.
    Relative(f64),
    /// In the units of the quantity.
    Absolute(f64),
}

/// The coupling criterion: a pure function of the step's history.
///
/// The iteration bound is no criterion. A step ends when the criterion holds *and* every field is below its
/// own residual bound, see [`ends_step`](Self::ends_step).
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Criterion {
    /// Every part of every field changed by less than `tolerance` within the last coupling iteration, the
    /// first one included.
    Changes {
        /// Bound of the relative changes.
        tolerance: f64,
    },
    /// Every field met its own residual bound at the *entry* of its call, so it had nothing to do
    /// (Spenke, Delaisse, Degroote, Hosters 2023). Needs no tolerance. A system in which nothing but round-off changes has
    /// nothing to do, either.
    EntryResiduals,
    /// `|r| < bound`, absolute \[m\] or relative to `|x_tilde|`.
    InterfaceResidual(Bound),
    /// Every one of these holds.
    All(Vec<Criterion>),
    /// At least one of these holds.
    Any(Vec<Criterion>),
}

impl Criterion {
    /// Whether the criterion holds after the last iteration of `history`. Before the first it never does.
    #[must_use]
    pub fn holds(&self, history: &StepHistory) -> bool {
        history.last().is_some_and(|iteration| self.holds_after(iteration))
    }

    /// Whether the step may end: the criterion holds and every field is below its own residual bound.
    #[must_use]
    pub fn ends_step(&self, history: &StepHistory) -> bool {
        self.holds(history)
            && history.last().is_some_and(|iteration| iteration.fields.iter().all(|field| field.converged))
    }

    fn holds_after(&self, iteration: &IterationRecord) -> bool {
        match self {
            Self::Changes { tolerance } => {
                iteration.fields.iter().all(|field| changes_below(field, *tolerance))
            }
            Self::EntryResiduals => {
                iteration.fields.iter().all(|field| field.entry_converged) || is_at_rest(iteration)
            }
            Self::InterfaceResidual(Bound::Absolute(bound)) => iteration.residual < *bound,
            Self::InterfaceResidual(Bound::Relative(bound)) => iteration.relative_residual < *bound,
            Self::All(parts) => !parts.is_empty() && parts.iter().all(|part| part.holds_after(iteration)),
            Self::Any(parts) => parts.iter().any(|part| part.holds_after(iteration)),
        }
    }

    /// Checks the ranges of all tolerances.
    ///
    /// # Errors
    /// When a tolerance is not positive, or a combination is empty.
    pub fn validate(&self) -> Result<(), SetupError> {
        match self {
            Self::Changes { tolerance: value }
            | Self::InterfaceResidual(Bound::Absolute(value) | Bound::Relative(value)) => {
                if *value > 0.0 && value.is_finite() {
                    return Ok(());
                }
                Err(SetupError::setting("criterion tolerance", value, "take a positive number"))
            }
            Self::EntryResiduals => Ok(()),
            Self::All(parts) | Self::Any(parts) => {
                if parts.is_empty() {
                    return Err(SetupError::setting("criterion", "[]", "combine at least one criterion"));
                }
                parts.iter().try_for_each(Self::validate)
            }
        }
    }
}

/// Whether nothing changes but round-off, of which both the interface and the fields make zero.
fn is_at_rest(iteration: &IterationRecord) -> bool {
    iteration.relative_residual <= 0.0
        && iteration.fields.iter().all(|field| changes_below(field, f64::MIN_POSITIVE))
}

/// A field that reports no change at all has not said that it is unchanged.
fn changes_below(field: &FieldRecord, tolerance: f64) -> bool {
    !field.changes.is_empty() && field.changes.iter().all(|change| change.value < tolerance)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::participant::Step;
    use crate::record::samples::history;

    const CHANGES: Criterion = Criterion::Changes { tolerance: 1e-5 };

    #[test]
    fn changes_must_all_be_below_the_tolerance() {
        assert!(CHANGES.holds(&history([9e-6, 0.0], false, true)));
        assert!(!CHANGES.holds(&history([1e-5, 0.0], false, true)));
        assert!(!CHANGES.holds(&history([0.0, 2e-5], false, true)));
        assert!(!CHANGES.holds(&history([0.0, f64::NAN], false, true)));
        let mut silent = history([0.0, 0.0], false, true);
        silent.iterations[0].fields[1].changes.clear();
        assert!(!CHANGES.holds(&silent), "a field without changes has said nothing");
    }

    #[test]
    fn step_goes_on_while_a_field_misses_its_own_bound() {
        let mut open = history([0.0, 0.0], false, true);
        assert!(CHANGES.ends_step(&open));
        open.iterations[0].fields[1].converged = false;
        assert!(CHANGES.holds(&open) && !CHANGES.ends_step(&open));
    }

    #[test]
    fn entry_residuals_ask_every_field() {
        assert!(Criterion::EntryResiduals.holds(&history([1.0, 1.0], true, true)));
        let mut one = history([0.0, 0.0], true, true);
        one.iterations[0].fields[0].entry_converged = false;
        assert!(!Criterion::EntryResiduals.holds(&one));
    }

    #[test]
    fn nothing_but_round_off_leaves_nothing_to_do() {
        let mut rest = history([0.0, 0.0], false, true);
        assert!(!Criterion::EntryResiduals.holds(&rest), "the interface still moves");
        rest.iterations[0].relative_residual = 0.0;
        assert!(Criterion::EntryResiduals.holds(&rest));
        rest.iterations[0].fields[0].changes[0].value = 1e-300;
        assert!(!Criterion::EntryResiduals.holds(&rest));
    }

    #[test]
    fn interface_residual_is_absolute_or_relative() {
        let history = history([1.0, 1.0], false, true);
        for (bound, expected) in [
            (Bound::Absolute(0.26), true),
            (Bound::Absolute(0.25), false),
            (Bound::Relative(0.126), true),
            (Bound::Relative(0.125), false),
        ] {
            assert_eq!(Criterion::InterfaceResidual(bound).holds(&history), expected, "{bound:?}");
        }
    }

    #[test]
    fn combinations_are_conjunction_and_disjunction() {
        let history = history([1e-6, 1e-6], false, true);
        let (yes, no) = (CHANGES, Criterion::EntryResiduals);
        assert!(Criterion::Any(vec![no.clone(), yes.clone()]).holds(&history));
        assert!(!Criterion::All(vec![no.clone(), yes.clone()]).holds(&history));
        assert!(Criterion::All(vec![yes.clone(), yes]).holds(&history));
        assert!(!Criterion::Any(vec![no]).holds(&history));
        assert!(!Criterion::All(vec![]).holds(&history), "nothing asked is nothing shown");
    }

    #[test]
    fn nothing_holds_before_the_first_iteration() {
        let empty = StepHistory::new(Step { index: 1, time: 0.1, dt: 0.1 });
        let all = [CHANGES, Criterion::EntryResiduals, Criterion::InterfaceResidual(Bound::Absolute(1e9))];
        assert!(all.iter().all(|criterion| !criterion.ends_step(&empty)));
    }

    #[test]
    fn criterion_is_blind_to_the_number_of_iterations() {
        let mut long = history([1.0, 1.0], false, true);
        for _ in 0..1000 {
            long.iterations.push(long.iterations[0].clone());
        }
        assert!(!CHANGES.holds(&long) && !Criterion::EntryResiduals.holds(&long));
    }
}
