//! What a run costs: wall-clock and processor time over all its sessions.

use std::time::{Duration, Instant};

use serde::{Deserialize, Serialize};

/// Cost of a run up to a moment, over all its sessions.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct Spent {
    /// Wall-clock time \[s\].
    pub wall_seconds: f64,
    /// Time on processors, all threads \[s\]; where the system does not tell, `None`.
    pub cpu_seconds: Option<f64>,
    /// Wall-clock time of writing \[s\].
    pub output_seconds: f64,
}

/// Measures the cost of a run, which a resumed run carries on. Start it with the program.
#[derive(Debug)]
pub struct Clock {
    start: Instant,
    before: Spent,
}

impl Clock {
    /// Starts to measure.
    #[must_use]
    pub fn start() -> Self {
        Self { start: Instant::now(), before: Spent { cpu_seconds: Some(0.0), ..Spent::default() } }
    }

    /// Counts what earlier sessions of the run cost too.
    pub(crate) fn go_on_from(&mut self, before: Spent) {
        self.before = before;
    }

    /// Counts time spent on writing.
    pub(crate) fn add_output(&mut self, time: Duration) {
        self.before.output_seconds += time.as_secs_f64();
    }

    /// The cost until now. Processor time is that of the whole process.
    #[must_use]
    pub fn spent(&self) -> Spent {
        self.spent_at(Instant::now(), process_cpu_seconds())
    }

    /// The cost until a moment at which the process has been on processors for `cpu` seconds.
    fn spent_at(&self, now: Instant, cpu: Option<f64>) -> Spent {
        Spent {
            wall_seconds: self.before.wall_seconds + (now - self.start).as_secs_f64(),
            cpu_seconds: self.before.cpu_seconds.zip(cpu).map(|(before, now)| before + now),
            output_seconds: self.before.output_seconds,
        }
    }
}

/// Processor time of this process, all threads \[s\].
#[cfg(unix)]
#[expect(clippy::unnecessary_wraps, reason = "other systems do not tell")]
fn process_cpu_seconds() -> Option<f64> {
    let time = rustix::time::clock_gettime(rustix::time::ClockId::ProcessCPUTime);
    Some(time.tv_sec as f64 + time.tv_nsec as f64 * 1e-9)
}

#[cfg(not(unix))]
fn process_cpu_seconds() -> Option<f64> {
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_clock_goes_on_from_earlier_sessions() {
        let before = Spent { wall_seconds: 100.0, cpu_seconds: Some(90.0), output_seconds: 3.0 };
        let mut clock = Clock::start();
        clock.go_on_from(before);
        clock.add_output(Duration::from_millis(500));
        let later = clock.start + Duration::from_secs(8);
        let expected = Spent { wall_seconds: 108.0, cpu_seconds: Some(92.0), output_seconds: 3.5 };
        assert_eq!(clock.spent_at(later, Some(2.0)), expected);
        assert_eq!(clock.spent_at(later, None), Spent { cpu_seconds: None, ..expected });
        clock.go_on_from(Spent { cpu_seconds: None, ..before });
        assert_eq!(clock.spent_at(later, Some(2.0)).cpu_seconds, None, "earlier sessions did not tell");
    }

    /// Whole seconds and their parts are put together; the process has run, so that it is not zero.
    #[cfg(unix)]
    #[test]
    fn unix_tells_the_processor_time_of_the_process() {
        assert!(process_cpu_seconds().expect("unix tells") > 0.0);
    }
}
