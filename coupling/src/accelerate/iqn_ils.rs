//! Interface quasi-Newton with a least-squares model of the inverse Jacobian.

use super::column::Columns;
use super::history::Secants;
use super::{Accelerator, Answer, DroppedColumn, Proposal, QuasiNewton, relax, wrong_size};
use crate::setup::SetupError;
use crate::state;

const NAME: &str = "iqn_ils";

/// IQN-ILS (Degroote, Bathe, Vierendeels 2009): `c = argmin |V c + r|`, `x <- x_tilde + W c`.
///
/// `V` and `W` hold the columns of this step and of the last `history` steps, newest first. Where the unseen part of `r` is
/// relaxed, `x <- x_tilde - b + (W - J_0 V) c` with `J_0 = (1 - omega_unseen) I` and `b = J_0 r`.
#[derive(Debug, Clone)]
pub struct IqnIls {
    settings: QuasiNewton,
    size: usize,
    /// Columns of accepted steps.
    committed: Columns,
    /// The same with those of this step, as the filter has left them.
    secants: Secants,
    /// `J_0 r`; empty where `J_0` is zero.
    b: Vec<f64>,
}

impl IqnIls {
    /// The method for `size` interface unknowns.
    ///
    /// # Errors
    /// When a setting is out of its range.
    pub fn new(settings: QuasiNewton, size: usize) -> Result<Self, SetupError> {
        settings.validate()?;
        let secants = Secants::new(settings.filter);
        Ok(Self { settings, size, committed: Columns::new(), secants, b: Vec::new() })
    }

    fn apply_initial_jacobian(&mut self, r: &[f64]) {
        let factor = self.settings.unseen_jacobian();
        self.b.clear();
        if factor != 0.0 {
            self.b.extend(r.iter().map(|r| factor * r));
        }
    }
}

impl Accelerator for IqnIls {
    fn name(&self) -> &str {
        NAME
    }

    fn propose(&mut self, x: &mut [f64], r: &[f64], answer: Answer) -> Proposal {
        let first = self.secants.at_first_iteration();
        self.apply_initial_jacobian(r);
        let dropped = self.secants.observe(x, r, &self.b, answer);
        if self.secants.len() == 0 || (first && self.settings.relax_first_iteration) {
            self.secants.move_on();
            return relax(self.settings.omega_0, x, r, dropped);
        }
        if !self.secants.waits() {
            self.secants.update(x, r, &self.b);
        }
        Proposal { columns: self.secants.len(), dropped, ..Proposal::default() }
    }

    fn step_converged(&mut self, x: &[f64], r: &[f64], answer: Answer) -> Vec<DroppedColumn> {
        let mut dropped = Vec::new();
        if self.settings.keep_last_differences {
            self.apply_initial_jacobian(r);
            dropped = self.secants.observe(x, r, &self.b, answer);
        }
        self.committed.clone_from(self.secants.columns());
        self.committed.end_step(self.settings.history);
        self.secants.start_step(self.committed.clone());
        dropped
    }

    fn step_failed(&mut self) {
        self.secants.start_step(self.committed.clone());
    }

    fn save(&self) -> Vec<u8> {
        state::encode(&self.committed)
    }

    fn restore(&mut self, bytes: &[u8]) -> Result<(), SetupError> {
        let columns: Columns = state::decode(NAME, bytes)?;
        if !columns.fit(self.size) {
            return Err(wrong_size(NAME, self.size));
        }
        self.committed.clone_from(&columns);
        self.secants.start_step(columns);
        Ok(())
    }
}
