//! Interface quasi-Newton with a dense multi-vector Jacobian: the reference for IQN-IMVLS.

use std::collections::VecDeque;

use super::column::Columns;
use super::history::Secants;
use super::{Accelerator, Answer, DroppedColumn, Proposal, QuasiNewton, relax, wrong_size};
use crate::setup::SetupError;
use crate::state;
use crate::vector::dot;

const NAME: &str = "iqn_mvj";

/// IQN-MVJ (Lindner, Mehl, Scheufele, Uekermann 2015): `J = J_prev + (W - J_prev V) V^+`, `x <- x_tilde - J r`.
///
/// `J` maps residual differences to output differences, and is `(1 - omega_unseen) I` before there are any. It is stored as a
/// dense matrix of size² entries: for small interfaces, and for tests.
#[derive(Debug, Clone)]
pub struct IqnMvj {
    settings: QuasiNewton,
    size: usize,
    /// `J_prev`, row by row; empty while no step is known.
    jacobian: Vec<f64>,
    /// The columns `J_prev` is made of, kept only where the history is limited.
    past: VecDeque<Columns>,
    secants: Secants,
    /// `J_prev r`.
    b: Vec<f64>,
}

impl IqnMvj {
    /// The method for `size` interface unknowns.
    ///
    /// # Errors
    /// When a setting is out of its range.
    pub fn new(settings: QuasiNewton, size: usize) -> Result<Self, SetupError> {
        settings.validate()?;
        Ok(Self {
            settings,
            size,
            jacobian: Vec::new(),
            past: VecDeque::new(),
            secants: Secants::new(settings.filter),
            b: vec![0.0; size],
        })
    }

    fn apply_previous_jacobian(&mut self, r: &[f64]) {
        multiply(&self.jacobian, self.settings.unseen_jacobian(), r, &mut self.b);
    }

    /// Takes the columns of the finished step into `J`.
    fn learn(&mut self) {
        match self.settings.history {
            None => {
                let unseen = self.settings.unseen_jacobian();
                update(&mut self.jacobian, unseen, &self.secants, self.size);
            }
            Some(steps) => {
                self.past.push_front(self.secants.columns().clone());
                self.past.truncate(steps);
                self.relearn();
            }
        }
    }

    /// `J` from the kept steps alone, oldest first.
    fn relearn(&mut self) {
        self.jacobian.clear();
        let unseen = self.settings.unseen_jacobian();
        for columns in self.past.iter().rev() {
            let mut columns = columns.clone();
            for column in &mut columns.all {
                multiply(&self.jacobian, unseen, &column.v, &mut column.jv);
            }
            update(&mut self.jacobian, unseen, &Secants::from_columns(columns), self.size);
        }
    }
}

/// `result = J r`; while `J` is empty it is a multiple of the identity.
fn multiply(jacobian: &[f64], unseen: f64, r: &[f64], result: &mut [f64]) {
    for (value, r) in result.iter_mut().zip(r) {
        *value = unseen * r;
    }
    for (value, row) in result.iter_mut().zip(jacobian.chunks_exact(r.len())) {
        *value = dot(row, r);
    }
}

/// `J += (W - J V) R^{-1} Q^T`; while `J` is empty it is a multiple of the identity.
fn update(jacobian: &mut Vec<f64>, unseen: f64, secants: &Secants, size: usize) {
    if jacobian.is_empty() {
        jacobian.resize(size * size, 0.0);
        jacobian.iter_mut().step_by(size + 1).for_each(|diagonal| *diagonal = unseen);
    }
    let mut unit = vec![0.0; size];
    let mut inverse_column = Vec::new();
    for column in 0..size {
        unit[column] = 1.0;
        secants.qr().solve(&unit, &mut inverse_column);
        unit[column] = 0.0;
        for (factor, difference) in inverse_column.iter().zip(&secants.columns().all) {
            for row in 0..size {
                jacobian[row * size + column] += factor * (difference.w[row] - difference.jv[row]);
            }
        }
    }
}

impl Accelerator for IqnMvj {
    fn name(&self) -> &str {
        NAME
    }

    fn propose(&mut self, x: &mut [f64], r: &[f64], answer: Answer) -> Proposal {
        let first = self.secants.at_first_iteration();
        self.apply_previous_jacobian(r);
        let dropped = self.secants.observe(x, r, &self.b, answer);
        let nothing_known = self.jacobian.is_empty() && self.secants.len() == 0;
        if nothing_known || (first && self.settings.relax_first_iteration) {
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
            self.apply_previous_jacobian(r);
            dropped = self.secants.observe(x, r, &self.b, answer);
        }
        if self.secants.len() > 0 && self.settings.history != Some(0) {
            self.learn();
        }
        self.secants.start_step(Columns::new());
        dropped
    }

    fn step_failed(&mut self) {
        self.secants.start_step(Columns::new());
    }

    fn save(&self) -> Vec<u8> {
        state::encode(&(&self.jacobian, &self.past))
    }

    fn restore(&mut self, bytes: &[u8]) -> Result<(), SetupError> {
        let (jacobian, past): (Vec<f64>, VecDeque<Columns>) = state::decode(NAME, bytes)?;
        let square = jacobian.is_empty() || jacobian.len() == self.size * self.size;
        if !square || !past.iter().all(|columns| columns.fit(self.size)) {
            return Err(wrong_size(NAME, self.size));
        }
        (self.jacobian, self.past) = (jacobian, past);
        self.secants.start_step(Columns::new());
        Ok(())
    }
}
