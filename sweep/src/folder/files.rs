//! Which files a sweep writes, and their removal.

use std::fs;
use std::io::ErrorKind;
use std::path::{Path, PathBuf};

use partita::checkpoint;

use super::refused;
use crate::error::SweepError;

/// A study as it was read.
pub const STUDY: &str = "study.toml";
/// Its settings, one a row.
pub const ROWS: &str = "study.csv";
/// Its work-precision diagram.
pub const DIAGRAM: &str = "study.svg";
/// A map as it was read.
pub const MAP: &str = "map.toml";
/// Its cells, one a row.
pub const CELLS: &str = "cells.csv";
/// Its picture.
pub const PICTURE: &str = "map.svg";
/// The folder of results and of runs in progress.
pub const RUNS: &str = "runs";
/// The folder of job arrays.
pub(crate) const SLURM: &str = "slurm";
/// Which sweep it is.
pub(super) const HEAD: &str = "sweep.json";
/// Who works here.
pub(super) const LOCK: &str = "lock";
/// A result before it has its name.
pub(super) const RESULT: &str = "result.json";
/// What earlier versions of a map wrote.
const EARLIER: &str = "cells.jsonl";

/// The name of a file while it is being written.
pub(super) fn part_of(path: &Path) -> PathBuf {
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    path.with_file_name(format!(".{name}.{}.part", std::process::id()))
}

/// What stands where in the folder of a sweep.
#[derive(Clone, Copy)]
enum Place {
    Top,
    Runs,
    Run,
    Slurm,
}

/// What an entry of a place is.
enum Entry {
    Foreign,
    File,
    Folder(Place),
}

impl Place {
    /// What an entry of this name is.
    fn entry(self, name: &str) -> Entry {
        let is_fingerprint = |name: &str| name.len() == 16 && name.bytes().all(|b| b.is_ascii_hexdigit());
        // The second is what a network file system leaves of a file that is still open.
        let ends = |ending: &str| name.strip_suffix(ending).is_some();
        if (name.starts_with('.') && ends(".part")) || name.starts_with(".nfs") {
            return Entry::File;
        }
        let is_known = match self {
            Self::Top if name == RUNS => return Entry::Folder(Self::Runs),
            Self::Top if name == SLURM => return Entry::Folder(Self::Slurm),
            Self::Runs if is_fingerprint(name) => return Entry::Folder(Self::Run),
            Self::Top => [STUDY, ROWS, DIAGRAM, MAP, CELLS, PICTURE, EARLIER].contains(&name),
            Self::Runs => {
                [HEAD, LOCK].contains(&name) || name.strip_suffix(".json").is_some_and(is_fingerprint)
            }
            Self::Run => [LOCK, RESULT].contains(&name) || checkpoint::FILES.contains(&name),
            Self::Slurm => name.starts_with("array-") && (ends(".sh") || ends(".log")),
        };
        if is_known { Entry::File } else { Entry::Foreign }
    }
}

/// Calls `each` with every file, and then with every folder, below `dir`; a folder that is not there has none.
fn walk(
    dir: &Path,
    place: Place,
    each: &mut impl FnMut(&Path, bool) -> Result<(), SweepError>,
) -> Result<(), SweepError> {
    let Ok(entries) = fs::read_dir(dir) else { return Ok(()) };
    for entry in entries.flatten() {
        let path = entry.path();
        match entry.file_name().to_str().map_or(Entry::Foreign, |name| place.entry(name)) {
            Entry::Foreign => return Err(SweepError::Foreign { path }),
            Entry::Folder(within) => {
                walk(&path, within, each)?;
                each(&path, true)?;
            }
            Entry::File => each(&path, false)?,
        }
    }
    Ok(())
}

/// Fails at the first file that no sweep writes.
pub(super) fn refuse_foreign(dir: &Path) -> Result<(), SweepError> {
    walk(dir, Place::Top, &mut |_, _| Ok(()))
}

/// Removes what a sweep has written, but for the lock that the caller holds. Which sweep it is goes last.
pub(super) fn remove_results(dir: &Path) -> Result<(), SweepError> {
    let (runs, kept) = (dir.join(RUNS), dir.join(RUNS).join(LOCK));
    let head = runs.join(HEAD);
    walk(dir, Place::Top, &mut |path, is_folder| {
        if path == kept || path == runs || path == head {
            return Ok(());
        }
        // A folder that is not empty holds what came meanwhile.
        let removed = if is_folder { fs::remove_dir(path).or(Ok(())) } else { remove(path) };
        removed.map_err(refused(path))
    })?;
    remove(&head).map_err(refused(&head))
}

/// Removes tables and pictures.
pub(super) fn remove_tables(dir: &Path) -> Result<(), SweepError> {
    [ROWS, DIAGRAM, CELLS, PICTURE]
        .map(|name| dir.join(name))
        .iter()
        .try_for_each(|path| remove(path).map_err(refused(path)))
}

/// Removes a file that may not be there.
pub(super) fn remove(path: &Path) -> std::io::Result<()> {
    match fs::remove_file(path) {
        Err(error) if error.kind() != ErrorKind::NotFound => Err(error),
        _ => Ok(()),
    }
}

/// Whether anything stands in the folder beside `runs` and `slurm`.
pub(super) fn holds_more_than_runs(dir: &Path) -> bool {
    let Ok(entries) = fs::read_dir(dir) else { return dir.exists() && !dir.is_dir() };
    let others = |name: &str| name != RUNS && name != SLURM && !name.starts_with('.');
    entries.flatten().any(|entry| entry.file_name().to_str().is_none_or(others))
}
