//! One more period of a finished level, with fields to look at.

use std::path::{Path, PathBuf};
use std::process::Command;

use super::case::Case;
use super::signals::Samples;
use crate::task::{TaskError, captured, read, run, write};

/// Pictures of a period.
const FRAMES: usize = 40;

/// Copies the run in `dir` beside it, goes on from its checkpoint for one period and writes fields: `fields/*.pvd` of the copy
/// opens in `ParaView`. The run itself stays what it is.
///
/// # Errors
/// When the level has no period, or the copy cannot be made or run.
pub(super) fn period(
    binary: &Path,
    case: &Case,
    dir: &Path,
    samples: Option<&Samples>,
) -> Result<PathBuf, TaskError> {
    let nothing =
        || TaskError::Failed(format!("{}: nothing in it swings, so there is no period to draw", case.name));
    // The time of the first sample is about minus one period before the last one begins.
    let times = samples.and_then(|samples| samples.get("time")).ok_or_else(nothing)?;
    let steps = times.iter().filter(|&&time| time < 0.0).count();
    let copy =
        dir.with_file_name(format!("{}-period", dir.file_name().unwrap_or_default().to_string_lossy()));
    duplicate(dir, &copy)?;
    let scene = copy.join("scene.toml");
    let done = done(&copy)?;
    write(&scene, &with_fields(&read(&scene)?, done + steps, (steps / FRAMES).max(1)))?;
    let mut command = Command::new(binary);
    command.arg("resume").arg(&copy).arg("--quiet");
    run(command)?;
    Ok(copy)
}

/// Steps of the run in a folder.
fn done(dir: &Path) -> Result<usize, TaskError> {
    let summary = read(&dir.join("summary.json"))?;
    let summary: serde_json::Value = serde_json::from_str(&summary)
        .map_err(|error| TaskError::Failed(format!("{}: {error}", dir.display())))?;
    let steps = summary["steps"].as_u64().and_then(|steps| usize::try_from(steps).ok());
    steps.ok_or_else(|| TaskError::Failed(format!("{}: the summary has no steps", dir.display())))
}

/// The resolved scene with another end and with files of fields.
fn with_fields(scene: &str, steps: usize, every: usize) -> String {
    let line = |line: &str| {
        if line.starts_with("steps = ") {
            format!("steps = {steps}\n")
        } else if line.starts_with("fields_every = ") {
            format!("fields_every = {every}\n")
        } else {
            format!("{line}\n")
        }
    };
    scene.lines().map(line).collect()
}

fn duplicate(from: &Path, to: &Path) -> Result<(), TaskError> {
    if to.exists() {
        std::fs::remove_dir_all(to).map_err(|source| TaskError::File { path: to.to_owned(), source })?;
    }
    let mut command = Command::new("cp");
    command.arg("-r").arg(from).arg(to);
    captured(command).map(drop)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_the_end_and_the_fields_of_a_scene_change() {
        let scene =
            "[time]\nstep = 0.002\nsteps = 100\n\n[output]\nfields_every = 0\ncheckpoint_every = 200\n";
        let expected =
            "[time]\nstep = 0.002\nsteps = 145\n\n[output]\nfields_every = 2\ncheckpoint_every = 200\n";
        assert_eq!(with_fields(scene, 145, 2), expected);
    }
}
