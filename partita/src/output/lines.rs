//! Files that grow line by line, and are cut at a line when a run is resumed.

use std::fs::{File, OpenOptions};
use std::io::{BufRead, BufReader, Write};
use std::path::{Path, PathBuf};

use super::OutputError;
use crate::lock::Locked;

/// A file that only grows. Each line goes to the system at once: a killed run loses none. While it is open no other
/// process can take it up.
#[derive(Debug)]
pub(super) struct LineFile {
    path: PathBuf,
    file: Locked,
}

impl LineFile {
    /// An empty file, in place of what is there.
    pub(super) fn create(path: PathBuf) -> Result<Self, OutputError> {
        let refused = |source| OutputError::Write { path: path.clone(), source };
        // Emptied under the lock: another run's file keeps its lines.
        let file =
            OpenOptions::new().create(true).truncate(false).write(true).open(&path).map_err(refused)?;
        let file = lock(file, &path)?;
        file.set_len(0).map_err(refused)?;
        Ok(Self { path, file })
    }

    /// Keeps the lines at the beginning of the file for which `keep(number, line)` is true, and goes on behind them.
    ///
    /// Lines are counted from 1 and come without their end; a last line without one was being written when the run was
    /// killed, and is dropped.
    pub(super) fn resume(
        path: PathBuf,
        mut keep: impl FnMut(usize, &str) -> Result<bool, String>,
    ) -> Result<Self, OutputError> {
        let refused = |source| OutputError::Write { path: path.clone(), source };
        let file = OpenOptions::new().append(true).open(&path).map_err(refused)?;
        let file = lock(file, &path)?;
        let kept = kept_bytes(&path, &mut keep)?;
        file.set_len(kept).map_err(refused)?;
        Ok(Self { path, file })
    }

    /// Appends text that ends with a line's end.
    pub(super) fn append(&mut self, lines: &[u8]) -> Result<(), OutputError> {
        self.file.write_all(lines).map_err(|source| OutputError::Write { path: self.path.clone(), source })
    }

    /// Waits until all is on the disk.
    pub(super) fn synchronize(&self) -> Result<(), OutputError> {
        self.file.sync_data().map_err(|source| OutputError::Write { path: self.path.clone(), source })
    }

    pub(super) fn path(&self) -> &Path {
        &self.path
    }
}

/// Takes the lock of an open file, or says that another run writes it.
pub(super) fn lock(file: File, path: &Path) -> Result<Locked, OutputError> {
    Locked::take(file).map_err(|_| OutputError::InUse { path: path.to_owned() })
}

fn kept_bytes(
    path: &Path,
    keep: &mut impl FnMut(usize, &str) -> Result<bool, String>,
) -> Result<u64, OutputError> {
    let unreadable = |source| OutputError::Read { path: path.to_owned(), source };
    let mut reader = BufReader::new(File::open(path).map_err(unreadable)?);
    let mut bytes = Vec::new();
    let mut kept = 0;
    for number in 1.. {
        bytes.clear();
        let length = reader.read_until(b'\n', &mut bytes).map_err(unreadable)?;
        let Some(line) = bytes.strip_suffix(b"\n") else { break };
        let corrupt = |reason| OutputError::Corrupt { path: path.to_owned(), line: number, reason };
        let line = std::str::from_utf8(line).map_err(|error| corrupt(error.to_string()))?;
        if !keep(number, line).map_err(corrupt)? {
            break;
        }
        kept += length as u64;
    }
    Ok(kept)
}
