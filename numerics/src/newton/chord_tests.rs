//! Factors used more than once: chord Newton, and linear problems.

use super::*;
use crate::rates::fitted_order;
use crate::small;

/// The intersection of the circle x^2 + y^2 = radius^2 with the hyperbola x y = 1, or, linear, of x + 3 y = radius with
/// x - y = 1; it keeps the inverse of a tangent.
struct Curves {
    point: [f64; 2],
    radius: f64,
    is_linear: bool,
    residual: [f64; 2],
    tangent: [[f64; 2]; 2],
    inverse: [[f64; 2]; 2],
    log: FactorLog,
    /// Where the last step started.
    start: [f64; 2],
}

impl Curves {
    fn new(is_linear: bool) -> Self {
        let zero = [[0.0; 2]; 2];
        Self {
            point: [2.0, 0.3],
            radius: 2.0,
            is_linear,
            residual: [0.0; 2],
            tangent: zero,
            inverse: zero,
            log: FactorLog::default(),
            start: [0.0; 2],
        }
    }

    /// A call to convergence, and the residuals before and after its iterations.
    fn run(&mut self, reuse_factor: Option<f64>) -> (Report, Vec<[f64; 2]>) {
        let settings = Settings { reuse_factor, bound: Bound::Relative(1e-13), ..Settings::default() };
        let mut residuals = Vec::new();
        let report = solve(self, &settings, Limit::ToConvergence, |_, iteration| {
            residuals.push([iteration.before.absolute, iteration.after.absolute]);
            Verdict::Continue
        })
        .expect("it converges");
        (report, residuals)
    }
}

impl Problem for Curves {
    type Error = std::convert::Infallible;

    fn assemble(&mut self, with_tangent: bool) -> Result<ResidualNorm, Self::Error> {
        let [x, y] = self.point;
        (self.residual, self.tangent) = if self.is_linear {
            ([x + 3.0 * y - self.radius, x - y - 1.0], [[1.0, 3.0], [1.0, -1.0]])
        } else {
            ([x * x + y * y - self.radius * self.radius, x * y - 1.0], [[2.0 * x, 2.0 * y], [y, x]])
        };
        if with_tangent {
            self.log.forget();
        } else {
            self.tangent = [[f64::NAN; 2]; 2];
        }
        Ok(ResidualNorm::new(small::dot(&self.residual, &self.residual).sqrt(), self.radius * self.radius))
    }

    fn solve_and_update(&mut self) -> Result<(), Self::Error> {
        self.inverse = small::inverse(&self.tangent).expect("the tangent of this iterate").0;
        self.log.factored([0.0; 3]);
        self.solve_reusing_factor()
    }

    fn solve_reusing_factor(&mut self) -> Result<(), Self::Error> {
        self.start = self.point;
        let step = small::apply(&self.inverse, &self.residual);
        self.point = [self.point[0] - step[0], self.point[1] - step[1]];
        Ok(())
    }

    fn reusable_factor(&self) -> ReusableFactor {
        self.log.worth(&[0.0; 3], self.is_linear)
    }

    fn take_back(&mut self) {
        self.point = self.start;
    }

    fn drop_factor(&mut self) {
        self.log.forget();
    }
}

#[test]
fn a_chord_converges_linearly_to_the_same_point() {
    let (mut newton, mut chord) = (Curves::new(false), Curves::new(false));
    let (with_newton, _) = newton.run(None);
    assert_eq!(with_newton.factorizations, with_newton.iterations);
    let (report, residuals) = chord.run(Some(0.9));
    assert_eq!((report.factorizations, report.tangents), (1, 1));
    assert_eq!((report.solves, report.assemblies), (report.iterations, report.iterations + 1));
    assert!(report.iterations > with_newton.iterations);
    let distance: f64 = (0..2).map(|c| (chord.point[c] - newton.point[c]).abs()).sum();
    assert!(distance < 1e-12, "{distance:e}");
    let (before, after): (Vec<f64>, Vec<f64>) =
        residuals[1..].iter().filter(|pair| pair[1] > 1e-11).map(|pair| (pair[0], pair[1])).unzip();
    let order = fitted_order(&before, &after);
    assert!((0.95..1.05).contains(&order), "order {order} from {residuals:?}");
}

#[test]
fn a_factor_is_replaced_once_the_residual_falls_too_slowly() {
    let wanted = 0.05;
    let (report, residuals) = Curves::new(false).run(Some(wanted));
    let slow = |pair: &&[f64; 2]| pair[1] >= wanted * pair[0];
    let last = residuals.len() - 1;
    let replaced = residuals[..last].iter().filter(slow).count();
    assert!(replaced > 0 && replaced < last, "{residuals:?}");
    assert_eq!(report.factorizations, 1 + replaced, "{residuals:?}");
    assert_eq!(report.tangents, report.factorizations);
    // Where the factor is replaced, the tangent is assembled beside the residual that showed it.
    assert_eq!(report.assemblies, 1 + report.iterations + replaced);
}

#[test]
fn a_factor_serves_later_calls() {
    let mut problem = Curves::new(false);
    problem.run(Some(0.5));
    problem.radius = 2.01;
    let (report, _) = problem.run(Some(0.5));
    assert_eq!((report.factorizations, report.tangents), (0, 0));
    assert!(report.converged && report.iterations > 2);
    problem.drop_factor();
    problem.radius = 2.02;
    assert_eq!(problem.run(Some(0.5)).0.factorizations, 1);
}

#[test]
fn a_step_that_raises_the_residual_is_taken_back() {
    let (mut chord, mut newton) = (Curves::new(false), Curves::new(false));
    chord.run(Some(0.5));
    // At the other end of the hyperbola, where the factor leads astray.
    for problem in [&mut chord, &mut newton] {
        problem.point = [-0.2, -4.0];
        problem.radius = 5.0;
    }
    let (report, _) = chord.run(Some(1e-9));
    let (expected, _) = newton.run(None);
    // One solve in vain, its residual, and that of the return; then Newton's method.
    assert_eq!((report.iterations, report.factorizations), (expected.iterations, expected.factorizations));
    assert_eq!(report.solves, expected.solves + 1);
    assert_eq!(chord.point.map(f64::to_bits), newton.point.map(f64::to_bits));
    // A call of one iteration makes one all the same.
    chord.log.factored([0.0; 3]);
    chord.inverse = [[-3.0, 0.0], [0.0, -3.0]];
    chord.radius = 6.0;
    let settings = Settings { reuse_factor: Some(0.5), ..Settings::default() };
    let report = solve(&mut chord, &settings, Limit::AtMost(1), |_, _| Verdict::Continue).expect("a call");
    assert_eq!((report.iterations, report.solves, report.factorizations), (1, 2, 1));
    assert!(report.exit.absolute < report.entry.absolute);
}

#[test]
fn a_call_of_one_iteration_remembers_for_the_next_that_its_factor_was_slow() {
    let settings = Settings { reuse_factor: Some(0.01), ..Settings::default() };
    let mut problem = Curves::new(false);
    let mut call =
        || solve(&mut problem, &settings, Limit::AtMost(1), |_, _| Verdict::Continue).expect("a call");
    let reports: Vec<Report> = (0..4).map(|_| call()).collect();
    for pair in reports.windows(2) {
        let slow = pair[0].exit.relative >= 0.01 * pair[0].entry.relative;
        assert_eq!(pair[1].factorizations, usize::from(slow), "{pair:?}");
    }
    assert!(reports[1..].iter().any(|report| report.factorizations == 0), "{reports:?}");
}

#[test]
fn without_the_setting_a_reusable_factor_changes_nothing() {
    let (mut kept, mut forgotten) = (Curves::new(false), Curves::new(false));
    for radius in [2.0, 2.5, 3.0] {
        (kept.radius, forgotten.radius) = (radius, radius);
        forgotten.drop_factor();
        assert_eq!(kept.run(None), forgotten.run(None));
        assert_eq!(kept.point.map(f64::to_bits), forgotten.point.map(f64::to_bits));
    }
}

#[test]
fn a_linear_problem_is_factored_once() {
    let mut problem = Curves::new(true);
    let reports: Vec<Report> = [2.0, 3.0, 4.0]
        .into_iter()
        .map(|radius| {
            problem.radius = radius;
            problem.run(None).0
        })
        .collect();
    let counts = |report: &Report| [report.solves, report.assemblies, report.tangents, report.factorizations];
    assert_eq!(reports.iter().map(counts).collect::<Vec<_>>(), [[1, 2, 1, 1], [1, 2, 0, 0], [1, 2, 0, 0]]);
}

#[test]
fn a_factor_is_worth_what_its_coefficients_say() {
    let (now, other) = ([1.0, 0.0, 2.0], [1.5, 0.0, 2.0]);
    let mut log = FactorLog::default();
    assert_eq!(log.worth(&now, true), ReusableFactor::Missing);
    assert_eq!(log.tangent(&[1.0]), None);
    log.factored(now);
    assert_eq!(log.worth(&now, true), ReusableFactor::Exact);
    assert_eq!(log.worth(&now, false), ReusableFactor::Earlier);
    assert_eq!(log.worth(&other, true), ReusableFactor::Missing);
    assert_eq!(log.tangent(&[4.0]), Some(ReusableTangent { coefficients: now, values: vec![4.0] }));
    log.outdate();
    assert_eq!(log.worth(&now, true), ReusableFactor::Earlier);
    log.forget();
    assert_eq!(log.worth(&now, false), ReusableFactor::Missing);
}
