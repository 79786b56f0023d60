//! The paper's tables, figures and claims, repeated.

pub(crate) mod case;
pub(crate) mod claims;
pub(crate) mod cost;
pub(crate) mod counts;
pub(crate) mod facts;
mod page;
pub(crate) mod published;
mod quick;
pub(crate) mod results;
pub(crate) mod setting;
pub(crate) mod study;
mod substitutes;

use std::path::Path;

use clap::Args;

use crate::options::{Abilities, Mode, Options};
use crate::report::{File, Found, Report, carry_out};
use crate::runs::Runs;
use crate::snapshot;
use crate::task::TaskError;
use case::Case;
use page::Page;
use published::Published;
pub(crate) use quick::Quick;
use study::{Study, carry_out_all};

/// What stands behind `reproduce`.
#[derive(Debug, Args)]
pub(crate) struct Arguments {
    /// Only the runs of one of the paper's tables
    #[arg(long, value_name = "1|2|3", value_parser = clap::value_parser!(u8).range(1..=3))]
    table: Option<u8>,
    /// Only the first steps at a few settings; modes compare (default) and write, for paper/results/quick.csv
    #[arg(long, conflicts_with = "table")]
    quick: bool,
    #[command(flatten)]
    options: Options,
}

/// The tables to be repeated.
#[derive(Debug, Default)]
pub(crate) struct Tables {
    /// One of them; `None` is all.
    only: Option<u8>,
}

/// The task as its arguments say.
pub(crate) fn run(root: &Path, arguments: &Arguments) -> Result<(), TaskError> {
    if arguments.quick {
        return carry_out(root, &Quick, &arguments.options);
    }
    carry_out(root, &Tables { only: arguments.table }, &arguments.options)
}

impl Report for Tables {
    fn abilities(&self) -> Abilities {
        Abilities::of("reproduce")
    }

    /// Runs the tables asked for; the other results stay as they are.
    fn found(&self, runs: Runs) -> Result<Found, TaskError> {
        let wanted = |table: u8| self.only.is_none_or(|only| only == table);
        let grids = Case::ALL.into_iter().filter(|case| wanted(case.table())).map(Study::of_table);
        let adaptive = Case::ALL.into_iter().filter(|_| wanted(3)).map(Study::of_adaptive);
        let studies: Vec<Study> = grids.chain(adaptive).collect();
        let mut ours = results::read(&runs.root)?;
        for facts in carry_out_all(&runs, &studies)? {
            ours[facts.case as usize].take(facts);
        }
        let tables = results::tables(&ours, &Published::read(&runs.root)?);
        Ok(Found { tables, files: snapshot::all(&runs)? })
    }

    fn pages(&self, root: &Path) -> Result<Vec<File>, TaskError> {
        Ok(Page::read(root)?.files())
    }
}

/// `--quick`.
pub(crate) const QUICK: Abilities =
    Abilities { has_page: false, default: Mode::Compare, ..Abilities::of("reproduce --quick") };
