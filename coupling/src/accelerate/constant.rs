//! Relaxation by a constant factor.

use super::{Accelerator, Answer, DroppedColumn, Proposal, check_omega};
use crate::setup::SetupError;
use crate::state;
use crate::vector::add_scaled;

const NAME: &str = "constant";

/// `x <- x + omega r`.
///
/// With the Dirichlet-Neumann eigenvalues `lambda <= 0` the errors are multiplied by `1 - omega (1 - lambda)`
/// an iteration: it converges for `omega < 2 / (1 - lambda_min)`.
#[derive(Debug, Clone)]
pub struct Constant {
    omega: f64,
}

impl Constant {
    /// Relaxation by `omega`.
    ///
    /// # Errors
    /// When `omega` is not positive.
    pub fn new(omega: f64) -> Result<Self, SetupError> {
        check_omega(omega)?;
        Ok(Self { omega })
    }
}

impl Accelerator for Constant {
    fn name(&self) -> &str {
        NAME
    }

    fn propose(&mut self, x: &mut [f64], r: &[f64], _: Answer) -> Proposal {
        add_scaled(self.omega, r, x);
        Proposal::relaxation(self.omega)
    }

    fn step_converged(&mut self, _: &[f64], _: &[f64], _: Answer) -> Vec<DroppedColumn> {
        Vec::new()
    }

    fn step_failed(&mut self) {}

    fn save(&self) -> Vec<u8> {
        Vec::new()
    }

    fn restore(&mut self, bytes: &[u8]) -> Result<(), SetupError> {
        state::expect_none(NAME, bytes)
    }
}
