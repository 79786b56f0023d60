//! `cargo xtask stability`: the maps of `maps/`, run with the release binary, their tables, pictures and page.
//!
//! A map is run by `partita stability`, which counts work and not time, so that its table is the same for any number of
//! jobs. The tables are kept in `docs/data`; the page is made from them, from the maps and from the remarks beside these.

mod compare;
mod page;
mod table;

use std::path::{Path, PathBuf};
use std::process::Command;

use crate::selection::{Mode, Selection};
use crate::task::{self, TaskError};
use table::{Map, Table};

/// The maps in the order of the page.
const MAPS: [&str; 6] = ["tank", "limits", "fluid", "poisson", "rotation", "swing"];

const PAGE: &str = "docs/stability.md";
/// Cells at a time.
const JOBS: &str = "2";

const USAGE: &str = "Usage: cargo xtask stability [--mode check|write|page] [MAP]...";

/// Runs the maps asked for, all of them where none is, and checks or writes what comes out.
pub(crate) fn run(root: &Path, words: &[&str]) -> Result<(), TaskError> {
    let Selection { mode, names } = Selection::parse("stability", USAGE, &MAPS, words)?;
    match mode {
        Mode::Page => {}
        Mode::Write => write(root, &names)?,
        Mode::Check => {
            check(root, &names)?;
            return check_page(root);
        }
    }
    for (path, text) in files(root)? {
        task::write(&root.join(path), &text)?;
    }
    Ok(())
}

/// The page and the pictures, made from the tables.
fn files(root: &Path) -> Result<Vec<(String, String)>, TaskError> {
    let all = all(root)?;
    let mut files = vec![(PAGE.to_owned(), page::markdown(&all))];
    files.extend(all.iter().map(|(map, table)| (format!("docs/{}", figure(&map.name)), table.picture(map))));
    Ok(files)
}

/// Keeps the tables of these maps.
fn write(root: &Path, names: &[&str]) -> Result<(), TaskError> {
    let binary = task::release_binary(root)?;
    for name in names {
        let folder = carry_out(root, &binary, name)?;
        task::write(&root.join(data(name)), &task::read(&folder.join("cells.csv"))?)?;
    }
    Ok(())
}

/// Compares these maps with the tables kept.
fn check(root: &Path, names: &[&str]) -> Result<(), TaskError> {
    let binary = task::release_binary(root)?;
    let mut faults = Vec::new();
    for name in names {
        let found = Table::read(&carry_out(root, &binary, name)?.join("cells.csv"))?;
        let kept = Table::read(&root.join(data(name)))?;
        let differences = compare::differences(&kept, &found);
        faults.extend(differences.into_iter().map(|fault| format!("{name}: {fault}")));
    }
    if faults.is_empty() { Ok(()) } else { Err(TaskError::Failed(faults.join("\n"))) }
}

/// Fails where page or pictures do not say what the tables say.
pub(crate) fn check_page(root: &Path) -> Result<(), TaskError> {
    let differs = |(path, text): &(String, String)| task::read(&root.join(path)).ok().as_ref() != Some(text);
    let differing: Vec<String> = files(root)?.into_iter().filter(differs).map(|(path, _)| path).collect();
    if differing.is_empty() {
        return Ok(());
    }
    Err(TaskError::Failed(format!(
        "these do not say what tables, maps and remarks say: {}\n\
         hint: `cargo xtask stability --mode page` writes them, `--mode write` runs the maps before that",
        differing.join(", ")
    )))
}

/// Runs one map anew; returns its folder.
fn carry_out(root: &Path, binary: &Path, name: &str) -> Result<PathBuf, TaskError> {
    let target = binary.parent().and_then(Path::parent).expect("target/release/partita");
    let folder = target.join("stability").join(name);
    task::remove_folder(&folder)?;
    eprintln!("{name}");
    let mut command = Command::new(binary);
    command.current_dir(root).arg("stability").arg(format!("maps/{name}.toml"));
    command.args(["--jobs", JOBS, "--out"]).arg(&folder);
    task::run(command)?;
    Ok(folder)
}

/// Maps, their remarks and their tables.
fn all(root: &Path) -> Result<Vec<(Map, Table)>, TaskError> {
    MAPS.into_iter().map(|name| Ok((Map::read(root, name)?, Table::read(&root.join(data(name)))?))).collect()
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
    use crate::task::workspace_root;

    #[test]
    fn the_page_is_that_of_the_tables() {
        check_page(workspace_root()).expect("nobody has edited one without the other");
    }

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

    #[test]
    fn words_that_are_no_map_are_refused() {
        for words in [&["tanks"][..], &["--mode"], &["--mode", "print"]] {
            assert!(matches!(run(workspace_root(), words), Err(TaskError::Usage { .. })), "{words:?}");
        }
    }
}
