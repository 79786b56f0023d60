//! Small coupled problems on which every method of this crate is debugged in milliseconds.
//!
//! * [`tube`]: flow through an elastic tube in one dimension; both fields nonlinear, each with its own Newton
//!   loop, so that Newton limits matter.
//! * [`tank`]: a tank with an elastic bottom; linear, with the added mass of the exact potential flow.
//!
//! For both, the Dirichlet-Neumann eigenvalues are known in closed form.

mod field;
mod generalized_alpha;
pub mod tank;
pub mod tube;

pub use field::{Field, Model};

use crate::setup::SetupError;

/// A property of a model that has to be positive.
fn check_positive(setting: &'static str, value: f64) -> Result<(), SetupError> {
    if value > 0.0 && value.is_finite() {
        return Ok(());
    }
    Err(SetupError::setting(setting, value, "take a positive number"))
}

/// A property of a model that must not be negative.
fn check_not_negative(setting: &'static str, value: f64) -> Result<(), SetupError> {
    if value >= 0.0 && value.is_finite() {
        return Ok(());
    }
    Err(SetupError::setting(setting, value, "take zero or a positive number"))
}
