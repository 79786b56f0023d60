//! Checkpoints: the whole state of a run in one file, kept bit for bit.
//!
//! `checkpoint.bin` is written under another name, synchronized and renamed; the one before stays as
//! `checkpoint.previous.bin`. At any moment one of them is complete. The layout, integers little-endian:
//!
//! | bytes | content |
//! |---|---|
//! | 8 | magic `PARTITA\n` |
//! | 4 | version of the layout |
//! | 4 | length of the stamp |
//! | 8 | length of the state |
//! | 4 | CRC-32 of all other bytes |
//! | | [`Stamp`], then the state, both in postcard's encoding: an `f64` is its eight bytes |
//!
//! Lengths are compared with the file's own before anything is read into memory, and the checksum before anything is
//! decoded.

use std::fs::{self, File};
use std::io::{self, ErrorKind, Read, Write};
use std::path::{Path, PathBuf};

use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};

use crate::clock::Spent;

/// Name of the latest checkpoint in a run's folder.
pub const LATEST: &str = "checkpoint.bin";
/// Name of the one before.
pub const PREVIOUS: &str = "checkpoint.previous.bin";

const TEMPORARY: &str = "checkpoint.tmp.bin";
/// All names that checkpoints have in a folder.
pub const FILES: [&str; 3] = [LATEST, PREVIOUS, TEMPORARY];
const MAGIC: [u8; 8] = *b"PARTITA\n";
/// Rises with every change of the layout or of a state that a checkpoint holds.
const VERSION: u32 = 3;
const PREFIX: usize = 28;

/// When a checkpoint was taken, and what the run had cost by then.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Stamp {
    /// The last finished step, counted from 1.
    pub step: usize,
    /// The time at its end \[s\].
    pub time: f64,
    /// Cost of the run so far.
    pub spent: Spent,
}

/// A checkpoint as it is read back.
#[derive(Debug)]
pub struct Checkpoint<T> {
    /// When it was taken.
    pub stamp: Stamp,
    /// The state of the run.
    pub state: T,
    /// Why the latest checkpoint could not be used, if this is the one before.
    pub latest_unusable: Option<CheckpointError>,
}

/// Why a checkpoint cannot be written or read.
#[derive(Debug, thiserror::Error, miette::Diagnostic)]
pub enum CheckpointError {
    /// The folder holds none.
    #[error("{dir}: no checkpoint", dir = dir.display())]
    #[diagnostic(help(
        "a run writes its first one after as many steps as `output.checkpoint_every` says; start it anew with `partita run` and --force"
    ))]
    Missing {
        /// Folder of the run.
        dir: PathBuf,
    },
    /// The system refuses.
    #[error("{path}: {source}", path = path.display())]
    #[diagnostic(help("check the folder's permissions and the space left"))]
    File {
        /// The file.
        path: PathBuf,
        /// What the system says.
        source: io::Error,
    },
    /// The file is something else.
    #[error("{path}: not a checkpoint of Partita", path = path.display())]
    #[diagnostic(help("give the output folder of a run, not another file"))]
    WrongMagic {
        /// The file.
        path: PathBuf,
    },
    /// Another version of Partita wrote it.
    #[error("{path}: checkpoint of version {found}, this program reads version {VERSION}", path = path.display())]
    #[diagnostic(help("resume with the program that wrote it"))]
    WrongVersion {
        /// The file.
        path: PathBuf,
        /// The version in the file.
        found: u32,
    },
    /// The file is shorter or longer than it says.
    #[error("{path}: {found} bytes where {expected} are announced", path = path.display())]
    #[diagnostic(help(
        "the file was cut or changed after it was written; {PREVIOUS}, if whole, holds the one before"
    ))]
    WrongLength {
        /// The file.
        path: PathBuf,
        /// Bytes that the file announces, or the least that any checkpoint has.
        expected: u64,
        /// Bytes that it has.
        found: u64,
    },
    /// Bytes have changed since the file was written.
    #[error("{path}: checksum {found:08x} where {expected:08x} was written", path = path.display())]
    #[diagnostic(help(
        "the file was cut or changed after it was written; {PREVIOUS}, if whole, holds the one before"
    ))]
    WrongChecksum {
        /// The file.
        path: PathBuf,
        /// Checksum in the file.
        expected: u32,
        /// Checksum of its bytes.
        found: u32,
    },
    /// The bytes are whole but are no state of this kind.
    #[error("{path}: not a state of this run: {source}", path = path.display())]
    #[diagnostic(help("the checkpoint belongs to another scene or program"))]
    Decode {
        /// The file.
        path: PathBuf,
        /// What the decoder says.
        source: postcard::Error,
    },
    /// The state cannot be written.
    #[error("the state cannot be encoded: {source}")]
    #[diagnostic(help("this is an error of the program; please report it"))]
    Encode {
        /// What the encoder says.
        source: postcard::Error,
    },
}

/// Writes a checkpoint into the folder of a run; the latest becomes the previous one.
///
/// # Errors
/// When the state cannot be encoded or the system refuses. The checkpoints that were there stay usable.
pub fn save<T: Serialize>(dir: &Path, stamp: &Stamp, state: &T) -> Result<(), CheckpointError> {
    let (temporary, latest, previous) = (dir.join(TEMPORARY), dir.join(LATEST), dir.join(PREVIOUS));
    write_file(&temporary, stamp, state)?;
    match fs::rename(&latest, &previous) {
        Err(error) if error.kind() != ErrorKind::NotFound => return Err(fail(&previous)(error)),
        _ => {}
    }
    fs::rename(&temporary, &latest).map_err(fail(&latest))?;
    synchronize_folder(dir).map_err(fail(dir))
}

/// Writes a checkpoint into one file, whole or not at all.
///
/// # Errors
/// When the state cannot be encoded or the system refuses. What was in the file stays then.
pub fn save_file<T: Serialize>(path: &Path, stamp: &Stamp, state: &T) -> Result<(), CheckpointError> {
    let mut temporary = path.as_os_str().to_owned();
    temporary.push(".part");
    let temporary = PathBuf::from(temporary);
    write_file(&temporary, stamp, state)?;
    fs::rename(&temporary, path).map_err(fail(path))?;
    synchronize_folder(path.parent().filter(|dir| !dir.as_os_str().is_empty()).unwrap_or(Path::new(".")))
        .map_err(fail(path))
}

fn write_file<T: Serialize>(path: &Path, stamp: &Stamp, state: &T) -> Result<(), CheckpointError> {
    let bytes = encode(stamp, state).map_err(|source| CheckpointError::Encode { source })?;
    write_through(path, &bytes).map_err(|source| {
        // Half a checkpoint only takes space.
        let _ = fs::remove_file(path);
        fail(path)(source)
    })
}

/// What the system says about a file.
fn fail(path: &Path) -> impl FnOnce(io::Error) -> CheckpointError + use<> {
    let path = path.to_owned();
    move |source| CheckpointError::File { path, source }
}

/// Bytes of a checkpoint of `state`.
///
/// # Errors
/// When the state cannot be encoded.
pub fn encoded_len<T: Serialize>(stamp: &Stamp, state: &T) -> Result<usize, CheckpointError> {
    encode(stamp, state).map(|bytes| bytes.len()).map_err(|source| CheckpointError::Encode { source })
}

/// Reads the latest checkpoint in the folder of a run, or the one before when the latest is not usable.
///
/// # Errors
/// When there is none, or neither is usable: then the error is that of the latest.
pub fn load<T: DeserializeOwned>(dir: &Path) -> Result<Checkpoint<T>, CheckpointError> {
    let latest_error = match load_file(&dir.join(LATEST)) {
        Ok((stamp, state)) => return Ok(Checkpoint { stamp, state, latest_unusable: None }),
        Err(error) => error,
    };
    match load_file(&dir.join(PREVIOUS)) {
        Ok((stamp, state)) => Ok(Checkpoint { stamp, state, latest_unusable: Some(latest_error) }),
        Err(previous_error) if is_missing(&latest_error) && is_missing(&previous_error) => {
            Err(CheckpointError::Missing { dir: dir.to_owned() })
        }
        Err(previous_error) if is_missing(&latest_error) => Err(previous_error),
        Err(_) => Err(latest_error),
    }
}

/// Reads one checkpoint file.
///
/// # Errors
/// When it cannot be read, is no checkpoint, is cut, changed, or of another version or state.
pub fn load_file<T: DeserializeOwned>(path: &Path) -> Result<(Stamp, T), CheckpointError> {
    let fail = |source| CheckpointError::File { path: path.to_owned(), source };
    let mut file = File::open(path).map_err(fail)?;
    let length = file.metadata().map_err(fail)?.len();
    let mut bytes = vec![0; PREFIX.min(usize::try_from(length).unwrap_or(PREFIX))];
    file.read_exact(&mut bytes).map_err(fail)?;
    let prefix = Prefix::parse(path, &bytes, length)?;
    file.read_to_end(&mut bytes).map_err(fail)?;
    prefix.check(path, &bytes)?;
    let (stamp, state) = bytes[PREFIX..].split_at(prefix.stamp_length);
    let decode = |source| CheckpointError::Decode { path: path.to_owned(), source };
    Ok((whole(stamp).map_err(decode)?, whole(state).map_err(decode)?))
}

/// Decodes a value that fills the bytes.
fn whole<T: DeserializeOwned>(bytes: &[u8]) -> Result<T, postcard::Error> {
    match postcard::take_from_bytes(bytes)? {
        (value, []) => Ok(value),
        _ => Err(postcard::Error::SerdeDeCustom),
    }
}

/// The checked head of a file.
struct Prefix {
    stamp_length: usize,
    checksum: u32,
}

impl Prefix {
    /// Reads the head of a file of `length` bytes; a file that is too short for one is cut.
    fn parse(path: &Path, bytes: &[u8], length: u64) -> Result<Self, CheckpointError> {
        let path = || path.to_owned();
        if !bytes.starts_with(&MAGIC[..MAGIC.len().min(bytes.len())]) || bytes.is_empty() {
            return Err(CheckpointError::WrongMagic { path: path() });
        }
        let Some((head, _)) = bytes.split_first_chunk::<PREFIX>() else {
            return Err(CheckpointError::WrongLength {
                path: path(),
                expected: PREFIX as u64,
                found: length,
            });
        };
        let version = word(head, 8);
        if version != VERSION {
            return Err(CheckpointError::WrongVersion { path: path(), found: version });
        }
        let stamp_length = word(head, 12);
        let state_length = u64::from(word(head, 16)) | u64::from(word(head, 20)) << 32;
        let expected = state_length.saturating_add(u64::from(stamp_length)).saturating_add(PREFIX as u64);
        if expected != length {
            return Err(CheckpointError::WrongLength { path: path(), expected, found: length });
        }
        // Smaller than the file, which was just compared.
        let stamp_length = usize::try_from(stamp_length).expect("32 bits fit into a usize");
        Ok(Self { stamp_length, checksum: word(head, 24) })
    }

    fn check(&self, path: &Path, bytes: &[u8]) -> Result<(), CheckpointError> {
        let found = checksum(bytes);
        if found == self.checksum {
            Ok(())
        } else {
            Err(CheckpointError::WrongChecksum { path: path.to_owned(), expected: self.checksum, found })
        }
    }
}

fn word(head: &[u8; PREFIX], at: usize) -> u32 {
    u32::from_le_bytes([head[at], head[at + 1], head[at + 2], head[at + 3]])
}

/// CRC-32 of all bytes but the four that hold it.
fn checksum(bytes: &[u8]) -> u32 {
    let mut hasher = crc32fast::Hasher::new();
    hasher.update(&bytes[..PREFIX - 4]);
    hasher.update(&bytes[PREFIX..]);
    hasher.finalize()
}

fn encode<T: Serialize>(stamp: &Stamp, state: &T) -> Result<Vec<u8>, postcard::Error> {
    let stamp = postcard::to_stdvec(stamp)?;
    let stamp_length = u32::try_from(stamp.len()).map_err(|_| postcard::Error::SerializeBufferFull)?;
    let mut bytes = Vec::with_capacity(PREFIX + stamp.len());
    bytes.extend(MAGIC);
    bytes.extend(VERSION.to_le_bytes());
    bytes.extend(stamp_length.to_le_bytes());
    bytes.extend([0; 12]);
    bytes.extend(&stamp);
    let mut bytes = postcard::to_extend(state, bytes)?;
    let state_length = bytes.len() - PREFIX - stamp.len();
    bytes[16..24].copy_from_slice(&(state_length as u64).to_le_bytes());
    let sum = checksum(&bytes);
    bytes[24..PREFIX].copy_from_slice(&sum.to_le_bytes());
    Ok(bytes)
}

fn is_missing(error: &CheckpointError) -> bool {
    matches!(error, CheckpointError::File { source, .. } if source.kind() == ErrorKind::NotFound)
}

/// Writes and waits until the bytes are on the disk.
fn write_through(path: &Path, bytes: &[u8]) -> io::Result<()> {
    let mut file = File::create(path)?;
    file.write_all(bytes)?;
    file.sync_all()
}

/// Makes the renames durable, where folders can be synchronized.
#[cfg(unix)]
fn synchronize_folder(dir: &Path) -> io::Result<()> {
    File::open(dir)?.sync_all()
}

#[cfg(not(unix))]
#[expect(clippy::unnecessary_wraps, reason = "the other systems' signature")]
fn synchronize_folder(_: &Path) -> io::Result<()> {
    Ok(())
}
