//! The contract of an accelerator.

use super::{Violation, expect, scattered};
use crate::accelerate::{Accelerator, Answer};
use crate::vector::{dot, norm};

/// Relative residual at which a step of the test problem is done.
const DONE: f64 = 1e-10;
/// Iterations any method may take for it.
const MAX_ITERATIONS: usize = 1000;

/// Checks that an accelerator solves a mild linear problem over several steps, stands still at a zero
/// residual, forgets a failed step, and continues from its saved state bit for bit.
///
/// `build` makes the accelerator under test, for `size` unknowns. The problem is `x_tilde = A x + c` with a
/// symmetric `A` whose eigenvalues lie between -0.9 and 0, so that relaxation by factors up to 1 converges.
///
/// # Errors
/// The first violation.
pub fn check_accelerator(
    name: &str,
    size: usize,
    build: &dyn Fn() -> Box<dyn Accelerator>,
) -> Result<(), Violation> {
    stands_still_at_zero(name, size, build().as_mut())?;
    let problem = Problem::new(size);
    let mut accelerator = build();
    for step in 1..=3 {
        forgets_a_failed_step(name, &problem, accelerator.as_mut(), step)?;
        continues_from_its_state(name, &problem, accelerator.as_mut(), build().as_mut(), step)?;
        problem.solve(name, accelerator.as_mut(), step)?;
    }
    accelerator.step_converged(&vec![0.0; size], &vec![0.0; size], Answer::default());
    problem.solve(name, accelerator.as_mut(), 4)?;
    Ok(())
}

/// A rank-one perturbed diagonal problem.
struct Problem {
    diagonal: Vec<f64>,
    direction: Vec<f64>,
}

impl Problem {
    fn new(size: usize) -> Self {
        let mut direction = scattered(size, 3);
        let length = norm(&direction);
        for value in &mut direction {
            *value /= length;
        }
        Self { diagonal: scattered(size, 4).iter().map(|value| -0.2 * value.abs()).collect(), direction }
    }

    /// `r = A x + c - x` with the load `c` of `step`.
    fn residual(&self, x: &[f64], step: u32) -> Vec<f64> {
        let projection = dot(&self.direction, x);
        let load = scattered(x.len(), 10);
        (0..x.len())
            .map(|i| {
                let load = load[i] * (1.0 + 0.1 * f64::from(step * (1 + u32::from(i % 2 == 0))));
                self.diagonal[i] * x[i] - 0.7 * self.direction[i] * projection + load - x[i]
            })
            .collect()
    }

    /// The iterates of a step, which ends converged.
    fn solve(
        &self,
        name: &str,
        accelerator: &mut dyn Accelerator,
        step: u32,
    ) -> Result<Vec<Vec<f64>>, Violation> {
        let (x, r, iterates) = self.iterate(accelerator, step, MAX_ITERATIONS);
        let size = norm(&r) / norm(&self.residual(&vec![0.0; x.len()], step));
        expect(name, size < DONE, || {
            format!("step {step} is not solved after {MAX_ITERATIONS} iterations: relative residual {size:e}")
        })?;
        accelerator.step_converged(&x, &r, Answer::default());
        Ok(iterates)
    }

    fn iterate(
        &self,
        accelerator: &mut dyn Accelerator,
        step: u32,
        iterations: usize,
    ) -> (Vec<f64>, Vec<f64>, Vec<Vec<f64>>) {
        let mut x = vec![0.0; self.diagonal.len()];
        let mut r = self.residual(&x, step);
        let target = DONE * norm(&r);
        let mut iterates = vec![x.clone()];
        while iterates.len() < iterations && norm(&r) >= target {
            accelerator.propose(&mut x, &r, Answer::default());
            r = self.residual(&x, step);
            iterates.push(x.clone());
        }
        (x, r, iterates)
    }
}

fn stands_still_at_zero(name: &str, size: usize, accelerator: &mut dyn Accelerator) -> Result<(), Violation> {
    let mut x = vec![0.0; size];
    let zero = x.clone();
    for _ in 0..2 {
        for _ in 0..3 {
            accelerator.propose(&mut x, &zero, Answer::default());
            expect(name, x == zero, || "a zero residual at zero does not stay there".to_owned())?;
        }
        accelerator.step_converged(&x, &zero, Answer::default());
    }
    Ok(())
}

fn forgets_a_failed_step(
    name: &str,
    problem: &Problem,
    accelerator: &mut dyn Accelerator,
    step: u32,
) -> Result<(), Violation> {
    let before = accelerator.save();
    let (_, _, first) = problem.iterate(accelerator, step, 6);
    accelerator.step_failed();
    expect(name, accelerator.save() == before, || {
        format!("a failed attempt at step {step} changes the state")
    })?;
    let (_, _, second) = problem.iterate(accelerator, step, 6);
    accelerator.step_failed();
    expect(name, first == second, || format!("a second attempt at step {step} differs from the first"))
}

fn continues_from_its_state(
    name: &str,
    problem: &Problem,
    accelerator: &mut dyn Accelerator,
    twin: &mut dyn Accelerator,
    step: u32,
) -> Result<(), Violation> {
    let restored = twin.restore(&accelerator.save());
    expect(name, restored.is_ok(), || format!("it refuses its own state before step {step}: {restored:?}"))?;
    let (_, _, original) = problem.iterate(accelerator, step, MAX_ITERATIONS);
    accelerator.step_failed();
    let resumed = problem.solve(name, twin, step)?;
    expect(name, original == resumed, || format!("step {step} after a restart differs from the original"))
}
