//! The threads of this process.

use std::num::NonZeroUsize;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::mpsc::{self, Sender};
use std::thread;

use partita::watch::Watcher;

use super::{Executed, Executor};
use crate::error::SweepError;
use crate::folder::{Claim, Folder};
use crate::run::{CHECKPOINT_WORK, Manner, carry_out};
use crate::sweep::{Run, Sweep};

/// Makes runs in this process, some of them at a time. The results do not depend on how many.
#[derive(Debug, Clone, Copy)]
pub struct Threads<'a> {
    /// Runs made at a time.
    pub jobs: NonZeroUsize,
    /// Whether times are measured where there is one job.
    pub timed: bool,
    /// Set from outside to stop: runs in progress write a checkpoint at the end of their step.
    pub stop: &'a AtomicBool,
    /// Unknowns times Newton iterations between two checkpoints of a run.
    pub checkpoint_work: u64,
}

/// Stack of a thread that makes runs, like that of a program's first one.
const STACK: usize = 8 << 20;

/// What a thread reports.
enum Report<'a> {
    Finished(&'a Run),
    Elsewhere,
    Interrupted,
    Failed(SweepError),
}

impl<'a> Threads<'a> {
    /// As many at a time as are asked for.
    #[must_use]
    pub fn new(jobs: NonZeroUsize, stop: &'a AtomicBool) -> Self {
        Self { jobs, timed: true, stop, checkpoint_work: CHECKPOINT_WORK }
    }

    /// Makes runs until there are none left, or it is told to stop.
    fn work<'r>(&self, sweep: &Sweep, folder: &Folder, queue: &Queue<'r>, reports: &Sender<Report<'r>>) {
        while let Some(run) = queue.next() {
            let stopped = queue.halted.load(Ordering::Relaxed) || self.stop.load(Ordering::Relaxed);
            let made = if stopped { Ok(Report::Interrupted) } else { self.make(sweep, folder, run) };
            let report = made.unwrap_or_else(Report::Failed);
            let ends = matches!(report, Report::Interrupted | Report::Failed(_));
            if reports.send(report).is_err() || ends {
                break;
            }
        }
    }

    /// Makes a run, unless somebody else has.
    fn make<'r>(&self, sweep: &Sweep, folder: &Folder, run: &'r Run) -> Result<Report<'r>, SweepError> {
        let work = match folder.claim(run)? {
            Claim::Finished => return Ok(Report::Finished(run)),
            Claim::Taken => return Ok(Report::Elsewhere),
            Claim::Mine(work) => work,
        };
        let timed = self.measures_time() && sweep.wants_seconds();
        let manner = Manner { stop: self.stop, timed, checkpoint_work: self.checkpoint_work };
        match carry_out(sweep, run, work.path(), manner) {
            Ok(Some(result)) => work.finish(&result).map(|()| Report::Finished(run)),
            Ok(None) => {
                work.leave();
                Ok(Report::Interrupted)
            }
            Err(error) => {
                work.leave();
                Err(error)
            }
        }
    }
}

impl Executor for Threads<'_> {
    fn measures_time(&self) -> bool {
        self.timed && self.jobs.get() == 1
    }

    fn execute(
        &mut self,
        sweep: &Sweep,
        folder: &Folder,
        runs: &[&Run],
        watcher: &mut dyn Watcher,
    ) -> Result<Executed, SweepError> {
        let count = sweep.runs().len();
        watcher.begins(count, count - runs.len());
        let queue = Queue { runs, next: AtomicUsize::new(0), halted: AtomicBool::new(false) };
        let (sender, receiver) = mpsc::channel();
        let executed = thread::scope(|scope| {
            for _ in 0..self.jobs.get().min(runs.len()) {
                let (sender, queue, threads) = (sender.clone(), &queue, &*self);
                let thread = thread::Builder::new().stack_size(STACK);
                let work = move || threads.work(sweep, folder, queue, &sender);
                if thread.spawn_scoped(scope, work).is_err() {
                    // Those that there are do the work; where there is none, the runs stay missing.
                    break;
                }
            }
            drop(sender);
            let done = count - runs.len();
            let mut course = Course { sweep, folder, watcher, done, executed: Executed::default() };
            let mut outcome = Ok(());
            for report in receiver {
                let noted = course.note(report);
                if noted.is_err() {
                    queue.halted.store(true, Ordering::Relaxed);
                    outcome = outcome.and(noted);
                }
            }
            outcome.map(|()| course.executed)
        });
        watcher.ends();
        executed
    }
}

/// The runs that are still to be made.
struct Queue<'a> {
    runs: &'a [&'a Run],
    next: AtomicUsize,
    /// Whether no further one is to be begun.
    halted: AtomicBool,
}

impl<'a> Queue<'a> {
    fn next(&self) -> Option<&'a Run> {
        self.runs.get(self.next.fetch_add(1, Ordering::Relaxed)).copied()
    }
}

/// What is known of the threads so far.
struct Course<'a> {
    sweep: &'a Sweep,
    folder: &'a Folder,
    watcher: &'a mut dyn Watcher,
    done: usize,
    executed: Executed,
}

impl Course<'_> {
    fn note(&mut self, report: Report<'_>) -> Result<(), SweepError> {
        match report {
            Report::Finished(run) => {
                self.done += 1;
                self.watcher.reaches(self.done);
                if let Some(line) = self.sweep.line(self.folder, run) {
                    self.watcher.finishes(&line);
                }
                return self.sweep.check(self.folder, run);
            }
            Report::Elsewhere => self.executed.elsewhere += 1,
            Report::Interrupted => self.executed.interrupted = true,
            Report::Failed(error) => return Err(error),
        }
        Ok(())
    }
}
