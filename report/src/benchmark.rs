//! Published benchmarks, run level by level and compared with the literature.
//!
//! A case is described by `benchmark.toml` beside its scene. What comes out is kept in `docs/data/benchmarks.csv`; the
//! page and the pictures are made from that file and the last periods in `docs/data/signals` alone.

mod animate;
mod case;
mod page;
mod plot;
mod row;
mod run;
mod signal;
mod signals;

use std::path::Path;

use clap::Args;

use case::Case;
use row::Row;

use crate::csv::Csv;
use crate::options::{Abilities, Options};
use crate::report::{File, Found, Report, Table, carry_out};
use crate::runs::Runs;
use crate::task::TaskError;

const DATA: &str = "docs/data/benchmarks.csv";
const PAGE: &str = "docs/benchmarks.md";

/// What stands behind `benchmark`.
#[derive(Debug, Args)]
pub(crate) struct Arguments {
    /// Cases to run [default: all]
    #[arg(value_name = "CASE")]
    cases: Vec<String>,
    /// Only this level; 1 is the coarsest
    #[arg(long, value_name = "L", value_parser = clap::value_parser!(u16).range(1..))]
    level: Option<u16>,
    /// Continue each run for one more period and write fields of it
    #[arg(long)]
    animate: bool,
    #[command(flatten)]
    options: Options,
}

/// Levels of cases.
struct Benchmarks {
    all: Vec<Case>,
    /// Places in `all`, and the levels of each.
    chosen: Vec<(usize, Vec<usize>)>,
    animate: bool,
}

/// The task as its arguments say.
pub(crate) fn run(root: &Path, arguments: &Arguments) -> Result<(), TaskError> {
    let all = case::all(root)?;
    let chosen = choose(&all, &arguments.cases, arguments.level.map(usize::from))?;
    carry_out(root, &Benchmarks { all, chosen, animate: arguments.animate }, &arguments.options)
}

/// Fails where page or pictures differ from the data.
pub(crate) fn check(root: &Path) -> Result<(), TaskError> {
    crate::report::check(root, &Benchmarks { all: case::all(root)?, chosen: Vec::new(), animate: false })
}

/// The cases asked for, all where none is, and the levels of each.
fn choose(
    all: &[Case],
    names: &[String],
    level: Option<usize>,
) -> Result<Vec<(usize, Vec<usize>)>, TaskError> {
    let refused = |what: String, hint: String| Err(TaskError::Refused { what, hint });
    if let Some(unknown) = names.iter().find(|name| !all.iter().any(|case| case.name == **name)) {
        let known: Vec<&str> = all.iter().map(|case| case.name.as_str()).collect();
        return refused(format!("no case `{unknown}`"), format!("there are {}", known.join(", ")));
    }
    let mut chosen = Vec::new();
    for (place, case) in
        all.iter().enumerate().filter(|(_, case)| names.is_empty() || names.contains(&case.name))
    {
        let levels: Vec<usize> =
            (1..=case.levels.len()).filter(|number| level.is_none_or(|only| only == *number)).collect();
        if levels.is_empty() {
            let what = format!("{} has no such level", case.name);
            return refused(what, format!("it has {} levels", case.levels.len()));
        }
        chosen.push((place, levels));
    }
    Ok(chosen)
}

impl Report for Benchmarks {
    /// One run has the machine to itself.
    fn abilities(&self) -> Abilities {
        Abilities { measures_time: true, ..Abilities::of("benchmark") }
    }

    fn found(&self, runs: Runs) -> Result<Found, TaskError> {
        let (mut rows, mut files) = (kept_rows(&runs.root)?, Vec::new());
        for (place, levels) in &self.chosen {
            let case = &self.all[*place];
            for &level in levels {
                let run::Found { rows: found, samples, dir } = run::level(&runs, case, level)?;
                print!("{}", table(&found));
                if self.animate {
                    let copy = animate::period(&runs, case, &dir, samples.as_ref())?;
                    println!("one more period with fields: {}", copy.display());
                }
                rows.retain(|row| (&row.case, row.level) != (&case.name, level));
                rows.extend(found);
                files.extend(
                    samples.map(|samples| (samples_path(case, level), signals::to_csv(&samples).to_text())),
                );
            }
        }
        let rows = row::to_csv(&in_order(&self.all, rows));
        let table = Table { path: DATA.to_owned(), rows, differences: row::differences };
        Ok(Found { tables: vec![table], files })
    }

    fn pages(&self, root: &Path) -> Result<Vec<File>, TaskError> {
        let rows = kept_rows(root)?;
        let mut files = vec![(PAGE.to_owned(), page::text(&self.all, &rows))];
        for case in &self.all {
            let of_case: Vec<&Row> = rows.iter().filter(|row| row.case == case.name).collect();
            let errors =
                plot::errors(&case.name, &case.title, &of_case).map(|picture| (String::new(), picture));
            let signals = signals::picture(case, &kept_samples(root, case)?)
                .map(|picture| ("-signals".to_owned(), picture));
            let pictures = errors.into_iter().chain(signals);
            files.extend(
                pictures.map(|(ending, text)| (format!("docs/benchmarks/{}{ending}.svg", case.name), text)),
            );
        }
        Ok(files)
    }
}

fn kept_rows(root: &Path) -> Result<Vec<Row>, TaskError> {
    let path = root.join(DATA);
    if path.is_file() { Csv::read_as(&path, Row::read) } else { Ok(Vec::new()) }
}

/// The rows in the order of the cases; those of cases that are gone are left out.
fn in_order(cases: &[Case], mut rows: Vec<Row>) -> Vec<Row> {
    let place = |row: &Row| {
        let case = cases.iter().position(|case| case.name == row.case)?;
        let quantity = cases[case].quantities.iter().position(|quantity| quantity.name == row.quantity)?;
        Some((case, row.level, quantity))
    };
    rows.retain(|row| place(row).is_some());
    rows.sort_by_key(place);
    rows
}

fn samples_path(case: &Case, level: usize) -> String {
    format!("docs/data/signals/{}-{level}.csv", case.name)
}

/// The last periods of each level that has been run; none of a case without periods.
fn kept_samples(root: &Path, case: &Case) -> Result<Vec<(usize, signals::Samples)>, TaskError> {
    let mut kept = Vec::new();
    for level in 1..=case.levels.len() {
        let path = root.join(samples_path(case, level));
        if path.is_file() {
            kept.push((level, signals::from_csv(&Csv::read(&path)?)));
        }
    }
    Ok(kept)
}

fn table(rows: &[Row]) -> String {
    let line = |row: &Row| {
        let mark = if row.meets_its_target() { "" } else { "  above its target" };
        format!(
            "{:<14} {} {:<28} {:>12} {:>12} {:>9} %{mark}\n",
            row.case, row.level, row.quantity, row.reference, row.ours, row.error_percent
        )
    };
    rows.iter().map(line).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::task::workspace_root;

    /// Runs to a periodic state are long; the page names the levels that are missing.
    #[test]
    fn every_case_has_rows_and_its_pictures() {
        let root = workspace_root();
        let all = case::all(root).expect("the shipped cases");
        let rows = kept_rows(root).expect("the shipped rows");
        let pages = Benchmarks { all, chosen: Vec::new(), animate: false };
        let files = pages.pages(root).expect("the page");
        let is_drawn =
            |name: &str| files.iter().any(|(path, _)| *path == format!("docs/benchmarks/{name}.svg"));
        for case in &pages.all {
            let of_case = rows.iter().filter(|row| row.case == case.name).count();
            let levels = of_case / case.quantities.len();
            assert_eq!(of_case, levels * case.quantities.len(), "rows of {}", case.name);
            assert!(levels == case.levels.len() || case.until.is_some(), "levels of {}", case.name);
            assert!(levels > 0, "{} has no rows", case.name);
            let samples = kept_samples(root, case).expect("the shipped signals").len();
            assert_eq!(samples, if case.until.is_some() { levels } else { 0 }, "signals of {}", case.name);
            assert_eq!(is_drawn(&case.name), levels > 1, "{}", case.name);
            assert_eq!(is_drawn(&format!("{}-signals", case.name)), samples > 0, "{}", case.name);
        }
    }

    #[test]
    fn cases_and_levels_that_do_not_exist_are_named() {
        let all = case::all(workspace_root()).expect("the shipped cases");
        let choose = |names: &[&str], level| {
            let names: Vec<String> = names.iter().map(|&name| name.to_owned()).collect();
            choose(&all, &names, level).map_err(|error| error.to_string())
        };
        assert_eq!(choose(&[], None).expect("all").len(), all.len());
        let one = choose(&["csm1"], Some(2)).expect("one");
        assert_eq!((one.len(), one[0].1.as_slice()), (1, &[2][..]));
        assert!(choose(&["csm9"], None).expect_err("no such case").contains("there are "));
        assert!(choose(&["csm1"], Some(77)).expect_err("no such level").contains("csm1 has no such level"));
    }
}
