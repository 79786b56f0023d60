//! Steps that fail are given up and repeated with half the size.
//!
//! A run has a grid of times `n dt` that it reaches in any case. A step that fails is repeated with half its size, down
//! to `dt / 2^halvings`. A size is doubled again, up to `dt`, as soon as a step of the double size would end on the grid
//! of that size, so that
//!
//! ```text
//! a step that fails in its first half:    dt/2  dt/2 | dt
//! one whose second half fails, too:       dt/2  dt/4 dt/4 | dt/2 dt/2 | dt
//! ```
//!
//! and **no step is more than twice as long as the one before**. That matters to the two-step backward differences, which
//! are stable for steps that grow by factors below `1 + sqrt(2)` (Hairer, Norsett, Wanner, *Solving Ordinary Differential
//! Equations I*, section III.5). Where the run stands follows from its clock alone: a checkpoint need not know of it.

use crate::clock::Clock;
use crate::error::StepError;
use crate::march::March;
use crate::observe::Observer;
use crate::participant::Participant;
use crate::record::{RetryRecord, StepRecord};

/// The sizes that the steps of a run may have: `dt / 2^k`, `k = 0 ... halvings`. The grid starts at t = 0.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StepSizes {
    dt: f64,
    halvings: u32,
}

impl StepSizes {
    /// Most halvings that can be allowed.
    pub const MOST: u32 = 16;

    /// Steps of size `dt` \[s\], in emergencies halved up to `halvings` times; 0 halves none.
    ///
    /// # Panics
    /// When `dt` is not positive, or `halvings` lies above [`MOST`](Self::MOST).
    #[must_use]
    pub fn new(dt: f64, halvings: u32) -> Self {
        assert!(dt > 0.0 && dt.is_finite(), "step size {dt} s is not positive");
        assert!(halvings <= Self::MOST, "{halvings} halvings are more than {}", Self::MOST);
        Self { dt, halvings }
    }

    /// Whole steps of the grid that lie behind the clock.
    ///
    /// # Panics
    /// When a `usize` does not hold so many.
    #[must_use]
    pub fn done(&self, clock: &Clock) -> usize {
        if self.halvings == 0 {
            return clock.steps;
        }
        usize::try_from(self.parts(clock.time) >> self.halvings)
            .expect("a run has no more steps than a usize")
    }

    /// Whether the clock stands at a time of the grid.
    #[must_use]
    pub fn on_grid(&self, clock: &Clock) -> bool {
        self.parts(clock.time).is_multiple_of(self.parts(self.dt)) || self.halvings == 0
    }

    /// Size of the step to try next \[s\].
    #[must_use]
    pub fn next(&self, clock: &Clock) -> f64 {
        if self.halvings == 0 || clock.steps == 0 {
            return self.dt;
        }
        let double = 2.0 * clock.dt;
        let fits = double <= self.dt && self.parts(clock.time).is_multiple_of(self.parts(double));
        if fits { double } else { clock.dt }
    }

    /// Half of `size` \[s\], where that is allowed.
    #[must_use]
    pub fn half(&self, size: f64) -> Option<f64> {
        (self.parts(size) > 1).then_some(0.5 * size)
    }

    /// A time or a size in parts of the smallest step. Times gather round-off, but a part is far above it.
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "counts of steps")]
    fn parts(&self, time: f64) -> u64 {
        let smallest = self.dt / f64::from(1_u32 << self.halvings);
        (time / smallest).round() as u64
    }
}

/// The record of a step that failed with `error` and is tried again with steps of `next_dt` \[s\].
fn record(error: &StepError, next_dt: f64) -> RetryRecord {
    RetryRecord {
        step: error.step.index,
        time: error.step.time,
        dt: error.step.dt,
        next_dt,
        iteration: error.iteration,
        cause: error.cause.to_string(),
    }
}

impl<A: Participant, B: Participant> March<A, B> {
    /// Makes the next step with the size that `sizes` says and, where it fails, with half of it, as often as allowed. The
    /// observer is told of every failure before the next attempt.
    ///
    /// # Errors
    /// When the smallest step fails. Everything is then back where that step began.
    pub fn step_or_halve(
        &mut self,
        sizes: &StepSizes,
        observer: &mut dyn Observer,
    ) -> Result<StepRecord, StepError> {
        let mut size = sizes.next(&self.clock());
        loop {
            let error = match self.step(size, observer) {
                Ok(record) => return Ok(record),
                Err(error) => error,
            };
            let Some(half) = sizes.half(size) else { return Err(error) };
            observer.step_retried(&record(&error, half));
            size = half;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// The sizes of the accepted steps up to `end`, in parts of `dt / 2^halvings`, where the attempts in `failing` fail.
    fn sizes(dt: f64, halvings: u32, end: usize, mut fails: impl FnMut() -> bool) -> Vec<u64> {
        let sizes = StepSizes::new(dt, halvings);
        let mut clock = Clock::new(0.0);
        let mut made = Vec::new();
        while sizes.done(&clock) < end {
            let mut size = sizes.next(&clock);
            while fails() {
                let Some(half) = sizes.half(size) else { break };
                size = half;
            }
            clock = clock.after(size);
            made.push(sizes.parts(size));
        }
        assert!(sizes.on_grid(&clock), "the run ends on the grid");
        made
    }

    fn failing(attempts: &[usize]) -> impl FnMut() -> bool {
        let mut attempt = 0;
        move || {
            attempt += 1;
            attempts.contains(&attempt)
        }
    }

    #[test]
    fn sizes_return_to_that_of_the_grid_by_doubling() {
        assert_eq!(sizes(0.01, 2, 3, failing(&[])), [4, 4, 4]);
        assert_eq!(sizes(0.01, 2, 3, failing(&[2])), [4, 2, 2, 4]);
        assert_eq!(sizes(0.01, 2, 3, failing(&[1, 2])), [1, 1, 2, 4, 4]);
        // dt fails, then its second half: the next step of the grid is made in halves, too.
        assert_eq!(sizes(0.01, 2, 3, failing(&[1, 3])), [2, 1, 1, 2, 2, 4]);
    }

    #[test]
    fn no_halvings_change_nothing() {
        let sizes = StepSizes::new(0.01, 0);
        let clock = Clock { steps: 7, ..Clock::new(0.3) };
        assert_eq!((sizes.done(&clock), sizes.next(&clock), sizes.half(0.01)), (7, 0.01, None));
        assert!(sizes.on_grid(&clock));
    }

    proptest! {
        #[test]
        fn no_step_is_more_than_twice_the_last_and_every_time_of_the_grid_is_met(
            dt in 1e-6_f64..10.0,
            halvings in 1_u32..8,
            fates in prop::collection::vec(any::<bool>(), 1..400),
        ) {
            let mut fates = fates.into_iter();
            let made = sizes(dt, halvings, 60, || fates.next().unwrap_or(false));
            let whole = 1 << halvings;
            let mut reached = 0;
            for pair in made.windows(2) {
                prop_assert!(pair[1] <= 2 * pair[0], "{made:?}");
            }
            for part in &made {
                prop_assert!(reached / whole == (reached + part - 1) / whole, "a step passes a time of the grid");
                reached += part;
            }
            prop_assert_eq!(reached, 60 * whole);
        }
    }
}
