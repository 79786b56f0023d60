//! A run: fields that are coupled or alone, stepped from the start or from a checkpoint to the end.

mod build;
mod error;
mod folder;
mod state;

use std::path::{Path, PathBuf};

use partita_coupling::{Clock, CouplingSettings, Participant, StepSizes};
use partita_fluid::FluidSolver;
use partita_structure::StructureSolver;
use serde_json::json;

pub use error::RunError;
pub use state::RunState;

use crate::checkpoint::{self, Stamp};
use crate::couple::FieldMarch;
use crate::draw::Drawing;
use crate::output::{self, Columns, DESCRIPTION, Ending, RunWriter, Spent, Summary};
use crate::probe::Named;
use crate::watch::Watcher;
use folder::{Folder, Scribe};
use partita_scene::Input;

/// A run of two coupled fields, of two fields coupled one way, or of one field alone.
///
/// It is made of solvers ([`couple`](Self::couple), [`one_way`](Self::one_way), [`fluid_alone`](Self::fluid_alone),
/// [`structure_alone`](Self::structure_alone)) or of a scene ([`of`](Self::of)); methods `with_...` add what differs from the
/// defaults. [`step`](Self::step) then makes one step after the other. Without a folder ([`with_output`](Self::with_output))
/// nothing is written. The crate's page has a whole program.
///
/// No bit of a run's numbers depends on what is read off or written, nor on whether it was resumed on the way.
pub struct Run {
    march: FieldMarch,
    /// The choices of a coupled run.
    settings: Option<CouplingSettings>,
    time: Option<Time>,
    probes: Vec<Named>,
    plan: Plan,
    folder: Option<Folder>,
    /// The scene as far as it decides about the numbers of a step; empty without a scene.
    scene: String,
}

/// The steps of a run.
#[derive(Debug, Clone, Copy)]
struct Time {
    steps: usize,
    dt: f64,
    sizes: StepSizes,
}

/// What is written where, and when.
#[derive(Debug, Clone)]
struct Plan {
    dir: Option<PathBuf>,
    fields_every: usize,
    checkpoint_every: usize,
    subdivisions: usize,
}

impl Run {
    /// Makes the next step; `false` if the run was at its end already.
    ///
    /// The fields, probes and checkpoints that are due are written. With the end comes the summary. A step that fails leaves
    /// its iterations, the fields and a checkpoint before it in the folder.
    ///
    /// # Errors
    /// If the run has no time step, the step cannot be solved, or the folder cannot be written.
    ///
    /// # Panics
    /// If a probe returns more or fewer values than it has columns.
    pub fn step(&mut self) -> Result<bool, RunError> {
        self.step_watched(&mut ())
    }

    /// The same, with somebody to report to.
    ///
    /// # Errors
    /// As [`step`](Self::step).
    ///
    /// # Panics
    /// As [`step`](Self::step).
    pub fn step_watched(&mut self, watcher: &mut dyn Watcher) -> Result<bool, RunError> {
        let time = self.time.ok_or(RunError::NoTimeStep)?;
        self.open()?;
        if time.sizes.done(&self.clock()) >= time.steps {
            self.end(Ending::Completed)?;
            return Ok(false);
        }
        match self.advance(&time.sizes, watcher) {
            Ok(()) => Ok(true),
            Err(error @ RunError::Step(_)) => Err(self.give_up(error, watcher)),
            Err(error) => Err(self.break_off(error)),
        }
    }

    fn advance(&mut self, sizes: &StepSizes, watcher: &mut dyn Watcher) -> Result<(), RunError> {
        let mut scribe = Scribe::new(self.folder.as_mut(), watcher);
        let result = self.march.step_or_halve(sizes, &mut scribe);
        if let Some(refused) = scribe.refused {
            return Err(refused.into());
        }
        let step = result?.step;
        self.look();
        let clock = self.clock();
        if let Some(folder) = &mut self.folder {
            let values: Vec<f64> = self.probes.iter().flat_map(|probe| &probe.latest).copied().collect();
            folder.writer.probes(step, clock.time, &values)?;
        }
        let (done, on_grid) = (sizes.done(&clock), sizes.on_grid(&clock));
        watcher.reaches(done);
        let due = |every: usize| every > 0 && on_grid && done.is_multiple_of(every);
        if due(self.plan.fields_every) {
            self.draw()?;
        }
        if due(self.plan.checkpoint_every) {
            self.save_in_folder()?;
        }
        Ok(())
    }

    /// Lets every probe see the committed state.
    fn look(&mut self) {
        let mut probes = std::mem::take(&mut self.probes);
        for Named { name, probe, latest } in &mut probes {
            *latest = probe.values(self);
            let columns = probe.columns().len();
            assert_eq!(latest.len(), columns, "probe `{name}` has a value for each of its columns");
        }
        self.probes = probes;
    }

    /// What the probe of this name saw at the end of the last step; `None` if there is no such probe, or no step yet.
    #[must_use]
    pub fn probe(&self, name: &str) -> Option<&[f64]> {
        let named = self.probes.iter().find(|named| named.name == name)?;
        (!named.latest.is_empty()).then_some(&*named.latest)
    }

    /// The fluid's solver, if the run has one.
    #[must_use]
    pub fn fluid(&self) -> Option<&FluidSolver<2>> {
        self.march.first().field()
    }

    /// The structure's solver, if the run has one.
    #[must_use]
    pub fn structure(&self) -> Option<&StructureSolver<2>> {
        self.march.second().field()
    }

    /// The time reached, and the number of accepted steps.
    #[must_use]
    pub fn clock(&self) -> Clock {
        self.march.clock()
    }

    /// Steps of the run's grid that are done; if some were halved, more steps were made.
    #[must_use]
    pub fn done(&self) -> usize {
        self.time.map_or(self.clock().steps, |time| time.sizes.done(&self.clock()))
    }

    /// The coupled fields: vectors at the interface, the history of the last step.
    #[must_use]
    pub fn march(&self) -> &FieldMarch {
        &self.march
    }

    /// The coupled fields without the run around them.
    #[must_use]
    pub fn into_march(self) -> FieldMarch {
        self.march
    }

    /// Writes the fields as they are now into the run's folder, unless they are there already.
    ///
    /// # Errors
    /// If the run has no folder, or the system refuses.
    pub fn write_fields(&mut self) -> Result<(), RunError> {
        self.open()?;
        if self.folder.is_none() {
            return Err(RunError::NoFolder);
        }
        Ok(self.draw()?)
    }

    /// Writes everything the run remembers into one file, from which an equal run can [`resume`](Self::resume) bit for bit.
    ///
    /// # Errors
    /// If the system refuses.
    pub fn save(&mut self, path: impl AsRef<Path>) -> Result<(), RunError> {
        let stamp = self.stamp()?;
        Ok(checkpoint::save_file(path.as_ref(), &stamp, &self.state())?)
    }

    /// Continues from a file that [`save`](Self::save) wrote, or from the latest checkpoint in the folder of a run.
    ///
    /// If this run writes to a folder, it must be that of the saved run: what was written after the checkpoint is dropped.
    ///
    /// # Errors
    /// If the file is not whole, belongs to another run, or the folder does not fit it. The run is of no use then.
    pub fn resume(&mut self, path: impl AsRef<Path>) -> Result<(), RunError> {
        let path = path.as_ref();
        let (stamp, state) = if path.is_dir() {
            let checkpoint = checkpoint::load::<RunState>(path)?;
            (checkpoint.stamp, checkpoint.state)
        } else {
            checkpoint::load_file(path)?
        };
        self.restore(&state)?;
        if let Some(dir) = self.plan.dir.clone() {
            self.resume_folder(&dir, &stamp, output::Clock::start())?;
        }
        Ok(())
    }

    /// Ends the run here: writes the checkpoint that is due, and the summary.
    ///
    /// # Errors
    /// If the folder cannot be written.
    pub(crate) fn end(&mut self, ending: Ending) -> Result<Option<Summary>, RunError> {
        if let Err(error) = self.save_if_wanted() {
            return Err(self.break_off(error));
        }
        let finished = self.folder.as_mut().map(|folder| folder.writer.finish(ending)).transpose()?;
        Ok(finished)
    }

    /// Starts the folder, if there is to be one.
    fn open(&mut self) -> Result<(), RunError> {
        let Some(dir) = self.plan.dir.clone().filter(|_| self.folder.is_none()) else { return Ok(()) };
        let text = serde_json::to_string_pretty(&json!({
            "fields": self.field_names(),
            "steps": self.time.map(|time| time.steps),
            "step_size": self.time.map(|time| time.dt),
            "accelerator": self.march.accelerator().name(),
            "coupling": self.settings,
        }));
        let text = text.expect("settings are plain data") + "\n";
        self.start_folder(&dir, (DESCRIPTION, &text), &[], output::Clock::start())
    }

    /// Starts the folder of a new run with what says what is run, copies of its input, and the fields at the start.
    pub(crate) fn start_folder(
        &mut self,
        dir: &Path,
        description: (&str, &str),
        inputs: &[Input],
        clock: output::Clock,
    ) -> Result<(), RunError> {
        let mut writer = RunWriter::create_with(dir, description, &self.columns(), clock)?;
        writer.keep(inputs)?;
        self.folder = Some(Folder::new(writer, self.drawing(), None));
        if self.plan.fields_every > 0 {
            self.draw()?;
        }
        Ok(())
    }

    pub(crate) fn resume_folder(
        &mut self,
        dir: &Path,
        stamp: &Stamp,
        clock: output::Clock,
    ) -> Result<(), RunError> {
        let writer = RunWriter::resume_with(dir, stamp, &self.columns(), clock)?;
        self.folder = Some(Folder::new(writer, self.drawing(), Some(stamp.step)));
        Ok(())
    }

    pub(crate) fn drawing(&self) -> Drawing {
        Drawing::new(&self.march, self.plan.subdivisions)
    }

    pub(crate) fn checkpoint_every(&self) -> usize {
        self.plan.checkpoint_every
    }

    /// Names of the two fields.
    fn field_names(&self) -> [String; 2] {
        [self.march.first().name().to_owned(), self.march.second().name().to_owned()]
    }

    fn columns(&self) -> Columns {
        let probes = self.probes.iter().flat_map(Named::columns).collect();
        Columns { fields: self.field_names(), probes }
    }

    fn stamp(&mut self) -> Result<Stamp, RunError> {
        let clock = self.clock();
        match &mut self.folder {
            Some(folder) => Ok(folder.writer.stamp(clock.steps, clock.time)?),
            None => Ok(Stamp { step: clock.steps, time: clock.time, spent: Spent::default() }),
        }
    }
}
