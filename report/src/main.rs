//! Pages and pictures about the published runs: each task starts the program `partita` for its runs, and writes what came of
//! them to `docs/` and `paper/`. `cargo xtask` has the same tasks by the same names.

#![expect(
    clippy::format_push_string,
    reason = "pages are put together once, where `write!` asks what to do when a String refuses text"
)]

mod accuracy;
mod benchmark;
mod beyond;
mod cache;
mod channel_mesh;
mod csv;
mod damping;
mod effects;
#[cfg(test)]
mod figures;
mod infer;
mod kept;
mod markdown;
mod options;
mod performance;
mod program;
mod report;
mod reproduce;
mod run;
mod runs;
mod sensitivity;
mod snapshot;
mod stability;
mod task;

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::{Parser, Subcommand};

use options::Options;
use report::carry_out;
use task::{TaskError, workspace_root};

/// Repeat the published runs, and write the pages and pictures about them.
///
/// All tasks have the same modes. A run is remembered by the program, its scene and its settings, and not done again.
#[derive(Debug, Parser)]
#[command(name = "cargo xtask", bin_name = "cargo xtask", arg_required_else_help = true)]
#[command(
    after_help = "Exit codes: 0 done; 1 a run failed, or data and pages differ; 2 the command line is wrong."
)]
struct Arguments {
    #[command(subcommand)]
    task: Task,
}

#[derive(Debug, Subcommand)]
enum Task {
    /// Run the paper's tables: paper/results, docs/reproduction.md
    Reproduce(reproduce::Arguments),
    /// Judge the paper's claims on cases with other values: a section of docs/reproduction.md
    Sensitivity(Options),
    /// Measure how far the counts depend on what the paper does not give: docs/inference.md
    Infer(Options),
    /// Run tables 1 and 2 with quadratic convergence: docs/beyond-the-paper.md
    Beyond(Options),
    /// Run published benchmarks level by level: docs/benchmarks.md
    Benchmark(benchmark::Arguments),
    /// Run the studies of accuracy against time: docs/accuracy.md
    Accuracy(accuracy::Arguments),
    /// Run the maps of what converges: docs/stability.md
    Stability(stability::Arguments),
    /// Run the beam in channel flow with effects switched on one by one, and without each of them: docs/effects.md
    Effects(Options),
    /// Run a few scenes at several spectral radii of the structure's time scheme: docs/damping.md
    Damping(Options),
    /// Time the fluid's parts and whole steps: docs/performance.md
    Performance(performance::Arguments),
    /// Check every page against its data, and the first steps of the paper's cases against their counts
    Check {
        /// Start this program instead of building `partita` in the profile of this one
        #[arg(long, value_name = "PATH")]
        program: Option<PathBuf>,
    },
}

fn main() -> ExitCode {
    match dispatch(workspace_root(), &Arguments::parse().task) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("report: {error}");
            ExitCode::from(if matches!(error, TaskError::Refused { .. }) { 2 } else { 1 })
        }
    }
}

fn dispatch(root: &Path, task: &Task) -> Result<(), TaskError> {
    match task {
        Task::Reproduce(arguments) => reproduce::run(root, arguments),
        Task::Sensitivity(options) => carry_out(root, &sensitivity::Sensitivity, options),
        Task::Infer(options) => carry_out(root, &infer::Infer, options),
        Task::Beyond(options) => carry_out(root, &beyond::Beyond, options),
        Task::Benchmark(arguments) => benchmark::run(root, arguments),
        Task::Accuracy(arguments) => accuracy::run(root, arguments),
        Task::Stability(arguments) => stability::run(root, arguments),
        Task::Effects(options) => carry_out(root, &effects::Effects, options),
        Task::Damping(options) => carry_out(root, &damping::Damping, options),
        Task::Performance(arguments) => performance::run(root, arguments),
        Task::Check { program } => {
            check_pages(root)?;
            println!("== cargo xtask reproduce --quick");
            carry_out(root, &reproduce::Quick, &Options::with(program.clone()))
        }
    }
}

/// All pages against the data they are made of.
fn check_pages(root: &Path) -> Result<(), TaskError> {
    type Check = fn(&Path) -> Result<(), TaskError>;
    let checks: [(&str, Check); 9] = [
        ("reproduction", |root| report::check(root, &reproduce::Tables::default())),
        ("inference", |root| report::check(root, &infer::Infer)),
        ("beyond the paper", |root| report::check(root, &beyond::Beyond)),
        ("benchmarks", benchmark::check),
        ("accuracy", |root| report::check(root, &accuracy::Accuracy::all())),
        ("stability", |root| report::check(root, &stability::Stability::default())),
        ("effects", |root| report::check(root, &effects::Effects)),
        ("damping", |root| report::check(root, &damping::Damping)),
        ("performance", |root| report::check(root, &performance::Performance::default())),
    ];
    for (page, check) in checks {
        println!("== page of {page}");
        check(root)?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Nobody has edited a page or its data without the other.
    #[test]
    fn every_page_is_that_of_its_data() {
        check_pages(workspace_root()).expect("the shipped pages");
    }

    fn refusal(line: &str) -> String {
        let words = std::iter::once("cargo xtask").chain(line.split_whitespace());
        match Arguments::try_parse_from(words) {
            Err(error) => {
                assert_eq!(error.exit_code(), 2, "{line}");
                error.to_string()
            }
            Ok(arguments) => match dispatch(workspace_root(), &arguments.task) {
                Err(error @ TaskError::Refused { .. }) => error.to_string(),
                other => panic!("{line}: {other:?}"),
            },
        }
    }

    #[test]
    fn what_a_task_does_not_do_is_refused_before_anything_runs() {
        for (line, reason) in [
            ("reproduce --table 4", "4 is not in 1..=3"),
            ("reproduce --table 1 --quick", "cannot be used with"),
            ("reproduce --quick --mode page", "reproduce --quick has no page"),
            ("benchmark csm9", "no case `csm9`"),
            ("benchmark csm1 --level 0", "0 is not in 1.."),
            ("benchmark csm1 --level 77", "csm1 has no such level"),
            ("accuracy csm2", "invalid value 'csm2'"),
            ("stability tanks", "invalid value 'tanks'"),
            ("effects --jobs 2", "one run goes at a time"),
            ("performance --mode compare", "no other run repeats"),
            ("infer --mode check --fresh", "--fresh asks for runs"),
            ("damping --mode print", "invalid value 'print'"),
            ("sensitivity --table 1", "unexpected argument '--table'"),
        ] {
            let message = refusal(line);
            assert!(message.contains(reason), "{line}: {message}");
        }
    }
}
