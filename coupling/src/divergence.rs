//! When the iterations of a step have gone astray for good.
//!
//! The indicator is the norm of the interface residual, `|r_k|`, against those the step began with. Three things are
//! normal and must not count:
//!
//! * the first iterations overshoot: they set the scale, [`FIRST`] of them;
//! * one bad quasi-Newton update is mended by the next: [`LAST`] iterations have to agree, unless one explodes;
//! * near the solution `r` is round-off, and round-off may grow by any factor: an iteration that has gone astray still
//!   moves the interface, `|r| >` [`MOVING`] `|x_tilde|`.
//!
//! A relaxation too large for the added mass multiplies `r` by some factor an iteration: one of 8 is noticed within a
//! dozen iterations, one of 2 within twenty. One below 1.07 is noticed at the iteration bound.

use crate::record::StepHistory;

/// Iterations at the beginning of a step whose largest residual is the scale of all later ones.
pub const FIRST: usize = 3;
/// Iterations at the end that all have to be far above that scale.
pub const LAST: usize = 5;
/// Least `|r| / |x_tilde|` of an iteration that has gone astray.
pub const MOVING: f64 = 0.1;
/// The step has diverged once the last iterations all lie this factor above the first ones,
pub const SUSTAINED: f64 = 1e3;
/// or one of them this factor,
pub const EXPLODED: f64 = 1e6;
/// or, at the iteration bound, all of the last ones this factor.
pub const AT_BOUND: f64 = 10.0;
/// A residual that fell by less than a tenth in so many iterations is not on its way to zero.
pub const STANDSTILL: usize = 10;
/// Where a field gives up, a residual that has grown by this factor shows that the iteration is to blame.
pub const SUSPICIOUS: f64 = 2.0;

/// How the interface residual grew within a step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Growth {
    /// The iteration of the smallest residual that is not zero, counted from 1.
    pub since: usize,
    /// `|r|` there \[m\].
    pub from: f64,
    /// The last iteration.
    pub at: usize,
    /// `|r|` there \[m\].
    pub to: f64,
}

/// The growth of a step that has diverged; nothing where there is hope. `at_bound` says that no iteration will follow.
pub(crate) fn diverged(history: &StepHistory, at_bound: bool) -> Option<Growth> {
    let residuals: Vec<f64> = residuals(history).collect();
    if residuals.len() < FIRST + 1 || !still_moves(history) {
        return None;
    }
    let scale = residuals[..FIRST].iter().copied().fold(0.0, f64::max);
    let latest = residuals[residuals.len() - 1];
    let later = &residuals[FIRST..];
    let all_of_the_last =
        later[later.len().saturating_sub(LAST)..].iter().copied().fold(f64::INFINITY, f64::min);
    let sustained = if at_bound { AT_BOUND } else { SUSTAINED };
    let astray = latest > EXPLODED * scale || (later.len() >= LAST && all_of_the_last > sustained * scale);
    if astray { growth(history) } else { None }
}

/// The growth of a step in which a field gave up, where it is large enough to be the reason.
pub(crate) fn suspected(history: &StepHistory) -> Option<Growth> {
    growth(history).filter(|growth| growth.to > SUSPICIOUS * growth.from && still_moves(history))
}

/// From the smallest residual to the last one. Residuals of zero, of a field that saw nothing to do, do not count.
pub(crate) fn growth(history: &StepHistory) -> Option<Growth> {
    let (at, to) = (history.iterations.len(), history.last()?.residual);
    let numbered = history.iterations.iter().map(|iteration| (iteration.iteration, iteration.residual));
    let (since, from) = numbered.filter(|(_, r)| *r > 0.0).min_by(|a, b| a.1.total_cmp(&b.1))?;
    Some(Growth { since, from, at, to })
}

/// The iteration of the smallest residual before the last [`STANDSTILL`] iterations, where these did not get below it to
/// speak of.
pub(crate) fn stands_since(history: &StepHistory) -> Option<usize> {
    let (before, lately) =
        history.iterations.split_at_checked(history.iterations.len().checked_sub(STANDSTILL)?)?;
    let smallest = before.iter().min_by(|a, b| a.residual.total_cmp(&b.residual))?;
    let falls = lately.iter().any(|iteration| iteration.residual < 0.9 * smallest.residual);
    (!falls).then_some(smallest.iteration)
}

fn still_moves(history: &StepHistory) -> bool {
    history.last().is_some_and(|last| last.relative_residual > MOVING)
}

/// From the first one on that is not zero.
fn residuals(history: &StepHistory) -> impl Iterator<Item = f64> {
    history.iterations.iter().map(|iteration| iteration.residual).skip_while(|r| *r == 0.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::record::samples;

    /// A step with these residuals, each 0.5 of the displacement.
    fn step(residuals: impl IntoIterator<Item = f64>) -> StepHistory {
        let sample = samples::history([1.0, 1.0], false, true);
        let mut history = StepHistory::new(sample.step);
        for (index, residual) in residuals.into_iter().enumerate() {
            let mut record = sample.iterations[0].clone();
            (record.iteration, record.residual, record.relative_residual) = (index + 1, residual, 0.5);
            history.iterations.push(record);
        }
        history
    }

    /// The iteration at which a residual that grows by `factor` an iteration is given up.
    fn noticed(factor: f64) -> usize {
        let found = (1..1000)
            .find(|&k| diverged(&step((0..k).map(|i| 1e-5 * factor.powf(i as f64))), false).is_some());
        found.expect("a residual that grows is noticed")
    }

    #[test]
    fn a_growing_residual_is_noticed_soon() {
        assert_eq!([8.0, 2.0, 1.3].map(noticed), [10, 17, 34]);
        let growth = diverged(&step((0..10).map(|i| 10_f64.powi(i))), false).expect("it diverges");
        assert_eq!(growth, Growth { since: 1, from: 1.0, at: 10, to: 1e9 });
    }

    #[test]
    fn overshoot_and_a_single_bad_update_are_no_divergence() {
        let overshoot = [1e-3, 5e-2, 8.0, 70.0, 6.0, 0.5, 1e-2];
        let bad_update = [1e-3, 1e-4, 1e-5, 1e-6, 10.0, 1e-4, 1e-6];
        let creeping = (0..100).map(|k| 1.07_f64.powi(k));
        for residuals in [overshoot.to_vec(), bad_update.to_vec(), creeping.collect(), vec![1.0; 100]] {
            for k in 0..=residuals.len() {
                assert_eq!(
                    diverged(&step(residuals[..k].iter().copied()), false),
                    None,
                    "{residuals:?} up to {k}"
                );
            }
        }
    }

    #[test]
    fn growth_of_round_off_is_no_divergence() {
        let mut history = step([1e-18, 1e-18, 1e-18, 1e-9]);
        assert!(diverged(&history, false).is_some());
        history.iterations[3].relative_residual = 1e-9;
        assert_eq!(diverged(&history, false), None);
        assert_eq!(diverged(&step([0.0, 0.0, 0.0, 0.0, 1e-9, 1e-9]), false), None, "zeros set no scale");
    }

    #[test]
    fn a_standstill_is_dated_from_the_smallest_residual() {
        let stuck = [1.0, 0.5, 0.1].into_iter().chain((0..12).map(|k| 0.2 - 0.001 * f64::from(k)));
        assert_eq!(stands_since(&step(stuck)), Some(3));
        assert_eq!(stands_since(&step((0..30).map(|k| 0.95_f64.powi(k)))), None, "slow, but on its way");
        assert_eq!(stands_since(&step([1.0; 10])), None, "too early to tell");
    }

    #[test]
    fn the_bound_ends_what_only_creeps() {
        let creeping = step((0..100).map(|k| 1.05_f64.powi(k)));
        assert_eq!(diverged(&creeping, false), None);
        assert!(diverged(&creeping, true).is_some());
        let two_calls_a_step = step([1.0, 50.0]);
        assert_eq!(diverged(&two_calls_a_step, true), None);
    }
}
