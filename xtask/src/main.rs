//! Tasks of the Partita workspace, started with `cargo xtask <task>`.
//!
//! What keeps the house is here; what runs scenes and writes pages about them is the program of `report/`, which is built with
//! optimization and started by the same names.

mod ci;
mod task;
mod tidy;

use std::process::ExitCode;

use task::{TaskError, cargo, workspace_root};

const USAGE: &str = "\
Usage: cargo xtask <task>

Tasks:
  tidy                   check what a compiler does not: arrows between rooms, file lengths, words that must not stand
  ci [--skip NAME]...    run all that CI runs, in its order: test, fmt, clippy, doc, tidy, report
  help                   show this, and the tasks of report

Any other task is one of report:

";

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let arguments: Vec<&str> = arguments.iter().map(String::as_str).collect();
    match dispatch(&arguments) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("xtask: {error}");
            ExitCode::from(code(&error))
        }
    }
}

/// A wrong command line is 2; a program that failed has a code of its own.
fn code(error: &TaskError) -> u8 {
    match error {
        TaskError::Usage { .. } => 2,
        TaskError::Command { status, .. } => {
            status.code().and_then(|code| u8::try_from(code).ok()).unwrap_or(1)
        }
        _ => 1,
    }
}

fn dispatch(arguments: &[&str]) -> Result<(), TaskError> {
    let root = workspace_root();
    match arguments {
        ["tidy"] => tidy::run(root),
        ["ci", options @ ..] => ci::run(root, &skipped(options)?),
        [] | ["help" | "--help" | "-h"] => {
            print!("{USAGE}");
            report(&["help"])
        }
        words => report(words),
    }
}

/// Starts a task of the program of `report/`. All programs are built together, as it builds the one it starts: with another
/// selection of packages the heavy dependencies have other features, and are compiled again.
fn report(words: &[&str]) -> Result<(), TaskError> {
    task::run(cargo(workspace_root(), &["build", "--release", "--quiet", "--workspace", "--bins"]))?;
    let mut command = task::built("release", "partita-report")?;
    command.args(words);
    task::run(command)
}

/// The names after each `--skip`.
fn skipped<'a>(options: &[&'a str]) -> Result<Vec<&'a str>, TaskError> {
    let names: Vec<&str> = match options {
        [] => return Ok(Vec::new()),
        ["--skip", name, rest @ ..] => std::iter::once(*name).chain(skipped(rest)?).collect(),
        _ => return Err(TaskError::Usage { given: options.join(" "), usage: USAGE }),
    };
    match names.iter().find(|name| !ci::names().any(|known| known == **name)) {
        Some(unknown) => Err(TaskError::Usage { given: format!("ci --skip {unknown}"), usage: USAGE }),
        None => Ok(names),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn skip_takes_known_names_and_refuses_others() {
        assert_eq!(skipped(&["--skip", "test", "--skip", "doc"]).expect("known names"), ["test", "doc"]);
        assert!(skipped(&["--skip", "tests"]).is_err());
        assert!(skipped(&["--skip"]).is_err());
        assert!(skipped(&["test"]).is_err());
    }
}
