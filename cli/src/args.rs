//! The command line.

mod sweep;

use std::num::NonZeroUsize;
use std::path::PathBuf;

use clap::{Args, Parser, Subcommand, ValueEnum};

pub(crate) use sweep::{Collect, List, Make, Output, Stability, Study, Submit, Sweep, SweepFile};

/// Two-dimensional fluid-structure interaction with partitioned solvers.
#[derive(Debug, Parser)]
#[command(name = "partita", version, arg_required_else_help = true)]
#[command(after_help = "Exit codes: 0 done; 2 the scene or the command line is wrong, nothing was written; \
3 the run failed; 130 interrupted.")]
pub(crate) struct Arguments {
    #[command(subcommand)]
    pub(crate) command: Command,
}

#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    /// Run a scene.
    Run(Run),
    /// Build a scene without running it, and report its meshes, settings and errors.
    Check(Check),
    /// List the effects that a scene needs and those that it does not, with the reason.
    Plan(Plan),
    /// Continue a run from its last checkpoint.
    Resume(Resume),
    /// Print the coupling iterations or the steps of a run as a CSV table.
    Table(Table),
    /// Measure error against computing time over many settings of a scene.
    Study(Study),
    /// Sweep two parameters of a scene and map where it converges.
    Stability(Stability),
    /// Plan, run, submit or collect the many runs of a study or map, one by one or all at once.
    #[command(subcommand)]
    Sweep(Sweep),
}

#[derive(Debug, Args)]
pub(crate) struct Run {
    #[command(flatten)]
    pub(crate) scene: SceneArguments,
    /// Output folder [default: runs/<name of the scene>].
    #[arg(long, value_name = "DIR")]
    pub(crate) out: Option<PathBuf>,
    /// Replace an earlier run in the output folder.
    #[arg(long)]
    pub(crate) force: bool,
    /// Refuse to run a scene with a warning that it does not accept (exit code 2).
    #[arg(long)]
    pub(crate) deny_warnings: bool,
    #[command(flatten)]
    pub(crate) manner: Manner,
}

#[derive(Debug, Args)]
pub(crate) struct Check {
    #[command(flatten)]
    pub(crate) scene: SceneArguments,
    /// Treat every warning that the scene does not accept as an error (exit code 2).
    #[arg(long)]
    pub(crate) deny_warnings: bool,
    /// Print the description, the warnings and the errors as JSON.
    #[arg(long)]
    pub(crate) json: bool,
}

#[derive(Debug, Args)]
pub(crate) struct Plan {
    #[command(flatten)]
    pub(crate) scene: SceneArguments,
}

#[derive(Debug, Args)]
pub(crate) struct Resume {
    /// Output folder of the run.
    #[arg(value_name = "DIR")]
    pub(crate) dir: PathBuf,
    #[command(flatten)]
    pub(crate) manner: Manner,
}

#[derive(Debug, Args)]
pub(crate) struct Table {
    /// Output folder of the run.
    #[arg(value_name = "DIR")]
    pub(crate) dir: PathBuf,
    /// One row for each coupling iteration, or for each time step.
    #[arg(long, value_enum, default_value = "iterations")]
    pub(crate) rows: Rows,
}

/// `--rows`.
#[derive(Debug, Clone, Copy, ValueEnum)]
pub(crate) enum Rows {
    Iterations,
    Steps,
}

#[derive(Debug, Args)]
pub(crate) struct SceneArguments {
    /// Scene file, or a folder that contains a scene.toml.
    #[arg(value_name = "SCENE")]
    pub(crate) path: PathBuf,
    /// Override one key of the scene, for example `time.steps=3`; can be repeated.
    #[arg(long = "set", value_name = "KEY=VALUE")]
    pub(crate) overrides: Vec<String>,
}

/// How a run is carried out; none of it changes a number.
#[derive(Debug, Args)]
pub(crate) struct Manner {
    /// Stop after this many steps; the run can be resumed.
    #[arg(long, value_name = "N")]
    pub(crate) steps: Option<NonZeroUsize>,
    /// Threads for the linear systems of the fluid; systems of up to 10000 unknowns always use one.
    #[arg(long, value_name = "N", default_value = "1")]
    pub(crate) threads: NonZeroUsize,
    /// Show no progress bar and print no summary.
    #[arg(long)]
    pub(crate) quiet: bool,
    /// Print the summary as JSON.
    #[arg(long)]
    pub(crate) json: bool,
}
