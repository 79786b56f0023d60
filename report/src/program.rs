//! The program `partita`, built in the profile of this one, and how it is started.

use std::hash::{DefaultHasher, Hash, Hasher};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use serde::Deserialize;

use crate::task::{self, TaskError};

/// Exit code of the program where a run failed: a step could not be solved.
const RUN_FAILED: i32 = 3;

/// The program `partita`.
#[derive(Debug)]
pub(crate) struct Program {
    root: PathBuf,
    binary: PathBuf,
    /// Checksum of the binary: the revision of all source that decides about a run.
    pub(crate) revision: u64,
}

impl Program {
    /// The one at this path, or one that is built. All programs of the workspace are built together, so that they share every
    /// compiled crate.
    pub(crate) fn open(root: &Path, path: Option<&Path>) -> Result<Self, TaskError> {
        let binary = match path {
            Some(path) => std::path::absolute(path)
                .map_err(|source| TaskError::File { path: path.to_owned(), source })?,
            None => build(root)?,
        };
        let revision = checksum(&task::read_bytes(&binary)?);
        Ok(Self { root: root.to_owned(), binary, revision })
    }

    /// Runs it in silence. Returns what it said where a step could not be solved; any other failure is an error.
    pub(crate) fn call(&self, words: &[String]) -> Result<Option<String>, TaskError> {
        let mut command = self.command(words);
        command.stdin(Stdio::null()).stdout(Stdio::null()).env("NO_COLOR", "1");
        let output =
            command.output().map_err(|source| TaskError::Start { command: shown(&command), source })?;
        if output.status.success() {
            return Ok(None);
        }
        let said = String::from_utf8_lossy(&output.stderr).into_owned();
        if output.status.code() == Some(RUN_FAILED) {
            return Ok(Some(said));
        }
        Err(TaskError::Command { command: shown(&command), status: output.status, said })
    }

    /// Runs it with its progress shown.
    pub(crate) fn call_in_sight(&self, words: &[String]) -> Result<(), TaskError> {
        run(self.command(words))
    }

    fn command(&self, words: &[String]) -> Command {
        let mut command = Command::new(&self.binary);
        command.current_dir(&self.root).args(words);
        command
    }
}

/// Builds the program and returns its path.
fn build(root: &Path) -> Result<PathBuf, TaskError> {
    let mut command = cargo(root, &["build", "--quiet", "--workspace", "--bins", "--profile", profile()]);
    command.arg("--message-format=json-render-diagnostics");
    executable(&captured(command)?, "partita")
        .ok_or_else(|| TaskError::Failed("cargo built no program `partita`".to_owned()))
}

/// The profile of this program.
fn profile() -> &'static str {
    if cfg!(debug_assertions) { "dev" } else { "release" }
}

/// Cargo, as the one that started this program.
pub(crate) fn cargo(root: &Path, arguments: &[&str]) -> Command {
    let mut command = Command::new(std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into()));
    command.current_dir(root).args(arguments);
    command
}

/// Runs a command whose output the reader sees.
pub(crate) fn run(mut command: Command) -> Result<(), TaskError> {
    let status = command.status().map_err(|source| TaskError::Start { command: shown(&command), source })?;
    if status.success() {
        return Ok(());
    }
    Err(TaskError::Command { command: shown(&command), status, said: String::new() })
}

/// Runs a command and returns what it writes to stdout; its stderr is the reader's.
pub(crate) fn captured(mut command: Command) -> Result<String, TaskError> {
    let output = command
        .stderr(Stdio::inherit())
        .output()
        .map_err(|source| TaskError::Start { command: shown(&command), source })?;
    if output.status.success() {
        return Ok(String::from_utf8_lossy(&output.stdout).into_owned());
    }
    Err(TaskError::Command { command: shown(&command), status: output.status, said: String::new() })
}

/// The command as one would type it.
fn shown(command: &Command) -> String {
    let program = Path::new(command.get_program()).file_stem().unwrap_or_default();
    std::iter::once(program)
        .chain(command.get_args())
        .map(|word| word.to_string_lossy().into_owned())
        .collect::<Vec<_>>()
        .join(" ")
}

/// The executable of this name in cargo's messages.
fn executable(messages: &str, name: &str) -> Option<PathBuf> {
    #[derive(Deserialize)]
    struct Message {
        executable: Option<PathBuf>,
    }
    let named = |line: &str| serde_json::from_str::<Message>(line).ok()?.executable;
    messages.lines().filter_map(named).find(|path| path.file_stem().is_some_and(|stem| stem == name))
}

/// A checksum of bytes, for names of folders and to see that a file is the same.
pub(crate) fn checksum(bytes: &[u8]) -> u64 {
    let mut hasher = DefaultHasher::new();
    bytes.hash(&mut hasher);
    hasher.finish()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_binary_is_found_among_the_executables_that_cargo_names() {
        let messages = "{\"reason\":\"compiler-artifact\",\"executable\":null}\n\
                        {\"reason\":\"compiler-artifact\",\"executable\":\"target/release/partita\"}\n\
                        {\"reason\":\"compiler-artifact\",\"executable\":\"target/release/partita-report\"}\n\
                        {\"reason\":\"build-finished\",\"success\":true}\n";
        assert_eq!(executable(messages, "partita"), Some(PathBuf::from("target/release/partita")));
        assert_eq!(executable("{\"reason\":\"build-finished\",\"success\":true}\n", "partita"), None);
    }
}
