//! The command line.

use std::num::NonZeroUsize;
use std::path::PathBuf;

use clap::{Args, Parser, Subcommand};

/// Partitioned fluid-structure interaction from a scene file.
#[derive(Debug, Parser)]
#[command(name = "partita", version, arg_required_else_help = true)]
#[command(
    after_help = "Exit codes: 0 done, 2 the scene or the command line is wrong (nothing was written), \
3 the run failed, 130 interrupted."
)]
pub(crate) struct Arguments {
    #[command(subcommand)]
    pub(crate) command: Command,
}

#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    /// Run a scene from its first step.
    Run(Run),
    /// Read and build a scene, say what it is, and run nothing.
    Check(Check),
    /// Say which effects of a scene run, which do not, and why; build and run nothing.
    Plan(Plan),
    /// Take up a run at its last checkpoint.
    Resume(Resume),
    /// Run a scene at many settings and show what accuracy costs.
    Study(Study),
    /// Run a scene over two parameters and some choices, and draw a map of what converges.
    Stability(Stability),
}

#[derive(Debug, Args)]
pub(crate) struct Run {
    #[command(flatten)]
    pub(crate) scene: SceneArguments,
    /// Folder for the output [default: runs/<name of the scene>].
    #[arg(long, value_name = "DIR")]
    pub(crate) out: Option<PathBuf>,
    /// Replace the run in the output folder.
    #[arg(long)]
    pub(crate) force: bool,
    /// Run nothing where the scene gives a warning that it does not accept.
    #[arg(long)]
    pub(crate) deny_warnings: bool,
    #[command(flatten)]
    pub(crate) manner: Manner,
}

#[derive(Debug, Args)]
pub(crate) struct Check {
    #[command(flatten)]
    pub(crate) scene: SceneArguments,
    /// End with exit code 2 where the scene gives a warning that it does not accept.
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
pub(crate) struct Study {
    /// Study file: a scene, choices and refinements, and what they are measured against.
    #[arg(value_name = "STUDY")]
    pub(crate) file: PathBuf,
    /// Folder for the output [default: runs/<name of the study>].
    #[arg(long, value_name = "DIR")]
    pub(crate) out: Option<PathBuf>,
    /// Replace the study in the output folder.
    #[arg(long)]
    pub(crate) force: bool,
    /// Name the cheapest setting with at most this error, instead of the study's own.
    #[arg(long, value_name = "ERROR", value_parser = positive)]
    pub(crate) wanted: Option<f64>,
    /// Show no progress and print nothing.
    #[arg(long)]
    pub(crate) quiet: bool,
}

#[derive(Debug, Args)]
pub(crate) struct Stability {
    /// Map file; the library's documentation of `stability` and docs/stability.md say what stands in it.
    #[arg(value_name = "MAP")]
    pub(crate) path: PathBuf,
    /// Folder for table and picture; finished cells in it are not run again [default: runs/<name of the map>].
    #[arg(long, value_name = "DIR")]
    pub(crate) out: Option<PathBuf>,
    /// Cells run at a time; the results are the same for any number [default: as many as there are processors].
    #[arg(long, value_name = "N")]
    pub(crate) jobs: Option<NonZeroUsize>,
    /// Run all cells again.
    #[arg(long)]
    pub(crate) force: bool,
    /// Show no progress and print nothing.
    #[arg(long)]
    pub(crate) quiet: bool,
}

#[derive(Debug, Args)]
pub(crate) struct SceneArguments {
    /// Scene file, or a folder with a scene.toml in it.
    #[arg(value_name = "SCENE")]
    pub(crate) path: PathBuf,
    /// Set one key of the scene, such as `time.steps=3`; may be repeated.
    #[arg(long = "set", value_name = "KEY=VALUE")]
    pub(crate) overrides: Vec<String>,
}

/// How a run is carried out; none of it changes a number.
#[derive(Debug, Args)]
pub(crate) struct Manner {
    /// Stop after this many steps of the scene; the run can be resumed.
    #[arg(long, value_name = "N")]
    pub(crate) steps: Option<NonZeroUsize>,
    /// Threads that solve the fluid's linear systems; up to 10000 unknowns there is one in any case.
    #[arg(long, value_name = "N", default_value = "1")]
    pub(crate) threads: NonZeroUsize,
    /// Show no progress and print no table.
    #[arg(long)]
    pub(crate) quiet: bool,
    /// Print the summary as JSON.
    #[arg(long)]
    pub(crate) json: bool,
}

fn positive(text: &str) -> Result<f64, String> {
    let number: f64 = text.parse().map_err(|_| "this is not a number".to_owned())?;
    if number > 0.0 && number.is_finite() {
        Ok(number)
    } else {
        Err("this is not a number above zero".to_owned())
    }
}
