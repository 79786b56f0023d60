//! `cargo xtask accuracy`: what one more digit costs.
//!
//! Every study in `studies/` is run by `partita study`, one after the other so that each has the machine to itself. The rows
//! are kept in `docs/data/accuracy.csv`; page and pictures are made from that file and the texts of the studies alone.

mod findings;
mod page;
mod row;
mod short;
mod study;
mod words;

use std::path::Path;

use clap::Args;

use crate::csv::Csv;
use crate::kept;
use crate::options::{Abilities, Options};
use crate::report::{File, Found, Report, Table, carry_out};
use crate::runs::Runs;
use crate::task::TaskError;
use findings::Findings;
use row::Row;
use study::{STUDIES, Study};

const DATA: &str = "docs/data/accuracy.csv";
const PAGE: &str = "docs/accuracy.md";

/// What stands behind `accuracy`.
#[derive(Debug, Args)]
pub(crate) struct Arguments {
    /// Studies to run [default: all]
    #[arg(value_name = "STUDY", value_parser = STUDIES)]
    studies: Vec<String>,
    #[command(flatten)]
    options: Options,
}

/// The studies to be run.
pub(crate) struct Accuracy {
    studies: Vec<&'static str>,
}

impl Accuracy {
    pub(crate) fn all() -> Self {
        Self::of(&[])
    }

    /// Those with these names in the order of the page, all where none is given.
    fn of(names: &[String]) -> Self {
        let asked = |name: &&str| names.is_empty() || names.iter().any(|other| other == name);
        Self { studies: STUDIES.into_iter().filter(asked).collect() }
    }
}

/// The task as its arguments say.
pub(crate) fn run(root: &Path, arguments: &Arguments) -> Result<(), TaskError> {
    carry_out(root, &Accuracy::of(&arguments.studies), &arguments.options)
}

impl Report for Accuracy {
    fn abilities(&self) -> Abilities {
        Abilities { measures_time: true, ..Abilities::of("accuracy") }
    }

    /// Runs the studies one after the other.
    fn found(&self, runs: Runs) -> Result<Found, TaskError> {
        let mut found = Vec::new();
        for name in &self.studies {
            let out = runs.sweep("study", &Study::file(name), &[])?;
            found.extend(Csv::read_as(&out.join("study.csv"), |row| Row::of_study(&row))?);
        }
        // Where all are new, nothing that is kept matters, not even whether it can be read.
        let is_part = self.studies.len() < STUDIES.len() && runs.root.join(DATA).exists();
        let others = if is_part { kept_rows(&runs.root)? } else { Vec::new() };
        let rows = row::to_csv(&merged(others, &self.studies, found));
        Ok(Found { tables: vec![Table { path: DATA.to_owned(), rows, differences }], files: Vec::new() })
    }

    fn pages(&self, root: &Path) -> Result<Vec<File>, TaskError> {
        let rows = kept_rows(root)?;
        let findings: Vec<Findings> = STUDIES
            .iter()
            .map(|name| Ok(Findings::new(Study::read(root, name)?, &rows)))
            .collect::<Result<_, TaskError>>()?;
        let mut files = vec![(PAGE.to_owned(), page::text(&findings))];
        for found in &findings {
            if let Some(picture) = found.diagram() {
                files.push((format!("docs/{}", found.picture()), picture));
            }
        }
        Ok(files)
    }
}

fn kept_rows(root: &Path) -> Result<Vec<Row>, TaskError> {
    Csv::read_as(&root.join(DATA), |row| Row::read(&row))
}

/// Errors; times and counts are left out.
fn differences(kept: &Csv, found: &Csv) -> Result<Vec<String>, TaskError> {
    kept::differences(&["study", "choice", "setting"], &[("error", row::ERROR)], kept, found)
}

/// The kept rows with those of `studies` replaced, in the order of the page.
fn merged(kept: Vec<Row>, studies: &[&str], found: Vec<Row>) -> Vec<Row> {
    let others = kept.into_iter().filter(|row| !studies.contains(&row.study.as_str()));
    let all: Vec<Row> = others.chain(found).collect();
    let of = |name: &&str| all.iter().filter(|row| row.study == *name).cloned().collect::<Vec<_>>();
    STUDIES.iter().flat_map(of).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::task::{self, workspace_root};

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
        let rows = kept_rows(root).expect("the shipped rows");
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
    fn one_study_is_replaced_and_the_others_stay() {
        let row = |study: &str, error: f64| row::tests::row(study, "BDF1", "dt", error, 1.0);
        let rows = merged(vec![row("csm1", 1.0), row("fsi1", 2.0)], &["csm1"], vec![row("csm1", 3.0)]);
        let found: Vec<(&str, Option<f64>)> =
            rows.iter().map(|row| (row.study.as_str(), row.error)).collect();
        assert_eq!(found, [("csm1", Some(3.0)), ("fsi1", Some(2.0))]);
    }
}
