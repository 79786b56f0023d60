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
        VtuError::Write { path: path.to_path_buf(), source }
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_write_that_fails_half_way_leaves_the_old_file_alone() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("fluid.pvd");
        write(&path, |file| file.write_all(b"old")).expect("writable");
        let failed = write(&path, |file| {
            file.write_all(b"half of the ne")?;
            Err(io::Error::other("the disk is full"))
        });
        assert!(matches!(failed, Err(VtuError::Write { .. })));
        assert_eq!(fs::read(&path).expect("readable"), b"old");
        assert_eq!(fs::read_dir(folder.path()).expect("a folder").count(), 1, "the part is gone");
    }

    #[test]
    fn the_file_does_not_appear_before_it_is_whole() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("fluid.vtu");
        write(&path, |file| {
            file.write_all(b"first half")?;
            file.flush()?;
            assert!(!path.exists());
            file.write_all(b", second half")
        })
        .expect("writable");
        assert_eq!(fs::read(&path).expect("readable"), b"first half, second half");
    }
}
