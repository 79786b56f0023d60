//! Aitken's dynamic relaxation.

use super::{Accelerator, AcceleratorState, Proposal, check_omega};
use crate::error::SetupError;
use crate::vector::{add_scaled, dot, subtract};

/// `x <- x + omega_k r^k` with
/// `omega_k = -omega_{k-1} (r^{k-1} . (r^k - r^{k-1})) / |r^k - r^{k-1}|^2` (Irons and Tuck 1969; Küttler and Wall 2008).
///
/// The first iteration of a step takes the last factor of the step before, with its sign, but at most
/// `omega_0` in size. Where the formula gives no usable factor (two equal residuals), the last one stays.
#[derive(Debug, Clone)]
pub struct Aitken {
    omega_0: f64,
    /// Last factor of the last accepted step.
    committed: Option<f64>,
    /// Last factor of this step.
    trial: Option<f64>,
    previous: Vec<f64>,
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
        Ok(Self { omega_0, committed: None, trial: None, previous: zeros.clone(), difference: zeros })
    }

    fn next_omega(&mut self, r: &[f64]) -> f64 {
        let Some(last) = self.trial else {
            return self.committed.map_or(self.omega_0, |last| last.abs().min(self.omega_0).copysign(last));
        };
        subtract(r, &self.previous, &mut self.difference);
        let omega = -last * dot(&self.previous, &self.difference) / dot(&self.difference, &self.difference);
        if omega.is_finite() && omega != 0.0 { omega } else { last }
    }
}

impl Accelerator for Aitken {
    fn propose(&mut self, x: &mut [f64], r: &[f64]) -> Proposal {
        let omega = self.next_omega(r);
        self.trial = Some(omega);
        self.previous.copy_from_slice(r);
        add_scaled(omega, r, x);
        Proposal::relaxation(omega)
    }

    fn step_converged(&mut self, _: &[f64], _: &[f64]) {
        self.committed = self.trial.take().or(self.committed);
    }

    fn step_failed(&mut self) {
        self.trial = None;
    }

    fn state(&self) -> AcceleratorState {
        AcceleratorState::Aitken { omega: self.committed }
    }

    fn restore(&mut self, state: &AcceleratorState) -> Result<(), SetupError> {
        let AcceleratorState::Aitken { omega } = state else {
            return Err(SetupError::state("acceleration", "it is not that of Aitken's method"));
        };
        self.committed = *omega;
        self.trial = None;
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
            aitken.propose(&mut x, &r);
        }
        assert!((x[0] - a / (1.0 - lambda)).abs() < 1e-14);
    }

    #[test]
    fn equal_residuals_keep_the_last_factor() {
        let mut aitken = Aitken::new(0.5, 2).unwrap();
        let mut x = [0.0; 2];
        for _ in 0..3 {
            assert_eq!(aitken.propose(&mut x, &[0.0, 0.0]).omega, Some(0.5));
        }
        assert_eq!(x.map(f64::to_bits), [0; 2]);
    }

    #[test]
    fn next_step_starts_with_the_last_factor_bounded_by_the_first() {
        let mut aitken = Aitken::new(0.5, 1).unwrap();
        let mut x = [0.0];
        aitken.propose(&mut x, &[1.0]);
        aitken.propose(&mut x, &[0.5]);
        aitken.step_converged(&x, &[0.0]);
        assert_eq!(aitken.state(), AcceleratorState::Aitken { omega: Some(1.0) });
        assert_eq!(aitken.propose(&mut x, &[1.0]).omega, Some(0.5));
    }
}
