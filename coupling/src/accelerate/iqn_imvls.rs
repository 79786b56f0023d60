//! Interface quasi-Newton with an implicit multi-vector update: linear cost in the interface size.

use std::collections::VecDeque;

use serde::{Deserialize, Serialize};

use super::column::Columns;
use super::history::Secants;
use super::{Accelerator, Answer, DroppedColumn, Proposal, QuasiNewton, relax, wrong_size};
use crate::setup::SetupError;
use crate::state;
use crate::vector::{add_scaled, dot};

const NAME: &str = "iqn_imvls";

/// What one finished step adds to the Jacobian: `J <- J + (W - J V) V^+` with `V^+ = R^{-1} Q^T`.
///
/// Kept as `Q` and `T = W R^{-1}`. The step's part of `J r` is then `T g` with `g = Q^T r`, and `V V^+ r = Q g` is
/// what older steps no longer see: two matrices instead of `V`, `W` and `Z`, and no triangular solve.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct StepInverse {
    /// Orthonormal columns of `Q`.
    pub q: Vec<Vec<f64>>,
    /// Columns of `T = W R^{-1}`.
    pub t: Vec<Vec<f64>>,
}

impl StepInverse {
    /// The columns of a finished step, newest first.
    fn new(secants: &Secants) -> Self {
        let mut t: Vec<Vec<f64>> = Vec::with_capacity(secants.len());
        for (j, column) in secants.columns().all.iter().enumerate() {
            let r = secants.qr().r(j);
            let mut t_j = column.w.clone();
            for i in 0..j {
                add_scaled(-r[i], &t[i], &mut t_j);
            }
            for value in &mut t_j {
                *value /= r[j];
            }
            t.push(t_j);
        }
        Self { q: secants.qr().q().to_vec(), t }
    }

    fn fits(&self, size: usize) -> bool {
        self.q.len() == self.t.len() && self.q.iter().chain(&self.t).all(|column| column.len() == size)
    }
}

/// IQN-IMVLS (Spenke, Hosters, Behr 2020): the update of IQN-MVJ without ever forming `J`.
///
/// With `b = J_prev r` from the recurrence over the kept steps, which ends with `(1 - omega_unseen) I`, and `B = W - J_prev V`
/// of this step, whose columns are `w_k - (b^k - b^{k-1})`: `c = argmin |V c + r|` over this step's columns, `x <- x_tilde - b + B c`.
#[derive(Debug, Clone)]
pub struct IqnImvls {
    settings: QuasiNewton,
    size: usize,
    /// Accepted steps, newest first.
    past: VecDeque<StepInverse>,
    secants: Secants,
    /// `b = J_prev r`.
    b: Vec<f64>,
    /// What of `r` older steps still see.
    rest: Vec<f64>,
    /// `g = Q^T r` of one past step.
    g: Vec<f64>,
}

impl IqnImvls {
    /// The method for `size` interface unknowns.
    ///
    /// # Errors
    /// When a setting is out of its range.
    pub fn new(settings: QuasiNewton, size: usize) -> Result<Self, SetupError> {
        settings.validate()?;
        Ok(Self {
            settings,
            size,
            past: VecDeque::new(),
            secants: Secants::new(settings.filter),
            b: vec![0.0; size],
            rest: vec![0.0; size],
            g: Vec::new(),
        })
    }

    /// `b = J_prev r`: newest step first, each takes the part of `r` it knows and leaves the rest to older ones.
    fn apply_previous_jacobian(&mut self, r: &[f64]) {
        self.b.fill(0.0);
        self.rest.copy_from_slice(r);
        for step in &self.past {
            self.g.clear();
            self.g.extend(step.q.iter().map(|q| dot(q, &self.rest)));
            for ((g, q), t) in self.g.iter().zip(&step.q).zip(&step.t) {
                add_scaled(*g, t, &mut self.b);
                add_scaled(-g, q, &mut self.rest);
            }
        }
        add_scaled(self.settings.unseen_jacobian(), &self.rest, &mut self.b);
    }
}

impl Accelerator for IqnImvls {
    fn name(&self) -> &str {
        NAME
    }

    fn propose(&mut self, x: &mut [f64], r: &[f64], answer: Answer) -> Proposal {
        let first = self.secants.at_first_iteration();
        self.apply_previous_jacobian(r);
        let dropped = self.secants.observe(x, r, &self.b, answer);
        let nothing_known = self.past.is_empty() && self.secants.len() == 0;
        if nothing_known || (first && self.settings.relax_first_iteration) {
            self.secants.move_on();
            return relax(self.settings.omega_0, x, r, dropped);
        }
        if !self.secants.waits() {
            self.secants.update(x, r, &self.b);
        }
        let past: usize = self.past.iter().map(|step| step.q.len()).sum();
        Proposal { columns: self.secants.len() + past, dropped, ..Proposal::default() }
    }

    fn step_converged(&mut self, x: &[f64], r: &[f64], answer: Answer) -> Vec<DroppedColumn> {
        let mut dropped = Vec::new();
        if self.settings.keep_last_differences {
            self.apply_previous_jacobian(r);
            dropped = self.secants.observe(x, r, &self.b, answer);
        }
        if self.secants.len() > 0 {
            self.past.push_front(StepInverse::new(&self.secants));
        }
        if let Some(steps) = self.settings.history {
            self.past.truncate(steps);
        }
        self.secants.start_step(Columns::new());
        dropped
    }

    fn step_failed(&mut self) {
        self.secants.start_step(Columns::new());
    }

    fn save(&self) -> Vec<u8> {
        state::encode(&self.past)
    }

    fn restore(&mut self, bytes: &[u8]) -> Result<(), SetupError> {
        let steps: VecDeque<StepInverse> = state::decode(NAME, bytes)?;
        if !steps.iter().all(|step| step.fits(self.size)) {
            return Err(wrong_size(NAME, self.size));
        }
        self.past = steps;
        self.secants.start_step(Columns::new());
        Ok(())
    }
}
