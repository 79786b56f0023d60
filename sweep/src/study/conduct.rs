//! A study in memory, and how it is conducted.

use std::ops::Range;
use std::path::Path;
use std::sync::atomic::AtomicBool;

use super::error::{MeasureError, StudyFailure};
use super::folder::Folder;
use super::measure::{Measured, measure};
use super::quantity::{Quantity, Truth};
use super::report::{Report, Row};
use partita_scene::Resolved;

/// A study whose settings are all sound.
#[derive(Debug)]
pub struct Study {
    pub(super) name: String,
    pub(super) title: String,
    pub(super) quantity: Quantity,
    pub(super) wanted: Option<f64>,
    pub(super) settings: Vec<Setting>,
    pub(super) reference: Standard,
    pub(super) text: String,
}

/// One point of a curve.
#[derive(Debug)]
pub struct Setting {
    pub(super) choice: String,
    pub(super) refinement: String,
    pub(super) resolved: Resolved,
    /// Its name in the study file.
    pub(super) place: Range<usize>,
}

/// What errors are measured against.
#[derive(Debug)]
pub(super) enum Standard {
    Value { value: f64, uncertainty: f64 },
    Run { run: Box<Resolved>, check: Option<Box<Resolved>> },
}

/// How a study is carried out.
pub struct Manner<'a> {
    /// Replace an earlier study in the folder.
    pub force: bool,
    /// Set from outside to stop; the setting being run is given up.
    pub stop: &'a AtomicBool,
    /// Is told what happens, a line at a time.
    pub tell: &'a mut dyn FnMut(&str),
}

impl Study {
    /// The name of its file, without the ending.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Asks for another error than the file does.
    #[must_use]
    pub fn with_wanted(self, wanted: Option<f64>) -> Self {
        Self { wanted: wanted.or(self.wanted), ..self }
    }

    /// Makes the reference run, then runs every setting, and writes rows and diagram into the folder `dir`. What has been
    /// measured when it is stopped stays there and is in the report.
    ///
    /// # Errors
    /// When the folder cannot be used, or the reference run fails; then nothing is left in it. A setting that fails is a row
    /// that says so.
    pub fn conduct(&self, dir: &Path, manner: Manner<'_>) -> Result<Report, StudyFailure> {
        let Manner { force, stop, tell } = manner;
        let mut report = Report::new(self);
        let mut folder = Folder::create(dir, &self.text, force)?;
        match self.truth(stop, tell) {
            Ok(Some((truth, uncertainty))) => {
                report.uncertainty = uncertainty;
                self.rows(&truth, &mut report, &mut folder, stop, tell)?;
                folder.draw(&report)?;
            }
            Ok(None) => report.interrupted = true,
            Err(failure) => {
                folder.remove();
                return Err(failure);
            }
        }
        Ok(report)
    }

    fn rows(
        &self,
        truth: &Truth,
        report: &mut Report,
        folder: &mut Folder,
        stop: &AtomicBool,
        tell: &mut dyn FnMut(&str),
    ) -> Result<(), StudyFailure> {
        for (index, setting) in self.settings.iter().enumerate() {
            let outcome = measure(&setting.resolved, &self.quantity.column, stop).and_then(|measured| {
                let Some(measured) = measured else { return Ok(None) };
                let value = self.quantity.of(&measured.series)?;
                Ok(Some((value, self.quantity.error(&measured.series, truth)?, measured)))
            });
            let row = match outcome {
                Ok(None) => {
                    report.interrupted = true;
                    return Ok(());
                }
                Ok(Some((value, error, measured))) => Row::measured(self, setting, value, error, &measured),
                Err(error) => Row::failed(self, setting, &error),
            };
            tell(&format!("{} of {}: {}", index + 1, self.settings.len(), row.line()));
            folder.append(&row, report.uncertainty)?;
            report.rows.push(row);
        }
        Ok(())
    }

    /// The truth and how well it is known; `None` where `stop` was set.
    fn truth(
        &self,
        stop: &AtomicBool,
        tell: &mut dyn FnMut(&str),
    ) -> Result<Option<(Truth, f64)>, StudyFailure> {
        let (run, check) = match &self.reference {
            Standard::Value { value, uncertainty } => return Ok(Some((Truth::Value(*value), *uncertainty))),
            Standard::Run { run, check } => (run, check),
        };
        let Some(fine) = self.standard("the reference run", run, stop)? else { return Ok(None) };
        tell(&format!("reference: {:.1} s", fine.cpu_seconds));
        let truth = Truth::Run(fine.series);
        let Some(check) = check else { return Ok(Some((truth, 0.0))) };
        let Some(coarse) = self.standard("the run that checks the reference", check, stop)? else {
            return Ok(None);
        };
        let distance = self.quantity.error(&coarse.series, &truth);
        let uncertainty = distance.map_err(|error| failed("the run that checks the reference", &error))?;
        tell(&format!("check of the reference: {:.1} s, {uncertainty:.1e} from it", coarse.cpu_seconds));
        Ok(Some((truth, uncertainty)))
    }

    fn standard(
        &self,
        name: &str,
        run: &Resolved,
        stop: &AtomicBool,
    ) -> Result<Option<Measured>, StudyFailure> {
        let measured = measure(run, &self.quantity.column, stop).map_err(|error| failed(name, &error))?;
        let Some(measured) = measured else { return Ok(None) };
        self.quantity.of(&measured.series).map_err(|error| failed(name, &error))?;
        if measured.totals.unconverged_steps > 0 {
            let cause = format!("{} steps did not converge", measured.totals.unconverged_steps);
            return Err(StudyFailure::Reference { run: name.to_owned(), cause });
        }
        Ok(Some(measured))
    }
}

fn failed(run: &str, error: &MeasureError) -> StudyFailure {
    let text = error.to_string();
    let cause = text.lines().next().unwrap_or_default().to_owned();
    StudyFailure::Reference { run: run.to_owned(), cause }
}
