//! The paper's tables, figures and claims, repeated with the release binary.
//!
//! A run is a scene and settings on its command line; what comes back is the `summary.json` of its output folder.

pub(crate) mod case;
pub(crate) mod claims;
pub(crate) mod cost;
pub(crate) mod counts;
pub(crate) mod facts;
pub(crate) mod heat_map;
pub(crate) mod markdown;
mod page;
pub(crate) mod published;
mod quick;
pub(crate) mod results;
pub(crate) mod run;
pub(crate) mod setting;
pub(crate) mod study;
mod substitutes;
pub(crate) mod workshop;

use std::path::Path;

use crate::options::{Mode, Options};
use crate::picture;
use crate::task::{self, TaskError};
use case::Case;
use facts::Facts;
use page::Page;
use published::Published;
use study::{Study, carry_out};
use workshop::{Spent, Workshop};

/// The task as its options say.
pub(crate) fn run(root: &Path, options: &Options) -> Result<(), TaskError> {
    if options.quick {
        let workshop = Workshop::open(root, options.jobs, false)?;
        return quick::run(root, &workshop, options.mode.unwrap_or(Mode::Check));
    }
    match options.mode.unwrap_or(Mode::Write) {
        Mode::Check => check_pages(root),
        Mode::Write => {
            let workshop = Workshop::open(root, options.jobs, !options.fresh)?;
            let (ours, spent) = tables(root, &workshop, options)?;
            picture::write_all(root, &workshop)?;
            let published = Published::read(root)?;
            results::write(root, &ours, &published)?;
            print!("{}", write_pages(root)?.summary());
            say(spent);
            Ok(())
        }
        Mode::Page => {
            picture::write_all(root, &Workshop::open(root, options.jobs, true)?)?;
            write_pages(root).map(drop)
        }
        Mode::Print => {
            let workshop = Workshop::open(root, options.jobs, !options.fresh)?;
            let (ours, spent) = tables(root, &workshop, options)?;
            let page = Page::new(root, Published::read(root)?, ours)?;
            print!("{}", page.text());
            say(spent);
            Ok(())
        }
    }
}

/// Writes pages, figures and the verdict on each claim, from the results.
fn write_pages(root: &Path) -> Result<Page, TaskError> {
    let page = Page::read(root)?;
    results::write_claims(root, page.judged())?;
    for (path, text) in page.files() {
        task::write(&root.join(path), &text)?;
    }
    Ok(page)
}

/// What CI runs: the first steps, one and several at a time.
pub(crate) fn quick(root: &Path) -> Result<(), TaskError> {
    run(root, &Options::parse("reproduce", &["--quick"])?)
}

/// Fails where a page or figure differs from what the results give.
pub(crate) fn check_pages(root: &Path) -> Result<(), TaskError> {
    let page = Page::read(root)?;
    let claims = results::claims_table(page.judged()).to_text();
    let files = page.files().into_iter().chain([("paper/results/claims.csv".to_owned(), claims)]);
    let differing: Vec<String> = files
        .filter(|(path, text)| task::read(&root.join(path)).ok().as_ref() != Some(text))
        .map(|(path, _)| path)
        .collect();
    if differing.is_empty() {
        return Ok(());
    }
    Err(TaskError::Failed(format!(
        "these do not say what paper/results says: {}\nhint: `cargo xtask reproduce` writes them",
        differing.join(", ")
    )))
}

/// Runs the tables asked for; the other results stay as they are.
fn tables(root: &Path, workshop: &Workshop<'_>, options: &Options) -> Result<([Facts; 2], Spent), TaskError> {
    let wanted = |table: usize| options.table.is_none_or(|only| only == table);
    let grids = Case::ALL.into_iter().filter(|case| wanted(case.table())).map(Study::of_table);
    let adaptive = Case::ALL.into_iter().filter(|_| wanted(3)).map(Study::of_adaptive);
    let studies: Vec<Study> = grids.chain(adaptive).collect();
    let (found, spent) = carry_out(workshop, &studies)?;
    let mut ours = results::read(root)?;
    for facts in found {
        ours[facts.case as usize].take(facts);
    }
    Ok((ours, spent))
}

fn say(spent: Spent) {
    let Spent { done, wall_seconds, cpu_seconds } = spent;
    eprintln!(
        "{done} runs done, the others remembered: {wall_seconds:.1} s, {cpu_seconds:.1} s of processor time"
    );
}
