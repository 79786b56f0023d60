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
use crate::selection::{Mode, Selection};
use crate::task::{self, TaskError};
use row::Row;

const DATA: &str = "docs/data/damping.csv";
const PAGE: &str = "docs/damping.md";

const USAGE: &str = "Usage: cargo xtask damping [--mode check|write|page]";

/// The task as its words say.
pub(crate) fn run(root: &Path, words: &[&str]) -> Result<(), TaskError> {
    match Selection::parse("damping", USAGE, &[], words)?.mode {
        Mode::Page => write_page(root),
        Mode::Write => {
            let rows = run::all(root)?;
            task::write(&root.join(DATA), &row::to_csv(&rows).to_text())?;
            write_page(root)
        }
        Mode::Check => {
            let differing = differences(&kept(root)?, &run::all(root)?);
            if differing.is_empty() {
                return check_page(root);
            }
            Err(TaskError::Failed(differing.join("\n")))
        }
    }
}

fn write_page(root: &Path) -> Result<(), TaskError> {
    task::write(&root.join(PAGE), &page::markdown(&kept(root)?))
}

fn check_page(root: &Path) -> Result<(), TaskError> {
    if task::read(&root.join(PAGE))? == page::markdown(&kept(root)?) {
        return Ok(());
    }
    Err(TaskError::Failed(format!("{PAGE} does not say what {DATA} says; `cargo xtask damping --mode page`")))
}

fn kept(root: &Path) -> Result<Vec<Row>, TaskError> {
    Csv::read(&root.join(DATA))?.rows().map(|values| Row::read(&values)).collect()
}

/// Rows that are not what was kept.
fn differences(kept: &[Row], found: &[Row]) -> Vec<String> {
    let difference = |found: &Row| match kept.iter().find(|row| row.is_run_of(found)) {
        None => Some(format!("{} is not in {DATA}", found.shown())),
        Some(kept) if kept.agrees_with(found) => None,
        Some(kept) => Some(format!("found  {}\nkept   {}", found.shown(), kept.shown())),
    };
    let mut all: Vec<String> = found.iter().filter_map(difference).collect();
    let lost = kept.iter().filter(|row| !found.iter().any(|found| found.is_run_of(row)));
    all.extend(lost.map(|row| format!("{} is in {DATA} alone", row.shown())));
    all
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
    fn the_page_is_that_of_the_data() {
        let root = workspace_root();
        check_page(root).expect("the shipped page");
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

    #[test]
    fn a_row_that_changed_appeared_or_went_is_told() {
        let row = |radius, second_difference| Row {
            case: "flap".to_owned(),
            radius,
            value: 0.5,
            second_difference: Some(second_difference),
            displacement_error: 0.1,
            force_error: Some(0.2),
        };
        let kept = [row(Radius::Default, 1.0)];
        assert_eq!(differences(&kept, &[row(Radius::Default, 1.000_01)]), Vec::<String>::new());
        assert_eq!(differences(&kept, &[row(Radius::Default, 1.01)]).len(), 1);
        assert_eq!(differences(&kept, &[row(Radius::Given(0.5), 1.0)]).len(), 2);
        assert_eq!(differences(&kept, &[Row { force_error: None, ..row(Radius::Default, 1.0) }]).len(), 1);
        assert_eq!(differences(&kept, &[Row { value: 0.6, ..row(Radius::Default, 1.0) }]).len(), 1);
    }
}
