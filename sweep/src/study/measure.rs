//! One setting, run and timed.
use partita_numerics::Field;

use std::sync::atomic::{AtomicBool, Ordering};

use partita_coupling::record::{IterationRecord, StepRecord};
use partita_coupling::{Observer, RetryRecord};
use partita_fluid::FluidSolver;
use partita_structure::StructureSolver;

use super::error::MeasureError;
use super::quantity::Series;
use partita::build::{self, FieldMarch};
use partita::output::Totals;
use partita::probe::Probes;
use partita_scene::Resolved;

/// What a run of a setting came to.
#[derive(Debug, Clone)]
pub(super) struct Measured {
    pub(super) series: Series,
    pub(super) cpu_seconds: f64,
    pub(super) unknowns: usize,
    pub(super) totals: Totals,
}

/// Runs that take less altogether \[s\] are repeated: the clock and the caches blur short times.
const LONG_ENOUGH: f64 = 0.5;
const MOST_REPEATS: usize = 5;

/// Runs a setting to its end; `None` where `stop` was set before that. The time is the least of the repeats; it is that
/// of building and stepping the run, without reading its files and without any output.
pub(super) fn measure(
    setting: &Resolved,
    column: &str,
    stop: &AtomicBool,
) -> Result<Option<Measured>, MeasureError> {
    let Some(mut measured) = once(setting, column, stop)? else { return Ok(None) };
    let mut spent = measured.cpu_seconds;
    for _ in 1..MOST_REPEATS {
        if spent >= LONG_ENOUGH {
            break;
        }
        let Some(again) = once(setting, column, stop)? else { break };
        spent += again.cpu_seconds;
        measured.cpu_seconds = measured.cpu_seconds.min(again.cpu_seconds);
    }
    Ok(Some(measured))
}

fn once(setting: &Resolved, column: &str, stop: &AtomicBool) -> Result<Option<Measured>, MeasureError> {
    let scene = &setting.scene;
    let start = Stopwatch::start();
    let mut run = build::march(setting)?;
    let mut cpu_seconds = start.seconds();
    let probes = Probes::new(&scene.output.probes, &run);
    let index = probes.columns().iter().position(|name| name == column);
    let index = index.expect("the column was looked up when the study was read");
    let mut series = Series::default();
    let mut totals = Totals::default();
    let mut retries = Retries(0);
    let sizes = scene.time.sizes();
    while sizes.done(&run.clock()) < scene.time.steps.get() {
        if stop.load(Ordering::Relaxed) {
            return Ok(None);
        }
        let start = Stopwatch::start();
        let record = run.step_or_halve(&sizes, &mut retries)?;
        // What was tried in vain is paid for, too.
        cpu_seconds += start.seconds();
        totals.add(&record);
        series.times.push(run.clock().time);
        series.values.push(probes.values(&run)[index]);
    }
    totals.retries = retries.0;
    Ok(Some(Measured { series, cpu_seconds, unknowns: unknowns(&run), totals }))
}

/// Counts the steps that failed and were repeated in halves.
struct Retries(usize);

impl Observer for Retries {
    fn iteration(&mut self, _: &IterationRecord) {}

    fn step_finished(&mut self, _: &StepRecord) {}

    fn step_retried(&mut self, _: &RetryRecord) {
        self.0 += 1;
    }
}

fn unknowns(run: &FieldMarch) -> usize {
    let of_fluid = |fluid: &FluidSolver<2>| fluid.parts().iter().map(|part| part.dofs.len()).sum();
    let of_structure = |solid: &StructureSolver<2>| solid.parts().iter().map(|part| part.dofs.len()).sum();
    run.first().field().map_or(0, of_fluid) + run.second().field().map_or(0, of_structure)
}

/// Processor time of this thread; where the system does not tell, time on the clock.
struct Stopwatch {
    #[cfg(unix)]
    start: f64,
    #[cfg(not(unix))]
    start: std::time::Instant,
}

#[cfg(unix)]
impl Stopwatch {
    fn now() -> f64 {
        let time = rustix::time::clock_gettime(rustix::time::ClockId::ThreadCPUTime);
        time.tv_sec as f64 + time.tv_nsec as f64 * 1e-9
    }

    fn start() -> Self {
        Self { start: Self::now() }
    }

    fn seconds(&self) -> f64 {
        Self::now() - self.start
    }
}

#[cfg(not(unix))]
impl Stopwatch {
    fn start() -> Self {
        Self { start: std::time::Instant::now() }
    }

    fn seconds(&self) -> f64 {
        self.start.elapsed().as_secs_f64()
    }
}
