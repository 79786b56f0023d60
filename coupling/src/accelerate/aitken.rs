//! Aitken's dynamic relaxation.

use super::{Accelerator, Answer, DropReason, DroppedColumn, Proposal, check_omega};
use crate::setup::SetupError;
use crate::state;
use crate::vector::{add_scaled, dot, norm, subtract};

const NAME: &str = "aitken";

/// `x <- x + omega_k r^k` with `omega_k = -(dx . dr) / |dr|^2`, where `dx = x^k - x^{k-1}` and `dr = r^k - r^{k-1}` (Irons and
/// Tuck 1969; Küttler and Wall 2008 write `omega_{k-1} r^{k-1}` for `dx`).
///
/// The first iteration of a step takes the last factor of the step before, with its sign, but at most
/// `omega_0` in size. Where the formula gives no usable factor (two equal residuals), the last one stays. So it does in an
/// iteration that a field did not answer; the differences of the next one reach back to the last answered.
#[derive(Debug, Clone)]
pub struct Aitken {
    omega_0: f64,
    /// Last factor of the last accepted step.
    committed: Option<f64>,
    /// Last factor of this step.
    trial: Option<f64>,
    /// Whether `previous` and `moved` are those of an answered iteration of this step.
    answered: bool,
    /// `r` of the last answered iteration.
    previous: Vec<f64>,
    /// How far `x` has moved since.
    moved: Vec<f64>,
    difference: Vec<f64>,
}

impl Aitken {
    /// Aitken relaxation of `size` unknowns that starts with `omega_0`.
    ///
    /// # Errors
    /// When `omega_0` is not positive.
    pub fn new(omega_0: f64, size: usize) -> Result<Self, SetupError> {
        check_omega(omega_0)?;
        let zeros = vec![0.0; size];
        Ok(Self {
            omega_0,
            committed: None,
            trial: None,
            answered: false,
            previous: zeros.clone(),
            moved: zeros.clone(),
            difference: zeros,
        })
    }

    /// The last factor of this step, or what it starts with.
    fn last_omega(&self) -> f64 {
        let first =
            || self.committed.map_or(self.omega_0, |last| last.abs().min(self.omega_0).copysign(last));
        self.trial.unwrap_or_else(first)
    }

    /// The factor of the two last answered iterations, or why they give none.
    fn secant(&mut self, x: &[f64], r: &[f64]) -> Result<f64, DropReason> {
        subtract(r, &self.previous, &mut self.difference);
        if norm(&self.difference) <= f64::EPSILON * norm(x) {
            return Err(DropReason::NoChange);
        }
        let omega = -dot(&self.moved, &self.difference) / dot(&self.difference, &self.difference);
        if omega.is_finite() && omega != 0.0 { Ok(omega) } else { Err(DropReason::NoChange) }
    }

    fn start_step(&mut self) {
        self.trial = None;
        self.answered = false;
    }
}

impl Accelerator for Aitken {
    fn name(&self) -> &str {
        NAME
    }

    fn propose(&mut self, x: &mut [f64], r: &[f64], answer: Answer) -> Proposal {
        let secant = match (answer.answered, self.answered) {
            (true, true) => self.secant(x, r).map(Some),
            (true, false) => Ok(None),
            (false, _) => Err(DropReason::NoAnswer),
        };
        let omega = secant.ok().flatten().unwrap_or_else(|| self.last_omega());
        self.trial = Some(omega);
        if answer.answered {
            self.answered = true;
            self.previous.copy_from_slice(r);
            self.moved.fill(0.0);
        }
        add_scaled(omega, r, &mut self.moved);
        add_scaled(omega, r, x);
        let dropped = secant.err().map(|reason| DroppedColumn { steps_ago: 0, column: 0, reason });
        Proposal { dropped: dropped.into_iter().collect(), ..Proposal::relaxation(omega) }
    }

    fn step_converged(&mut self, _: &[f64], _: &[f64], _: Answer) -> Vec<DroppedColumn> {
        self.committed = self.trial.or(self.committed);
        self.start_step();
        Vec::new()
    }

    fn step_failed(&mut self) {
        self.start_step();
    }

    fn save(&self) -> Vec<u8> {
        state::encode(&self.committed)
    }

    fn restore(&mut self, bytes: &[u8]) -> Result<(), SetupError> {
        self.committed = state::decode(NAME, bytes)?;
        self.start_step();
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn scalar_linear_problem_is_solved_in_three_iterations() {
        // x_tilde = a + lambda x, a strongly added-mass dominated case.
        let (a, lambda) = (3.0, -7.5);
        let mut aitken = Aitken::new(0.05, 1).unwrap();
        let mut x = [0.0];
        for _ in 0..2 {
            let r = [a + lambda * x[0] - x[0]];
            aitken.propose(&mut x, &r, Answer::default());
        }
        assert!((x[0] - a / (1.0 - lambda)).abs() < 1e-14);
    }

    #[test]
    fn equal_residuals_keep_the_last_factor() {
        let mut aitken = Aitken::new(0.5, 2).unwrap();
        let mut x = [0.0; 2];
        for _ in 0..3 {
            assert_eq!(aitken.propose(&mut x, &[0.0, 0.0], Answer::default()).omega, Some(0.5));
        }
        assert_eq!(x.map(f64::to_bits), [0; 2]);
    }

    #[test]
    fn next_step_starts_with_the_last_factor_bounded_by_the_first() {
        let mut aitken = Aitken::new(0.5, 1).unwrap();
        let mut x = [0.0];
        let answer = Answer::default();
        aitken.propose(&mut x, &[1.0], answer);
        aitken.propose(&mut x, &[0.5], answer);
        aitken.step_converged(&x, &[0.0], answer);
        assert_eq!(state::decode(NAME, &aitken.save()), Ok(Some(1.0)));
        assert_eq!(aitken.propose(&mut x, &[1.0], answer).omega, Some(0.5));
    }

    #[test]
    fn an_iteration_without_an_answer_is_passed_over() {
        // x_tilde = a + lambda x; the second residual is that of the first output.
        let (a, lambda) = (3.0, -7.5);
        let mut aitken = Aitken::new(0.05, 1).unwrap();
        let mut x = [0.0];
        aitken.propose(&mut x, &[a], Answer::default());
        let stale = [a - x[0]];
        let proposal = aitken.propose(&mut x, &stale, Answer { answered: false });
        assert_eq!((proposal.omega, proposal.dropped[0].reason), (Some(0.05), DropReason::NoAnswer));
        let r = [a + lambda * x[0] - x[0]];
        aitken.propose(&mut x, &r, Answer::default());
        assert!((x[0] - a / (1.0 - lambda)).abs() < 1e-14);
    }
}
