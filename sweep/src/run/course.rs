//! What is known of a run so far, and the checkpoint that holds it.

use std::path::Path;

use partita::build::FieldMarch as Fields;
use partita::checkpoint::{self, Stamp};
use partita::output::Spent;
use partita::probe::Probes;
use partita::session::RunState;
use partita_coupling::record::{IterationRecord, StepRecord};
use partita_coupling::{Observer, RetryRecord};
use partita_fluid::FluidSolver;
use partita_scene::Resolved;
use serde::{Deserialize, Serialize};

use super::unknowns;
use crate::error::SweepError;
use crate::map::measure;
use crate::result::{Counts, Failure, Health, Measured, RunResult, Series};
use crate::sweep::{Kind, Run, Sweep};

/// What is known of a run so far.
#[derive(Debug)]
pub(super) struct Course {
    pub(super) counts: Counts,
    /// Processor time so far \[s\], where it counts.
    pub(super) seconds: Option<f64>,
    measured: Measured,
    /// Work behind the last checkpoint.
    saved: u64,
    is_resumed: bool,
}

/// The state of a run that a checkpoint holds.
#[derive(Debug, Serialize, Deserialize)]
pub(super) struct Saved {
    fingerprint: String,
    pub(super) fields: RunState,
    counts: Counts,
    seconds: Option<f64>,
    measured: Measured,
    work: u64,
}

impl Saved {
    /// The checkpoint of this run, if the folder `work` holds one that can be read.
    pub(super) fn load(run: &Run, work: &Path) -> Option<Self> {
        let saved: Self = checkpoint::load(work).ok()?.state;
        (saved.fingerprint == run.fingerprint).then_some(saved)
    }
}

/// Where to look while a run goes on.
pub(super) struct Gauge {
    /// The probes and the column that is kept.
    column: Option<(Probes, usize)>,
    /// Whether two fields iterate.
    pub(super) coupled: bool,
}

impl Gauge {
    pub(super) fn new(sweep: &Sweep, resolved: &Resolved, fields: &Fields) -> Self {
        let column = match &sweep.kind {
            Kind::Map(_) => None,
            Kind::Study(study) => {
                let probes = Probes::new(&resolved.scene.output.probes, fields);
                let index = probes.columns().iter().position(|name| *name == study.quantity.column);
                Some((probes, index.expect("the column was looked up when the study was read")))
            }
        };
        Self { column, coupled: resolved.scene.coupling.is_some() }
    }
}

/// Runs that take less altogether \[s\] are repeated: the clock and the caches blur short times.
const LONG_ENOUGH: f64 = 0.5;
const MOST_REPEATS: usize = 5;

impl Course {
    pub(super) fn new(sweep: &Sweep) -> Self {
        let measured = match sweep.kind {
            Kind::Study(_) => Measured::History(Series::default()),
            Kind::Map(_) => Measured::Health(Health::default()),
        };
        Self { counts: Counts::default(), seconds: None, measured, saved: 0, is_resumed: false }
    }

    /// Where a checkpoint was taken; its time counts if all of it was measured.
    pub(super) fn resumed(saved: Saved, timed: bool) -> Self {
        let Saved { counts, seconds, measured, work, .. } = saved;
        Self { counts, seconds: seconds.filter(|_| timed), measured, saved: work, is_resumed: true }
    }

    pub(super) fn spend(&mut self, seconds: f64) {
        self.seconds = self.seconds.map(|spent| spent + seconds);
    }

    /// Keeps what a finished step came to.
    pub(super) fn note(&mut self, gauge: &Gauge, fields: &Fields, step: &StepRecord) {
        self.counts.add(step);
        match &mut self.measured {
            Measured::History(series) => {
                let Some((probes, index)) = &gauge.column else { return };
                series.times.push(fields.clock().time);
                series.values.push(probes.values(fields)[*index]);
            }
            Measured::Health(health) => health.note(gauge.coupled, fields, step),
        }
    }

    /// Unknowns times Newton iterations since the last checkpoint.
    pub(super) fn work_since_checkpoint(&self, fields: &Fields) -> u64 {
        self.work(fields) - self.saved
    }

    fn work(&self, fields: &Fields) -> u64 {
        let newton = [self.counts.newton_fluid, self.counts.newton_structure];
        unknowns(fields).into_iter().zip(newton).map(|(unknowns, newton)| (unknowns * newton) as u64).sum()
    }

    /// Writes a checkpoint into the folder `work`.
    pub(super) fn save(
        &mut self,
        run: &Run,
        work: &Path,
        fields: &Fields,
        resolved: &Resolved,
    ) -> Result<(), SweepError> {
        let clock = fields.clock();
        let stamp = Stamp { step: clock.steps, time: clock.time, spent: Spent::default() };
        self.saved = self.work(fields);
        let state = Saved {
            fingerprint: run.fingerprint.clone(),
            fields: RunState::of(fields, resolved),
            counts: self.counts,
            seconds: self.seconds,
            measured: self.measured.clone(),
            work: self.saved,
        };
        checkpoint::save(work, &stamp, &state).map_err(SweepError::Checkpoint)
    }

    /// Takes the least time of some repeats where it is short.
    pub(super) fn repeat(&mut self, mut again: impl FnMut() -> Option<f64>) {
        let Some(mut spent) = self.seconds.filter(|_| !self.is_resumed) else { return };
        for _ in 1..MOST_REPEATS {
            if spent >= LONG_ENOUGH {
                break;
            }
            let Some(seconds) = again() else { break };
            spent += seconds;
            self.seconds = self.seconds.map(|least| least.min(seconds));
        }
    }

    /// The result of a run that is at its end.
    pub(super) fn result(mut self, run: &Run, failure: Option<Failure>, fields: &Fields) -> RunResult {
        if let Measured::Health(health) = &mut self.measured {
            health.sum_up(fields);
        }
        RunResult { unknowns: unknowns(fields), failure, ..self.without_fields(run) }
    }

    /// The result of a run that could not begin.
    pub(super) fn failed(self, run: &Run, failure: Failure) -> RunResult {
        RunResult { failure: Some(failure), ..self.without_fields(run) }
    }

    fn without_fields(self, run: &Run) -> RunResult {
        RunResult {
            fingerprint: run.fingerprint.clone(),
            run: run.label(),
            failure: None,
            counts: self.counts,
            unknowns: [0; 2],
            cpu_seconds: self.seconds,
            measured: self.measured,
        }
    }
}

impl Health {
    fn note(&mut self, coupled: bool, fields: &Fields, step: &StepRecord) {
        let newton = step.fields.iter().map(|field| field.newton).sum();
        self.iterations.push(if coupled { step.iterations } else { newton });
        if !step.converged {
            self.unconverged.get_or_insert((step.step, step.residual));
        }
        self.energies.push(measure::energy(fields));
        if let Some(quality) = fields.first().field().and_then(FluidSolver::mesh_quality) {
            let smallest = self.mesh_quality.unwrap_or(f64::INFINITY);
            self.mesh_quality = Some(smallest.min(quality.smallest_quality));
        }
    }

    fn sum_up(&mut self, fields: &Fields) {
        if self.iterations.is_empty() {
            return;
        }
        self.structure_displacement = fields.second().field().map(measure::largest_displacement);
        self.pressure_oscillation = fields.first().field().map(measure::pressure_oscillation);
    }
}

impl Counts {
    fn add(&mut self, step: &StepRecord) {
        self.steps += 1;
        self.unconverged_steps += usize::from(!step.converged);
        self.coupling_iterations += step.iterations;
        self.newton_fluid += step.newton_of("fluid");
        self.newton_structure += step.newton_of("structure");
    }
}

/// Counts as it happens what steps do not tell: Newton iterations of failed steps, and retries.
impl Observer for Counts {
    fn iteration(&mut self, record: &IterationRecord) {
        self.newton += record.fields.iter().map(|field| field.newton).sum::<usize>();
    }

    fn step_finished(&mut self, _: &StepRecord) {}

    fn step_retried(&mut self, _: &RetryRecord) {
        self.retries += 1;
    }
}
