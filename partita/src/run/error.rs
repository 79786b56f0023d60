//! Why a run could not go on.

use std::path::{Path, PathBuf};

use partita_coupling::{SetupError, StepError};
use partita_numerics::time::shown;

use crate::checkpoint::CheckpointError;
use crate::error::BuildError;
use crate::output::OutputError;

/// Why a run could not go on.
#[derive(Debug, thiserror::Error, miette::Diagnostic)]
pub enum RunError {
    /// The run cannot be built.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Build(#[from] BuildError),
    /// The run was not told how long its steps are.
    #[error("the run has no time step")]
    #[diagnostic(help("say how many steps of which size it makes: `run.with_steps(100, 1e-3)`"))]
    NoTimeStep,
    /// Something is to be written, but nowhere.
    #[error("the run has no folder to write to")]
    #[diagnostic(help("name one: `run.with_output(\"out\")`"))]
    NoFolder,
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
    /// The saved state belongs to another run.
    #[error("the saved state does not fit this run: {0}")]
    #[diagnostic(help("build the run as it was when it saved that state, probes included"))]
    Foreign(String),
}

impl From<SetupError> for RunError {
    fn from(error: SetupError) -> Self {
        Self::Build(error.into())
    }
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
