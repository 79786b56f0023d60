//! What a task is made of, and its four modes.

use std::path::Path;

use crate::csv::Csv;
use crate::options::{Abilities, Mode, Options};
use crate::program::Program;
use crate::runs::Runs;
use crate::task::{self, TaskError};

/// A file to be written: its path from the root of the workspace, and its text.
pub(crate) type File = (String, String);

/// What the runs of a task come to.
#[derive(Default)]
pub(crate) struct Found {
    /// The data that pages are made of.
    pub(crate) tables: Vec<Table>,
    /// Files that no comparison is made with: drawings of fields, samples, what the machine is.
    pub(crate) files: Vec<File>,
}

/// A table that is kept.
pub(crate) struct Table {
    /// From the root of the workspace.
    pub(crate) path: String,
    /// All its rows, those of earlier runs among them where only a part was run again.
    pub(crate) rows: Csv,
    /// What differs between the rows that are kept, the first, and those that were found.
    pub(crate) differences: fn(&Csv, &Csv) -> Result<Vec<String>, TaskError>,
}

/// Runs scenes, keeps what they come to in tables, and makes pages and pictures of these alone.
pub(crate) trait Report {
    fn abilities(&self) -> Abilities;

    /// Does the runs.
    fn found(&self, runs: Runs) -> Result<Found, TaskError>;

    /// The page and its pictures, made from what is kept.
    fn pages(&self, root: &Path) -> Result<Vec<File>, TaskError>;
}

/// Does a task in the mode that its options ask for.
pub(crate) fn carry_out(root: &Path, report: &impl Report, options: &Options) -> Result<(), TaskError> {
    let abilities = report.abilities();
    let mode = options.mode(&abilities)?;
    let found = || {
        let program = Program::open(root, options.program.as_deref())?;
        report.found(Runs::open(root, program, options.jobs(&abilities), options.fresh))
    };
    match mode {
        Mode::Write => {
            let Found { tables, files } = found()?;
            let tables = tables.into_iter().map(|table| (table.path, table.rows.to_text()));
            write(root, tables.chain(files))?;
            write(root, report.pages(root)?)
        }
        Mode::Compare => compare(root, abilities.task, &found()?.tables),
        Mode::Page => write(root, report.pages(root)?),
        Mode::Check => check(root, report),
    }
}

/// Runs nothing; fails where page or pictures differ from what the data give.
pub(crate) fn check(root: &Path, report: &impl Report) -> Result<(), TaskError> {
    let is_stale = |(path, text): &File| task::read(&root.join(path)).ok().as_ref() != Some(text);
    let stale: Vec<String> = report.pages(root)?.into_iter().filter(is_stale).map(|(path, _)| path).collect();
    if stale.is_empty() {
        return Ok(());
    }
    Err(TaskError::Failed(format!(
        "not what the data say: {}\nhint: `cargo xtask {} --mode page` writes them again",
        stale.join(", "),
        report.abilities().task
    )))
}

fn compare(root: &Path, task: &str, tables: &[Table]) -> Result<(), TaskError> {
    let mut all = Vec::new();
    for Table { path, rows, differences } in tables {
        println!("{path}\n{}", rows.to_text());
        let found = differences(&Csv::read(&root.join(path))?, rows)?;
        all.extend(found.into_iter().map(|difference| format!("{path}: {difference}")));
    }
    if all.is_empty() {
        return Ok(());
    }
    all.push(format!(
        "hint: where the change is meant, keep it with `cargo xtask {task} --mode write`, and say why"
    ));
    Err(TaskError::Failed(all.join("\n")))
}

/// Writes files whose text has changed, and names them.
fn write(root: &Path, files: impl IntoIterator<Item = File>) -> Result<(), TaskError> {
    for (path, text) in files {
        let file = root.join(&path);
        if std::fs::read_to_string(&file).is_ok_and(|before| before == text) {
            continue;
        }
        task::write(&file, &text)?;
        eprintln!("wrote {path}");
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Copies a word of its data to its page.
    struct Copy;

    impl Report for Copy {
        fn abilities(&self) -> Abilities {
            Abilities::of("copy")
        }

        fn found(&self, _: Runs) -> Result<Found, TaskError> {
            unreachable!("these tests run nothing")
        }

        fn pages(&self, root: &Path) -> Result<Vec<File>, TaskError> {
            Ok(vec![("page.md".to_owned(), format!("# {}", task::read(&root.join("data.csv"))?))])
        }
    }

    #[test]
    fn a_page_is_checked_against_its_data() {
        let root = tempfile::tempdir().expect("a folder");
        let root = root.path();
        task::write(&root.join("data.csv"), "a\n1\n").expect("written");
        let message = check(root, &Copy).expect_err("there is no page").to_string();
        assert_eq!(
            message,
            "not what the data say: page.md\nhint: `cargo xtask copy --mode page` writes them again"
        );
        write(root, Copy.pages(root).expect("a page")).expect("written");
        check(root, &Copy).expect("the page of the data");
        task::write(&root.join("data.csv"), "a\n2\n").expect("written");
        assert!(check(root, &Copy).is_err());
    }

    #[test]
    fn tables_that_differ_are_named_with_what_to_do() {
        let root = tempfile::tempdir().expect("a folder");
        let path = "data.csv".to_owned();
        task::write(&root.path().join(&path), "a\n1\n").expect("written");
        let table = |rows: &str| Table {
            path: path.clone(),
            rows: Csv::parse(rows).expect("a table"),
            differences: |kept, found| {
                Ok(if kept == found { Vec::new() } else { vec!["another number".to_owned()] })
            },
        };
        compare(root.path(), "copy", &[table("a\n1\n")]).expect("the same");
        let message = compare(root.path(), "copy", &[table("a\n2\n")]).expect_err("another").to_string();
        assert!(message.starts_with("data.csv: another number\nhint: "), "{message}");
        assert!(message.contains("`cargo xtask copy --mode write`"), "{message}");
    }
}
