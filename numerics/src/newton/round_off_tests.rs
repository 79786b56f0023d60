//! Residuals at round-off.

#![allow(clippy::float_cmp, reason = "these values are exact")]

use std::convert::Infallible;

use super::*;

/// Residuals as written down, one an assembly, against the scale one; two sizes of noise.
struct Noisy {
    residuals: Vec<f64>,
    assemblies: usize,
    round_off: f64,
    uncertainty: f64,
}

impl Noisy {
    fn new(residuals: &[f64], round_off: f64) -> Self {
        Self { residuals: residuals.to_vec(), assemblies: 0, round_off, uncertainty: round_off }
    }

    fn last(&self) -> f64 {
        self.residuals[(self.assemblies - 1).min(self.residuals.len() - 1)]
    }

    fn run(&mut self, check: Check, bound: Bound, limit: Limit) -> Result<Report, Failure<Infallible>> {
        self.assemblies = 0;
        solve(self, &Settings { check, bound, ..Settings::default() }, limit, |_, _| Verdict::Continue)
    }
}

impl Problem for Noisy {
    type Error = Infallible;

    fn assemble(&mut self, _with_tangent: bool) -> Result<ResidualNorm, Infallible> {
        self.assemblies += 1;
        Ok(ResidualNorm::new(self.last(), 1.0))
    }

    fn round_offs(&mut self) -> f64 {
        self.last() / self.round_off
    }

    fn uncertainties(&mut self) -> f64 {
        self.last() / self.uncertainty
    }

    fn solve_and_update(&mut self) -> Result<(), Infallible> {
        Ok(())
    }
}

const BOUND: Bound = Bound::Relative(1e-10);

#[test]
fn a_bound_below_round_off_counts_as_met_there_and_the_report_says_so() {
    let mut slender = Noisy::new(&[1.0, 1e-4, 3e-9, 2e-9], 5e-9);
    for (bound, expected) in [(BOUND, true), (Bound::Absolute(1e-10), true), (Bound::Relative(1e-8), false)] {
        let report = slender.run(Check::Before, bound, Limit::ToConvergence).unwrap();
        assert_eq!((report.iterations, report.at_round_off, report.entry_converged), (2, expected, false));
        assert!(report.converged && !report.stagnated);
    }
    let report = slender.run(Check::Lagged, BOUND, Limit::ToConvergence).unwrap();
    assert_eq!((report.iterations, report.at_round_off), (3, true), "one more, as lagged checks have it");
    let report = slender.run(Check::Before, BOUND, Limit::AtMost(1)).unwrap();
    assert!(!report.converged && !report.at_round_off);
}

#[test]
fn a_standstill_above_round_off_is_a_failure_and_says_how_far_above() {
    let failure =
        Noisy::new(&[1.0, 4e-9], 1e-10).run(Check::Before, BOUND, Limit::ToConvergence).unwrap_err();
    let Failure::Stagnated { round_offs, .. } = failure else { panic!("{failure}") };
    assert!((round_offs - 40.0).abs() < 1e-9);
    assert!(
        failure
            .to_string()
            .contains("(relative 4.000e-9), 40.0 times the round-off of its terms; the bound is 1e-10")
    );
}

#[test]
fn a_call_that_enters_with_noise_leaves_the_iterate_alone() {
    for check in [Check::Before, Check::Lagged] {
        // Below the bound, and below nothing but its own round-off.
        for residual in [1e-12, 1e-9] {
            let report = Noisy::new(&[residual, 1.0], 2e-9).run(check, BOUND, Limit::ToConvergence).unwrap();
            assert_eq!((report.iterations, report.solves, report.exit.absolute), (0, 0, residual));
            assert!(report.converged && report.entry_converged && report.at_round_off);
        }
    }
}

#[test]
fn uncertain_data_end_a_call_at_its_entry_only() {
    let mut problem = Noisy { uncertainty: 1e-8, ..Noisy::new(&[5e-9, 3e-11, 2e-11], 1e-15) };
    let report = problem.run(Check::Lagged, BOUND, Limit::ToConvergence).unwrap();
    assert!(report.iterations == 0 && report.converged && report.at_round_off);
    problem.residuals.insert(0, 1e-3);
    let report = problem.run(Check::Before, BOUND, Limit::ToConvergence).unwrap();
    assert_eq!((report.iterations, report.at_round_off), (2, false), "it goes on below the uncertainty");
}

#[test]
fn a_residual_of_zero_is_solved_as_ever() {
    let report = Noisy::new(&[0.0], 1e-9).run(Check::Lagged, BOUND, Limit::ToConvergence).unwrap();
    assert_eq!((report.iterations, report.converged, report.at_round_off), (1, true, false));
}

#[test]
fn large_residuals_are_never_taken_for_round_off_after_the_entry() {
    let mut problem = Noisy { uncertainty: 0.0, ..Noisy::new(&[1.0, 0.5, 0.3, 1e-11], 1e3) };
    assert_eq!(problem.run(Check::Before, BOUND, Limit::ToConvergence).unwrap().iterations, 3);
}
