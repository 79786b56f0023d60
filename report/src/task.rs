//! What every task needs: where the workspace is, files in it, and how a task fails.

use std::path::{Path, PathBuf};

/// Why a task did not succeed.
#[derive(Debug, thiserror::Error)]
pub(crate) enum TaskError {
    /// The command line asks for what the task does not do.
    #[error("{what}\nhint: {hint}")]
    Refused { what: String, hint: String },
    /// A file could not be read or written.
    #[error("{path}: {source}", path = path.display())]
    File { path: PathBuf, source: std::io::Error },
    /// A program could not be started.
    #[error("cannot start `{command}`: {source}")]
    Start { command: String, source: std::io::Error },
    /// A program ended with an error.
    #[error("`{command}` failed ({status}){gap}{said}", gap = if said.is_empty() { "" } else { "\n" })]
    Command { command: String, status: std::process::ExitStatus, said: String },
    /// The task itself found something wrong and has told what.
    #[error("{0}")]
    Failed(String),
}

/// The folder of the workspace's `Cargo.toml`.
pub(crate) fn workspace_root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR")).parent().expect("xtask is a member of the workspace")
}

/// The text of a file.
pub(crate) fn read(path: &Path) -> Result<String, TaskError> {
    std::fs::read_to_string(path).map_err(|source| TaskError::File { path: path.to_owned(), source })
}

/// The bytes of a file.
pub(crate) fn read_bytes(path: &Path) -> Result<Vec<u8>, TaskError> {
    std::fs::read(path).map_err(|source| TaskError::File { path: path.to_owned(), source })
}

/// Reads a file of settings.
pub(crate) fn read_toml<T: serde::de::DeserializeOwned>(path: &Path) -> Result<T, TaskError> {
    toml::from_str(&read(path)?).map_err(|error| TaskError::Failed(format!("{}: {error}", path.display())))
}

/// Reads plain data that a program wrote.
pub(crate) fn read_json<T: serde::de::DeserializeOwned>(path: &Path) -> Result<T, TaskError> {
    serde_json::from_str(&read(path)?)
        .map_err(|error| TaskError::Failed(format!("{}: {error}", path.display())))
}

/// Writes a file, and the folders it stands in where they are missing.
pub(crate) fn write(path: &Path, text: &str) -> Result<(), TaskError> {
    let fail = |source| TaskError::File { path: path.to_owned(), source };
    if let Some(folder) = path.parent() {
        std::fs::create_dir_all(folder).map_err(fail)?;
    }
    std::fs::write(path, text).map_err(fail)
}

/// Removes a folder and what is in it, if it is there.
pub(crate) fn remove_folder(path: &Path) -> Result<(), TaskError> {
    match std::fs::remove_dir_all(path) {
        Err(source) if source.kind() != std::io::ErrorKind::NotFound => {
            Err(TaskError::File { path: path.to_owned(), source })
        }
        _ => Ok(()),
    }
}

/// The folders in a folder, sorted.
pub(crate) fn folders_of(folder: &Path) -> Result<Vec<PathBuf>, TaskError> {
    let fail = |source| TaskError::File { path: folder.to_owned(), source };
    let mut found = Vec::new();
    for entry in std::fs::read_dir(folder).map_err(fail)? {
        found.extend(Some(entry.map_err(fail)?.path()).filter(|path| path.is_dir()));
    }
    found.sort();
    Ok(found)
}

/// Names and contents of the files in a folder, sorted by name; folders in it are left out.
pub(crate) fn files_of(folder: &Path) -> Result<Vec<(String, Vec<u8>)>, TaskError> {
    let fail = |source| TaskError::File { path: folder.to_owned(), source };
    let mut files = Vec::new();
    for entry in std::fs::read_dir(folder).map_err(fail)? {
        let path = entry.map_err(fail)?.path();
        if path.is_file() {
            let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
            files.push((name, read_bytes(&path)?));
        }
    }
    files.sort();
    Ok(files)
}
