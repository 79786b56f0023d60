//! The folder of a sweep: runs that have ended stay so.
//!
//! | file | content |
//! |---|---|
//! | `study.toml` or `map.toml` | the sweep as it was read |
//! | `study.csv`, `study.svg`, or `cells.csv`, `map.svg` | table and picture |
//! | `runs/sweep.json` | which sweep it is |
//! | `runs/lock` | shared by those who work here, held alone by who measures times or replaces the results |
//! | `runs/<fingerprint>.json` | the result of a run, see [`RunResult`] |
//! | `runs/<fingerprint>/` | a run in progress: its lock, its checkpoints; removed once the result is there |
//! | `slurm/` | scripts and messages of job arrays |
//!
//! Every file appears by a rename, so that there is never half of one. A result is looked up by its name alone, never in a
//! listing, and one that cannot be read is not there yet: on a network file system both may lag behind. Two processes that do not
//! see each other at worst make the same run twice, with the same result.

mod files;
mod run_folder;

use std::fs::{self, File, OpenOptions};
use std::path::{Path, PathBuf};

use partita::lock::Locked;
use serde::{Deserialize, Serialize};

use crate::error::SweepError;
use crate::result::RunResult;
use crate::sweep::{Run, Sweep};

pub(crate) use files::SLURM;
pub use files::{CELLS, DIAGRAM, MAP, PICTURE, ROWS, RUNS, STUDY};
pub use run_folder::State;
pub(crate) use run_folder::{Claim, RunFolder};

/// Who may work in a folder meanwhile.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Access {
    /// Others that share it.
    Shared,
    /// Nobody.
    Alone,
}

/// `runs/sweep.json`.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
struct Head {
    kind: String,
    name: String,
    /// Of all runs together.
    fingerprint: String,
    runs: usize,
}

impl Head {
    fn of(sweep: &Sweep) -> Self {
        let Sweep { name, runs, .. } = sweep;
        let (kind, name) = (sweep.word().to_owned(), name.clone());
        Self { kind, name, fingerprint: sweep.fingerprint(), runs: runs.len() }
    }

    /// What the folder says, if it says it already.
    fn read(dir: &Path) -> Option<Self> {
        serde_json::from_str(&fs::read_to_string(dir.join(RUNS).join(files::HEAD)).ok()?).ok()
    }

    fn is_called(&self) -> String {
        format!("{} `{}`", self.kind, self.name)
    }
}

/// The folder of a sweep.
#[derive(Debug)]
pub struct Folder {
    dir: PathBuf,
    /// `None` where it is only looked at.
    lock: Option<Locked>,
    /// Whether it held no sweep before.
    is_new: bool,
}

impl Folder {
    /// Starts the folder of `sweep`, or goes on with it; `force` removes first what an earlier sweep has left there.
    pub(crate) fn open(dir: &Path, sweep: &Sweep, access: Access, force: bool) -> Result<Self, SweepError> {
        if force {
            files::refuse_foreign(dir)?;
        } else {
            refuse_another(dir, sweep)?;
        }
        let runs = dir.join(RUNS);
        fs::create_dir_all(&runs).map_err(refused(&runs))?;
        let path = runs.join(files::LOCK);
        let in_use = |_| SweepError::InUse { dir: dir.to_owned() };
        if force {
            let alone = Locked::take(open_lock(&path).map_err(refused(&path))?).map_err(in_use)?;
            files::remove_results(dir)?;
            drop(alone);
        }
        let file = open_lock(&path).map_err(refused(&path))?;
        let taken = if access == Access::Alone { Locked::take(file) } else { Locked::share(file) };
        let lock = taken.map_err(in_use)?;
        let (before, head) = (Head::read(dir), Head::of(sweep));
        let folder = Self { dir: dir.to_owned(), lock: Some(lock), is_new: before.is_none() };
        if before.is_some_and(|before| before != head) {
            // They were made of other results.
            files::remove_tables(dir)?;
        }
        let head = serde_json::to_string(&head).expect("a head is plain data") + "\n";
        folder.put(&format!("{RUNS}/{}", files::HEAD), &head)?;
        folder.put(if sweep.word() == "map" { MAP } else { STUDY }, &sweep.text)?;
        Ok(folder)
    }

    /// The folder of `sweep`, to be read.
    ///
    /// # Errors
    /// When it is another sweep's, or holds none.
    pub fn look(dir: &Path, sweep: &Sweep) -> Result<Self, SweepError> {
        refuse_another(dir, sweep)?;
        if !dir.join(RUNS).is_dir() {
            return Err(SweepError::Nothing { dir: dir.to_owned(), wanted: Head::of(sweep).is_called() });
        }
        Ok(Self { dir: dir.to_owned(), lock: None, is_new: false })
    }

    /// Where it is.
    #[must_use]
    pub fn dir(&self) -> &Path {
        &self.dir
    }

    /// Whether it held no sweep before it was opened.
    pub(crate) fn is_new(&self) -> bool {
        self.is_new
    }

    /// The result of a run, if it is there.
    #[must_use]
    pub fn result(&self, run: &Run) -> Option<RunResult> {
        let text = fs::read_to_string(self.dir.join(RUNS).join(format!("{}.json", run.fingerprint))).ok()?;
        let result: RunResult = serde_json::from_str(&text).ok()?;
        (result.fingerprint == run.fingerprint).then_some(result)
    }

    /// How far a run is.
    #[must_use]
    pub fn state(&self, run: &Run) -> State {
        match self.result(run) {
            Some(RunResult { failure: None, .. }) => State::Finished,
            Some(_) => State::Failed,
            None => run_folder::state(&self.dir.join(RUNS).join(&run.fingerprint)),
        }
    }

    /// Takes a run on, unless it has a result or another process has taken it on.
    pub(crate) fn claim(&self, run: &Run) -> Result<Claim, SweepError> {
        let taken = RunFolder::take(&self.dir.join(RUNS), run)?;
        Ok(match taken {
            taken if self.result(run).is_some() => {
                if let Some(folder) = taken {
                    folder.remove();
                }
                Claim::Finished
            }
            Some(folder) => Claim::Mine(folder),
            None => Claim::Taken,
        })
    }

    /// Removes everything that a sweep has written, the folder itself too if it is empty then.
    pub(crate) fn remove(self) {
        let Self { dir, lock, .. } = self;
        let _ = files::remove_results(&dir);
        drop(lock);
        let _ = fs::remove_file(dir.join(RUNS).join(files::LOCK));
        let _ = fs::remove_dir(dir.join(RUNS));
        let _ = fs::remove_dir(&dir);
    }

    /// Writes a file, or removes the one that is there.
    pub(crate) fn put_or_remove(&self, name: &str, text: Option<&str>) -> Result<(), SweepError> {
        let path = self.dir.join(name);
        match text {
            Some(text) => self.put(name, text),
            None => files::remove(&path).map_err(refused(&path)),
        }
    }

    /// Writes a whole file under another name and renames it: there is never half of one.
    pub(crate) fn put(&self, name: &str, text: &str) -> Result<(), SweepError> {
        let path = self.dir.join(name);
        if fs::read_to_string(&path).is_ok_and(|there| there == text) {
            return Ok(());
        }
        let part = files::part_of(&path);
        fs::write(&part, text).and_then(|()| fs::rename(&part, &path)).map_err(|source| {
            let _ = fs::remove_file(&part);
            SweepError::Write { path, source }
        })
    }
}

pub(crate) fn refused(path: &Path) -> impl FnOnce(std::io::Error) -> SweepError {
    let path = path.to_owned();
    move |source| SweepError::Write { path, source }
}

fn open_lock(path: &Path) -> std::io::Result<File> {
    OpenOptions::new().create(true).truncate(false).read(true).write(true).open(path)
}

/// Fails where the folder is not new, not empty, and not that of this sweep.
fn refuse_another(dir: &Path, sweep: &Sweep) -> Result<(), SweepError> {
    let wanted = Head::of(sweep);
    match Head::read(dir) {
        Some(head) if (&head.kind, &head.name) == (&wanted.kind, &wanted.name) => Ok(()),
        Some(head) => Err(SweepError::Another {
            dir: dir.to_owned(),
            other: head.is_called(),
            wanted: wanted.is_called(),
        }),
        // Others may just be starting it.
        None if files::holds_more_than_runs(dir) => Err(SweepError::Occupied { dir: dir.to_owned() }),
        None => Ok(()),
    }
}
