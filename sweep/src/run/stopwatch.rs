//! Processor time of this thread; where the system does not tell, time on the clock.

#[cfg(not(unix))]
use std::time::Instant;

/// Runs from its start.
pub(super) struct Stopwatch {
    #[cfg(unix)]
    start: f64,
    #[cfg(not(unix))]
    start: Instant,
}

#[cfg(unix)]
impl Stopwatch {
    fn now() -> f64 {
        let time = rustix::time::clock_gettime(rustix::time::ClockId::ThreadCPUTime);
        time.tv_sec as f64 + time.tv_nsec as f64 * 1e-9
    }

    pub(super) fn start() -> Self {
        Self { start: Self::now() }
    }

    pub(super) fn seconds(&self) -> f64 {
        Self::now() - self.start
    }
}

#[cfg(not(unix))]
impl Stopwatch {
    pub(super) fn start() -> Self {
        Self { start: Instant::now() }
    }

    pub(super) fn seconds(&self) -> f64 {
        self.start.elapsed().as_secs_f64()
    }
}
