//! What was done before: a folder for each fingerprint, `target/report/<fingerprint>/`.
//!
//! | file | content |
//! |---|---|
//! | `key` | everything that decides about what is found; the fingerprint is its checksum |
//! | `out/` | what the program wrote |
//! | `found.json` | what was read of it; it is written last, so that an entry without one was cut off |

use std::path::{Path, PathBuf};

use serde::Serialize;
use serde::de::DeserializeOwned;

use crate::program::checksum;
use crate::task::{self, TaskError};

/// The entries, and whether they are taken.
#[derive(Debug, Clone)]
pub(crate) struct Cache {
    folder: PathBuf,
    /// Take what is there; otherwise everything is done again.
    pub(crate) remembers: bool,
}

impl Cache {
    pub(crate) fn new(folder: PathBuf, remembers: bool) -> Self {
        Self { folder, remembers }
    }

    /// The entry of a key: everything that decides about what is found.
    pub(crate) fn entry(&self, key: String) -> Entry {
        let dir = self.folder.join(format!("{:016x}", checksum(key.as_bytes())));
        Entry { dir, key }
    }

    /// What was found before under this key.
    pub(crate) fn remembered<T: DeserializeOwned>(&self, entry: &Entry) -> Option<T> {
        if !self.remembers || !entry.is_of_its_key() {
            return None;
        }
        task::read_json(&entry.dir.join("found.json")).ok()
    }

    /// Does the work in the entry's folder for output, which is empty unless the work was cut off before, and keeps what was found.
    pub(crate) fn keep<T: Serialize>(
        &self,
        entry: &Entry,
        work: impl FnOnce(&Path) -> Result<T, TaskError>,
    ) -> Result<T, TaskError> {
        let file = entry.dir.join("found.json");
        let was_cut_off = self.remembers && entry.is_of_its_key() && !file.exists();
        if !was_cut_off {
            task::remove_folder(&entry.dir)?;
            task::write(&entry.dir.join("key"), &entry.key)?;
        }
        let found = work(&entry.out())?;
        let text = serde_json::to_string_pretty(&found).expect("what is found is plain data");
        let beside = file.with_extension("part");
        task::write(&beside, &text)?;
        std::fs::rename(&beside, &file).map_err(|source| TaskError::File { path: file, source })?;
        Ok(found)
    }
}

/// One key and its folder.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct Entry {
    dir: PathBuf,
    key: String,
}

impl Entry {
    /// Where the program writes.
    pub(crate) fn out(&self) -> PathBuf {
        self.dir.join("out")
    }

    /// Two keys may have one checksum.
    fn is_of_its_key(&self) -> bool {
        std::fs::read_to_string(self.dir.join("key")).is_ok_and(|key| key == self.key)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn found(cache: &Cache, key: &str, value: usize) -> usize {
        let entry = cache.entry(key.to_owned());
        cache.remembered(&entry).unwrap_or_else(|| cache.keep(&entry, |_| Ok(value)).expect("a folder"))
    }

    #[test]
    fn what_was_found_is_remembered_by_its_key_until_everything_is_done_again() {
        let folder = tempfile::tempdir().expect("a folder");
        let cache = Cache::new(folder.path().to_owned(), true);
        assert_eq!(found(&cache, "a", 1), 1);
        assert_eq!((found(&cache, "a", 2), found(&cache, "b", 3)), (1, 3));
        let fresh = Cache { remembers: false, ..cache.clone() };
        assert_eq!(found(&fresh, "a", 4), 4);
        assert_eq!(found(&cache, "a", 5), 4);
    }

    #[test]
    fn work_that_was_cut_off_goes_on_in_its_folder_and_other_work_starts_from_nothing() {
        let folder = tempfile::tempdir().expect("a folder");
        let cache = Cache::new(folder.path().to_owned(), true);
        let entry = cache.entry("a".to_owned());
        let cut_off = cache.keep(&entry, |out| -> Result<usize, TaskError> {
            task::write(&out.join("half"), "1")?;
            Err(TaskError::Failed("cut off".to_owned()))
        });
        assert!(cut_off.is_err());
        assert_eq!(cache.remembered::<usize>(&entry), None, "it has no end");
        let seen = |cache: &Cache| cache.keep(&entry, |out| Ok(out.join("half").exists())).expect("a folder");
        assert!(seen(&cache), "it goes on");
        assert!(!seen(&cache), "it was finished, and is done again");
        std::fs::write(entry.dir.join("key"), "another").expect("written");
        assert_eq!(cache.remembered::<bool>(&entry), None, "the same checksum, another key");
    }
}
