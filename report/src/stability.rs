//! `cargo xtask stability`: the maps of `maps/`, their tables, pictures and page.
//!
//! A map is run by `partita stability`, which counts work and not time, so that its table is the same for any number of
//! jobs. The tables are kept in `docs/data`; the page is made from them, from the maps and from the remarks beside these.

mod compare;
mod page;
mod table;

use std::path::Path;

use clap::Args;

use crate::csv::Csv;
use crate::options::{Abilities, Options};
use crate::report::{File, Found, Report, carry_out};
use crate::runs::Runs;
use crate::task::TaskError;
use table::{Map, Table};

/// The maps in the order of the page.
const MAPS: [&str; 6] = ["tank", "limits", "fluid", "poisson", "rotation", "swing"];

const PAGE: &str = "docs/stability.md";

/// What stands behind `stability`.
#[derive(Debug, Args)]
pub(crate) struct Arguments {
    /// Maps to run [default: all]
    #[arg(value_name = "MAP", value_parser = MAPS)]
    maps: Vec<String>,
    #[command(flatten)]
    options: Options,
}

/// The maps to be run.
#[derive(Default)]
pub(crate) struct Stability {
    maps: Vec<String>,
}

/// The task as its arguments say.
pub(crate) fn run(root: &Path, arguments: &Arguments) -> Result<(), TaskError> {
    carry_out(root, &Stability { maps: arguments.maps.clone() }, &arguments.options)
}

impl Report for Stability {
    fn abilities(&self) -> Abilities {
        Abilities::of("stability")
    }

    fn found(&self, runs: Runs) -> Result<Found, TaskError> {
        let is_asked = |name: &&str| self.maps.is_empty() || self.maps.iter().any(|other| other == name);
        let mut tables = Vec::new();
        for name in MAPS.into_iter().filter(is_asked) {
            let jobs = ["--jobs".to_owned(), runs.jobs.to_string()];
            let rows =
                Csv::read(&runs.sweep("stability", &format!("maps/{name}.toml"), &jobs)?.join("cells.csv"))?;
            let differences = compare::differences;
            tables.push(crate::report::Table { path: data(name), rows, differences });
        }
        Ok(Found { tables, files: Vec::new() })
    }

    fn pages(&self, root: &Path) -> Result<Vec<File>, TaskError> {
        let all = all(root)?;
        let mut files = vec![(PAGE.to_owned(), page::text(&all))];
        files.extend(
            all.iter().map(|(map, table)| (format!("docs/{}", figure(&map.name)), table.picture(map))),
        );
        Ok(files)
    }
}

/// Maps, their remarks and their tables.
fn all(root: &Path) -> Result<Vec<(Map, Table)>, TaskError> {
    let read = |name| Ok((Map::read(root, name)?, Table::read(&Csv::read(&root.join(data(name)))?)?));
    MAPS.into_iter().map(read).collect()
}

fn data(name: &str) -> String {
    format!("docs/data/stability_{name}.csv")
}

/// Seen from the page.
fn figure(name: &str) -> String {
    format!("figures/stability-{name}.svg")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::task::{self, workspace_root};

    #[test]
    fn every_shipped_map_is_on_the_page_with_a_table_of_its_cells() {
        let root = workspace_root();
        let files = task::files_of(&root.join("maps")).expect("the maps");
        let shipped = files.iter().filter_map(|(name, _)| name.strip_suffix(".toml"));
        let mut ours = MAPS;
        ours.sort_unstable();
        assert_eq!(shipped.collect::<Vec<_>>(), ours);
        for (map, table) in all(root).expect("maps and tables") {
            let cells = map.choices.len() * map.axes[0].values.len() * map.axes[1].values.len();
            assert_eq!(table.cells.len(), cells, "{}", map.name);
        }
    }
}
