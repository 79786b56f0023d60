//! Pages and pictures about the published runs: each task starts the program `partita` for its runs, and writes what came of
//! them to `docs/` and `paper/`. `cargo xtask` has the same tasks by the same names.

#![expect(
    clippy::format_push_string,
    reason = "pages are put together once, where `write!` asks what to do when a String refuses text"
)]

mod accuracy;
mod benchmark;
mod beyond;
mod csv;
mod damping;
mod effects;
#[cfg(test)]
mod figures;
mod infer;
mod options;
mod performance;
mod picture;
mod reproduce;
mod selection;
mod sensitivity;
mod stability;
mod stretch;
mod task;

use std::path::Path;
use std::process::ExitCode;

use options::Options;
use task::{TaskError, workspace_root};

const USAGE: &str = "\
Usage: cargo xtask <task>

Tasks:
  reproduce              run the paper's tables, write paper/results and docs/reproduction.md
    --table 1|2|3        only the runs of this table
    --quick              only the first steps at a few settings, beside the counts they had before
    --mode MODE          write (default), check: run nothing, fail if a page differs from the results, print, or
                         page: write pages and figures from the results, running only the two snapshots
                         (with --quick: check is the default, write keeps the counts)
    --jobs N             runs at a time (default: as many as there are cores)
    --fresh              run again what is remembered
  benchmark [CASE]...    run published benchmarks on all levels and compare with docs/data/benchmarks.csv
    --level L            only this level, 1 is the coarsest
    --mode MODE          check (default), write: keep the results, write docs/benchmarks.md and its pictures, or page:
                         run nothing, write page and pictures from the data
  performance            time the fluid's parts and whole steps, write docs/data/performance.csv and docs/performance.md
    --largest DOFS       leave out sizes of more unknowns, such as 100000
    --mode MODE          write (default), or check: measure nothing, fail where the page differs from the data
  effects                run the beam in channel flow with effects switched on one by one, and without each of them
    --mode MODE          check (default): counts and errors as in docs/data/effects.csv, or write that and docs/effects.md
  damping                run a few scenes at several spectral radii of the structure's time scheme
    --mode MODE          check (default): oscillations and errors as in docs/data/damping.csv, write: keep them and write
                         docs/damping.md, or page: write that alone
  accuracy [STUDY]...    run the studies of accuracy against time (studies/), or some of them
    --mode MODE          check (default): errors as in docs/data/accuracy.csv, or write that, docs/accuracy.md and its
                         pictures, or page: run nothing, write page and pictures from the data
  stability [MAP]...     run the maps of what converges, compare with docs/data/stability_*.csv
    --mode MODE          check (default), write: keep the tables, write docs/stability.md and its pictures, or page:
                         run nothing, write page and pictures from the tables
  infer                  how far the counts depend on what the paper does not give (paper/inference.md); options
                         --mode, --jobs and --fresh as above
  sensitivity            judge the claims on cases with other values, write paper/results/sensitivity.csv
  beyond                 run tables 1 and 2 with quadratic convergence, write docs/beyond-the-paper.md
  check                  run nothing but the first steps of the paper's cases; fail where a page differs from its data
";

type Task = fn(&Path) -> Result<(), TaskError>;

const CHECKS: [(&str, Task); 4] = [
    ("the pages of cargo xtask reproduce", reproduce::check_pages),
    ("docs/accuracy.md against docs/data/accuracy.csv", accuracy::check_pages),
    ("the page of cargo xtask stability", stability::check_page),
    ("cargo xtask reproduce --quick", reproduce::quick),
];

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let arguments: Vec<&str> = arguments.iter().map(String::as_str).collect();
    match dispatch(&arguments) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("report: {error}");
            ExitCode::from(if matches!(error, TaskError::Usage { .. }) { 2 } else { 1 })
        }
    }
}

fn dispatch(arguments: &[&str]) -> Result<(), TaskError> {
    let root = workspace_root();
    match arguments {
        ["reproduce", options @ ..] => reproduce::run(root, &Options::parse("reproduce", options)?),
        ["benchmark", options @ ..] => benchmark::run(root, options),
        ["performance", options @ ..] => performance::run(root, options),
        ["effects", options @ ..] => effects::run(root, options),
        ["damping", options @ ..] => damping::run(root, options),
        ["accuracy", options @ ..] => accuracy::run(root, options),
        ["stability", options @ ..] => stability::run(root, options),
        ["infer", options @ ..] => infer::run(root, &Options::parse("infer", options)?),
        ["sensitivity", options @ ..] => sensitivity::run(root, &Options::parse("sensitivity", options)?),
        ["beyond", options @ ..] => beyond::run(root, &Options::parse("beyond", options)?),
        ["check"] => check(root),
        ["help" | "--help" | "-h"] => {
            print!("{USAGE}");
            Ok(())
        }
        _ => Err(TaskError::Usage { given: arguments.join(" "), usage: USAGE }),
    }
}

/// What CI checks: the pages against what they tell of, and the first steps of the paper's cases.
fn check(root: &Path) -> Result<(), TaskError> {
    for (line, task) in CHECKS {
        println!("== {line}");
        task(root)?;
    }
    Ok(())
}
