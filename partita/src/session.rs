//! The run of a scene in its folder, from its first step, or its checkpoint, to its end.

use std::num::NonZeroUsize;
use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};

use partita_numerics::Field;

use crate::build;
use crate::checkpoint::{self, Stamp};
use crate::couple::FieldMarch;
use crate::output::space::{self, Estimate};
use crate::output::{Clock, Ending, SCENE, Spent, Summary};
use crate::run::Run;
use crate::watch::Watcher;
use partita_scene::Resolved;
use partita_scene::schema::Scene;

pub use crate::run::{RunError, RunState};

/// How a run is to be carried out; nothing here changes its numbers.
#[derive(Debug, Clone, Copy, Default)]
pub struct Options<'a> {
    /// Stop at the end of this step, if the scene goes on beyond it.
    pub steps: Option<usize>,
    /// Set from outside to stop at the end of the step.
    pub stop: Option<&'a AtomicBool>,
    /// How many threads solve large linear systems, one if nothing is said; no result depends on it.
    pub threads: Option<NonZeroUsize>,
}

impl Options<'_> {
    /// The number of threads, at least one.
    #[must_use]
    pub fn threads(&self) -> usize {
        self.threads.map_or(1, NonZeroUsize::get)
    }
}

/// A run of a scene in progress.
pub struct Session<'a> {
    run: Run,
    scene: &'a Scene,
    options: Options<'a>,
    /// What the user should know before the first step.
    note: Option<String>,
}

impl<'a> Session<'a> {
    /// Builds the run of the scene and starts its folder `dir`, which must be new or empty; `clock` has run since the
    /// program started. Nothing is written when the scene cannot be built.
    ///
    /// # Errors
    /// When the scene cannot be built, the folder not be written, or its disk has less space than the run will fill.
    pub fn start(
        resolved: &'a Resolved,
        dir: &Path,
        options: Options<'a>,
        clock: Clock,
    ) -> Result<Self, RunError> {
        Self::start_with(build::march_on(resolved, options.threads())?, resolved, dir, options, clock)
    }

    /// The same with the fields that were built from the scene.
    ///
    /// # Errors
    /// When the folder cannot be written, or its disk has less space than the run will fill.
    pub fn start_with(
        march: FieldMarch,
        resolved: &'a Resolved,
        dir: &Path,
        options: Options<'a>,
        clock: Clock,
    ) -> Result<Self, RunError> {
        let mut run = Run::of_march(march, resolved);
        estimate(&run, &resolved.scene, options).check(dir)?;
        run.start_folder(dir, (SCENE, &resolved.to_toml()), &resolved.shapes.inputs, clock)?;
        Ok(Self { run, scene: &resolved.scene, options, note: None })
    }

    /// Resumes the run in the folder `dir`, which holds this scene, at its checkpoint.
    ///
    /// # Errors
    /// When there is no usable checkpoint, the folder does not fit it, or the disk has less space than the rest of the
    /// run will fill.
    pub fn resume(
        resolved: &'a Resolved,
        dir: &Path,
        options: Options<'a>,
        clock: Clock,
    ) -> Result<Self, RunError> {
        let checkpoint = checkpoint::load::<RunState>(dir)?;
        let mut run = Run::of_march(build::march_on(resolved, options.threads())?, resolved);
        run.restore(&checkpoint.state)?;
        estimate(&run, &resolved.scene, options).check(dir)?;
        run.resume_folder(dir, &checkpoint.stamp, clock)?;
        let step = checkpoint.stamp.step;
        let note = checkpoint.latest_unusable.map(|error| {
            format!("the latest checkpoint is not usable, the run goes on after step {step}\n{error}")
        });
        Ok(Self { run, scene: &resolved.scene, options, note })
    }

    /// Steps to the end of the scene, or to where the options say, and writes the summary, with nobody watching.
    ///
    /// # Errors
    /// As [`finish_watched`](Self::finish_watched).
    pub fn finish(self) -> Result<Summary, RunError> {
        self.finish_watched(&mut ())
    }

    /// Steps to the end of the scene, or to where the options say, and writes the summary.
    ///
    /// A step that fails leaves its iterations, a checkpoint and the fields before it in the folder. Where the folder takes
    /// no more, it holds whole files up to its last checkpoint, and the run can be resumed from there.
    ///
    /// # Errors
    /// When a step cannot be solved, or what it came to not be written.
    pub fn finish_watched(mut self, watcher: &mut dyn Watcher) -> Result<Summary, RunError> {
        let last =
            self.options.steps.map_or(self.scene.time.steps.get(), |s| s.min(self.scene.time.steps.get()));
        watcher.begins(last, self.run.done());
        if let Some(note) = &self.note {
            watcher.note(note);
        }
        let outcome = self.march_to(last, watcher);
        watcher.ends();
        let summary = self.run.end(outcome?)?;
        summary.ok_or(RunError::NoFolder)
    }

    fn march_to(&mut self, last: usize, watcher: &mut dyn Watcher) -> Result<Ending, RunError> {
        while self.run.done() < last {
            self.run.step_watched(watcher)?;
            let stop = self.options.stop.is_some_and(|stop| stop.load(Ordering::Relaxed));
            if stop && self.run.done() < last {
                return Ok(Ending::Interrupted);
            }
        }
        let completed = self.run.done() >= self.scene.time.steps.get();
        Ok(if completed { Ending::Completed } else { Ending::Stopped })
    }
}

/// Steps of the scene that the checkpoint in the folder of a run has behind it.
///
/// # Errors
/// When there is no usable checkpoint.
pub fn steps_done(resolved: &Resolved, dir: &Path) -> Result<usize, RunError> {
    let checkpoint = checkpoint::load::<RunState>(dir)?;
    Ok(resolved.scene.time.sizes().done(&checkpoint.state.march.clock))
}

/// Coupling iterations that a step is taken to need when its records are estimated.
const ITERATIONS_A_STEP: usize = 8;

/// What the rest of `run` will write, roughly.
fn estimate(run: &Run, scene: &Scene, options: Options) -> Estimate {
    let all = scene.time.steps.get();
    let steps = options.steps.map_or(all, |steps| steps.min(all)).saturating_sub(run.done());
    let iterations = if scene.coupling.is_some() { ITERATIONS_A_STEP } else { 1 };
    let mut estimate = Estimate::of_records(steps, iterations);
    if let Some(files) = steps.checked_div(scene.output.fields_every) {
        estimate = run.drawing().add_to(estimate, run.march(), files);
    }
    if run.checkpoint_every() > 0 {
        let stamp = Stamp { step: 0, time: 0.0, spent: Spent::default() };
        let bytes = checkpoint::encoded_len(&stamp, &run.state());
        // Where a run is resumed there are two already, which the new ones replace.
        let count = if run.clock().steps == 0 { space::CHECKPOINTS } else { 1 };
        estimate = estimate.with_checkpoints(count, bytes.unwrap_or_default() + most_kept_bytes(run));
    }
    estimate
}

/// Bytes of the tangents that a checkpoint of `run` may hold once there are factors.
fn most_kept_bytes(run: &Run) -> usize {
    let entries = run.fluid().map_or(0, most_entries) + run.structure().map_or(0, most_entries);
    entries * size_of::<f64>()
}

/// Most entries of a tangent that a checkpoint will hold.
fn most_entries<F: Field>(field: &F) -> usize {
    if field.keeps_factor() { field.tangent().1.len() } else { 0 }
}
