//! From one iterate of the interface displacement to the next.
//!
//! An accelerator sees pairs `(x, r)` with `r = x_tilde - x` and proposes the next `x`. Within a step it
//! collects what it needs; at the end of the step [`step_converged`](Accelerator::step_converged) moves it into the state that
//! lasts, [`step_failed`](Accelerator::step_failed) forgets it.

mod aitken;
mod constant;

use serde::{Deserialize, Serialize};

pub use aitken::Aitken;
pub use constant::Constant;

use crate::error::SetupError;

/// Turns `(x, r)` into the next interface displacement.
pub trait Accelerator: Send {
    /// Corrects the first participant's output `load` before the second one sees it; `x` is what led to it.
    /// Block methods need it, the others leave it alone.
    fn correct_first_output(&mut self, x: &[f64], load: &mut [f64]) {
        let _ = (x, load);
    }

    /// Replaces `x` by the next iterate, from the residual `r = x_tilde - x` that `x` led to.
    fn propose(&mut self, x: &mut [f64], r: &[f64]) -> Proposal;

    /// The step is accepted. `x` and `r` belong to its last iteration, which no proposal followed.
    fn step_converged(&mut self, x: &[f64], r: &[f64]);

    /// The step is given up: back to the state before it, bit for bit.
    fn step_failed(&mut self);

    /// What lasts from step to step.
    fn state(&self) -> AcceleratorState;

    /// Continues from a saved state, bit for bit.
    ///
    /// # Errors
    /// When the state belongs to another method or another interface.
    fn restore(&mut self, state: &AcceleratorState) -> Result<(), SetupError>;
}

/// How a proposal came about.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Proposal {
    /// The relaxation factor, where the proposal was a relaxation.
    pub omega: Option<f64>,
    /// Secant columns that took part, those of earlier steps included.
    pub columns: usize,
    /// Columns dropped in this iteration.
    pub dropped: Vec<DroppedColumn>,
}

impl Proposal {
    /// A relaxation by `omega`.
    #[must_use]
    pub fn relaxation(omega: f64) -> Self {
        Self { omega: Some(omega), ..Self::default() }
    }
}

/// A secant column that was dropped.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct DroppedColumn {
    /// How many steps ago it was made; 0 is the current step.
    pub steps_ago: usize,
    /// Its place among the columns of that step at this moment; 0 is the newest.
    pub column: usize,
    /// Why.
    pub reason: DropReason,
}

/// Why a column was dropped.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum DropReason {
    /// The residual or the output did not change at all between the two iterations.
    NoChange,
    /// The filter found it to depend on newer columns.
    Dependent {
        /// What is independent of newer columns, relative to what the filter compares it with.
        independent: f64,
    },
}

/// The accelerations a scene can name.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Acceleration {
    /// Relaxation by a constant factor.
    Constant {
        /// The factor.
        omega: f64,
    },
    /// Aitken's dynamic relaxation.
    Aitken {
        /// The factor of the very first iteration, and the largest one at the first iteration of a step.
        omega_0: f64,
    },
}

impl Acceleration {
    /// The accelerator for an interface of `size` unknowns.
    ///
    /// # Errors
    /// When a setting is out of its range.
    pub fn build(&self, size: usize) -> Result<Box<dyn Accelerator>, SetupError> {
        Ok(match *self {
            Self::Constant { omega } => Box::new(Constant::new(omega)?),
            Self::Aitken { omega_0 } => Box::new(Aitken::new(omega_0, size)?),
        })
    }
}

/// What an accelerator keeps from step to step, as plain data.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum AcceleratorState {
    /// Constant relaxation keeps nothing.
    Constant,
    /// Aitken's factor of the last iteration, if there was one.
    Aitken {
        /// The factor.
        omega: Option<f64>,
    },
}

/// A relaxation factor must be positive; factors above one overrelax and are allowed.
fn check_omega(omega: f64) -> Result<(), SetupError> {
    if omega > 0.0 && omega.is_finite() {
        return Ok(());
    }
    Err(SetupError::setting("relaxation factor", omega, "take a positive number, commonly 0.01 to 1"))
}
