//! Whether an enclosed fluid keeps its volume at the times of the scene.

use partita_fluid::{FluidError, FluidSolver};

use partita_scene::schema::Time;

/// Steps at the start that are looked at one by one, and those after them.
const FIRST: usize = 3;
const SAMPLES: usize = 40;

/// Looks at what is prescribed in the first steps, the last one and some between.
///
/// # Errors
/// What the run would stop at, of the first of these steps that it could not make.
pub(super) fn check(fluid: &FluidSolver<2>, time: &Time) -> Result<(), FluidError> {
    if !fluid.is_closed() {
        return Ok(());
    }
    let dt = time.step.get();
    steps(time.steps.get()).into_iter().try_for_each(|step| fluid.check_prescribed(end_of(step, dt), dt))
}

/// The time at the end of a step \[s\], to twelve digits: 6 times 0.1 is 0.6.
fn end_of(step: usize, dt: f64) -> f64 {
    let time = step as f64 * dt;
    format!("{time:.11e}").parse().unwrap_or(time)
}

/// The steps that are looked at, counted from 1, rising.
fn steps(last: usize) -> Vec<usize> {
    let between = (1..=SAMPLES).map(|sample| FIRST + (last.saturating_sub(FIRST)) * sample / SAMPLES);
    let mut steps: Vec<usize> = (1..=FIRST).chain(between).map(|step| step.min(last)).collect();
    steps.dedup();
    steps
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn first_steps_and_the_last_one_are_among_those_looked_at() {
        assert_eq!(steps(1), [1]);
        assert_eq!(steps(2), [1, 2]);
        assert_eq!(steps(20), (1..=20).collect::<Vec<_>>());
        let many = steps(100_000);
        assert!(
            many.starts_with(&[1, 2, 3]) && many.last() == Some(&100_000) && many.len() == FIRST + SAMPLES
        );
        assert!(many.is_sorted());
        assert_eq!(
            [(6, 0.1), (51, 0.1), (3, 1e-9)].map(|(step, dt)| end_of(step, dt).to_string()),
            ["0.6", "5.1", "0.000000003"]
        );
    }
}
