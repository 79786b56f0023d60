//! The folder of a study: its text, its rows, its diagram.

use std::fs::{self, File};
use std::io::Write as _;
use std::path::{Path, PathBuf};

use super::error::StudyFailure;
use super::report::{COLUMNS, Report, Row};
use partita::output::table::{csv_header, csv_row};

/// The study file as it was read.
pub const STUDY: &str = "study.toml";
/// A row a setting.
pub const ROWS: &str = "study.csv";
/// The work-precision diagram.
pub const DIAGRAM: &str = "study.svg";

/// The folder while the study is conducted.
pub(super) struct Folder {
    dir: PathBuf,
    rows: File,
}

impl Folder {
    /// Starts a folder, which must be new, empty, or with `force` that of an earlier study.
    pub(super) fn create(dir: &Path, study: &str, force: bool) -> Result<Self, StudyFailure> {
        let refused = |path: &Path, source| StudyFailure::Write { path: path.to_owned(), source };
        fs::create_dir_all(dir).map_err(|source| refused(dir, source))?;
        let entries = fs::read_dir(dir).map_err(|source| refused(dir, source))?;
        let ours = |name: &str| [STUDY, ROWS, DIAGRAM].contains(&name);
        for entry in entries.flatten() {
            if !(force && entry.file_name().to_str().is_some_and(ours)) {
                return Err(StudyFailure::Occupied { dir: dir.to_owned() });
            }
        }
        for name in [DIAGRAM, ROWS, STUDY] {
            let _ = fs::remove_file(dir.join(name));
        }
        let path = dir.join(STUDY);
        fs::write(&path, study).map_err(|source| refused(&path, source))?;
        let path = dir.join(ROWS);
        let rows = File::create(&path).map_err(|source| refused(&path, source))?;
        let mut folder = Self { dir: dir.to_owned(), rows };
        folder.line(&csv_header(&COLUMNS))?;
        Ok(folder)
    }

    /// Writes a row; it is with the system when this returns.
    pub(super) fn append(&mut self, row: &Row, uncertainty: f64) -> Result<(), StudyFailure> {
        self.line(&csv_row(&row.cells(uncertainty)))
    }

    fn line(&mut self, line: &str) -> Result<(), StudyFailure> {
        self.rows
            .write_all(line.as_bytes())
            .map_err(|source| StudyFailure::Write { path: self.dir.join(ROWS), source })
    }

    /// Draws what there is.
    pub(super) fn draw(&self, report: &Report) -> Result<(), StudyFailure> {
        let Some(picture) = report.diagram() else { return Ok(()) };
        let path = self.dir.join(DIAGRAM);
        fs::write(&path, picture).map_err(|source| StudyFailure::Write { path, source })
    }

    /// Leaves nothing behind.
    pub(super) fn remove(self) {
        for name in [ROWS, STUDY] {
            let _ = fs::remove_file(self.dir.join(name));
        }
        // A folder with something else in it stays.
        let _ = fs::remove_dir(&self.dir);
    }
}
