//! What a Newton iteration, a step and their memory cost: measured, kept in `docs/data`, shown in `docs/performance.md`.
//!
//! The fluid's bench is started once for each size, so that the peak of memory is that of the size; the paper's scenes run
//! with the program. Times are those of the machine at hand, so that nothing compares them with the ones kept.

mod fit;
mod measure;
mod page;

use std::path::Path;

use clap::Args;

use crate::csv::Csv;
use crate::options::{Abilities, Options};
use crate::report::{File, Found, Report, carry_out};
use crate::runs::Runs;
use crate::task::{self, TaskError};

const TIMES: &str = "docs/data/performance.csv";
const MEMORY: &str = "docs/data/memory.csv";
const MACHINE: &str = "docs/data/performance-machine.txt";
const PAGE: &str = "docs/performance.md";

/// What stands behind `performance`.
#[derive(Debug, Args)]
pub(crate) struct Arguments {
    /// Leave out sizes of more unknowns
    #[arg(long, value_name = "DOFS", default_value_t = usize::MAX, hide_default_value = true)]
    largest: usize,
    #[command(flatten)]
    options: Options,
}

/// Measurements of sizes up to this number of unknowns.
#[derive(Default)]
pub(crate) struct Performance {
    largest: usize,
}

/// The task as its arguments say.
pub(crate) fn run(root: &Path, arguments: &Arguments) -> Result<(), TaskError> {
    carry_out(root, &Performance { largest: arguments.largest }, &arguments.options)
}

impl Report for Performance {
    fn abilities(&self) -> Abilities {
        Abilities { measures_time: true, compares: false, ..Abilities::of("performance") }
    }

    fn found(&self, runs: Runs) -> Result<Found, TaskError> {
        let Data { times, memory, machine } = measure::all(&runs, self.largest)?;
        let files = [(TIMES, times.to_text()), (MEMORY, memory.to_text()), (MACHINE, machine)];
        let files = files.map(|(path, text)| (path.to_owned(), text)).to_vec();
        Ok(Found { files, ..Found::default() })
    }

    fn pages(&self, root: &Path) -> Result<Vec<File>, TaskError> {
        Ok(vec![(PAGE.to_owned(), page::text(&Data::read(root)?)?)])
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
}
