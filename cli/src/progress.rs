//! The bar that a run draws on a terminal.

use std::fmt::Write as _;
use std::io::IsTerminal;

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use partita::watch::Watcher;
use partita_coupling::{IterationRecord, RetryRecord};
use partita_numerics::time::shown;

/// A bar over the steps, with the counts of the step being solved and the time left.
///
/// It stands on stderr, and only where that is a terminal: logs and pipes see nothing of it.
#[derive(Debug)]
pub(crate) struct Progress {
    bar: ProgressBar,
    newton: [usize; 2],
    quiet: bool,
}

impl Progress {
    /// A bar that says nothing of what goes well when it is `quiet`.
    pub(crate) fn new(quiet: bool) -> Self {
        let target = if quiet || !std::io::stderr().is_terminal() {
            ProgressDrawTarget::hidden()
        } else {
            ProgressDrawTarget::stderr()
        };
        let bar = ProgressBar::with_draw_target(None, target);
        bar.set_style(style());
        Self { bar, newton: [0; 2], quiet }
    }
}

impl Watcher for Progress {
    fn begins(&mut self, total: usize, done: usize) {
        self.bar.set_length(total as u64);
        self.bar.set_position(done as u64);
        self.bar.reset_eta();
    }

    fn iteration(&mut self, record: &IterationRecord) {
        if record.iteration <= 1 {
            self.newton = [0; 2];
        }
        let mut message = format!("coupling {}, Newton", record.iteration);
        for (sum, field) in self.newton.iter_mut().zip(&record.fields) {
            *sum += field.newton;
            write!(message, " {} {sum}", field.name).expect("a String takes any text");
        }
        self.bar.set_message(message);
    }

    fn retried(&mut self, record: &RetryRecord) {
        if self.quiet {
            return;
        }
        self.note(&format!(
            "step {} (t = {} s) of {} s failed, goes on with {} s: {}",
            record.step,
            shown(record.time),
            shown(record.dt),
            shown(record.next_dt),
            record.cause
        ));
    }

    fn reaches(&mut self, done: usize) {
        self.bar.set_position(done as u64);
    }

    fn finishes(&mut self, line: &str) {
        if !self.quiet {
            self.note(line);
        }
    }

    fn note(&mut self, line: &str) {
        self.bar.suspend(|| eprintln!("{line}"));
    }

    fn ends(&mut self) {
        self.bar.finish_and_clear();
    }
}

fn style() -> ProgressStyle {
    ProgressStyle::with_template("step {pos}/{len} {bar:30} {eta} left  {msg}")
        .expect("the template is well formed")
}

#[cfg(test)]
mod tests {
    use partita_coupling::participant::{Effort, NewtonLimit};
    use partita_coupling::record::{FieldRecord, Seconds};

    use super::*;

    fn iteration(step: usize, iteration: usize, newton: [usize; 2]) -> IterationRecord {
        let call = |name, newton| {
            FieldRecord::new(name, NewtonLimit::ToConvergence, Effort { newton, ..Effort::default() })
        };
        IterationRecord {
            step,
            iteration,
            residual: 0.0,
            relative_residual: 0.0,
            work_defect: 0.0,
            fields: [call("fluid", newton[0]), call("structure", newton[1])],
            acceleration: None,
            seconds: Seconds::default(),
        }
    }

    #[test]
    fn newton_counts_are_those_of_the_step_being_solved() {
        let mut progress = Progress::new(true);
        progress.begins(50, 0);
        progress.iteration(&iteration(1, 1, [5, 3]));
        progress.iteration(&iteration(1, 2, [4, 0]));
        assert_eq!(progress.bar.message(), "coupling 2, Newton fluid 9 structure 3");
        progress.iteration(&iteration(2, 1, [6, 1]));
        assert_eq!(progress.bar.message(), "coupling 1, Newton fluid 6 structure 1");
    }

    #[test]
    fn a_resumed_run_starts_where_it_was() {
        let mut progress = Progress::new(true);
        progress.begins(50, 20);
        assert_eq!((progress.bar.position(), progress.bar.length()), (20, Some(50)));
    }

    #[test]
    fn nothing_is_drawn_when_quiet() {
        assert!(Progress::new(true).bar.is_hidden());
    }
}
