#![allow(clippy::float_cmp, reason = "these values are exact")]

use miette::Diagnostic;

use super::*;
use crate::rates::fitted_order;
use crate::small;

/// The first solve of a call fails here.
#[derive(Debug, Clone, PartialEq, thiserror::Error, Diagnostic)]
#[error("broken")]
#[diagnostic(help("mend it"))]
struct Broken;

/// Residuals as written down, one an assembly, against the scale one; a log of what the loop asked for.
struct Script {
    residuals: Vec<f64>,
    tangents: Vec<bool>,
    solves: usize,
    broken_at: Option<usize>,
}

impl Script {
    fn new(residuals: &[f64]) -> Self {
        Self { residuals: residuals.to_vec(), tangents: Vec::new(), solves: 0, broken_at: None }
    }

    fn run(&mut self, check: Check, limit: Limit) -> Result<Report, Failure<Broken>> {
        let settings = Settings { check, ..Settings::default() };
        solve(self, &settings, limit, |_, _| Verdict::Continue)
    }
}

impl Problem for Script {
    type Error = Broken;

    fn assemble(&mut self, with_tangent: bool) -> Result<ResidualNorm, Broken> {
        let next = self.tangents.len().min(self.residuals.len() - 1);
        self.tangents.push(with_tangent);
        Ok(ResidualNorm::new(self.residuals[next], 1.0))
    }

    fn solve_and_update(&mut self) -> Result<(), Broken> {
        assert_eq!(self.tangents.last(), Some(&true), "a solve needs the tangent of its iterate");
        self.solves += 1;
        if self.broken_at == Some(self.solves) { Err(Broken) } else { Ok(()) }
    }
}

/// The intersection of the circle x^2 + y^2 = radius^2 with the hyperbola x y = 1.
struct Curves {
    point: [f64; 2],
    radius: f64,
    tangent: Option<[[f64; 2]; 2]>,
    residual: [f64; 2],
}

impl Curves {
    fn new(radius: f64) -> Self {
        Self { point: [2.0, 0.3], radius, tangent: None, residual: [0.0; 2] }
    }
}

impl Problem for Curves {
    type Error = Broken;

    fn assemble(&mut self, with_tangent: bool) -> Result<ResidualNorm, Broken> {
        let [x, y] = self.point;
        self.residual = [x * x + y * y - self.radius * self.radius, x * y - 1.0];
        self.tangent = with_tangent.then_some([[2.0 * x, 2.0 * y], [y, x]]);
        Ok(ResidualNorm::new(small::dot(&self.residual, &self.residual).sqrt(), self.radius * self.radius))
    }

    fn solve_and_update(&mut self) -> Result<(), Broken> {
        let (inverse, _) = self.tangent.and_then(|tangent| small::inverse(&tangent)).ok_or(Broken)?;
        let step = small::apply(&inverse, &self.residual);
        self.point = [self.point[0] - step[0], self.point[1] - step[1]];
        Ok(())
    }
}

fn run(problem: &mut Curves, limit: Limit) -> Report {
    solve(problem, &Settings::default(), limit, |_, _| Verdict::Continue).unwrap()
}

#[test]
fn convergence_is_quadratic() {
    let mut residuals = Vec::new();
    let mut problem = Curves::new(2.0);
    let settings = Settings { bound: Bound::Relative(1e-13), ..Settings::default() };
    let report = solve(&mut problem, &settings, Limit::ToConvergence, |_, iteration| {
        residuals.push((iteration.before.absolute, iteration.after.absolute));
        Verdict::Continue
    })
    .unwrap();
    assert!(report.converged && !report.stagnated && !report.stopped_by_callback);
    // x^2 and y^2 are 2 + sqrt(3) and 2 - sqrt(3).
    assert!((problem.point[0] - (2.0 + 3_f64.sqrt()).sqrt()).abs() < 1e-14);
    let (before, after): (Vec<f64>, Vec<f64>) =
        residuals.iter().filter(|(before, after)| *before < 0.5 && *after > 1e-12).copied().unzip();
    let order = fitted_order(&before, &after);
    assert!((1.9..2.2).contains(&order), "order {order} from {residuals:?}");
}

#[test]
fn report_counts_every_piece_of_work() {
    let report = run(&mut Curves::new(2.0), Limit::ToConvergence);
    assert_eq!(report.iterations, 4);
    assert_eq!((report.factorizations, report.solves), (4, 4));
    assert_eq!((report.assemblies, report.tangents), (5, 5));
    let limited = run(&mut Curves::new(2.0), Limit::AtMost(2));
    assert_eq!((limited.assemblies, limited.tangents, limited.factorizations), (3, 2, 2));
}

#[test]
fn converged_entry_costs_nothing_when_checked_before() {
    for limit in [Limit::ToConvergence, Limit::AtMost(3), Limit::AtMost(0)] {
        let mut problem = Script::new(&[1e-11]);
        let report = problem.run(Check::Before, limit).unwrap();
        assert!(report.converged);
        assert_eq!((report.iterations, report.assemblies, problem.solves), (0, 1, 0));
        assert_eq!(report.entry, report.exit);
    }
}

#[test]
fn converged_entry_costs_one_iteration_when_the_check_lags() {
    for limit in [Limit::ToConvergence, Limit::AtMost(1)] {
        let mut problem = Script::new(&[1e-11, 1e-12]);
        let report = problem.run(Check::Lagged, limit).unwrap();
        assert!(report.converged);
        assert_eq!((report.iterations, report.assemblies, problem.solves), (1, 2, 1));
        assert_eq!(report.exit.absolute, 1e-12);
    }
}

#[test]
fn lagged_check_costs_one_iteration_more_than_needed() {
    let residuals = [1.0, 1e-2, 1e-5, 1e-11, 1e-15];
    let before = Script::new(&residuals).run(Check::Before, Limit::ToConvergence).unwrap();
    let lagged = Script::new(&residuals).run(Check::Lagged, Limit::ToConvergence).unwrap();
    assert_eq!((before.iterations, before.exit.absolute), (3, 1e-11));
    assert_eq!((lagged.iterations, lagged.exit.absolute), (4, 1e-15));
}

#[test]
fn limit_reached_is_not_an_error_and_not_convergence() {
    let residuals = [1.0, 0.1, 0.01, 1e-11];
    for check in [Check::Before, Check::Lagged] {
        for limit in 0..3 {
            let report = Script::new(&residuals).run(check, Limit::AtMost(limit)).unwrap();
            assert_eq!(report.iterations, limit);
            assert_eq!(report.assemblies, limit + 1);
            assert!(!report.converged);
        }
    }
    // The third iteration meets the bound; a lagging check cannot know yet.
    assert!(Script::new(&residuals).run(Check::Before, Limit::AtMost(3)).unwrap().converged);
    assert!(!Script::new(&residuals).run(Check::Lagged, Limit::AtMost(3)).unwrap().converged);
}

#[test]
fn limits_may_exceed_the_iterations_of_a_run_to_convergence() {
    let slow: Vec<f64> = (0..80).map(|i| 0.9_f64.powi(i)).collect();
    assert_eq!(Script::new(&slow).run(Check::Before, Limit::AtMost(70)).unwrap().iterations, 70);
}

#[test]
fn run_to_convergence_fails_after_too_many_iterations() {
    let slow: Vec<f64> = (0..80).map(|i| 0.9_f64.powi(i)).collect();
    for check in [Check::Before, Check::Lagged] {
        let failure = Script::new(&slow).run(check, Limit::ToConvergence).unwrap_err();
        let Failure::TooManyIterations { iterations, entry, residual, bound } = failure else {
            panic!("{failure:?}")
        };
        assert_eq!((iterations, entry.absolute, residual.absolute), (50, 1.0, slow[50]));
        assert_eq!(bound, Bound::Relative(1e-10));
    }
}

#[test]
fn tangent_is_assembled_only_where_an_iteration_can_follow() {
    let tangents = |check, limit, residuals: &[f64]| {
        let mut problem = Script::new(residuals);
        problem.run(check, limit).unwrap();
        problem.tangents
    };
    let residuals = [1.0, 0.1, 1e-11, 1e-12, 1e-13];
    assert_eq!(tangents(Check::Before, Limit::AtMost(0), &residuals), [false]);
    assert_eq!(tangents(Check::Before, Limit::AtMost(1), &residuals), [true, false]);
    assert_eq!(tangents(Check::Lagged, Limit::AtMost(2), &residuals), [true, true, false]);
    // Only the residual tells that the loop ends here.
    assert_eq!(tangents(Check::Before, Limit::ToConvergence, &residuals), [true, true, true]);
    // The residual from before the third solve has told already.
    assert_eq!(tangents(Check::Lagged, Limit::ToConvergence, &residuals), [true, true, true, false]);
}

#[test]
fn residual_that_is_not_finite_is_always_an_error() {
    for limit in [Limit::AtMost(1), Limit::ToConvergence] {
        for broken in [f64::NAN, f64::INFINITY] {
            for (iteration, residuals) in [(0, vec![broken]), (1, vec![1.0, broken])] {
                let failure = Script::new(&residuals).run(Check::Before, limit).unwrap_err();
                assert!(matches!(failure, Failure::NotFinite { iteration: at, .. } if at == iteration));
            }
        }
    }
}

#[test]
fn exploding_residual_is_always_an_error() {
    for (limit, check) in [(Limit::AtMost(1), Check::Before), (Limit::ToConvergence, Check::Lagged)] {
        let failure = Script::new(&[1e-3, 2e10]).run(check, limit).unwrap_err();
        assert!(
            matches!(failure, Failure::Diverged { iteration: 1, residual, .. } if residual.absolute == 2e10)
        );
    }
    // Growth far above a tiny entry residual, but not above the scale of the terms, is no explosion.
    let report = Script::new(&[1e-9, 1e3, 1e-11]).run(Check::Before, Limit::ToConvergence).unwrap();
    assert_eq!(report.iterations, 2);
}

#[test]
fn growth_from_an_exactly_zero_entry_is_measured_from_the_first_residual() {
    let lagged = |residuals: &[f64]| Script::new(residuals).run(Check::Lagged, Limit::AtMost(2));
    assert!(lagged(&[0.0, 1e-14]).unwrap().converged);
    let report = Script::new(&[0.0]).run(Check::Before, Limit::ToConvergence).unwrap();
    assert_eq!((report.iterations, report.converged), (0, true));
}

#[test]
fn standstill_at_the_round_off_of_a_stiff_problem_must_last() {
    let hovering = |k: usize| if k.is_multiple_of(2) { 2e-7 } else { 3e-7 };
    let residuals: Vec<f64> = [1.0, 1e-3].into_iter().chain((0..30).map(hovering)).collect();
    let failure = Script::new(&residuals).run(Check::Before, Limit::ToConvergence).unwrap_err();
    assert!(matches!(failure, Failure::Stagnated { iteration: 12, .. }), "{failure}");
    let hard: Vec<f64> = residuals.iter().map(|r| 1e3 * r).collect();
    let failure = Script::new(&hard).run(Check::Before, Limit::ToConvergence).unwrap_err();
    assert!(matches!(failure, Failure::TooManyIterations { .. }), "far above round-off: {failure}");
    let slow: Vec<f64> = (0..60).map(|k| 9e-6 * 0.98_f64.powi(k)).collect();
    let failure = Script::new(&slow).run(Check::Before, Limit::ToConvergence).unwrap_err();
    assert!(matches!(failure, Failure::TooManyIterations { .. }), "it falls: {failure}");
}

#[test]
fn standstill_at_round_off_is_an_error_or_a_flag() {
    let floor = [1.0, 1e-5, 3e-10, 2.9e-10, 3.1e-10, 2.8e-10, 3e-10];
    let failure = Script::new(&floor).run(Check::Before, Limit::ToConvergence).unwrap_err();
    assert!(
        matches!(failure, Failure::Stagnated { iteration: 5, residual, .. } if residual.absolute == 2.8e-10)
    );
    let report = Script::new(&floor).run(Check::Before, Limit::AtMost(6)).unwrap();
    assert!(report.stagnated && !report.converged && report.iterations == 6);
    let report = Script::new(&floor).run(Check::Before, Limit::AtMost(4)).unwrap();
    assert!(!report.stagnated);
}

#[test]
fn slow_or_high_residuals_are_not_taken_for_round_off() {
    let slow: Vec<f64> = (0..100).map(|i| 1e-9 * 0.95_f64.powi(i)).collect();
    assert!(Script::new(&slow).run(Check::Before, Limit::ToConvergence).unwrap().converged);
    // A plateau far above round-off may still end.
    let plateau = [1e-2, 1e-2, 1e-2, 1e-2, 1e-2, 1e-2, 1e-11];
    assert_eq!(Script::new(&plateau).run(Check::Before, Limit::ToConvergence).unwrap().iterations, 6);
    // Standing still is no failure where the bound is met, now or before the last solve.
    let met = [1.01e-10, 1.01e-10, 1.01e-10, 0.99e-10, 1.02e-10];
    let report = Script::new(&met).run(Check::Lagged, Limit::ToConvergence).unwrap();
    assert!(report.converged && !report.stagnated);
}

#[test]
fn callback_sees_every_iteration_and_its_residuals() {
    let residuals = [1.0, 0.1, 1e-11, 1e-12];
    for (check, iterations) in [(Check::Before, 2), (Check::Lagged, 3)] {
        let mut seen = Vec::new();
        let settings = Settings { check, ..Settings::default() };
        solve(&mut Script::new(&residuals), &settings, Limit::ToConvergence, |problem, iteration| {
            assert_eq!(problem.tangents.len(), iteration.index + 1);
            seen.push((iteration.index, iteration.before.absolute, iteration.after.absolute));
            Verdict::Continue
        })
        .unwrap();
        let expected: Vec<_> = (1..=iterations).map(|i| (i, residuals[i - 1], residuals[i])).collect();
        assert_eq!(seen, expected);
    }
}

#[test]
fn callback_stops_the_loop_without_an_error() {
    let stop_at = |at| {
        solve(
            &mut Script::new(&[1.0, 0.1, 1e-11]),
            &Settings::default(),
            Limit::ToConvergence,
            |_, iteration| {
                if iteration.index == at { Verdict::Stop } else { Verdict::Continue }
            },
        )
        .unwrap()
    };
    let early = stop_at(1);
    assert!(early.stopped_by_callback && !early.converged);
    assert_eq!((early.iterations, early.exit.absolute), (1, 0.1));
    let late = stop_at(2);
    assert!(late.stopped_by_callback && late.converged);
}

#[test]
fn entry_residual_is_evaluated_afresh_in_every_call() {
    let mut problem = Curves::new(2.0);
    assert!(run(&mut problem, Limit::ToConvergence).converged);
    // New input: what converged before does not any more.
    problem.radius = 3.0;
    let report = run(&mut problem, Limit::AtMost(1));
    assert!((report.entry.absolute - 5.0).abs() < 1e-9);
    assert!(report.iterations == 1 && !report.converged);
    // The next call goes on from the latest iterate.
    let exit = report.exit;
    let report = run(&mut problem, Limit::ToConvergence);
    assert_eq!(report.entry, exit);
    assert!(report.converged);
}

#[test]
fn failures_of_the_problem_name_their_iteration() {
    let mut problem = Script { broken_at: Some(2), ..Script::new(&[1.0, 0.1]) };
    let failure = problem.run(Check::Before, Limit::ToConvergence).unwrap_err();
    assert_eq!(failure, Failure::Problem { iteration: 2, source: Broken });
    assert_eq!(std::error::Error::source(&failure).unwrap().to_string(), "broken");
    assert_eq!(failure.help().unwrap().to_string(), "mend it");
}

#[test]
fn a_failure_has_a_remedy() {
    let lost = Script::new(&[1.0, 4.0, f64::NAN]).run(Check::Before, Limit::ToConvergence).unwrap_err();
    assert_eq!(
        lost.to_string(),
        "Newton iteration 2: the residual is not finite: NaN (relative NaN), \
         from 1.000e0 (relative 1.000e0) at the entry and 4.000e0 (relative 4.000e0) before"
    );
    assert_eq!(lost.help().unwrap().to_string(), "check the input of this call, or take a smaller time step");
    let residual = ResidualNorm::new(3.0, 12.0);
    let failure: Failure<Broken> =
        Failure::Stagnated { iteration: 7, residual, bound: Bound::Relative(1e-10), round_offs: 40.0 };
    assert_eq!(
        failure.to_string(),
        "Newton iteration 7: the residual stands still at 3.000e0 (relative 2.500e-1), \
         40.0 times the round-off of its terms; \
         the bound is 1e-10 (relative)"
    );
    assert_eq!(
        failure.help().unwrap().to_string(),
        "the tangent may be nearly singular, or the bound may ask for more than the arithmetic can give"
    );
}
