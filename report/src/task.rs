//! What every task needs: where the workspace is, and how a task fails.

use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

/// Why a task did not succeed.
#[derive(Debug, thiserror::Error)]
pub(crate) enum TaskError {
    /// The command line names no task.
    #[error("no such task: {given:?}\n{usage}")]
    Usage { given: String, usage: &'static str },
    /// A file could not be read or written.
    #[error("{path}: {source}", path = path.display())]
    File { path: PathBuf, source: std::io::Error },
    /// A program could not be started.
    #[error("cannot start `{command}`: {source}")]
    Start { command: String, source: std::io::Error },
    /// A program ended with an error.
    #[error("`{command}` failed ({status})")]
    Command { command: String, status: std::process::ExitStatus },
    /// The task itself found something wrong and has told what.
    #[error("{0}")]
    Failed(String),
}

/// The folder of the workspace's `Cargo.toml`.
pub(crate) fn workspace_root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR")).parent().expect("xtask is a member of the workspace")
}

/// Cargo, as the one that started this task.
pub(crate) fn cargo(root: &Path, arguments: &[&str]) -> Command {
    let mut command = Command::new(std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into()));
    command.current_dir(root).args(arguments);
    command
}

/// The command as one would type it.
pub(crate) fn shown(command: &Command) -> String {
    let program = Path::new(command.get_program()).file_stem().unwrap_or_default();
    std::iter::once(program)
        .chain(command.get_args())
        .map(|word| word.to_string_lossy().into_owned())
        .collect::<Vec<_>>()
        .join(" ")
}

/// Runs a command whose output the reader sees.
pub(crate) fn run(mut command: Command) -> Result<(), TaskError> {
    let status = command.status().map_err(|source| TaskError::Start { command: shown(&command), source })?;
    if status.success() { Ok(()) } else { Err(TaskError::Command { command: shown(&command), status }) }
}

/// Runs a command and returns what it writes to stdout; its stderr is the reader's.
pub(crate) fn captured(mut command: Command) -> Result<String, TaskError> {
    let output = command
        .stderr(Stdio::inherit())
        .output()
        .map_err(|source| TaskError::Start { command: shown(&command), source })?;
    if output.status.success() {
        Ok(String::from_utf8_lossy(&output.stdout).into_owned())
    } else {
        Err(TaskError::Command { command: shown(&command), status: output.status })
    }
}

/// Builds the program; it lies beside the profile of this one.
pub(crate) fn release_binary(root: &Path) -> Result<PathBuf, TaskError> {
    run(cargo(root, &["build", "--release", "--package", "partita-cli", "--bin", "partita"]))?;
    let this =
        std::env::current_exe().map_err(|source| TaskError::File { path: PathBuf::from("xtask"), source })?;
    let target = this.parent().and_then(Path::parent).expect("cargo puts a binary into target/<profile>");
    Ok(target.join("release").join(format!("partita{}", std::env::consts::EXE_SUFFIX)))
}

/// The text of a file.
pub(crate) fn read(path: &Path) -> Result<String, TaskError> {
    std::fs::read_to_string(path).map_err(|source| TaskError::File { path: path.to_owned(), source })
}

/// The bytes of a file.
pub(crate) fn read_bytes(path: &Path) -> Result<Vec<u8>, TaskError> {
    std::fs::read(path).map_err(|source| TaskError::File { path: path.to_owned(), source })
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
