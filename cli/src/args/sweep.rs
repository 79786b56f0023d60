//! The commands for many runs.

use std::num::NonZeroUsize;
use std::path::PathBuf;

use clap::{Args, Subcommand};

#[derive(Debug, Args)]
pub(crate) struct Study {
    /// Study file: a scene, its refinements and choices, and the reference they are compared with.
    #[arg(value_name = "STUDY")]
    pub(crate) file: PathBuf,
    #[command(flatten)]
    pub(crate) output: Output,
    /// Find the cheapest setting with at most this error, instead of the error named in the study.
    #[arg(long, value_name = "ERROR", value_parser = positive)]
    pub(crate) wanted: Option<f64>,
}

#[derive(Debug, Args)]
pub(crate) struct Stability {
    /// Map file: a scene, two parameters and the choices to compare; see docs/stability.md.
    #[arg(value_name = "MAP")]
    pub(crate) file: PathBuf,
    #[command(flatten)]
    pub(crate) output: Output,
    /// Number of cells to run at the same time; it does not affect the results [default: number of processors].
    #[arg(long, value_name = "N")]
    pub(crate) jobs: Option<NonZeroUsize>,
}

/// What the commands that write a sweep's folder have in common.
#[derive(Debug, Args)]
pub(crate) struct Output {
    /// Output folder; runs that are finished there are not run again [default: runs/<name of the file>].
    #[arg(long, value_name = "DIR")]
    pub(crate) out: Option<PathBuf>,
    /// Remove what an earlier sweep has left in the output folder first; other files are never removed.
    #[arg(long)]
    pub(crate) force: bool,
    /// Show no progress bar and print nothing.
    #[arg(long)]
    pub(crate) quiet: bool,
}

/// Many runs of one scene; see docs/sweeps.md.
#[derive(Debug, Subcommand)]
pub(crate) enum Sweep {
    /// List the runs: index, settings, fingerprint and state.
    Plan(List),
    /// Make all runs that have no result yet, or one of them.
    Run(Make),
    /// Submit the runs that have no result yet to a batch system.
    Submit(Submit),
    /// Write table and picture of the results that are there, and list what failed and why.
    Collect(Collect),
}

/// A sweep and its folder.
#[derive(Debug, Args)]
pub(crate) struct SweepFile {
    /// Study or map file.
    #[arg(value_name = "FILE")]
    pub(crate) file: PathBuf,
    /// Output folder [default: runs/<name of the file>].
    #[arg(long, value_name = "DIR")]
    pub(crate) out: Option<PathBuf>,
}

#[derive(Debug, Args)]
pub(crate) struct List {
    #[command(flatten)]
    pub(crate) sweep: SweepFile,
    /// Print the list as JSON.
    #[arg(long)]
    pub(crate) json: bool,
}

#[derive(Debug, Args)]
pub(crate) struct Make {
    /// Study or map file.
    #[arg(value_name = "FILE")]
    pub(crate) file: PathBuf,
    #[command(flatten)]
    pub(crate) output: Output,
    /// Make this run only, unless it has a result; it continues from its checkpoint if there is one.
    #[arg(long, value_name = "I", conflicts_with_all = ["force", "jobs"])]
    pub(crate) index: Option<usize>,
    /// Refuse if the run with this index has another fingerprint, because the file or the scene was changed.
    #[arg(long, value_name = "DIGITS", requires = "index")]
    pub(crate) fingerprint: Option<String>,
    /// Number of runs to make at the same time [default: number of processors]. Times are measured with one only.
    #[arg(long, value_name = "N")]
    pub(crate) jobs: Option<NonZeroUsize>,
}

#[derive(Debug, Args)]
pub(crate) struct Submit {
    #[command(flatten)]
    pub(crate) sweep: SweepFile,
    /// Submit job arrays of Slurm.
    #[arg(long, required = true)]
    pub(crate) slurm: bool,
    /// Most tasks of one array [default: what `scontrol show config` says].
    #[arg(long, value_name = "N")]
    pub(crate) array_size: Option<NonZeroUsize>,
    /// Time limit of each run, as for sbatch; a run that is cut off continues from its checkpoint when submitted again.
    #[arg(long, value_name = "TIME")]
    pub(crate) time: Option<String>,
    /// Partition, as for sbatch.
    #[arg(long, value_name = "NAME")]
    pub(crate) partition: Option<String>,
    /// Any other option for sbatch, such as `--sbatch=--mem=4G`; can be repeated.
    #[arg(long, value_name = "OPTION", allow_hyphen_values = true)]
    pub(crate) sbatch: Vec<String>,
    /// More options for sbatch.
    #[arg(last = true, value_name = "OPTIONS")]
    pub(crate) more: Vec<String>,
    /// Print the scripts, and write and submit nothing.
    #[arg(long)]
    pub(crate) dry_run: bool,
}

#[derive(Debug, Args)]
pub(crate) struct Collect {
    #[command(flatten)]
    pub(crate) sweep: SweepFile,
}

fn positive(text: &str) -> Result<f64, String> {
    let number: f64 = text.parse().map_err(|_| "this is not a number".to_owned())?;
    if number > 0.0 && number.is_finite() {
        Ok(number)
    } else {
        Err("this is not a number above zero".to_owned())
    }
}
