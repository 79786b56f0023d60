//! Who makes the runs of a sweep: this process, or a batch system.

pub(crate) mod slurm;
pub(crate) mod threads;

use std::path::Path;

use partita::output::table::Table;
use partita::watch::Watcher;

use crate::error::SweepError;
use crate::folder::{Access, Folder, State};
use crate::sweep::{Kind, Run, Sweep};

/// Takes care that runs are made. A run that fails does not keep the others from being made.
pub trait Executor {
    /// Whether the processor time of a run is that of the run alone: only then it is measured.
    fn measures_time(&self) -> bool;

    /// Makes these runs of the sweep, or hands them on to who will.
    ///
    /// # Errors
    /// When the folder cannot be written, or nobody takes the runs. What goes wrong in a run is its result.
    fn execute(
        &mut self,
        sweep: &Sweep,
        folder: &Folder,
        runs: &[&Run],
        watcher: &mut dyn Watcher,
    ) -> Result<Executed, SweepError>;
}

/// What an executor did.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Executed {
    /// Whether it was stopped before all runs were made.
    pub interrupted: bool,
    /// Runs that another process had taken on.
    pub elsewhere: usize,
    /// Jobs that were submitted: what they are called, and how many runs they make.
    pub submitted: Vec<(String, usize)>,
}

/// Which runs are to be made, and in which folder.
#[derive(Debug, Clone, Copy)]
pub struct Order<'a> {
    /// The output folder.
    pub dir: &'a Path,
    /// Remove what an earlier sweep has left there, first.
    pub force: bool,
    /// One run, by its index, and the fingerprint that it must have; or all.
    pub only: Option<(usize, Option<&'a str>)>,
}

impl Sweep {
    /// Makes the runs that have no result yet.
    ///
    /// # Errors
    /// As [`Executor::execute`]; when the folder is not that of this sweep, or in use; when the run that errors are measured
    /// against fails.
    pub fn execute(
        &self,
        order: Order<'_>,
        executor: &mut dyn Executor,
        watcher: &mut dyn Watcher,
    ) -> Result<Executed, SweepError> {
        let wanted = self.chosen(order.only)?;
        let alone = self.wants_seconds() && executor.measures_time();
        let access = if alone { Access::Alone } else { Access::Shared };
        let folder = Folder::open(order.dir, self, access, order.force)?;
        let missing = missing(&folder, wanted);
        let executed = executor.execute(self, &folder, &missing, watcher);
        if let (Err(SweepError::Reference { .. }), true) = (&executed, alone && folder.is_new()) {
            folder.remove();
        }
        executed
    }

    /// How far each run is, as the folder tells.
    ///
    /// # Errors
    /// When the folder is another's.
    pub fn states(&self, dir: &Path) -> Result<Vec<State>, SweepError> {
        match Folder::look(dir, self) {
            Ok(folder) => Ok(self.runs.iter().map(|run| folder.state(run)).collect()),
            Err(SweepError::Nothing { .. }) => Ok(vec![State::Missing; self.runs.len()]),
            Err(error) => Err(error),
        }
    }

    /// A row for each run: index, settings, fingerprint, and how far it is.
    #[must_use]
    pub fn table(&self, states: &[State]) -> Table {
        let mut table = Table::new(["run", "settings", "fingerprint", "state"]);
        for (run, state) in self.runs.iter().zip(states) {
            let fingerprint = run.fingerprint.as_str().into();
            table.push([run.index.into(), run.label().into(), fingerprint, state.word().into()]);
        }
        table
    }

    fn chosen(&self, only: Option<(usize, Option<&str>)>) -> Result<&[Run], SweepError> {
        let Some((index, fingerprint)) = only else { return Ok(&self.runs) };
        let sweep = self.is_called();
        let Some(run) = self.runs.get(index) else {
            return Err(SweepError::NoSuchRun { index, sweep, runs: self.runs.len() });
        };
        match fingerprint.filter(|wanted| *wanted != run.fingerprint) {
            Some(wanted) => {
                let (found, wanted) = (run.fingerprint.clone(), wanted.to_owned());
                Err(SweepError::Changed { index, sweep, found, wanted })
            }
            None => Ok(&self.runs[index..=index]),
        }
    }

    /// What is said when this run has its result.
    fn line(&self, folder: &Folder, run: &Run) -> Option<String> {
        match &self.kind {
            Kind::Map(_) => None,
            Kind::Study(study) => {
                study.line(&self.name, run.index, &|index| folder.result(&self.runs[index]))
            }
        }
    }

    /// Fails where this run has failed and all others are measured against it.
    fn check(&self, folder: &Folder, run: &Run) -> Result<(), SweepError> {
        match &self.kind {
            Kind::Study(study) if study.is_measured_against(run.index) => {
                study.truth(&|index| folder.result(&self.runs[index])).map(drop)
            }
            _ => Ok(()),
        }
    }
}

/// Those among the runs that have no result. Runs that set the same things are one.
fn missing<'a>(folder: &Folder, runs: &'a [Run]) -> Vec<&'a Run> {
    let mut missing: Vec<&Run> = Vec::new();
    for run in runs {
        let seen = missing.iter().any(|other| other.fingerprint == run.fingerprint);
        if !seen && folder.result(run).is_none() {
            missing.push(run);
        }
    }
    missing
}
