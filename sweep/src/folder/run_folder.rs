//! The folder of a run in progress.

use std::fs::{self, File};
use std::io::ErrorKind;
use std::path::{Path, PathBuf};

use partita::checkpoint;
use partita::lock::Locked;

use super::{files, open_lock, refused};
use crate::error::SweepError;
use crate::result::RunResult;
use crate::sweep::Run;

/// How far a run is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum State {
    /// It has ended well.
    Finished,
    /// It has ended early; its result says why.
    Failed,
    /// A process works on it.
    Running,
    /// Nobody works on it, but it goes on from a checkpoint.
    Interrupted,
    /// Nothing is there yet.
    Missing,
}

impl State {
    /// As tables have it.
    #[must_use]
    pub fn word(self) -> &'static str {
        match self {
            Self::Finished => "finished",
            Self::Failed => "failed",
            Self::Running => "running",
            Self::Interrupted => "interrupted",
            Self::Missing => "missing",
        }
    }
}

/// How far a run without a result is. Where locks are not seen from other machines, one that runs there may look interrupted.
pub(super) fn state(folder: &Path) -> State {
    let running = File::open(folder.join(files::LOCK)).is_ok_and(|lock| Locked::share(lock).is_err());
    if running {
        State::Running
    } else if folder.join(checkpoint::LATEST).exists() {
        State::Interrupted
    } else {
        State::Missing
    }
}

/// What came of taking a run on.
#[derive(Debug)]
pub(crate) enum Claim {
    /// It has a result.
    Finished,
    /// Another process works on it.
    Taken,
    /// It is the caller's.
    Mine(RunFolder),
}

/// The folder of a run, under its lock.
#[derive(Debug)]
pub(crate) struct RunFolder {
    path: PathBuf,
    result: PathBuf,
    lock: Locked,
}

/// Another process may remove the folder between two calls; it does that once for each run.
const ATTEMPTS: usize = 10;

impl RunFolder {
    /// Takes the folder of a run below `runs`, unless another process has.
    pub(super) fn take(runs: &Path, run: &Run) -> Result<Option<Self>, SweepError> {
        let path = runs.join(&run.fingerprint);
        let lock = path.join(files::LOCK);
        let mut attempt = 1;
        let file = loop {
            fs::create_dir_all(&path).map_err(refused(&path))?;
            match open_lock(&lock) {
                Ok(file) => break file,
                Err(error) if error.kind() == ErrorKind::NotFound && attempt < ATTEMPTS => attempt += 1,
                Err(error) => return Err(refused(&lock)(error)),
            }
        };
        let result = runs.join(format!("{}.json", run.fingerprint));
        Ok(Locked::take(file).ok().map(|lock| Self { path, result, lock }))
    }

    pub(crate) fn path(&self) -> &Path {
        &self.path
    }

    /// Keeps the result of the run, and removes what was needed to get there.
    pub(crate) fn finish(self, result: &RunResult) -> Result<(), SweepError> {
        let text = serde_json::to_string(result).expect("a result is plain data") + "\n";
        let part = self.path.join(files::RESULT);
        fs::write(&part, text).and_then(|()| fs::rename(&part, &self.result)).map_err(|source| {
            let _ = fs::remove_file(&part);
            SweepError::Write { path: self.result.clone(), source }
        })?;
        self.remove();
        Ok(())
    }

    /// Gives the run up, whose checkpoint stays where there is one.
    pub(crate) fn leave(self) {
        if self.path.join(checkpoint::LATEST).exists() {
            return;
        }
        self.remove();
    }

    /// Removes the files that a run leaves here, and the folder if it is empty then. That it is not is no failure: the next who
    /// takes the run on finds the result.
    pub(super) fn remove(self) {
        let Self { path, lock, .. } = self;
        for name in checkpoint::FILES.into_iter().chain([files::RESULT, files::LOCK]) {
            let _ = fs::remove_file(path.join(name));
        }
        // A network file system keeps a file that is open under another name.
        drop(lock);
        let _ = fs::remove_dir(&path);
    }
}
