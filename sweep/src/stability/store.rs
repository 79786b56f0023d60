//! The folder of a map: cells that are finished stay finished.
//!
//! | file | content |
//! |---|---|
//! | `cells.jsonl` | which map it is, then a line for each finished cell, in the order in which they finished |
//! | `map.toml` | the map as it was read |
//! | `cells.csv` | all cells in the map's order; written at the end |
//! | `map.svg` | the same as a picture; written at the end |

use std::collections::BTreeMap;
use std::fs::{self, OpenOptions};
use std::io::{self, Write as _};
use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};

use super::read::Map;
use super::row::Row;
use partita::lock::Locked;

/// Finished cells.
pub const JOURNAL: &str = "cells.jsonl";
/// The map.
pub const MAP: &str = "map.toml";
/// The table.
pub const TABLE: &str = "cells.csv";
/// The picture.
pub const PICTURE: &str = "map.svg";

/// A file while it is being written.
const PART: &str = "map.part";

/// Why a map's folder cannot be used.
#[derive(Debug, thiserror::Error)]
pub enum StoreError {
    /// The folder holds something else.
    #[error("{dir} holds {what}\nhint: name another folder with --out, or replace what a map has written there with --force", dir = dir.display())]
    Foreign {
        /// The folder.
        dir: PathBuf,
        /// What is in it.
        what: String,
    },
    /// Another process works on it.
    #[error("{path} is being written by another map\nhint: wait for it, or choose another folder with --out", path = path.display())]
    InUse {
        /// The file.
        path: PathBuf,
    },
    /// The system refuses.
    #[error("{path}: {source}\nhint: check the folder's permissions and the space left; finished cells are kept, and the same command goes on", path = path.display())]
    File {
        /// The file.
        path: PathBuf,
        /// What the system says.
        source: io::Error,
    },
}

/// The first line of a journal.
#[derive(Debug, PartialEq, Serialize, Deserialize)]
struct Head {
    map: String,
    cells: usize,
    /// Of everything that decides about the numbers.
    checksum: u32,
}

/// A finished cell.
#[derive(Debug, Serialize, Deserialize)]
struct Entry {
    cell: usize,
    row: Row,
}

/// A folder that takes the cells of a map.
#[derive(Debug)]
pub(super) struct Store {
    dir: PathBuf,
    journal: Locked,
    pub(super) rows: BTreeMap<usize, Row>,
}

impl Store {
    /// Starts the folder of a map or takes it up; `fresh` forgets cells that are there.
    pub(super) fn open(dir: &Path, map: &Map, checksum: u32, fresh: bool) -> Result<Self, StoreError> {
        let head = Head { map: map.name.clone(), cells: map.cells.len(), checksum };
        let path = dir.join(JOURNAL);
        let fail = |path: &Path| {
            let path = path.to_owned();
            move |source| StoreError::File { path, source }
        };
        fs::create_dir_all(dir).map_err(fail(dir))?;
        let foreign = |what: String| StoreError::Foreign { dir: dir.to_owned(), what };
        for entry in fs::read_dir(dir).map_err(fail(dir))?.flatten() {
            let name = entry.file_name();
            if ![JOURNAL, MAP, TABLE, PICTURE, PART].iter().any(|ours| name == *ours) {
                return Err(foreign(format!("{}, which is not of a map", name.display())));
            }
        }
        let journal = OpenOptions::new()
            .create(true)
            .truncate(false)
            .read(true)
            .write(true)
            .open(&path)
            .map_err(fail(&path))?;
        let journal = Locked::take(journal).map_err(|_| StoreError::InUse { path: path.clone() })?;
        let text = fs::read_to_string(&path).map_err(fail(&path))?;
        let mut store = Self { dir: dir.to_owned(), journal, rows: BTreeMap::new() };
        let mut kept = 0;
        if !fresh && !text.is_empty() {
            let (first, rest) = text.split_once('\n').unwrap_or((&text, ""));
            if serde_json::from_str::<Head>(first).ok().as_ref() != Some(&head) {
                return Err(foreign(
                    "the cells of another map, or of this one before it was changed".to_owned(),
                ));
            }
            kept = first.len() + 1;
            // The last line may have been cut by what ended the program.
            for line in rest.split_inclusive('\n') {
                let Ok(Entry { cell, row }) = serde_json::from_str(line) else { break };
                if !line.ends_with('\n') {
                    break;
                }
                store.rows.insert(cell, row);
                kept += line.len();
            }
        }
        store.journal.set_len(kept as u64).map_err(fail(&path))?;
        io::Seek::seek(&mut *store.journal, io::SeekFrom::Start(kept as u64)).map_err(fail(&path))?;
        if kept == 0 {
            store.append(&head)?;
            store.put(MAP, &map.text)?;
        }
        Ok(store)
    }

    /// Keeps a finished cell.
    pub(super) fn keep(&mut self, cell: usize, row: Row) -> Result<(), StoreError> {
        let entry = Entry { cell, row };
        self.append(&entry)?;
        self.rows.insert(cell, entry.row);
        Ok(())
    }

    fn append(&mut self, line: &impl Serialize) -> Result<(), StoreError> {
        let mut json = serde_json::to_vec(line).expect("a row is plain data");
        json.push(b'\n');
        self.journal
            .write_all(&json)
            .map_err(|source| StoreError::File { path: self.dir.join(JOURNAL), source })
    }

    /// Writes a whole file under another name and renames it: there is never half of one.
    pub(super) fn put(&self, name: &str, text: &str) -> Result<(), StoreError> {
        let (path, part) = (self.dir.join(name), self.dir.join(PART));
        let written = fs::write(&part, text).and_then(|()| fs::rename(&part, &path));
        written.map_err(|source| {
            let _ = fs::remove_file(&part);
            StoreError::File { path, source }
        })
    }
}
