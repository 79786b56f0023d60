//! Copies of the files that a scene names, so that a run's folder needs nothing else.

use std::fs;
use std::path::Path;

use super::OutputError;
use super::fields::remove_if_there;
use partita_scene::{INPUT_FILES, INPUT_FOLDER, Input};

/// Writes the copies; no folder when there are none.
pub(super) fn keep(dir: &Path, inputs: &[Input]) -> Result<(), OutputError> {
    let folder = dir.join(INPUT_FOLDER);
    for input in inputs {
        let path = folder.join(input.name);
        let written = fs::create_dir_all(&folder).and_then(|()| fs::write(&path, &input.bytes));
        written.map_err(|source| OutputError::Write { path, source })?;
    }
    Ok(())
}

/// Whether a run writes a copy of that name.
pub(super) fn is_ours(name: &str) -> bool {
    INPUT_FILES.contains(&name)
}

/// Removes the copies and their folder.
pub(super) fn remove_all(dir: &Path) -> Result<(), OutputError> {
    let folder = dir.join(INPUT_FOLDER);
    for name in INPUT_FILES {
        remove_if_there(&folder.join(name))?;
    }
    // A folder that holds something else stays.
    let _ = fs::remove_dir(&folder);
    Ok(())
}
