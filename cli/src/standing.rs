//! Whether a run that is to be resumed has anything left to do.

use std::fmt;
use std::fs;
use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};

use partita::checkpoint::CheckpointError;
use partita::output::{self, Ending, Summary};
use partita::scene::Resolved;
use partita::session::{self, RunError};
use partita_numerics::time::shown;

/// A run with no step left to make.
#[derive(Debug)]
pub(crate) enum Standing {
    /// All steps of its scene are done.
    Complete {
        dir: PathBuf,
        steps: usize,
        time: f64,
        /// Whether it could go on.
        has_checkpoint: bool,
    },
    /// All steps that were asked for are done.
    Reached { dir: PathBuf, asked: usize, done: usize, steps: usize },
}

/// Looks at the folder of a run. Nothing is said of one whose last session did not end by itself: it still has to write its
/// summary.
pub(crate) fn nothing_left(
    resolved: &Resolved,
    dir: &Path,
    asked: Option<NonZeroUsize>,
) -> Result<Option<Standing>, RunError> {
    let Some(summary) = summary(dir) else { return Ok(None) };
    let time = &resolved.scene.time;
    let steps = time.steps.get();
    let completed = summary.ending == Ending::Completed;
    let (done, has_checkpoint) = match session::steps_done(resolved, dir) {
        Ok(done) => (done, true),
        Err(RunError::Checkpoint(CheckpointError::Missing { .. })) if completed && summary.steps >= steps => {
            (steps, false)
        }
        Err(error) => return Err(error),
    };
    let dir = dir.to_owned();
    if completed && done >= steps {
        let time = steps as f64 * time.step.get();
        return Ok(Some(Standing::Complete { dir, steps, time, has_checkpoint }));
    }
    let reached = asked.map(NonZeroUsize::get).filter(|asked| *asked <= done);
    Ok(reached.map(|asked| Standing::Reached { dir, asked, done, steps }))
}

fn summary(dir: &Path) -> Option<Summary> {
    serde_json::from_str(&fs::read_to_string(dir.join(output::SUMMARY)).ok()?).ok()
}

impl fmt::Display for Standing {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Complete { dir, steps, time, has_checkpoint } => {
                let (dir, time) = (dir.display(), shown(*time));
                write!(
                    f,
                    "the run in {dir} is complete: all {steps} steps are done, to t = {time} s\nhint: "
                )?;
                if *has_checkpoint {
                    write!(
                        f,
                        "to go further, raise `time.steps` in {dir}/{} and resume it again",
                        output::SCENE
                    )
                } else {
                    write!(
                        f,
                        "it holds no checkpoint to go further from; run the scene again with more `time.steps`"
                    )
                }
            }
            Self::Reached { dir, asked, done, steps } => write!(
                f,
                "the run in {} has {done} of {steps} steps behind it, so that --steps {asked} asks for nothing\nhint: --steps \
                 counts from the first step of the scene; leave it out to go to the end",
                dir.display()
            ),
        }
    }
}
