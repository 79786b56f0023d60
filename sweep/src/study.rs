//! Accuracy against cost: one scene at many settings, each with its error and what it took.
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
//! A run keeps the values of the column; errors are made of them when the results are collected, so that another quantity, window
//! or wanted error runs nothing again. A step that fails is repeated in halves where the setting's scene has `[time.retry]`; what
//! was tried in vain counts in the time.

mod answer;
mod quantity;
mod report;

use crate::error::SweepError;
use crate::result::{Measured, RunResult, Series};
pub(crate) use quantity::{Quantity, Truth};
pub use report::{Numbers, Report, Row};

/// What is special about a sweep that is a study.
#[derive(Debug, Clone)]
pub struct Study {
    pub(crate) quantity: Quantity,
    pub(crate) wanted: Option<f64>,
    pub(crate) reference: Reference,
    pub(crate) settings: Vec<Setting>,
}

/// One point of a curve.
#[derive(Debug, Clone)]
pub(crate) struct Setting {
    pub(crate) choice: String,
    pub(crate) refinement: String,
    /// The index of its run.
    pub(crate) run: usize,
}

/// What errors are measured against: a value, or runs by their index.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Reference {
    Value { value: f64, uncertainty: f64 },
    Run { run: usize, check: Option<usize> },
}

const REFERENCE: &str = "the reference run";
const CHECK: &str = "the run that checks the reference";

impl Study {
    /// Asks for another error than the file does.
    pub fn ask_for(&mut self, wanted: Option<f64>) {
        self.wanted = wanted.or(self.wanted);
    }

    /// Whether a run is one that errors are measured against.
    pub(crate) fn is_measured_against(&self, run: usize) -> bool {
        matches!(self.reference, Reference::Run { run: fine, check } if run == fine || Some(run) == check)
    }

    /// What errors are measured against, and how well that is known; `None` while a run of it has no result.
    ///
    /// # Errors
    /// When the run failed.
    pub(crate) fn truth(
        &self,
        result: &dyn Fn(usize) -> Option<RunResult>,
    ) -> Result<Option<(Truth, f64)>, SweepError> {
        let (run, check) = match self.reference {
            Reference::Value { value, uncertainty } => return Ok(Some((Truth::Value(value), uncertainty))),
            Reference::Run { run, check } => (run, check),
        };
        let Some(fine) = result(run) else { return Ok(None) };
        let truth = Truth::Run(self.standard(REFERENCE, &fine)?);
        let Some(check) = check else { return Ok(Some((truth, 0.0))) };
        let Some(coarse) = result(check) else { return Ok(None) };
        let distance = self.quantity.error(&self.standard(CHECK, &coarse)?, &truth);
        let uncertainty = distance.map_err(|error| failed(CHECK, &error.to_string()))?;
        Ok(Some((truth, uncertainty)))
    }

    /// The values of a run that is measured against.
    fn standard(&self, name: &str, result: &RunResult) -> Result<Series, SweepError> {
        if let Some(failure) = &result.failure {
            return Err(failed(name, &failure.what));
        }
        let series = series(result);
        self.quantity.of(series).map_err(|error| failed(name, &error.to_string()))?;
        match result.counts.unconverged_steps {
            0 => Ok(series.clone()),
            steps => Err(failed(name, &format!("{steps} steps did not converge"))),
        }
    }

    /// What is said when a run has its result.
    pub(crate) fn line(
        &self,
        name: &str,
        run: usize,
        result: &dyn Fn(usize) -> Option<RunResult>,
    ) -> Option<String> {
        let seconds = |found: &RunResult| match found.cpu_seconds {
            Some(seconds) => format!("{seconds:.1} s"),
            None => "finished".to_owned(),
        };
        match self.reference {
            Reference::Run { run: fine, .. } if run == fine => {
                return Some(format!("reference: {}", seconds(&result(run)?)));
            }
            Reference::Run { check: Some(check), .. } if run == check => {
                let found = result(run)?;
                let distance = match self.truth(result) {
                    Ok(Some((_, uncertainty))) => format!(", {uncertainty:.1e} from it"),
                    _ => String::new(),
                };
                return Some(format!("check of the reference: {}{distance}", seconds(&found)));
            }
            _ => {}
        }
        let at = self.settings.iter().position(|setting| setting.run == run)?;
        let setting = &self.settings[at];
        let words = match self.truth(result) {
            Ok(Some((truth, _))) => Row::of(self, name, setting, &result(run)?, &truth).line(),
            _ => format!("{}, {}: finished", setting.choice, setting.refinement),
        };
        Some(format!("{} of {}: {words}", at + 1, self.settings.len()))
    }
}

/// What a run of a study has measured.
pub(crate) fn series(result: &RunResult) -> &Series {
    const NONE: &Series = &Series { times: Vec::new(), values: Vec::new() };
    match &result.measured {
        Measured::History(series) => series,
        Measured::Health(_) => NONE,
    }
}

fn failed(run: &str, cause: &str) -> SweepError {
    SweepError::Reference { run: run.to_owned(), cause: cause.lines().next().unwrap_or_default().to_owned() }
}
