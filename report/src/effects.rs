//! `cargo xtask effects`: what each effect of a scene costs, and what leaving it out does to the answer.
//!
//! One family of scenes, the beam in channel flow: effects are switched on one by one, then the whole scene is run without
//! one of them at a time. Which effects a run had is what `partita plan` says of it. The rows are kept in
//! `docs/data/effects.csv`; the page is made from that file alone.

mod family;
mod page;
mod row;
mod run;

use std::path::Path;

use crate::csv::Csv;
use crate::kept::{self, EXACT, Tolerance};
use crate::options::Abilities;
use crate::report::{File, Found, Report, Table};
use crate::runs::Runs;
use crate::task::TaskError;
use row::Row;

const DATA: &str = "docs/data/effects.csv";
const PAGE: &str = "docs/effects.md";

/// The family.
pub(crate) struct Effects;

impl Report for Effects {
    fn abilities(&self) -> Abilities {
        Abilities { measures_time: true, ..Abilities::of("effects") }
    }

    fn found(&self, runs: Runs) -> Result<Found, TaskError> {
        let rows = row::to_csv(&run::family(&runs)?);
        Ok(Found { tables: vec![Table { path: DATA.to_owned(), rows, differences }], files: Vec::new() })
    }

    fn pages(&self, root: &Path) -> Result<Vec<File>, TaskError> {
        Ok(vec![(PAGE.to_owned(), page::text(&kept(root)?))])
    }
}

fn kept(root: &Path) -> Result<Vec<Row>, TaskError> {
    Csv::read_as(&root.join(DATA), |row| Row::read(&row))
}

/// Counts are the same, errors to three digits; those below a millionth are round-off of the bounds.
fn differences(kept: &Csv, found: &Csv) -> Result<Vec<String>, TaskError> {
    let error = Tolerance { part: 1e-3, least: 1e-6 };
    let columns = [
        ("effects", EXACT),
        ("factorizations", EXACT),
        ("assemblies", EXACT),
        ("error", error),
        ("load_error", error),
    ];
    kept::differences(&["scene"], &columns, kept, found)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::task::workspace_root;

    #[test]
    fn every_member_has_a_row() {
        let root = workspace_root();
        let rows = kept(root).expect("the shipped rows");
        let names: Vec<&str> = rows.iter().map(|row| row.name.as_str()).collect();
        assert_eq!(names, family::all().iter().map(|member| member.name).collect::<Vec<_>>());
    }
}
