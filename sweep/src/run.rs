//! One run of a sweep, from its first step or its checkpoint to its end.

mod course;
mod stopwatch;

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};

use partita::build::{self, BuildError, FieldMarch as Fields};
use partita_coupling::{StepError, StepFailure};
use partita_numerics::Field;
use partita_scene::Resolved;

use crate::error::SweepError;
use crate::result::{Failure, FailureKind, RunResult, one_line, remedy};
use crate::sweep::{Run, Sweep};
use course::{Course, Gauge, Saved};
use stopwatch::Stopwatch;

/// Work between two checkpoints of a run, in unknowns times Newton iterations: a quarter of a minute to a minute of computing.
/// No clock decides, so that a run writes its checkpoints after the same steps on every machine.
pub const CHECKPOINT_WORK: u64 = 5_000_000;

/// How a run is carried out; nothing here changes its numbers.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Manner<'a> {
    /// Set from outside to stop at the end of the step.
    pub(crate) stop: &'a AtomicBool,
    /// Whether nothing else runs meanwhile, so that the time is that of the run.
    pub(crate) timed: bool,
    /// Work between two checkpoints.
    pub(crate) checkpoint_work: u64,
}

/// Runs `run`, whose checkpoints are kept in the folder `work`; `None` where it was stopped before its end.
///
/// # Errors
/// When a checkpoint cannot be written. What goes wrong in the run itself is a result.
pub(crate) fn carry_out(
    sweep: &Sweep,
    run: &Run,
    work: &Path,
    manner: Manner<'_>,
) -> Result<Option<RunResult>, SweepError> {
    // A panic is an error of the program; it must not take the other runs with it.
    catch_unwind(AssertUnwindSafe(|| attempt(sweep, run, work, manner))).unwrap_or_else(|panic| {
        let words = panic.downcast_ref::<String>().map(String::as_str);
        let words = words.or_else(|| panic.downcast_ref::<&str>().copied()).unwrap_or("no message");
        let remedy = "this is an error of the program; please report it";
        Ok(Some(Course::new(sweep).failed(run, Failure::at_start(FailureKind::Broken, words, remedy))))
    })
}

fn attempt(
    sweep: &Sweep,
    run: &Run,
    work: &Path,
    manner: Manner<'_>,
) -> Result<Option<RunResult>, SweepError> {
    let refused = |what: &str, remedy: &str| {
        Ok(Some(Course::new(sweep).failed(run, Failure::at_start(FailureKind::Refused, what, remedy))))
    };
    let resolved = match sweep.resolve(run) {
        Ok(resolved) => resolved,
        Err(error) => return refused(&error.to_string(), ""),
    };
    let (mut fields, mut course) = match begin(sweep, run, work, &resolved, manner.timed) {
        Ok(begun) => begun,
        Err(error) => return refused(&error.to_string(), &remedy(&error)),
    };
    let failure = match march(sweep, run, work, manner, &resolved, (&mut fields, &mut course))? {
        Ended::Stopped => return Ok(None),
        Ended::Well => None,
        Ended::Failed(failure) => Some(failure),
    };
    if failure.is_none() {
        course.repeat(|| time_again(&resolved, manner.stop));
    }
    Ok(Some(course.result(run, failure, &fields)))
}

/// The fields at their start, or where the checkpoint in the folder `work` has them. One that is of no use is as good as none.
fn begin(
    sweep: &Sweep,
    run: &Run,
    work: &Path,
    resolved: &Resolved,
    timed: bool,
) -> Result<(Fields, Course), BuildError> {
    let start = Stopwatch::start();
    let mut fields = build::march(resolved)?;
    let seconds = timed.then(|| start.seconds());
    if let Some(saved) = Saved::load(run, work) {
        if saved.fields.restore(&mut fields, resolved).is_ok() {
            return Ok((fields, Course::resumed(saved, timed)));
        }
        fields = build::march(resolved)?;
    }
    let mut course = Course::new(sweep);
    course.seconds = seconds;
    Ok((fields, course))
}

enum Ended {
    Well,
    Stopped,
    Failed(Failure),
}

fn march(
    sweep: &Sweep,
    run: &Run,
    work: &Path,
    manner: Manner<'_>,
    resolved: &Resolved,
    (fields, course): (&mut Fields, &mut Course),
) -> Result<Ended, SweepError> {
    let time = &resolved.scene.time;
    let sizes = time.sizes();
    let gauge = Gauge::new(sweep, resolved, fields);
    while sizes.done(&fields.clock()) < time.steps.get() {
        if manner.stop.load(Ordering::Relaxed) {
            course.save(run, work, fields, resolved)?;
            return Ok(Ended::Stopped);
        }
        let budget = sweep.newton_budget();
        if course.counts.newton >= budget {
            return Ok(Ended::Failed(out_of_budget(budget, fields.clock().steps + 1)));
        }
        let start = Stopwatch::start();
        let stepped = fields.step_or_halve(&sizes, &mut course.counts);
        // What was tried in vain is paid for, too.
        course.spend(start.seconds());
        match stepped {
            Ok(record) => course.note(&gauge, fields, &record),
            Err(error) => return Ok(Ended::Failed(step_failure(&error, gauge.coupled))),
        }
        if course.work_since_checkpoint(fields) >= manner.checkpoint_work {
            course.save(run, work, fields, resolved)?;
        }
    }
    Ok(Ended::Well)
}

fn out_of_budget(budget: usize, step: usize) -> Failure {
    let cause = format!("{budget} Newton iterations were used up");
    Failure {
        kind: FailureKind::OutOfBudget,
        what: format!("step {step}: {cause}"),
        cause,
        remedy: "raise newton_budget of the map, or ask for fewer steps".to_owned(),
        step: Some(step),
    }
}

fn step_failure(error: &StepError, coupled: bool) -> Failure {
    let kind = match &*error.cause {
        StepFailure::TooManyIterations { .. } => FailureKind::IterationBound,
        StepFailure::Diverges { .. } | StepFailure::NotFinite { .. } => FailureKind::Diverged,
        StepFailure::Participant(_) => FailureKind::FieldFailed,
    };
    let (cause, remedy) = (one_line(&error.cause.to_string()), remedy(&*error.cause));
    let cause = match error.iteration {
        iteration if iteration > 0 && coupled => format!("coupling iteration {iteration}: {cause}"),
        _ => cause,
    };
    let what = error.to_string().lines().next().unwrap_or_default().to_owned();
    Failure { kind, what, cause, remedy, step: Some(error.step.index) }
}

/// Unknowns of the fluid and of the structure.
fn unknowns(fields: &Fields) -> [usize; 2] {
    [fields.first().field().map_or(0, Field::unknowns), fields.second().field().map_or(0, Field::unknowns)]
}

/// Processor time of building and stepping the run once more \[s\]; `None` where it was stopped.
fn time_again(resolved: &Resolved, stop: &AtomicBool) -> Option<f64> {
    let start = Stopwatch::start();
    let mut fields = build::march(resolved).ok()?;
    let time = &resolved.scene.time;
    let sizes = time.sizes();
    while sizes.done(&fields.clock()) < time.steps.get() {
        if stop.load(Ordering::Relaxed) {
            return None;
        }
        fields.step_or_halve(&sizes, &mut ()).ok()?;
    }
    Some(start.seconds())
}
