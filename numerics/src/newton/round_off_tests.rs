//! Residuals at round-off.

#![allow(clippy::float_cmp, reason = "these values are exact")]

use std::convert::Infallible;

use super::*;

/// Residuals as written down, one per assembly, against the scale one, and the size of their noise.
struct Noisy {
    residuals: Vec<f64>,
    assemblies: usize,
    round_off: f64,
}

impl Noisy {
    fn new(residuals: &[f64], round_off: f64) -> Self {
        Self { residuals: residuals.to_vec(), assemblies: 0, round_off }
    }

    fn last(&self) -> f64 {
        self.residuals[(self.assemblies - 1).min(self.residuals.len() - 1)]
    }

    fn run(&mut self, check: Check, bound: Bound, limit: Limit) -> Result<Report, Failure<Infallible>> {
        self.assemblies = 0;
        solve(self, &Settings { bound, check, ..Settings::default() }, limit, |_, _| Verdict::Continue)
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
fn a_call_that_enters_at_round_off_costs_what_its_check_asks_for() {
    for (check, iterations) in [(Check::Before, 0), (Check::Lagged, 1)] {
        let report = Noisy::new(&[1e-9, 1e-9], 2e-9).run(check, BOUND, Limit::ToConvergence).unwrap();
        assert_eq!((report.iterations, report.entry_converged), (iterations, true));
        assert!(report.converged && report.at_round_off);
    }
}

#[test]
fn a_residual_of_zero_is_solved_as_ever() {
    let report = Noisy::new(&[0.0], 1e-9).run(Check::Lagged, BOUND, Limit::ToConvergence).unwrap();
    assert_eq!((report.iterations, report.converged, report.at_round_off), (1, true, false));
}

#[test]
fn large_residuals_are_never_taken_for_round_off() {
    let mut problem = Noisy::new(&[1.0, 0.5, 0.3, 1e-11], 1e3);
    assert_eq!(problem.run(Check::Before, BOUND, Limit::ToConvergence).unwrap().iterations, 3);
}
