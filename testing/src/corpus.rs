//! The inputs that fuzzing has found: `fuzz/corpus.tar.gz`, a folder a target.

use std::fs::File;
use std::io::Read;
use std::path::Path;

use flate2::read::GzDecoder;
use tar::Archive;

/// Every input of a target.
///
/// # Panics
/// When the archive cannot be read, or has no such folder.
#[must_use]
pub fn of(target: &str) -> Vec<Vec<u8>> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../fuzz/corpus.tar.gz");
    let file = File::open(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    let mut archive = Archive::new(GzDecoder::new(file));
    let mut inputs = Vec::new();
    for entry in archive.entries().expect("an archive") {
        let mut entry = entry.expect("an entry");
        let is_ours = entry.path().expect("a name").starts_with(Path::new("corpus").join(target));
        if is_ours && entry.header().entry_type().is_file() {
            let mut bytes = Vec::new();
            entry.read_to_end(&mut bytes).expect("a whole archive");
            inputs.push(bytes);
        }
    }
    assert!(!inputs.is_empty(), "{} has no folder corpus/{target}", path.display());
    inputs
}
