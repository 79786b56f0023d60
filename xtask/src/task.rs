//! What every task needs: where the workspace is, and how a task fails.

use std::path::{Path, PathBuf};
use std::process::Command;

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

/// A program of the workspace that was built in a profile: it lies beside the profile of this one.
pub(crate) fn built(profile: &str, program: &str) -> Result<Command, TaskError> {
    let this =
        std::env::current_exe().map_err(|source| TaskError::File { path: PathBuf::from("xtask"), source })?;
    let target = this.parent().and_then(Path::parent).expect("cargo puts a binary into target/<profile>");
    let name = format!("{program}{}", std::env::consts::EXE_SUFFIX);
    Ok(Command::new(target.join(profile).join(name)))
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
