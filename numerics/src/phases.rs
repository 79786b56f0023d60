//! Seconds per phase of a solver call.

use std::ops::{Add, AddAssign, Sub};
use std::time::Instant;

/// Wall-clock time a field has spent in each phase since it was built (s).
///
/// The cost of one call is the difference of two snapshots.
///
/// ```
/// use partita_numerics::phases::{PhaseSeconds, timed};
///
/// let mut phases = PhaseSeconds::default();
/// let before = phases;
/// let sum: f64 = timed(&mut phases.assembly, || (0..10).map(f64::from).sum());
/// assert_eq!(sum, 45.0);
/// assert_eq!((phases - before).total(), phases.assembly);
/// ```
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct PhaseSeconds {
    /// Element residuals and tangents.
    pub assembly: f64,
    /// Numeric factorizations.
    pub factorization: f64,
    /// Forward and backward substitutions.
    pub solve: f64,
    /// Mesh motion, its own factorizations and solves included.
    pub motion: f64,
}

impl PhaseSeconds {
    /// All phases together (s).
    #[must_use]
    pub fn total(&self) -> f64 {
        self.assembly + self.factorization + self.solve + self.motion
    }
}

impl Add for PhaseSeconds {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self {
            assembly: self.assembly + other.assembly,
            factorization: self.factorization + other.factorization,
            solve: self.solve + other.solve,
            motion: self.motion + other.motion,
        }
    }
}

impl AddAssign for PhaseSeconds {
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl Sub for PhaseSeconds {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        Self {
            assembly: self.assembly - other.assembly,
            factorization: self.factorization - other.factorization,
            solve: self.solve - other.solve,
            motion: self.motion - other.motion,
        }
    }
}

/// Runs `work` and adds its wall-clock time (s) to `seconds`.
///
/// Where `work` needs the owner of the phases as a whole, use a [`Stopwatch`].
pub fn timed<T>(seconds: &mut f64, work: impl FnOnce() -> T) -> T {
    timed_by(Instant::now, seconds, work)
}

fn timed_by<T>(mut now: impl FnMut() -> Instant, seconds: &mut f64, work: impl FnOnce() -> T) -> T {
    let watch = Stopwatch { start: now() };
    let result = work();
    watch.stop_at(now(), seconds);
    result
}

/// A running clock, stopped into the phase it belongs to.
#[derive(Debug)]
#[must_use = "a stopwatch measures nothing until it is stopped into a phase"]
pub struct Stopwatch {
    start: Instant,
}

impl Stopwatch {
    /// Starts the clock.
    pub fn start() -> Self {
        Self { start: Instant::now() }
    }

    /// Adds the time since the start (s) to `seconds`.
    pub fn stop(self, seconds: &mut f64) {
        self.stop_at(Instant::now(), seconds);
    }

    fn stop_at(self, end: Instant, seconds: &mut f64) {
        *seconds += (end - self.start).as_secs_f64();
    }
}

#[cfg(test)]
#[allow(clippy::float_cmp, reason = "these values are exact")]
mod tests {
    use std::time::Duration;

    use super::*;

    const PHASES: PhaseSeconds = PhaseSeconds { assembly: 1.0, factorization: 2.0, solve: 4.0, motion: 8.0 };

    #[test]
    fn sums_and_differences_go_phase_by_phase() {
        let mut sum = PHASES;
        sum += PHASES + PHASES;
        let difference = sum - PHASES;
        let twice = PhaseSeconds { assembly: 2.0, factorization: 4.0, solve: 8.0, motion: 16.0 };
        assert_eq!(difference, twice);
        assert_eq!(difference.total(), 30.0);
    }

    #[test]
    fn time_accumulates_in_the_phase_it_is_given() {
        let mut phases = PhaseSeconds { motion: 1.0, ..PhaseSeconds::default() };
        let watch = Stopwatch::start();
        let mut time = watch.start;
        watch.stop_at(time + Duration::from_millis(500), &mut phases.motion);
        let mut ticks = || {
            time += Duration::from_millis(2250);
            time
        };
        assert_eq!(timed_by(&mut ticks, &mut phases.motion, || 7), 7);
        assert_eq!(phases, PhaseSeconds { motion: 3.75, ..PhaseSeconds::default() });
    }
}
