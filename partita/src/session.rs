//! A run from its first step, or its checkpoint, to its end: the time loop, and what is written on the way.

use std::error::Error;
use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};

use miette::Diagnostic;
use partita_coupling::{IterationRecord, MarchState, Observer, RetryRecord, StepError, StepRecord};
use partita_fluid::FluidState;
use partita_numerics::Field;
use partita_numerics::time::shown;
use partita_structure::StructureState;
use serde::{Deserialize, Serialize};

use crate::adapt::SlotState;
use crate::build::{self, BuildError, Run};
use crate::checkpoint::{self, CheckpointError, Stamp};
use crate::draw::Drawing;
use crate::output::space::{self, Estimate};
use crate::output::{Clock, Ending, OutputError, RunWriter, Spent, Summary};
use crate::probe::Probes;
use crate::watch::Watcher;
use partita_scene::Resolved;
use partita_scene::schema::Scene;

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

/// Why a run could not go on.
#[derive(Debug, thiserror::Error, miette::Diagnostic)]
pub enum RunError {
    /// The scene cannot be built.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Build(#[from] BuildError),
    /// A step could not be solved; the run's folder holds what was reached.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Step(#[from] StepError),
    /// The output folder.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Output(#[from] OutputError),
    /// What a step came to could not be written.
    #[error("step {step} (t = {} s), output: {source}", shown(*time))]
    #[diagnostic(help("see that the folder can be written and has space; {}", way_back(dir, *checkpoint)))]
    Storage {
        /// The last step that was solved.
        step: usize,
        /// The time at its end \[s\].
        time: f64,
        /// The run's folder.
        dir: PathBuf,
        /// The step of its last checkpoint.
        checkpoint: Option<usize>,
        /// Which file, and why.
        source: Box<RunError>,
    },
    /// The checkpoint.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Checkpoint(#[from] CheckpointError),
    /// The checkpoint belongs to another scene.
    #[error("the checkpoint does not fit the scene beside it: {0}")]
    #[diagnostic(help(
        "the scene of a run must not be changed before it is resumed; start a new run instead"
    ))]
    Misfit(String),
}

/// Everything a run remembers between two steps.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct RunState {
    /// The scene as far as it decides about the numbers of a step.
    scene: String,
    march: MarchState,
    fluid: SlotState<FluidState>,
    structure: SlotState<StructureState>,
}

/// A run in progress.
pub struct Session<'a> {
    run: Run,
    resolved: &'a Resolved,
    scene: &'a Scene,
    probes: Probes,
    drawing: Drawing,
    writer: RunWriter,
    options: Options<'a>,
    /// The step of the last checkpoint in the folder.
    saved: Option<usize>,
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
        Self::start_with(build::run_on(resolved, options.threads())?, resolved, dir, options, clock)
    }

    /// The same with the run that was built from the scene.
    ///
    /// # Errors
    /// When the folder cannot be written, or its disk has less space than the run will fill.
    pub fn start_with(
        run: Run,
        resolved: &'a Resolved,
        dir: &Path,
        options: Options<'a>,
        clock: Clock,
    ) -> Result<Self, RunError> {
        let scene = &resolved.scene;
        let probes = Probes::new(&scene.output.probes, &run);
        let drawing = Drawing::new(&run, scene.output.spline_subdivisions.get());
        estimate(&run, resolved, &drawing, options).check(dir)?;
        let mut writer = RunWriter::create(dir, &resolved.to_toml(), probes.columns(), clock)?;
        writer.keep(&resolved.shapes.inputs)?;
        if scene.output.fields_every > 0 {
            drawing.write(&run, &mut writer, 0, 0.0)?;
        }
        Ok(Self { run, resolved, scene, probes, drawing, writer, options, saved: None, note: None })
    }

    /// Takes up the run in the folder `dir`, which holds this scene, at its checkpoint.
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
        let mut run = build::run_on(resolved, options.threads())?;
        checkpoint.state.restore(&mut run, resolved)?;
        let scene = &resolved.scene;
        let probes = Probes::new(&scene.output.probes, &run);
        let drawing = Drawing::new(&run, scene.output.spline_subdivisions.get());
        estimate(&run, resolved, &drawing, options).check(dir)?;
        let writer = RunWriter::resume(dir, &checkpoint.stamp, probes.columns(), clock)?;
        let step = checkpoint.stamp.step;
        let note = checkpoint.latest_unusable.map(|error| {
            let hint = error.help().map_or_else(String::new, |help| format!("\nhint: {help}"));
            format!("the latest checkpoint is not usable, the run goes on after step {step}\n{error}{hint}")
        });
        Ok(Self { run, resolved, scene, probes, drawing, writer, options, saved: Some(step), note })
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
        watcher.begins(last, self.done());
        if let Some(note) = &self.note {
            watcher.note(note);
        }
        let outcome = self.march_to(last, watcher).and_then(|ending| {
            self.save_if_wanted()?;
            Ok(ending)
        });
        watcher.ends();
        match outcome {
            Ok(ending) => Ok(self.writer.finish(ending)?),
            Err(error @ RunError::Step(_)) => Err(self.give_up(error, watcher)),
            Err(error) => Err(self.break_off(error)),
        }
    }

    /// Writes what a failed step leaves: the fields and the checkpoint before it, and the summary. What cannot be written
    /// is said, but the step's error is the one that counts.
    fn give_up(mut self, error: RunError, watcher: &mut dyn Watcher) -> RunError {
        let drawn = self.draw().map_err(RunError::from);
        let saved = self.save_if_wanted();
        let summed = self.writer.fail(error.to_string()).map(drop).map_err(RunError::from);
        for lost in [drawn, saved, summed].into_iter().filter_map(Result::err) {
            watcher.note(&format!("warning: {lost}"));
        }
        error
    }

    /// The folder takes no more: says where the run can be taken up again. The files are left as they are, for a later
    /// checkpoint would be ahead of them.
    fn break_off(self, error: RunError) -> RunError {
        let clock = self.run.clock();
        let error = RunError::Storage {
            step: clock.steps,
            time: clock.time,
            dir: self.writer.dir().to_owned(),
            checkpoint: self.saved,
            source: Box::new(error),
        };
        // A small file may still fit; that it does not is no news.
        let _ = self.writer.fail(error.to_string());
        error
    }

    fn march_to(&mut self, last: usize, watcher: &mut dyn Watcher) -> Result<Ending, RunError> {
        while self.done() < last {
            self.step(watcher)?;
            let stop = self.options.stop.is_some_and(|stop| stop.load(Ordering::Relaxed));
            if stop && self.done() < last {
                return Ok(Ending::Interrupted);
            }
        }
        let completed = self.done() >= self.scene.time.steps.get();
        Ok(if completed { Ending::Completed } else { Ending::Stopped })
    }

    /// Steps of the scene that are done; where some were halved, the run has made more.
    fn done(&self) -> usize {
        self.scene.time.sizes().done(&self.run.clock())
    }

    fn step(&mut self, watcher: &mut dyn Watcher) -> Result<(), RunError> {
        let sizes = self.scene.time.sizes();
        let mut scribe = Scribe { writer: &mut self.writer, watcher: &mut *watcher, refused: None };
        let result = self.run.step_or_halve(&sizes, &mut scribe);
        if let Some(refused) = scribe.refused {
            return Err(refused.into());
        }
        let step = result?.step;
        self.writer.probes(step, self.run.clock().time, &self.probes.values(&self.run))?;
        let clock = self.run.clock();
        let (done, on_grid) = (sizes.done(&clock), sizes.on_grid(&clock));
        watcher.reaches(done);
        let due = |every: usize| every > 0 && on_grid && done.is_multiple_of(every);
        if due(self.scene.output.fields_every) {
            self.draw()?;
        }
        if due(self.scene.output.checkpoint_every) {
            self.save()?;
        }
        Ok(())
    }

    /// Draws the committed state, unless that is there already.
    fn draw(&mut self) -> Result<(), OutputError> {
        let clock = self.run.clock();
        if self.writer.shows(clock.time) {
            return Ok(());
        }
        self.drawing.write(&self.run, &mut self.writer, clock.steps, clock.time)
    }

    fn save(&mut self) -> Result<(), RunError> {
        let clock = self.run.clock();
        let stamp = self.writer.stamp(clock.steps, clock.time)?;
        checkpoint::save(self.writer.dir(), &stamp, &RunState::of(&self.run, self.resolved))?;
        self.saved = Some(clock.steps);
        Ok(())
    }

    fn save_if_wanted(&mut self) -> Result<(), RunError> {
        // A second one of the same step would push the one before out of the folder.
        let due = self.scene.output.checkpoint_every > 0 && self.saved != Some(self.run.clock().steps);
        if due { self.save() } else { Ok(()) }
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
fn estimate(run: &Run, resolved: &Resolved, drawing: &Drawing, options: Options) -> Estimate {
    let scene = &resolved.scene;
    let all = scene.time.steps.get();
    let steps = options
        .steps
        .map_or(all, |steps| steps.min(all))
        .saturating_sub(scene.time.sizes().done(&run.clock()));
    let iterations = if scene.coupling.is_some() { ITERATIONS_A_STEP } else { 1 };
    let mut estimate = Estimate::of_records(steps, iterations);
    if let Some(files) = steps.checked_div(scene.output.fields_every) {
        estimate = drawing.add_to(estimate, run, files);
    }
    if scene.output.checkpoint_every > 0 {
        let stamp = Stamp { step: 0, time: 0.0, spent: Spent::default() };
        let bytes = checkpoint::encoded_len(&stamp, &RunState::of(run, resolved));
        // Where a run is taken up there are two already, which the new ones replace.
        let count = if run.clock().steps == 0 { space::CHECKPOINTS } else { 1 };
        estimate = estimate.with_checkpoints(count, bytes.unwrap_or_default() + most_kept_bytes(run));
    }
    estimate
}

/// Bytes of the tangents that a checkpoint of `run` may hold once there are factors.
fn most_kept_bytes(run: &Run) -> usize {
    let entries = run.first().field().map_or(0, most_entries) + run.second().field().map_or(0, most_entries);
    entries * size_of::<f64>()
}

/// Most entries of a tangent that a checkpoint will hold.
fn most_entries<F: Field>(field: &F) -> usize {
    if field.keeps_factor() { field.tangent().1.len() } else { 0 }
}

fn way_back(dir: &Path, checkpoint: Option<usize>) -> String {
    let dir = dir.display();
    match checkpoint {
        Some(step) => {
            format!("`partita resume {dir}` then goes on after step {step}, that of the last checkpoint")
        }
        None => format!("there is no checkpoint in {dir} yet: start the run again with --force"),
    }
}

impl RunState {
    /// What `run` of `scene` remembers now.
    fn of(run: &Run, scene: &Resolved) -> Self {
        Self {
            scene: scene.decisive(),
            march: run.state(),
            fluid: run.first().state(),
            structure: run.second().state(),
        }
    }

    /// Puts `run` of `scene` where this state was taken.
    fn restore(&self, run: &mut Run, scene: &Resolved) -> Result<(), RunError> {
        let now = scene.decisive();
        if let Some((then, now)) = self.scene.lines().zip(now.lines()).find(|(then, now)| then != now) {
            return Err(RunError::Misfit(format!("`{}` is now `{}`", then.trim(), now.trim())));
        }
        let misfit = |error: &dyn Error| RunError::Misfit(error.to_string());
        run.restore(&self.march).map_err(|error| misfit(&error))?;
        let (fluid, structure) = run.participants_mut();
        fluid.restore(&self.fluid).map_err(|error| misfit(&error))?;
        structure.restore(&self.structure).map_err(|error| misfit(&error))
    }
}

/// Passes what happens inside a step on to files and watcher; keeps the first refusal for after the step.
struct Scribe<'a> {
    writer: &'a mut RunWriter,
    watcher: &'a mut dyn Watcher,
    refused: Option<OutputError>,
}

impl Scribe<'_> {
    /// Writes, unless the folder has refused before: behind half a line nothing can be read.
    fn write(&mut self, write: impl FnOnce(&mut RunWriter) -> Result<(), OutputError>) {
        if self.refused.is_none() {
            self.refused = write(self.writer).err();
        }
    }
}

impl Observer for Scribe<'_> {
    fn iteration(&mut self, record: &IterationRecord) {
        self.write(|writer| writer.iteration(record));
        self.watcher.iteration(record);
    }

    fn step_finished(&mut self, record: &StepRecord) {
        self.write(|writer| writer.step(record));
    }

    fn step_retried(&mut self, record: &RetryRecord) {
        self.write(|writer| writer.retry(record));
        self.watcher.retried(record);
    }
}
