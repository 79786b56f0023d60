//! What a Newton iteration, a step and their memory cost: measured, kept in `docs/data`, shown in `docs/performance.md`.
//!
//! The fluid's bench is started once for each size, so that the peak of memory is that of the size; the paper's scenes run
//! with the release binary. Times are those of the machine at hand, so that nothing compares them with the ones kept.

mod fit;
mod measure;
mod page;

use std::path::Path;

use crate::csv::Csv;
use crate::task::{self, TaskError};

const TIMES: &str = "docs/data/performance.csv";
const MEMORY: &str = "docs/data/memory.csv";
const MACHINE: &str = "docs/data/performance-machine.txt";
const PAGE: &str = "docs/performance.md";

/// The words behind `performance`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Options {
    /// Sizes beyond this number of unknowns are left out.
    largest: usize,
    /// Only ask whether the page says what the data says.
    check: bool,
}

impl Options {
    fn read(words: &[&str]) -> Result<Self, String> {
        let mut options = Self { largest: usize::MAX, check: false };
        let mut words = words.iter().copied();
        while let Some(word) = words.next() {
            let value = words.next().unwrap_or_default();
            match word {
                "--largest" => {
                    options.largest = value
                        .parse()
                        .map_err(|_| format!("--largest takes a number of unknowns, not `{value}`"))?;
                }
                "--mode" => {
                    options.check = match value {
                        "write" => false,
                        "check" => true,
                        other => return Err(format!("--mode is `write` or `check`, not `{other}`")),
                    };
                }
                other => return Err(format!("no such option: {other}")),
            }
        }
        Ok(options)
    }
}

/// What was measured.
#[derive(Debug, Clone, PartialEq, Eq)]
struct Data {
    /// `part,dofs,threads,milliseconds,ratio_to_faer`
    times: Csv,
    /// `dofs,factor_megabytes,peak_megabytes` of the fluid's steps.
    memory: Csv,
    machine: String,
}

impl Data {
    fn new(machine: String) -> Self {
        let times = Csv::new(["part", "dofs", "threads", "milliseconds", "ratio_to_faer"]);
        let memory = Csv::new(["dofs", "factor_megabytes", "peak_megabytes"]);
        Self { times, memory, machine }
    }

    fn read(root: &Path) -> Result<Self, TaskError> {
        Ok(Self {
            times: Csv::read(&root.join(TIMES))?,
            memory: Csv::read(&root.join(MEMORY))?,
            machine: task::read(&root.join(MACHINE))?,
        })
    }

    fn write(&self, root: &Path) -> Result<(), TaskError> {
        task::write(&root.join(TIMES), &self.times.to_text())?;
        task::write(&root.join(MEMORY), &self.memory.to_text())?;
        task::write(&root.join(MACHINE), &self.machine)?;
        task::write(&root.join(PAGE), &page::markdown(self)?)
    }
}

/// Measures all sizes that `words` ask for and writes data and page, or checks the page.
pub(crate) fn run(root: &Path, words: &[&str]) -> Result<(), TaskError> {
    let options = Options::read(words).map_err(TaskError::Failed)?;
    if options.check { check(root) } else { measure::all(root, options.largest)?.write(root) }
}

fn check(root: &Path) -> Result<(), TaskError> {
    if task::read(&root.join(PAGE))? == page::markdown(&Data::read(root)?)? {
        return Ok(());
    }
    Err(TaskError::Failed(format!(
        "{PAGE} does not say what docs/data says\nhint: `cargo xtask performance` measures and writes both"
    )))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::task::workspace_root;

    #[test]
    fn options_are_read_and_others_refused() {
        let options = Options::read(&["--largest", "100000", "--mode", "check"]).expect("sound");
        assert_eq!(options, Options { largest: 100_000, check: true });
        for words in [&["--largest", "many"][..], &["--mode", "print"], &["--largest"], &["parts"]] {
            assert!(Options::read(words).is_err(), "{words:?}");
        }
    }

    /// Nobody has edited one without the other.
    #[test]
    fn the_page_is_that_of_the_data() {
        check(workspace_root()).expect("the shipped page");
    }
}
