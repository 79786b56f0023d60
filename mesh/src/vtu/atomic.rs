//! Files that appear only when they are whole.

use std::fs::{self, File};
use std::io::{self, BufWriter, Write};
use std::path::Path;

use super::VtuError;

/// Writes `path` through a temporary neighbour `<path>.part` and a rename, which replaces the old file in one
/// step. A failed write leaves the old file and no neighbour.
pub(super) fn write(
    path: &Path,
    content: impl FnOnce(&mut BufWriter<File>) -> io::Result<()>,
) -> Result<(), VtuError> {
    let mut part = path.as_os_str().to_owned();
    part.push(".part");
    let part = Path::new(&part);
    let written = File::create(part).and_then(|file| {
        let mut file = BufWriter::new(file);
        content(&mut file)?;
        file.flush()?;
        drop(file);
        fs::rename(part, path)
    });
    written.map_err(|source| {
        // What counts is the first error; the part may not even exist.
        let _ = fs::remove_file(part);
        VtuError::Io { action: "write", path: path.to_path_buf(), source }
    })
}
