//! The words behind a task.

use crate::USAGE;
use crate::task::TaskError;

/// What to do with pages and results.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Mode {
    /// Do the runs and write results and pages.
    Write,
    /// Do no runs; fail where a page differs from the results.
    Check,
    /// Do the runs, show what came of them, write nothing.
    Print,
    /// Write the pages and figures from the results that are kept.
    Page,
}

/// How a task that runs scenes is done.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Options {
    /// Of the paper's tables; `None` is all.
    pub(crate) table: Option<usize>,
    pub(crate) quick: bool,
    /// `None` where the command line does not say.
    pub(crate) mode: Option<Mode>,
    /// Runs at a time.
    pub(crate) jobs: usize,
    /// Do again what is remembered.
    pub(crate) fresh: bool,
}

impl Options {
    /// Reads `--table N --quick --mode M --jobs N --fresh`, each at most once, in any order.
    pub(crate) fn parse(task: &str, words: &[&str]) -> Result<Self, TaskError> {
        let wrong = || TaskError::Usage { given: format!("{task} {}", words.join(" ")), usage: USAGE };
        let cores = std::thread::available_parallelism().map_or(1, Into::into);
        let mut options = Self { table: None, quick: false, mode: None, jobs: cores, fresh: false };
        let mut seen = Vec::new();
        let mut rest = words.iter();
        while let Some(&word) = rest.next() {
            if seen.contains(&word) {
                return Err(wrong());
            }
            seen.push(word);
            let mut value = || rest.next().copied().ok_or_else(wrong);
            match word {
                "--quick" => options.quick = true,
                "--fresh" => options.fresh = true,
                "--table" => match value()? {
                    number @ ("1" | "2" | "3") => options.table = number.parse().ok(),
                    _ => return Err(wrong()),
                },
                "--jobs" => {
                    let jobs = value()?.parse().ok().filter(|jobs| *jobs > 0);
                    options.jobs = jobs.ok_or_else(wrong)?;
                }
                "--mode" => {
                    options.mode = Some(match value()? {
                        "write" => Mode::Write,
                        "check" => Mode::Check,
                        "print" => Mode::Print,
                        "page" if matches!(task, "reproduce" | "beyond" | "infer") => Mode::Page,
                        _ => return Err(wrong()),
                    });
                }
                _ => return Err(wrong()),
            }
        }
        // The quick runs are on no page.
        if options.quick && options.mode == Some(Mode::Page) { Err(wrong()) } else { Ok(options) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn options_are_read_in_any_order() {
        let options =
            Options::parse("reproduce", &["--jobs", "3", "--table", "2", "--mode", "check", "--fresh"]);
        let expected =
            Options { table: Some(2), quick: false, mode: Some(Mode::Check), jobs: 3, fresh: true };
        assert_eq!(options.expect("sound"), expected);
        let plain = Options::parse("reproduce", &["--quick"]).expect("sound");
        assert!(plain.quick && plain.mode.is_none() && plain.table.is_none() && plain.jobs > 0);
    }

    #[test]
    fn what_is_not_an_option_is_refused() {
        for words in [
            &["--table", "4"][..],
            &["--table"],
            &["--jobs", "0"],
            &["--mode", "maybe"],
            &["--quick", "--quick"],
            &["quick"],
            &["--quick", "--mode", "page"],
        ] {
            assert!(Options::parse("reproduce", words).is_err(), "{words:?}");
        }
        assert!(Options::parse("sensitivity", &["--mode", "page"]).is_err(), "it has no page");
    }
}
