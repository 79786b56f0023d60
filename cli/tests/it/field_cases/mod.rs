//! Inputs in the manner of public bug reports, each with the outcome that is right for its kind of fault.

mod convergence;
mod forces;
mod geometry;
mod meshes;
mod transfer;

use std::fs;
use std::path::{Path, PathBuf};

use super::program::{Outcome, partita};

/// A copy of the folder `name` of `tests/field-cases`, where a test may change files and run scenes.
struct Case(tempfile::TempDir);

impl Case {
    fn new(name: &str) -> Self {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/field-cases").join(name);
        for entry in fs::read_dir(source).expect("the case is there") {
            let path = entry.expect("an entry").path();
            let name = path.file_name().expect("a file has a name");
            fs::copy(&path, folder.path().join(name)).expect("the file is copied");
        }
        Self(folder)
    }

    fn path(&self, file: &str) -> PathBuf {
        self.0.path().join(file)
    }

    /// Calls the program in the folder of the case.
    fn partita(&self, arguments: &[&str]) -> Outcome {
        partita(self.0.path(), arguments)
    }

    fn text(&self, file: &str) -> String {
        fs::read_to_string(self.path(file)).expect("the file is text")
    }

    /// Replaces `old`, which must be there, in a file.
    fn replace(&self, file: &str, old: &str, new: &str) {
        let text = self.text(file);
        assert!(text.contains(old), "{file} holds no `{old}`");
        fs::write(self.path(file), text.replace(old, new)).expect("the file is written");
    }

    /// The last value of a column of the probes of the run in `out`.
    fn last_probe(&self, out: &str, column: &str) -> f64 {
        let table = self.text(&format!("{out}/probes.csv"));
        let mut lines = table.lines().filter(|line| !line.starts_with('#'));
        let header = lines.next().expect("a header");
        let at = header.split(',').position(|name| name == column);
        let at = at.unwrap_or_else(|| panic!("no column {column} in {header}"));
        let last = lines.next_back().expect("a row");
        last.split(',').nth(at).and_then(|value| value.parse().ok()).expect("a number")
    }
}
