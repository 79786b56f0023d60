//! Files beside the scene.

use std::fs;
use std::path::Path;

use partita_mesh::gmsh::GmshFile;

use crate::finding::Finding;
use crate::schema::{FileName, Positive};

/// A file that was read for a scene; its run keeps a copy.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Input {
    /// What the copy is called.
    pub name: &'static str,
    /// All of it.
    pub bytes: Vec<u8>,
}

/// Largest file that is read: a mesh beyond it would not fit any machine the program is written for.
const MOST_BYTES: u64 = 4 << 30;

/// A file of gmsh with its coordinates in metres, and its bytes.
pub(super) fn gmsh(name: &FileName, scale: Positive, folder: &Path) -> Result<(GmshFile, Vec<u8>), Finding> {
    let bytes = bytes(name, folder)?;
    let mut file =
        GmshFile::parse(&bytes).map_err(|error| Finding::of(&error).led_by(&format!("{name}, ")))?;
    for x in file.points.as_flattened_mut() {
        *x *= scale.get();
    }
    Ok((file, bytes))
}

/// All bytes of a file that a scene in `folder` names.
pub(super) fn bytes(file: &FileName, folder: &Path) -> Result<Vec<u8>, Finding> {
    let path = file.within(folder);
    let refused = |error: &std::io::Error| {
        Finding::new(format!("{} cannot be read: {error}", path.display())).hint(
            "names of files are relative to the folder of the scene; check the spelling and the permissions",
        )
    };
    let about = fs::metadata(&path).map_err(|error| refused(&error))?;
    // A pipe or a device may never end.
    if !about.is_file() {
        return Err(Finding::new(format!("{} is not a file", path.display()))
            .hint("name a file; a folder, a pipe or a device cannot be read as one"));
    }
    if about.len() > MOST_BYTES {
        return Err(Finding::new(format!("{} has {} bytes", path.display(), about.len()))
            .hint(format!("at most {MOST_BYTES} bytes are read; is this the right file?")));
    }
    fs::read(&path).map_err(|error| refused(&error))
}
