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
use crate::task::{self, TaskError};
use row::Row;

const DATA: &str = "docs/data/effects.csv";
const PAGE: &str = "docs/effects.md";

const USAGE: &str = "Usage: cargo xtask effects [--mode write|check]";

/// Runs the family and checks or writes what comes out.
pub(crate) fn run(root: &Path, words: &[&str]) -> Result<(), TaskError> {
    let write = match words {
        [] | ["--mode", "check"] => false,
        ["--mode", "write"] => true,
        _ => return Err(TaskError::Usage { given: format!("effects {}", words.join(" ")), usage: USAGE }),
    };
    let found = run::family(root)?;
    for row in &found {
        println!("{}", row.shown());
    }
    if write {
        task::write(&root.join(DATA), &row::to_csv(&found).to_text())?;
        return task::write(&root.join(PAGE), &page::markdown(&found));
    }
    let kept = kept(root)?;
    let differing = differences(&kept, &found);
    if differing.is_empty() { Ok(()) } else { Err(TaskError::Failed(differing.join("\n"))) }
}

fn kept(root: &Path) -> Result<Vec<Row>, TaskError> {
    Csv::read(&root.join(DATA))?.rows().map(|values| Row::read(&values)).collect()
}

/// Rows that are not what was kept, times left aside.
fn differences(kept: &[Row], found: &[Row]) -> Vec<String> {
    let difference = |found: &Row| match kept.iter().find(|row| row.name == found.name) {
        None => Some(format!("{} is not in {DATA}", found.name)),
        Some(kept) if kept.agrees_with(found) => None,
        Some(kept) => Some(format!("found  {}\nkept   {}", found.shown(), kept.shown())),
    };
    let mut all: Vec<String> = found.iter().filter_map(difference).collect();
    let lost = kept.iter().filter(|row| !found.iter().any(|found| found.name == row.name));
    all.extend(lost.map(|row| format!("{} is in {DATA} alone", row.name)));
    all
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::task::workspace_root;

    /// The page says what the data says: nobody has edited one without the other.
    #[test]
    fn the_page_is_that_of_the_data() {
        let root = workspace_root();
        let rows = kept(root).expect("the shipped rows");
        let page = task::read(&root.join(PAGE)).expect("the shipped page");
        assert!(page == page::markdown(&rows), "{PAGE} is not of {DATA}; cargo xtask effects --mode write");
        let names: Vec<&str> = rows.iter().map(|row| row.name.as_str()).collect();
        assert_eq!(names, family::all().iter().map(|member| member.name).collect::<Vec<_>>());
    }

    #[test]
    fn times_may_differ_and_counts_may_not() {
        let row = |seconds: &str, factorizations: usize, error: &str| Row {
            name: "all".to_owned(),
            effects: "fluid".to_owned(),
            seconds_per_step: seconds.to_owned(),
            factorizations,
            assemblies: 7,
            error: error.to_owned(),
            load_error: "0".to_owned(),
        };
        let kept = [row("1", 3, "0.5")];
        assert_eq!(differences(&kept, &[row("2", 3, "0.50001")]), Vec::<String>::new());
        assert_eq!(differences(&kept, &[row("1", 4, "0.5")]).len(), 1);
        assert_eq!(differences(&kept, &[row("1", 3, "0.51")]).len(), 1);
        assert_eq!(differences(&kept, &[]).len(), 1);
    }
}
