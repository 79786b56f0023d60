//! The options that all tasks have.

use std::num::NonZeroUsize;
use std::path::PathBuf;

use clap::{Args, ValueEnum};

use crate::task::TaskError;

/// What becomes of the runs and of the pages about them.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum Mode {
    /// Run, keep the data, and write page and pictures
    Write,
    /// Run and compare with the data that is kept; write nothing, fail where they differ
    Compare,
    /// Run nothing; write page and pictures from the data
    Page,
    /// Run nothing and write nothing; fail where page or pictures differ from the data
    Check,
}

impl Mode {
    fn runs(self) -> bool {
        matches!(self, Self::Write | Self::Compare)
    }
}

/// How a task is done.
#[derive(Debug, Clone, Default, PartialEq, Eq, Args)]
pub(crate) struct Options {
    /// What to do with runs, data and pages [default: write]
    #[arg(long, value_enum)]
    mode: Option<Mode>,
    /// Number of runs at a time; it does not affect the results [default: number of processors]
    #[arg(long, value_name = "N")]
    jobs: Option<NonZeroUsize>,
    /// Run again what is remembered from an earlier task
    #[arg(long)]
    pub(crate) fresh: bool,
    /// Start this program instead of building `partita` in the profile of this one
    #[arg(long, value_name = "PATH")]
    pub(crate) program: Option<PathBuf>,
}

/// What a task does of all that its options could ask for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Abilities {
    /// Its name on the command line.
    pub(crate) task: &'static str,
    /// Where it measures times, each run has the machine to itself.
    pub(crate) measures_time: bool,
    /// Whether it has numbers that come out again.
    pub(crate) compares: bool,
    /// Whether there is a page made of its data.
    pub(crate) has_page: bool,
    pub(crate) default: Mode,
}

impl Abilities {
    /// A task with a page, whose runs can go side by side and come out again.
    pub(crate) const fn of(task: &'static str) -> Self {
        Self { task, measures_time: false, compares: true, has_page: true, default: Mode::Write }
    }
}

impl Options {
    /// All defaults, with this program.
    pub(crate) fn with(program: Option<PathBuf>) -> Self {
        Self { program, ..Self::default() }
    }

    /// The mode, once everything has been refused that the task does not do.
    pub(crate) fn mode(&self, abilities: &Abilities) -> Result<Mode, TaskError> {
        let Abilities { task, measures_time, compares, has_page, default } = *abilities;
        let refused = |what: String, hint: &str| Err(TaskError::Refused { what, hint: hint.to_owned() });
        let mode = self.mode.unwrap_or(default);
        if mode == Mode::Compare && !compares {
            let what =
                format!("{task} measures times, which no other run repeats: --mode compare is not for it");
            return refused(what, "use write, page or check");
        }
        if !mode.runs() && !has_page {
            return refused(format!("{task} has no page"), "use --mode write or --mode compare");
        }
        let of_runs =
            [(self.fresh, "--fresh"), (self.jobs.is_some(), "--jobs"), (self.program.is_some(), "--program")];
        for (given, option) in of_runs {
            if given && !mode.runs() {
                return refused(
                    format!("{option} asks for runs, and this mode runs nothing"),
                    "leave it out",
                );
            }
        }
        if self.jobs.is_some() && measures_time {
            let what = format!("{task} measures times, so that one run goes at a time: --jobs is not for it");
            return refused(what, "leave it out");
        }
        Ok(mode)
    }

    /// Runs at a time.
    pub(crate) fn jobs(&self, abilities: &Abilities) -> usize {
        let cores = || std::thread::available_parallelism().map_or(1, Into::into);
        if abilities.measures_time { 1 } else { self.jobs.map_or_else(cores, Into::into) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::Parser;

    #[derive(Parser)]
    struct Line {
        #[command(flatten)]
        options: Options,
    }

    const TABLES: Abilities = Abilities::of("tables");

    fn mode(abilities: &Abilities, line: &str) -> Result<Mode, String> {
        let words = std::iter::once("task").chain(line.split_whitespace());
        let line = Line::try_parse_from(words).map_err(|error| error.to_string())?;
        line.options.mode(abilities).map_err(|error| error.to_string())
    }

    #[test]
    fn every_mode_is_known_and_a_task_writes_unless_told_otherwise() {
        assert_eq!(mode(&TABLES, ""), Ok(Mode::Write));
        for (line, expected) in [
            ("--mode write --jobs 3 --fresh", Mode::Write),
            ("--fresh --jobs 3 --mode compare", Mode::Compare),
            ("--mode page", Mode::Page),
            ("--mode check", Mode::Check),
        ] {
            assert_eq!(mode(&TABLES, line), Ok(expected), "{line}");
        }
        let quick = Abilities { default: Mode::Compare, ..TABLES };
        assert_eq!(mode(&quick, ""), Ok(Mode::Compare));
    }

    #[test]
    fn what_does_not_apply_is_refused_with_the_reason() {
        let times = Abilities { measures_time: true, compares: false, ..TABLES };
        let pageless = Abilities { has_page: false, ..TABLES };
        for (abilities, line, reason) in [
            (&TABLES, "--mode print", "invalid value 'print'"),
            (&TABLES, "--jobs 0", "invalid value '0'"),
            (&TABLES, "--mode page --fresh", "--fresh asks for runs"),
            (&TABLES, "--mode check --jobs 2", "--jobs asks for runs"),
            (&times, "--mode compare", "no other run repeats"),
            (&times, "--jobs 2", "one run goes at a time"),
            (&pageless, "--mode page", "tables has no page"),
        ] {
            let message = mode(abilities, line).expect_err(line);
            assert!(message.contains(reason), "{line}: {message}");
        }
    }

    #[test]
    fn times_are_measured_one_at_a_time() {
        let line = Line::try_parse_from(["task", "--jobs", "7"]).expect("sound");
        assert_eq!(line.options.jobs(&TABLES), 7);
        assert_eq!(line.options.jobs(&Abilities { measures_time: true, ..TABLES }), 1);
    }
}
