//! The provided verbs, on a field of one unknown: y' = f - y^3 by implicit Euler.

use super::*;
use crate::newton::{ResidualNorm, ReusableFactor};

#[derive(Debug, PartialEq)]
enum CubicError {
    Mismatch(StateMismatch),
    Step,
    Negative,
}

impl From<StateMismatch> for CubicError {
    fn from(mismatch: StateMismatch) -> Self {
        Self::Mismatch(mismatch)
    }
}

struct Cubic {
    committed: f64,
    trial: [f64; 1],
    dt: f64,
    force: f64,
    residual: f64,
    tangent: [f64; 1],
    log: FactorLog,
    parts: [Part; 1],
    pattern: Pattern,
    settings: newton::Settings,
}

impl Cubic {
    fn new() -> Self {
        let dofs = crate::DofMap::new(&[false]);
        let pattern = Pattern::new(&dofs, &[&crate::Connectivity::new(1, vec![0])]);
        Self {
            committed: 1.0,
            trial: [1.0],
            dt: 0.0,
            force: 0.0,
            residual: 0.0,
            tangent: [0.0],
            log: FactorLog::default(),
            parts: [Part { name: "y", dofs: vec![0] }],
            pattern,
            settings: newton::Settings::default(),
        }
    }
}

impl Problem for Cubic {
    type Error = CubicError;

    fn assemble(&mut self, with_tangent: bool) -> Result<ResidualNorm, CubicError> {
        let [y] = self.trial;
        self.residual = (y - self.committed) / self.dt + y.powi(3) - self.force;
        if with_tangent {
            self.tangent = [1.0 / self.dt + 3.0 * y * y];
        }
        Ok(ResidualNorm::new(self.residual.abs(), 1.0 / self.dt))
    }

    fn solve_and_update(&mut self) -> Result<(), CubicError> {
        self.log.factored(self.coefficients());
        self.trial[0] -= self.residual / self.tangent[0];
        Ok(())
    }

    /// Where factors are reused, nothing takes a step back or drops the factor.
    fn reusable_factor(&self) -> ReusableFactor {
        if self.settings.reuse_factor.is_none() {
            return ReusableFactor::Missing;
        }
        self.log.worth(&self.coefficients(), false)
    }
}

impl Field for Cubic {
    type State = f64;
    const NAME: &'static str = "cubic";

    fn begin_step(&mut self, _: f64, dt: f64) -> Result<(), CubicError> {
        if dt <= 0.0 {
            return Err(CubicError::Step);
        }
        (self.dt, self.trial) = (dt, [self.committed]);
        Ok(())
    }
    fn impose(&mut self, input: &[f64]) -> Result<(), CubicError> {
        self.force = input[0];
        Ok(())
    }
    fn output(&self, output: &mut [f64]) {
        output.copy_from_slice(&self.trial);
    }
    fn verify(&mut self) -> Result<(), CubicError> {
        if self.trial[0] < 0.0 { Err(CubicError::Negative) } else { Ok(()) }
    }
    fn commit(&mut self) {
        self.committed = self.trial[0];
    }
    fn rewind(&mut self) {
        self.trial = [self.committed];
        self.log.forget();
    }
    fn state(&self) -> &f64 {
        &self.committed
    }
    fn restore(&mut self, state: &f64) -> Result<(), CubicError> {
        self.committed = *state;
        self.rewind();
        Ok(())
    }
    fn values(&self) -> &[f64] {
        &self.trial
    }
    fn parts(&self) -> &[Part] {
        &self.parts
    }
    fn resolution(&self, _: usize) -> f64 {
        0.0
    }
    fn largest_residual(&self) -> Option<LargestResidual> {
        None
    }
    fn newton_settings(&self) -> &newton::Settings {
        &self.settings
    }
    fn phases(&self) -> PhaseSeconds {
        PhaseSeconds::default()
    }
    fn work(&self) -> FieldWork {
        FieldWork::default()
    }
    fn is_linear(&self) -> bool {
        false
    }
    fn keeps_factor(&self) -> bool {
        true
    }
    fn coefficients(&self) -> Coefficients {
        [self.dt, 0.0, 0.0]
    }
    fn factor_log(&self) -> &FactorLog {
        &self.log
    }
    fn tangent(&self) -> (&Pattern, &[f64]) {
        (&self.pattern, &self.tangent)
    }
    fn factor_tangent(&mut self, values: &[f64], coefficients: Coefficients) -> Result<(), CubicError> {
        self.tangent.copy_from_slice(values);
        self.log.factored(coefficients);
        Ok(())
    }
}

#[test]
fn a_step_alone_is_solved_and_committed() {
    let mut cubic = Cubic::new();
    assert!(cubic.step_alone(0.1, 0.1).expect("a step").converged);
    let y = *cubic.state();
    assert!(((y - 1.0) / 0.1 + y.powi(3)).abs() < 1e-6 && y < 1.0, "{y}");
    assert_eq!(cubic.unknowns(), 1);
}

#[test]
fn a_step_alone_that_ends_in_an_impossible_state_or_cannot_begin_leaves_nothing() {
    let mut cubic = Cubic::new();
    cubic.impose(&[-1e3]).expect("a force");
    let negative = cubic.step_alone(0.1, 0.1).expect_err("y is negative");
    assert!(matches!(negative, Failure::Problem { iteration: 1.., source: CubicError::Negative }));
    let step = cubic.step_alone(0.1, 0.0).expect_err("no step");
    assert!(matches!(step, Failure::Problem { iteration: 0, source: CubicError::Step }));
    assert_eq!((*cubic.state(), cubic.values()), (1.0, &[1.0][..]));
    assert_eq!(cubic.reusable_tangent(), None, "a step that is given up leaves no factor");
}

#[test]
fn a_tangent_goes_from_one_solver_to_another_that_it_fits() {
    let mut cubic = Cubic::new();
    cubic.step_alone(0.1, 0.1).expect("a step");
    let tangent = cubic.reusable_tangent().expect("it was factored");
    let mut other = Cubic::new();
    other.restore_tangent(&tangent).expect("it fits");
    assert_eq!(other.reusable_tangent(), Some(tangent.clone()));
    let longer = ReusableTangent { values: vec![1.0; 2], ..tangent };
    let mismatch = StateMismatch { what: "entries of the kept tangent", found: 2, expected: 1 };
    assert_eq!(other.restore_tangent(&longer), Err(CubicError::Mismatch(mismatch)));
}

/// Without the rule that a factor is not tried again after its step was taken back, this test does not end.
#[test]
fn the_loop_ends_although_a_problem_never_drops_its_factor() {
    let mut cubic = Cubic::new();
    cubic.settings.reuse_factor = Some(0.5);
    cubic.impose(&[-1e3]).expect("a force");
    assert!(cubic.step_alone(0.1, 0.1).is_err(), "such a problem is not solved, but that is said");
    assert_eq!(cubic.values(), [1.0], "the step is given up");
}
