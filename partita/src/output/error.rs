//! What can go wrong with an output folder.

use std::io;
use std::path::PathBuf;

use partita_mesh::vtu::VtuError;

use super::space::{Estimate, size};

/// Why a run's output cannot be written or taken up again.
#[derive(Debug, thiserror::Error, miette::Diagnostic)]
pub enum OutputError {
    /// The system refuses to write.
    #[error("cannot write {path}: {source}", path = path.display())]
    #[diagnostic(help("check the folder's permissions and the space left"))]
    Write {
        /// The file or folder.
        path: PathBuf,
        /// What the system says.
        source: io::Error,
    },
    /// The system refuses to read.
    #[error("cannot read {path}: {source}", path = path.display())]
    #[diagnostic(help("give the output folder of a run"))]
    Read {
        /// The file or folder.
        path: PathBuf,
        /// What the system says.
        source: io::Error,
    },
    /// The disk has less space than the run will fill.
    #[error("the run will write about {} to {dir}, where {} are free (fields {}, records and tables {}, checkpoints {})", size(estimate.total()), size(*free), size(estimate.fields), size(estimate.records), size(estimate.checkpoints), dir = dir.display())]
    #[diagnostic(help(
        "write fields less often (output.fields_every), make space, or choose another folder with --out"
    ))]
    NoSpace {
        /// The folder.
        dir: PathBuf,
        /// What the run will write.
        estimate: Estimate,
        /// Bytes that are free.
        free: u64,
    },
    /// The folder is in use.
    #[error("{dir} is not empty", dir = dir.display())]
    #[diagnostic(help(
        "choose another folder with --out; --force replaces an earlier run, never other files"
    ))]
    Occupied {
        /// The folder.
        dir: PathBuf,
    },
    /// The folder of a run holds something else too.
    #[error("{path} is not of a run; nothing was removed", path = path.display())]
    #[diagnostic(help("move it away, or choose another folder with --out"))]
    Foreign {
        /// The file or folder.
        path: PathBuf,
    },
    /// Another process writes there.
    #[error("{path} is being written by another run", path = path.display())]
    #[diagnostic(help("wait for it, or choose another folder with --out"))]
    InUse {
        /// The file.
        path: PathBuf,
    },
    /// A line is not what a run writes.
    #[error("{path}:{line}: {reason}", path = path.display())]
    #[diagnostic(help("the file was changed after the run wrote it, or by another version of Partita"))]
    Corrupt {
        /// The file.
        path: PathBuf,
        /// Its line, counted from 1.
        line: usize,
        /// What is wrong.
        reason: String,
    },
    /// A file lacks steps that the checkpoint has behind it.
    #[error("{path} ends before step {step}, the step of the checkpoint", path = path.display())]
    #[diagnostic(help("the file was cut; resume from an earlier checkpoint or start anew"))]
    Cut {
        /// The file.
        path: PathBuf,
        /// The checkpoint's step.
        step: usize,
    },
    /// A field file or its collection.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Fields(#[from] VtuError),
}

impl OutputError {
    /// Whether the folder did not take a file, so that another folder helps.
    #[must_use]
    pub fn is_refused_write(&self) -> bool {
        matches!(self, Self::Write { .. } | Self::Fields(VtuError::Write { .. }))
    }
}
