//! One cell: a run of its scene, step by step, until it ends or cannot go on.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::atomic::{AtomicBool, Ordering};

use miette::Diagnostic;
use partita_coupling::record::{IterationRecord, StepRecord};
use partita_coupling::{Observer, RetryRecord, StepError, StepFailure};

use partita_fluid::FluidSolver;

use super::measure;
use super::read::{Cell, Map};
use super::row::{Outcome, Row};
use partita::build::{self, FieldMarch};
use partita_scene::Resolved;

/// Runs a cell; nothing when `stop` was set before it came to its end.
pub(super) fn run(map: &Map, cell: &Cell, stop: &AtomicBool) -> Option<Row> {
    // A panic is an error of the program; it must not take the other cells with it.
    catch_unwind(AssertUnwindSafe(|| attempt(map, cell, stop))).unwrap_or_else(|panic| {
        let words = panic.downcast_ref::<String>().map(String::as_str);
        let words = words.or_else(|| panic.downcast_ref::<&str>().copied()).unwrap_or("no message");
        Some(Row::empty(Outcome::Broken, words, "this is an error of the program; please report it"))
    })
}

fn attempt(map: &Map, cell: &Cell, stop: &AtomicBool) -> Option<Row> {
    let refused = |what: &str, hint: &str| Some(Row::empty(Outcome::Refused, &line(what), &line(hint)));
    let resolved = match partita_scene::load(&cell.scene, &cell.overrides) {
        Ok(resolved) => resolved,
        Err(error) => return refused(&error.to_string(), ""),
    };
    match build::march(&resolved) {
        Ok(run) => Course::new(run, &resolved).finish(map, stop),
        Err(error) => refused(&error.to_string(), &remedy(&error)),
    }
}

/// A run in progress and what is known of it.
struct Course<'a> {
    run: FieldMarch,
    resolved: &'a Resolved,
    coupled: bool,
    counts: Counts,
    energies: Vec<f64>,
    row: Row,
}

impl<'a> Course<'a> {
    fn new(run: FieldMarch, resolved: &'a Resolved) -> Self {
        let row = Row::empty(Outcome::Converged, "", "");
        let coupled = resolved.scene.coupling.is_some();
        Self { run, resolved, coupled, counts: Counts::default(), energies: Vec::new(), row }
    }

    fn finish(mut self, map: &Map, stop: &AtomicBool) -> Option<Row> {
        let time = self.resolved.scene.time;
        let sizes = time.sizes();
        while sizes.done(&self.run.clock()) < time.steps.get() {
            if stop.load(Ordering::Relaxed) {
                return None;
            }
            if self.counts.newton >= map.newton_budget {
                self.row.outcome = Outcome::OutOfBudget;
                self.row.cause = format!("{} Newton iterations were used up", map.newton_budget);
                "raise newton_budget of the map, or ask for fewer steps".clone_into(&mut self.row.remedy);
                self.row.failing_step = Some(self.run.clock().steps + 1);
                break;
            }
            match self.run.step_or_halve(&sizes, &mut self.counts) {
                Ok(step) => self.note(&step),
                Err(error) => {
                    self.fail(&error);
                    break;
                }
            }
        }
        Some(self.summed_up(map))
    }

    fn note(&mut self, step: &StepRecord) {
        let newton = step.fields.iter().map(|field| field.newton).sum();
        self.row.iterations.push(if self.coupled { step.iterations } else { newton });
        if !step.converged {
            self.row.outcome = Outcome::Unconverged;
            self.row.failing_step.get_or_insert(step.step);
            if self.row.cause.is_empty() {
                self.row.cause = format!("accepted at the iteration bound, |r| = {:.3e} m", step.residual);
            }
        }
        self.energies.push(measure::energy(&self.run));
        if let Some(quality) = self.run.first().field().and_then(FluidSolver::mesh_quality) {
            let smallest = self.row.mesh_quality.unwrap_or(f64::INFINITY);
            self.row.mesh_quality = Some(smallest.min(quality.smallest_quality));
        }
    }

    fn fail(&mut self, error: &StepError) {
        self.row.outcome = match &*error.cause {
            StepFailure::TooManyIterations { .. } => Outcome::IterationBound,
            StepFailure::Diverges { .. } | StepFailure::NotFinite { .. } => Outcome::Diverged,
            StepFailure::Participant(_) => Outcome::FieldFailed,
        };
        let what = line(&error.cause.to_string());
        self.row.cause = match error.iteration {
            0 => what,
            iteration if self.coupled => format!("coupling iteration {iteration}: {what}"),
            _ => what,
        };
        self.row.remedy = line(&remedy(error));
        self.row.failing_step = Some(error.step.index);
    }

    fn summed_up(mut self, map: &Map) -> Row {
        self.row.newton_iterations = self.counts.newton;
        self.row.retries = self.counts.retries;
        self.row.energy_growth = measure::growth(&self.energies);
        if self.row.outcome == Outcome::Converged
            && let Some(growth) =
                self.row.energy_growth.filter(|growth| growth.is_nan() || *growth > map.largest_energy_growth)
        {
            self.row.outcome = Outcome::EnergyGrows;
            self.row.cause = format!(
                "the largest energy of the last half of the steps is {growth:.1e} times that of the first"
            );
            "take a damped time scheme or another step size; compare with smaller steps before trusting it"
                .clone_into(&mut self.row.remedy);
        }
        let structure = self.run.second().field().filter(|_| !self.row.iterations.is_empty());
        self.row.structure_displacement = structure.map(measure::largest_displacement);
        let fluid = self.run.first().field().filter(|_| !self.row.iterations.is_empty());
        self.row.pressure_oscillation = fluid.map(measure::pressure_oscillation);
        self.row
    }
}

/// What to change.
fn remedy(error: &dyn Diagnostic) -> String {
    error.help().map(|help| help.to_string()).unwrap_or_default()
}

/// A text on one line.
fn line(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// Newton iterations and retries as they happen, those of failed steps among them.
#[derive(Default)]
struct Counts {
    newton: usize,
    retries: usize,
}

impl Observer for Counts {
    fn iteration(&mut self, record: &IterationRecord) {
        self.newton += record.fields.iter().map(|field| field.newton).sum::<usize>();
    }

    fn step_finished(&mut self, _: &StepRecord) {}

    fn step_retried(&mut self, _: &RetryRecord) {
        self.retries += 1;
    }
}
