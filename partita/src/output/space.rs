//! How much a run will write, and how much the disk takes.

use std::path::Path;

use super::OutputError;

/// Bytes of one number in a field file: eight, compressed by a tenth, in base64.
const NUMBER: u64 = 10;
/// Bytes of one cell in a field file; its three or four node numbers compress well.
const CELL: u64 = 8;
/// Bytes of a field file beside its numbers, its place in the collection included.
const FIELD_FILE: u64 = 2000;
/// Bytes of the line that one coupling iteration adds to the records.
const ITERATION: u64 = 1300;
/// Bytes of the lines that one step adds to records and tables.
const STEP: u64 = 1300;
/// Checkpoints that lie in the folder while one is written: the latest, the one before, and the new one.
pub const CHECKPOINTS: usize = 3;

/// Bytes that a run will write.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Estimate {
    /// Field files and collections.
    pub fields: u64,
    /// Records and tables.
    pub records: u64,
    /// Checkpoints.
    pub checkpoints: u64,
}

impl Estimate {
    /// What `steps` steps of `iterations` coupling iterations each write.
    #[must_use]
    pub fn of_records(steps: usize, iterations: usize) -> Self {
        let step = (iterations as u64).saturating_mul(ITERATION).saturating_add(STEP);
        Self { records: step.saturating_mul(steps as u64), ..Self::default() }
    }

    /// Adds `files` files of a field with `points` points, `numbers` numbers that vary at each of them, and `cells`
    /// cells.
    #[must_use]
    pub fn with_fields(mut self, files: usize, points: usize, numbers: u64, cells: usize) -> Self {
        let data = (points as u64).saturating_mul(numbers * NUMBER);
        let file = data.saturating_add(cells as u64 * CELL).saturating_add(FIELD_FILE);
        self.fields = self.fields.saturating_add(file.saturating_mul(files as u64));
        self
    }

    /// Adds `count` checkpoints of `bytes` each.
    #[must_use]
    pub fn with_checkpoints(mut self, count: usize, bytes: usize) -> Self {
        self.checkpoints = (bytes as u64).saturating_mul(count as u64);
        self
    }

    /// All of it.
    #[must_use]
    pub fn total(&self) -> u64 {
        self.fields.saturating_add(self.records).saturating_add(self.checkpoints)
    }

    /// Compares with the space that is free where `dir` is or will be. Where the system does not tell, there is enough.
    ///
    /// # Errors
    /// [`OutputError::NoSpace`] with both numbers.
    pub fn check(&self, dir: &Path) -> Result<(), OutputError> {
        match free_bytes(dir) {
            Some(free) if free < self.total() => {
                Err(OutputError::NoSpace { dir: dir.to_owned(), estimate: *self, free })
            }
            _ => Ok(()),
        }
    }
}

/// Bytes that an ordinary user may still write to the file system of `dir`, or of the nearest folder above it that
/// exists.
#[cfg(unix)]
fn free_bytes(dir: &Path) -> Option<u64> {
    let here = Path::new(".");
    let folders = dir.ancestors().map(|folder| if folder.as_os_str().is_empty() { here } else { folder });
    let stat = rustix::fs::statvfs(folders.into_iter().find(|folder| folder.exists())?).ok()?;
    // What is no disk, such as /proc, has no blocks at all.
    (stat.f_blocks > 0).then(|| stat.f_bavail.saturating_mul(stat.f_frsize))
}

#[cfg(not(unix))]
fn free_bytes(_: &Path) -> Option<u64> {
    None
}

/// A number of bytes with three digits and a unit: `1.23 GB`.
pub(super) fn size(bytes: u64) -> String {
    const UNITS: [&str; 7] = ["B", "kB", "MB", "GB", "TB", "PB", "EB"];
    let mut value = bytes as f64;
    let mut unit = 0;
    while value >= 999.5 && unit + 1 < UNITS.len() {
        value /= 1000.0;
        unit += 1;
    }
    let digits = if unit == 0 || value >= 99.95 {
        0
    } else if value >= 9.995 {
        1
    } else {
        2
    };
    format!("{value:.digits$} {}", UNITS[unit])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes_have_three_digits() {
        let shown = [0, 999, 1000, 12_345, 999_700, 250_000_000, u64::MAX].map(size);
        assert_eq!(shown, ["0 B", "999 B", "1.00 kB", "12.3 kB", "1.00 MB", "250 MB", "18.4 EB"]);
    }

    #[test]
    fn parts_add_up_and_never_overflow() {
        let estimate = Estimate::of_records(10, 8).with_fields(5, 100, 3, 50).with_checkpoints(3, 1000);
        assert_eq!((estimate.records, estimate.fields, estimate.checkpoints), (117_000, 27_000, 3000));
        assert_eq!(estimate.total(), 147_000);
        let endless = Estimate::of_records(usize::MAX, 8).with_fields(usize::MAX, 100, 3, 50);
        assert_eq!(endless.total(), u64::MAX);
    }

    #[test]
    fn a_folder_that_is_not_there_yet_is_on_the_disk_of_the_one_above() {
        let folder = tempfile::tempdir().expect("a folder");
        let dir = folder.path().join("runs/tank");
        assert!(Estimate::default().check(&dir).is_ok());
        let endless = Estimate { fields: u64::MAX, ..Estimate::default() };
        // Where the system does not tell, nothing is refused.
        assert_eq!(endless.check(&dir).is_err(), cfg!(unix));
    }
}
