//! Accuracy against time: one scene at many settings, each with its error and its CPU time.
//!
//! A study file names a scene, choices (curves) and refinements (their points), what is measured, and what it is measured
//! against:
//!
//! ```toml
//! title = "Tank: time steps"
//! scene = "../scenes/elastic-bottom"          # relative to this file
//! set = ["time.steps=10"]                     # optional: overrides of every run, as for `--set`
//! wanted = 1e-3                               # optional: the error to be reached
//!
//! [quantity]
//! name = "deflection of the middle [m]"
//! column = "middle_displacement_y"            # of probes.csv
//! take = "last"                               # "last", "max", "min", "mean" or "history"
//! from = 0.05                                 # optional: only times from here [s] ...
//! to = 0.1                                    # optional: ... to here
//! error = "relative"                          # or "absolute"
//!
//! [reference]
//! set = ["time.step=1e-4", "time.steps=1000"] # a run of its own; or `value = 0.125`
//! check = ["time.step=2e-4", "time.steps=500"] # optional: a coarser one, whose distance tells how sure the first is
//!
//! [[choice]]
//! name = "BDF1"
//! set = ["fluid.time_scheme=bdf1"]
//! refinements = [                             # of this choice; or above, outside the choices, for all of them
//!     { name = "dt = 0.01 s", set = [] },
//!     { name = "dt = 0.005 s", set = ["time.step=0.005", "time.steps=20"] },
//! ]
//! ```
//!
//! [`Study::load`] reads it and builds every setting once, so that nothing is run or written before all of them are sound;
//! [`Study::conduct`] runs them. Every row goes to the system as soon as it is measured. A step that fails is repeated in halves
//! where the setting's scene has `[time.retry]`; what was tried in vain counts in the time.

mod conduct;
mod error;
mod file;
mod folder;
mod measure;
mod prepare;
mod quantity;
mod report;

pub use conduct::{Manner, Setting, Study};
pub use error::{StudyError, StudyFailure};
pub use folder::{DIAGRAM, ROWS, STUDY};
pub use report::{Report, Row};
