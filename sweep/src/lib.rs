//! Many runs of one scene, in one way.
//!
//! A [`Sweep`] is a list of runs. Its file is that of a [study], which measures error against cost, or of a [map],
//! which shows where a scene converges; what a run measures and what is made of the results is all that differs. An [`Executor`]
//! makes the runs that have no result yet: [`Threads`] of this process, or job arrays of [`Slurm`]. Their results stand in the
//! [folder], one file for each run, and [`Sweep::collect`] makes table and picture of those that are there. Any number of
//! processes, on any number of machines that share the folder, may do all of this at once.
//!
//! ```no_run
//! use std::sync::atomic::AtomicBool;
//! use partita_sweep::{Order, Sweep, Threads};
//!
//! let sweep = Sweep::load("maps/tank.toml".as_ref())?;
//! let (dir, stop) = ("runs/tank".as_ref(), AtomicBool::new(false));
//! let mut threads = Threads::new(std::thread::available_parallelism()?, &stop);
//! sweep.execute(Order { dir, force: false, only: None }, &mut threads, &mut ())?;
//! let collected = sweep.collect(dir)?;
//! assert!(collected.unfinished.is_empty());
//! let summary = collected.words();
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod collect;
mod error;
mod exact;
mod executor;
mod file;
mod fingerprint;
pub mod folder;
pub mod map;
pub mod result;
mod run;
pub mod study;
mod sweep;

pub use collect::{Collected, Findings, Trouble};
pub use error::SweepError;
pub use executor::slurm::Slurm;
pub use executor::threads::Threads;
pub use executor::{Executed, Executor, Order};
pub use folder::{Folder, State};
pub use run::CHECKPOINT_WORK;
pub use sweep::{Kind, Run, Sweep};
