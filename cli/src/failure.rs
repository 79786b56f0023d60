//! From an error to a message on the terminal and an exit code.

use std::fmt;
use std::path::Path;
use std::process::ExitCode;

use miette::{Diagnostic, Report};
use partita::build::BuildError;
use partita::checkpoint::CheckpointError;
use partita::output::{self, OutputError};
use partita::scene::SceneError;
use partita::session::RunError;
use partita_sweep::SweepError;
use serde_json::{Value, json};

/// The scene or the command line is wrong.
pub(crate) const WRONG_INPUT: u8 = 2;
/// The run failed.
pub(crate) const FAILED_RUN: u8 = 3;

/// Why the program ends without success.
#[derive(Debug)]
pub(crate) struct Failure {
    code: u8,
    report: Report,
}

impl Failure {
    /// A folder that no run has written.
    pub(crate) fn no_run(dir: &Path) -> Self {
        let what =
            format!("{} is not the output folder of a run: it holds no {}", dir.display(), output::SCENE);
        let hint = "give the folder that `partita run` wrote to".to_owned();
        Self { code: WRONG_INPUT, report: Complaint { what, hint }.into() }
    }

    /// What keeps a run from starting is the command line's fault: its folder cannot be used.
    pub(crate) fn before_the_first_step(error: RunError) -> Self {
        match error {
            RunError::Output(error) if error.is_refused_write() => Self {
                code: WRONG_INPUT,
                report: Complaint {
                    what: error.to_string(),
                    hint: "name a folder that can be written, on a disk with space, with --out".to_owned(),
                }
                .into(),
            },
            other => other.into(),
        }
    }

    /// Warnings that the user does not want to pass.
    pub(crate) fn denied(count: usize) -> Self {
        let warnings = if count == 1 { "1 warning is".to_owned() } else { format!("{count} warnings are") };
        let what = format!("{warnings} denied by --deny-warnings");
        let hint = "change the scene, or accept a warning by its name with a reason: a line such as \
                    `long_step = \"only the steady state counts\"` under [warnings.accept]"
            .to_owned();
        Self { code: WRONG_INPUT, report: Complaint { what, hint }.into() }
    }

    /// The exit code.
    pub(crate) fn code(&self) -> ExitCode {
        ExitCode::from(self.code)
    }

    /// What is wrong, each with its remedy, as data.
    pub(crate) fn problems(&self) -> Vec<Value> {
        let one = |problem: &dyn Diagnostic| {
            let help = problem.help().map(|help| help.to_string()).unwrap_or_default();
            json!({ "what": problem.to_string(), "remedy": help, "place": place(problem) })
        };
        let top: &dyn Diagnostic = &*self.report;
        top.related().map_or_else(|| vec![one(top)], |several| several.map(one).collect())
    }

    /// Standard output takes nothing.
    pub(crate) fn no_stdout(error: &std::io::Error) -> Self {
        let what = format!("cannot write to standard output: {error}");
        let hint = "the results are in the output folder".to_owned();
        Self { code: FAILED_RUN, report: Complaint { what, hint }.into() }
    }

    /// Says it on stderr; returns the exit code.
    pub(crate) fn show(&self) -> ExitCode {
        eprintln!("{:?}", self.report);
        ExitCode::from(self.code)
    }
}

impl From<SceneError> for Failure {
    fn from(error: SceneError) -> Self {
        Self { code: WRONG_INPUT, report: error.into() }
    }
}

impl From<BuildError> for Failure {
    fn from(error: BuildError) -> Self {
        Self { code: WRONG_INPUT, report: Complaint::of(&error).into() }
    }
}

impl From<OutputError> for Failure {
    fn from(error: OutputError) -> Self {
        match &error {
            OutputError::Occupied { dir } => Self {
                code: WRONG_INPUT,
                report: Complaint {
                    what: format!("the output folder {} is not empty", dir.display()),
                    hint:
                        "name another one with --out, replace the run in it with --force, or take it up with \
                           `partita resume`"
                            .to_owned(),
                }
                .into(),
            },
            OutputError::Foreign { .. } | OutputError::InUse { .. } | OutputError::NoSpace { .. } => {
                Self { code: WRONG_INPUT, report: Complaint::of(&error).into() }
            }
            _ => Self { code: FAILED_RUN, report: Complaint::of(&error).into() },
        }
    }
}

impl From<SweepError> for Failure {
    fn from(error: SweepError) -> Self {
        let code = if error.is_wrong_input() { WRONG_INPUT } else { FAILED_RUN };
        Self { code, report: error.into() }
    }
}

impl From<RunError> for Failure {
    fn from(error: RunError) -> Self {
        match error {
            RunError::Build(error) => error.into(),
            RunError::Output(error) => error.into(),
            RunError::Misfit(_) | RunError::Checkpoint(CheckpointError::Missing { .. }) => {
                Self { code: WRONG_INPUT, report: Complaint::of(&error).into() }
            }
            _ => Self { code: FAILED_RUN, report: Complaint::of(&error).into() },
        }
    }
}

/// File and line of the first mark.
fn place(problem: &dyn Diagnostic) -> Option<String> {
    let mark = problem.labels()?.next()?;
    let text = problem.source_code()?.read_span(mark.inner(), 0, 0).ok()?;
    Some(format!("{}:{}", text.name()?, text.line() + 1))
}

/// What is wrong and what to do about it, without the errors behind it, which say it again.
#[derive(Debug)]
struct Complaint {
    what: String,
    hint: String,
}

impl Complaint {
    fn of(error: &dyn Diagnostic) -> Self {
        let hint = error.help().map(|help| help.to_string());
        Self { what: error.to_string(), hint: hint.unwrap_or_default() }
    }
}

impl fmt::Display for Complaint {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.what)
    }
}

impl std::error::Error for Complaint {}

impl Diagnostic for Complaint {
    fn help<'a>(&'a self) -> Option<Box<dyn fmt::Display + 'a>> {
        (!self.hint.is_empty()).then(|| Box::new(&self.hint) as Box<dyn fmt::Display>)
    }
}
