//! `cargo xtask damping`: which spectral radius keeps the interface force from oscillating, and what it costs in accuracy.
//!
//! A few scenes are run at several radii and with much smaller steps. The rows are kept in `docs/data/damping.csv`; the page
//! is made from that file alone.

mod case;
mod page;
mod row;
mod run;
mod series;

use std::path::Path;

use crate::csv::Csv;
use crate::kept::{self, EXACT, Tolerance};
use crate::options::Abilities;
use crate::report::{File, Found, Report, Table};
use crate::runs::Runs;
use crate::task::TaskError;
use row::Row;

const DATA: &str = "docs/data/damping.csv";
const PAGE: &str = "docs/damping.md";

/// The scenes at several radii.
pub(crate) struct Damping;

impl Report for Damping {
    fn abilities(&self) -> Abilities {
        Abilities::of("damping")
    }

    fn found(&self, runs: Runs) -> Result<Found, TaskError> {
        let rows = row::to_csv(&run::all(&runs)?);
        Ok(Found { tables: vec![Table { path: DATA.to_owned(), rows, differences }], files: Vec::new() })
    }

    fn pages(&self, root: &Path) -> Result<Vec<File>, TaskError> {
        Ok(vec![(PAGE.to_owned(), page::text(&kept(root)?))])
    }
}

fn kept(root: &Path) -> Result<Vec<Row>, TaskError> {
    Csv::read_as(&root.join(DATA), |row| Row::read(&row))
}

/// Numbers to three digits; errors below a millionth are round-off of the bounds.
fn differences(kept: &Csv, found: &Csv) -> Result<Vec<String>, TaskError> {
    let number = Tolerance { part: 1e-3, least: 1e-6 };
    let columns = [
        ("spectral_radius", EXACT),
        ("second_difference", number),
        ("displacement_error", number),
        ("force_error", number),
    ];
    kept::differences(&["case", "run"], &columns, kept, found)
}

#[cfg(test)]
mod tests {
    use super::case::CASES;
    use super::row::Radius;
    use super::*;
    use crate::task::workspace_root;

    /// All rows that a full run gives, without what was measured.
    fn wanted() -> impl Iterator<Item = (&'static str, Radius)> {
        CASES.iter().flat_map(|case| row::RADII.into_iter().map(|radius| (case.name, radius)))
    }

    #[test]
    fn every_run_of_every_case_has_a_row() {
        let root = workspace_root();
        let rows = kept(root).expect("the shipped rows");
        let names: Vec<_> = rows.iter().map(|row| (row.case.as_str(), row.radius)).collect();
        assert_eq!(names, wanted().collect::<Vec<_>>());
    }

    /// The row of the default is a run that does not name a radius, so that a default that has been changed shows here.
    #[test]
    fn the_default_removes_the_oscillation_of_the_flap_and_keeps_the_accuracy() {
        let rows = kept(workspace_root()).expect("the shipped rows");
        let of = |case: &str, radius: Radius| {
            rows.iter().find(|row| row.case == case && row.radius == radius).expect("a row for each radius")
        };
        let second_difference =
            |radius| of(case::FLAP, radius).second_difference.expect("the flap has a force");
        assert!(second_difference(Radius::Default) <= second_difference(Radius::Given(1.0)) / 5.0);
        for case in &CASES {
            let [default, undamped] =
                [Radius::Default, Radius::Given(1.0)].map(|radius| of(case.name, radius));
            assert!(default.displacement_error <= 1.2 * undamped.displacement_error, "{}", case.name);
            assert!(default.force_error <= undamped.force_error, "{}", case.name);
        }
    }
}
