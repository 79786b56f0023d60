//! One more period of a finished level, with fields to look at.

use std::path::{Path, PathBuf};

use partita::output::{self, Summary};

use super::case::Case;
use super::signals::Samples;
use crate::runs::Runs;
use crate::task::{TaskError, files_of, folders_of, read, read_json, remove_folder, write};

/// Pictures of a period.
const FRAMES: usize = 40;

/// Copies the run in `dir` beside it, goes on from its checkpoint for one period and writes fields: `fields/*.pvd` of the copy
/// opens in `ParaView`. The run itself stays what it is.
///
/// # Errors
/// When the level has no period, or the copy cannot be made or run.
pub(super) fn period(
    runs: &Runs,
    case: &Case,
    dir: &Path,
    samples: Option<&Samples>,
) -> Result<PathBuf, TaskError> {
    let nothing =
        || TaskError::Failed(format!("{}: nothing in it swings, so there is no period to draw", case.name));
    // The time of the first sample is about minus one period before the last one begins.
    let times = samples.and_then(|samples| samples.get("time")).ok_or_else(nothing)?;
    let steps = times.iter().filter(|&&time| time < 0.0).count();
    let copy = dir.with_file_name("period");
    duplicate(dir, &copy)?;
    let scene = copy.join("scene.toml");
    let done = read_json::<Summary>(&copy.join(output::SUMMARY))?.steps;
    write(&scene, &with_fields(&read(&scene)?, done + steps, (steps / FRAMES).max(1)))?;
    runs.resume(&copy)?;
    Ok(copy)
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

/// Copies a folder of a run, which holds files and one level of folders.
fn duplicate(from: &Path, to: &Path) -> Result<(), TaskError> {
    remove_folder(to)?;
    for folder in [from.to_owned()].into_iter().chain(folders_of(from)?) {
        let into = to.join(folder.strip_prefix(from).unwrap_or(&folder));
        std::fs::create_dir_all(&into).map_err(|source| TaskError::File { path: into.clone(), source })?;
        for (name, bytes) in files_of(&folder)? {
            let path = into.join(name);
            std::fs::write(&path, bytes).map_err(|source| TaskError::File { path, source })?;
        }
    }
    Ok(())
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
