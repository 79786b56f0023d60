//! `cargo xtask accuracy`: what one more digit costs.
//!
//! Every study in `studies/` is run by `partita study`, one after the other so that each has the machine to itself. The rows
//! are kept in `docs/data/accuracy.csv`; page and pictures are made from that file and the texts of the studies alone.

mod findings;
mod page;
mod row;
mod run;
mod short;
mod study;

use std::path::Path;

use crate::csv::Csv;
use crate::selection::{Mode, Selection};
use crate::task::{self, TaskError};
use findings::Findings;
use row::Row;
use study::{STUDIES, Study};

const DATA: &str = "docs/data/accuracy.csv";
const PAGE: &str = "docs/accuracy.md";

const USAGE: &str = "Usage: cargo xtask accuracy [--mode check|write|page] [STUDY]...";

/// The task as its words say.
pub(crate) fn run(root: &Path, words: &[&str]) -> Result<(), TaskError> {
    let Selection { mode, names: studies } = Selection::parse("accuracy", USAGE, &STUDIES, words)?;
    match mode {
        Mode::Page => write_pages(root),
        Mode::Write => {
            let found = run::studies(root, &studies)?;
            // Where all are new, nothing that is kept matters, not even whether it can be read.
            let is_part = studies.len() < STUDIES.len() && root.join(DATA).exists();
            let others = if is_part { kept(root)? } else { Vec::new() };
            let rows = merged(others, &studies, found);
            task::write(&root.join(DATA), &row::to_csv(&rows).to_text())?;
            write_pages(root)
        }
        Mode::Check => {
            let found = run::studies(root, &studies)?;
            let mut differing = differences(&kept(root)?, &studies, &found);
            differing.extend(stale(root)?);
            if differing.is_empty() { Ok(()) } else { Err(TaskError::Failed(differing.join("\n"))) }
        }
    }
}

fn write_pages(root: &Path) -> Result<(), TaskError> {
    for (path, text) in files(root)? {
        task::write(&root.join(path), &text)?;
    }
    Ok(())
}

/// Runs nothing; fails where page or pictures differ from what the data give.
pub(crate) fn check_pages(root: &Path) -> Result<(), TaskError> {
    let stale = stale(root)?;
    if stale.is_empty() { Ok(()) } else { Err(TaskError::Failed(stale.join("\n"))) }
}

fn stale(root: &Path) -> Result<Vec<String>, TaskError> {
    let differs = |(path, text): &(String, String)| task::read(&root.join(path)).ok().as_ref() != Some(text);
    let line =
        |(path, _)| format!("{path} does not say what {DATA} says; `cargo xtask accuracy --mode page`");
    Ok(files(root)?.into_iter().filter(differs).map(line).collect())
}

/// Page and pictures of the kept rows, by their paths.
fn files(root: &Path) -> Result<Vec<(String, String)>, TaskError> {
    let rows = kept(root)?;
    let findings: Vec<Findings> = STUDIES
        .iter()
        .map(|name| Ok(Findings::new(Study::read(root, name)?, &rows)))
        .collect::<Result<_, TaskError>>()?;
    let mut files = vec![(PAGE.to_owned(), page::markdown(&findings))];
    for found in &findings {
        if let Some(picture) = found.diagram() {
            files.push((format!("docs/{}", found.picture()), picture));
        }
    }
    Ok(files)
}

fn kept(root: &Path) -> Result<Vec<Row>, TaskError> {
    Csv::read(&root.join(DATA))?.rows().map(|values| Row::read(&values)).collect()
}

/// The kept rows with those of `studies` replaced, in the order of the page.
fn merged(kept: Vec<Row>, studies: &[&str], found: Vec<Row>) -> Vec<Row> {
    let others = kept.into_iter().filter(|row| !studies.contains(&row.study.as_str()));
    let all: Vec<Row> = others.chain(found).collect();
    let of = |name: &&str| all.iter().filter(|row| row.study == *name).cloned().collect::<Vec<_>>();
    STUDIES.iter().flat_map(of).collect()
}

/// Rows of `studies` that are not what was kept, times left aside.
fn differences(kept: &[Row], studies: &[&str], found: &[Row]) -> Vec<String> {
    let difference = |found: &Row| match kept.iter().find(|row| row.is_setting_of(found)) {
        None => Some(format!("{} is not in {DATA}", found.shown())),
        Some(kept) if kept.agrees_with(found) => None,
        Some(kept) => Some(format!("found  {}\nkept   {}", found.shown(), kept.shown())),
    };
    let mut all: Vec<String> = found.iter().filter_map(difference).collect();
    let asked = kept.iter().filter(|row| studies.contains(&row.study.as_str()));
    let lost = asked.filter(|row| !found.iter().any(|found| found.is_setting_of(row)));
    all.extend(lost.map(|row| format!("{} is in {DATA} alone", row.shown())));
    all
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::task::workspace_root;

    /// The page says what the data says: nobody has edited one without the other.
    #[test]
    fn page_and_pictures_are_those_of_the_data() {
        check_pages(workspace_root()).expect("the shipped page");
    }

    #[test]
    fn every_study_on_the_disk_is_on_the_page_and_has_rows() {
        let root = workspace_root();
        let mut on_disk: Vec<String> = task::files_of(&root.join("studies"))
            .expect("the folder of studies")
            .into_iter()
            .filter_map(|(name, _)| name.strip_suffix(".toml").map(str::to_owned))
            .collect();
        on_disk.sort();
        let mut listed = STUDIES.to_vec();
        listed.sort_unstable();
        assert_eq!(on_disk, listed);
        let rows = kept(root).expect("the shipped rows");
        for name in STUDIES {
            assert!(rows.iter().any(|row| row.study == name), "{name} has no row in {DATA}");
            for beside in Study::read(root, name).expect("a shipped study").beside {
                assert!(
                    rows.iter().any(|row| row.title() == beside),
                    "{name}: {beside} has no row in {DATA}"
                );
            }
        }
    }

    #[test]
    fn times_may_differ_and_errors_may_not() {
        let row = |study: &str, error: f64, cpu: f64| row::tests::row(study, "BDF1", "dt", error, cpu);
        let kept = [row("csm1", 0.5, 1.0), row("fsi1", 1e-3, 1.0)];
        let found = |error: f64, cpu: f64| differences(&kept, &["csm1"], &[row("csm1", error, cpu)]).len();
        assert_eq!(found(0.5, 9.0), 0);
        assert_eq!(found(0.501, 1.0), 0);
        assert_eq!(found(0.52, 1.0), 1);
        // What is missing is found where it was asked for only.
        assert_eq!(differences(&kept, &["csm1"], &[]).len(), 1);
        assert_eq!(differences(&kept, &["csm1", "fsi1"], &[]).len(), 2);
        assert_eq!(differences(&[], &["csm1"], &[row("csm1", 0.5, 1.0)]).len(), 1);
    }

    #[test]
    fn one_study_is_replaced_and_the_others_stay() {
        let row = |study: &str, error: f64| row::tests::row(study, "BDF1", "dt", error, 1.0);
        let rows = merged(vec![row("csm1", 1.0), row("fsi1", 2.0)], &["csm1"], vec![row("csm1", 3.0)]);
        let found: Vec<(&str, Option<f64>)> =
            rows.iter().map(|row| (row.study.as_str(), row.error)).collect();
        assert_eq!(found, [("csm1", Some(3.0)), ("fsi1", Some(2.0))]);
    }
}
