//! What a run writes on its way, and what it leaves behind if it fails.

use partita_coupling::{IterationRecord, Observer, RetryRecord, StepRecord};

use super::{Run, RunError};
use crate::checkpoint;
use crate::draw::Drawing;
use crate::output::{OutputError, RunWriter};
use crate::watch::Watcher;

/// The folder of a run.
pub(super) struct Folder {
    pub(super) writer: RunWriter,
    drawing: Drawing,
    /// The step of the last checkpoint in it.
    saved: Option<usize>,
}

impl Folder {
    pub(super) fn new(writer: RunWriter, drawing: Drawing, saved: Option<usize>) -> Self {
        Self { writer, drawing, saved }
    }
}

impl Run {
    /// Draws the committed state, unless that is there already.
    pub(super) fn draw(&mut self) -> Result<(), OutputError> {
        let clock = self.clock();
        let Some(Folder { writer, drawing, .. }) = &mut self.folder else { return Ok(()) };
        if writer.shows(clock.time) {
            return Ok(());
        }
        drawing.write(&self.march, writer, clock.steps, clock.time)
    }

    pub(super) fn save_in_folder(&mut self) -> Result<(), RunError> {
        if self.folder.is_none() {
            return Ok(());
        }
        let (stamp, state) = (self.stamp()?, self.state());
        let Some(folder) = &mut self.folder else { return Ok(()) };
        checkpoint::save(folder.writer.dir(), &stamp, &state)?;
        folder.saved = Some(stamp.step);
        Ok(())
    }

    pub(super) fn save_if_wanted(&mut self) -> Result<(), RunError> {
        // A second one of the same step would push the one before out of the folder.
        let steps = self.clock().steps;
        let fresh = self.folder.as_ref().is_some_and(|folder| folder.saved != Some(steps));
        if self.plan.checkpoint_every > 0 && fresh { self.save_in_folder() } else { Ok(()) }
    }

    /// Writes what a failed step leaves: the fields and the checkpoint before it, and the summary. What cannot be written
    /// is said, but the step's error is the one that counts.
    pub(super) fn give_up(&mut self, error: RunError, watcher: &mut dyn Watcher) -> RunError {
        let drawn = self.draw().map_err(RunError::from);
        let saved = self.save_if_wanted();
        let summed = self.sum_up_failure(&error);
        for lost in [drawn, saved, summed].into_iter().filter_map(Result::err) {
            watcher.note(&format!("warning: {lost}"));
        }
        error
    }

    /// The folder takes no more: says where the run can be resumed. The files are left as they are, for a later checkpoint
    /// would be ahead of them.
    pub(super) fn break_off(&mut self, error: RunError) -> RunError {
        let clock = self.clock();
        let Some(folder) = &self.folder else { return error };
        let error = RunError::Storage {
            step: clock.steps,
            time: clock.time,
            dir: folder.writer.dir().to_owned(),
            checkpoint: folder.saved,
            source: Box::new(error),
        };
        // A small file may still fit; that it does not is no news.
        let _ = self.sum_up_failure(&error);
        error
    }

    fn sum_up_failure(&mut self, error: &RunError) -> Result<(), RunError> {
        if let Some(folder) = &mut self.folder {
            folder.writer.fail(error.to_string())?;
        }
        Ok(())
    }
}

/// Passes what happens inside a step on to files and watcher; keeps the first refusal for after the step.
pub(super) struct Scribe<'a> {
    writer: Option<&'a mut RunWriter>,
    watcher: &'a mut dyn Watcher,
    pub(super) refused: Option<OutputError>,
}

impl<'a> Scribe<'a> {
    pub(super) fn new(folder: Option<&'a mut Folder>, watcher: &'a mut dyn Watcher) -> Self {
        Self { writer: folder.map(|folder| &mut folder.writer), watcher, refused: None }
    }

    /// Writes, unless the folder has refused before: behind half a line nothing can be read.
    fn write(&mut self, write: impl FnOnce(&mut RunWriter) -> Result<(), OutputError>) {
        if let Some(writer) = self.writer.as_deref_mut().filter(|_| self.refused.is_none()) {
            self.refused = write(writer).err();
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
