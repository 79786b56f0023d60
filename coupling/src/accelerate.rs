//! From one iterate of the interface displacement to the next.
//!
//! An accelerator sees pairs `(x, r)` with `r = x_tilde - x` and proposes the next `x`. It may learn only from pairs that both
//! fields answered (see [`Answer`]). Within a step it collects what it needs; at the end of the step [`step_converged`](Accelerator::step_converged) moves it into the state that
//! lasts, [`step_failed`](Accelerator::step_failed) forgets it.

mod aitken;
mod column;
mod constant;
mod filter;
mod history;
mod iqn_ils;
mod iqn_imvls;
mod iqn_mvj;
mod qr;

use serde::{Deserialize, Serialize};

pub use aitken::Aitken;
pub use column::{Column, Columns};
pub use constant::Constant;
pub use filter::Filter;
pub use iqn_ils::IqnIls;
pub use iqn_imvls::{IqnImvls, StepInverse};
pub use iqn_mvj::IqnMvj;

use crate::setup::SetupError;
use crate::vector::add_scaled;

/// Turns `(x, r)` into the next interface displacement.
pub trait Accelerator: Send {
    /// Name of the method, in records, checkpoints and messages.
    fn name(&self) -> &str;

    /// Corrects the first participant's output `load` before the second one sees it; `x` is what led to it.
    /// Block methods need it, the others leave it alone.
    fn correct_first_output(&mut self, x: &[f64], load: &mut [f64]) {
        let _ = (x, load);
    }

    /// Replaces `x` by the next iterate, from the residual `r = x_tilde - x` that `x` led to.
    fn propose(&mut self, x: &mut [f64], r: &[f64], answer: Answer) -> Proposal;

    /// The step is accepted. `x`, `r` and `answer` belong to its last iteration, which no proposal followed. Returns the
    /// columns dropped now.
    fn step_converged(&mut self, x: &[f64], r: &[f64], answer: Answer) -> Vec<DroppedColumn>;

    /// The step is given up: back to the state before it, bit for bit.
    fn step_failed(&mut self);

    /// What lasts from step to step, in bytes that nobody else reads: [`state::encode`](crate::state::encode) makes them of
    /// plain data.
    fn save(&self) -> Vec<u8>;

    /// Continues from the bytes of [`save`](Self::save), bit for bit.
    ///
    /// # Errors
    /// If the bytes belong to another method or to an interface of another size.
    fn restore(&mut self, bytes: &[u8]) -> Result<(), SetupError>;
}

/// What a residual is worth as evidence of how the fields respond.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Answer {
    /// Whether both fields answered the input of this iteration. A field that enters its call converged and takes no Newton
    /// iteration does not: it hands out the load, or the displacement, of an earlier input. The difference to another
    /// iteration then is no derivative of anything.
    pub answered: bool,
}

impl Default for Answer {
    /// An answer.
    fn default() -> Self {
        Self { answered: true }
    }
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
    /// Name of the method, if it is none of those that settings can name; left out of the record otherwise.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub method: Option<String>,
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
    /// The residual or the output did not change between the two iterations, or by no more than round-off.
    NoChange,
    /// A field entered its call converged and took no iteration: its output is the answer to an earlier input.
    NoAnswer,
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
    /// Interface quasi-Newton with a least-squares model, columns of earlier steps reused.
    IqnIls(QuasiNewton),
    /// Interface quasi-Newton, implicit multi-vector update: linear cost.
    IqnImvls(QuasiNewton),
    /// Interface quasi-Newton, dense multi-vector Jacobian: quadratic cost, for small interfaces.
    IqnMvj(QuasiNewton),
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
            Self::IqnIls(settings) => Box::new(IqnIls::new(settings, size)?),
            Self::IqnImvls(settings) => Box::new(IqnImvls::new(settings, size)?),
            Self::IqnMvj(settings) => Box::new(IqnMvj::new(settings, size)?),
        })
    }
}

/// Settings of the interface quasi-Newton methods.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct QuasiNewton {
    /// Relaxation factor where no column is known: the first iteration of a run.
    pub omega_0: f64,
    /// Relaxation factor of the part of `r` that the columns do not tell of: `J = (1 - omega_unseen) I` there.
    ///
    /// The textbook's is 1: what is unseen goes into the next iterate as it is. A heavy fluid multiplies that part by the
    /// ratio of the masses, far beyond what a structure or a mesh bears. The factor costs little: on a linear interface and
    /// in exact arithmetic the first step is GMRES (Walker and Ni 2011), which is blind to it. But a small factor makes
    /// small changes, whatever is left of `r`: then judge a step by `r` too.
    pub omega_unseen: f64,
    /// Steps before the current one whose columns are used; `None` is all of them, 0 none.
    pub history: Option<usize>,
    /// Which columns may stay.
    pub filter: Filter,
    /// Whether the first iteration of each step is relaxed by `omega_0` even when earlier steps are known.
    pub relax_first_iteration: bool,
    /// Whether the differences to the last iteration of a converged step are kept too; some codes drop them.
    pub keep_last_differences: bool,
}

impl Default for QuasiNewton {
    /// `omega_0` 0.1, `omega_unseen` 1, five steps, QR3 at 1e-2, no relaxation where there is history, all differences kept.
    fn default() -> Self {
        Self {
            omega_0: 0.1,
            omega_unseen: 1.0,
            history: Some(5),
            filter: Filter::default(),
            relax_first_iteration: false,
            keep_last_differences: true,
        }
    }
}

impl QuasiNewton {
    fn validate(&self) -> Result<(), SetupError> {
        check_omega(self.omega_0)?;
        check_omega(self.omega_unseen)?;
        self.filter.validate()
    }

    /// The multiple of the identity that `J` is where no column tells of it.
    fn unseen_jacobian(&self) -> f64 {
        1.0 - self.omega_unseen
    }
}

/// The saved state of `method` is for an interface of another size.
fn wrong_size(method: &str, size: usize) -> SetupError {
    SetupError::state(method, format!("it is not for an interface of {size} unknowns"))
}

/// `x <- x + omega r`, where a quasi-Newton method has nothing to go by.
fn relax(omega: f64, x: &mut [f64], r: &[f64], dropped: Vec<DroppedColumn>) -> Proposal {
    add_scaled(omega, r, x);
    Proposal { dropped, ..Proposal::relaxation(omega) }
}

/// A relaxation factor must be positive; factors above one overrelax and are allowed.
fn check_omega(omega: f64) -> Result<(), SetupError> {
    if omega > 0.0 && omega.is_finite() {
        return Ok(());
    }
    Err(SetupError::setting("relaxation factor", omega, "take a positive number, commonly 0.01 to 1"))
}
