//! Why a sweep cannot be carried out.

use std::fmt;
use std::io;
use std::path::PathBuf;

use miette::Diagnostic;
use partita::checkpoint::CheckpointError;
use thiserror::Error;

/// Why a sweep cannot be carried out. What goes wrong in one of its runs is no error, but the result of that run.
#[derive(Debug, Error)]
pub enum SweepError {
    /// The folder holds what no sweep has written.
    #[error("{path} is not of a sweep; nothing was removed", path = path.display())]
    Foreign {
        /// The file or folder.
        path: PathBuf,
    },
    /// The folder is not that of a sweep, or one of an earlier version wrote it.
    #[error("{dir} is not empty, and not the folder of a sweep", dir = dir.display())]
    Occupied {
        /// The folder.
        dir: PathBuf,
    },
    /// The folder is that of another sweep.
    #[error("{dir} holds the results of the {other}, not of the {wanted}", dir = dir.display())]
    Another {
        /// The folder.
        dir: PathBuf,
        /// Which sweep it is, such as "map `tank`".
        other: String,
        /// Which sweep was asked for.
        wanted: String,
    },
    /// Others work in the folder, and it is needed alone, or the reverse.
    #[error("{dir} is in use by another process", dir = dir.display())]
    InUse {
        /// The folder.
        dir: PathBuf,
    },
    /// The folder holds nothing of the sweep.
    #[error("{dir} holds no results of the {wanted}", dir = dir.display())]
    Nothing {
        /// The folder.
        dir: PathBuf,
        /// Which sweep was asked for.
        wanted: String,
    },
    /// The system refuses.
    #[error("cannot write {path}: {source}", path = path.display())]
    Write {
        /// The file or folder.
        path: PathBuf,
        /// What the system says.
        source: io::Error,
    },
    /// A checkpoint cannot be written.
    #[error("{}", first_line(.0))]
    Checkpoint(#[source] CheckpointError),
    /// The sweep has no such run.
    #[error("there is no run {index}: the {sweep} has {runs} runs, from 0 to {last}", last = runs - 1)]
    NoSuchRun {
        /// What was asked for.
        index: usize,
        /// Which sweep it is.
        sweep: String,
        /// How many it has.
        runs: usize,
    },
    /// The sweep is no longer the one whose run was asked for.
    #[error(
        "run {index} of the {sweep} has the fingerprint {found}, not {wanted}: file or scene were changed"
    )]
    Changed {
        /// Which run.
        index: usize,
        /// Which sweep it is.
        sweep: String,
        /// What it has now.
        found: String,
        /// What was asked for.
        wanted: String,
    },
    /// A run that every error is measured against has no result to measure against.
    #[error("{run}: {cause}")]
    Reference {
        /// Which run.
        run: String,
        /// What happened.
        cause: String,
    },
    /// Slurm does not take a job.
    #[error("{command}: {what}{}", submitted_before(.submitted))]
    Slurm {
        /// What was tried.
        command: String,
        /// What it said.
        what: String,
        /// Jobs that were submitted before.
        submitted: Vec<String>,
    },
}

impl SweepError {
    /// Whether the command line or the folder is at fault, and not a run.
    #[must_use]
    pub fn is_wrong_input(&self) -> bool {
        !matches!(self, Self::Checkpoint(_) | Self::Reference { .. } | Self::Slurm { .. })
    }

    fn remedy(&self) -> &'static str {
        match self {
            Self::Foreign { .. } => "move it away, or choose another folder with --out",
            Self::Occupied { .. } => {
                "choose another folder with --out; --force replaces what an earlier sweep has left, never other files"
            }
            Self::Another { .. } => "choose another folder with --out, or replace these results with --force",
            Self::InUse { .. } => {
                "wait for it, or choose another folder with --out; several processes share a folder as long as none of them \
                 measures times (`partita study`, `--jobs 1`) or replaces results (--force)"
            }
            Self::Nothing { .. } => "run it with `partita sweep run`, or name its folder with --out",
            Self::Write { .. } => {
                "name a folder that can be written, on a disk with space, with --out; finished runs are kept, and the same \
                 command goes on"
            }
            Self::Checkpoint(_) => {
                "check the folder's permissions and the space left; finished runs are kept, and the same command goes on"
            }
            Self::NoSuchRun { .. } => "`partita sweep plan` lists them",
            Self::Changed { .. } => {
                "submit it again with `partita sweep submit`: results whose runs did not change are kept"
            }
            Self::Reference { .. } => {
                "every error is measured against this run: choose settings for it, under [reference], with which the scene runs"
            }
            Self::Slurm { .. } => {
                "submit where Slurm's commands are on the PATH, with options that it takes; --dry-run prints the script, \
                 and the same command submits what is missing"
            }
        }
    }
}

fn first_line(error: &CheckpointError) -> String {
    error.to_string().lines().next().unwrap_or_default().to_owned()
}

fn submitted_before(jobs: &[String]) -> String {
    if jobs.is_empty() { String::new() } else { format!(" (submitted before that: {})", jobs.join(", ")) }
}

impl Diagnostic for SweepError {
    fn help<'a>(&'a self) -> Option<Box<dyn fmt::Display + 'a>> {
        Some(Box::new(self.remedy()))
    }
}
