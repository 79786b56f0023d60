//! What a study has found: rows, diagram, and the answer in words.

use std::fmt::Write as _;

use partita_charts::axis::rounded;
use partita_charts::work_precision::{Curve, Diagram, FloorKind, Point, Trend, cheapest, most_accurate};

use super::conduct::{Setting, Study};
use super::error::MeasureError;
use super::file::Measure;
use super::measure::Measured;
use partita::output::table::{Cell, Table};

/// Columns of the rows.
pub(super) const COLUMNS: [&str; 16] = [
    "study",
    "setting",
    "error",
    "cpu_seconds",
    "choice",
    "refinement",
    "value",
    "uncertainty",
    "unknowns",
    "steps",
    "coupling_iterations",
    "newton_fluid",
    "newton_structure",
    "unconverged_steps",
    "retries",
    "failure",
];

/// A setting and what it came to.
#[derive(Debug, Clone, PartialEq)]
pub struct Row {
    study: String,
    /// The curve.
    pub choice: String,
    /// The point of it.
    pub refinement: String,
    /// What was measured, or why there is nothing.
    pub outcome: Result<Numbers, String>,
}

/// What was measured at a setting.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Numbers {
    /// Distance from the truth.
    pub error: f64,
    /// Processor time of building and stepping the run \[s\], the least of some repeats where it is short.
    pub cpu_seconds: f64,
    /// The quantity itself.
    pub value: f64,
    /// Unknowns of both fields.
    pub unknowns: usize,
    /// Time steps.
    pub steps: usize,
    /// Coupling iterations.
    pub coupling_iterations: usize,
    /// Newton iterations of the fluid.
    pub newton_fluid: usize,
    /// Newton iterations of the structure.
    pub newton_structure: usize,
    /// Steps that ended on the iteration bound.
    pub unconverged_steps: usize,
    /// Steps that failed and were repeated in halves.
    pub retries: usize,
}

impl Row {
    pub(super) fn measured(
        study: &Study,
        setting: &Setting,
        value: f64,
        error: f64,
        measured: &Measured,
    ) -> Self {
        let Measured { cpu_seconds, unknowns, totals, .. } = measured;
        let numbers = Numbers {
            error,
            cpu_seconds: *cpu_seconds,
            value,
            unknowns: *unknowns,
            steps: totals.steps,
            coupling_iterations: totals.coupling_iterations,
            newton_fluid: totals.newton_fluid,
            newton_structure: totals.newton_structure,
            unconverged_steps: totals.unconverged_steps,
            retries: totals.retries,
        };
        Self::new(study, setting, Ok(numbers))
    }

    pub(super) fn failed(study: &Study, setting: &Setting, error: &MeasureError) -> Self {
        let cause = error.to_string().lines().next().unwrap_or_default().to_owned();
        Self::new(study, setting, Err(cause))
    }

    fn new(study: &Study, setting: &Setting, outcome: Result<Numbers, String>) -> Self {
        let Setting { choice, refinement, .. } = setting;
        Self { study: study.name.clone(), choice: choice.clone(), refinement: refinement.clone(), outcome }
    }

    /// The row in a line of words.
    pub(super) fn line(&self) -> String {
        let setting = self.setting();
        match &self.outcome {
            Ok(Numbers { error, cpu_seconds, .. }) => {
                format!("{setting}: error {}, {} s", rounded(*error, 2), rounded(*cpu_seconds, 2))
            }
            Err(cause) => format!("{setting}: {cause}"),
        }
    }

    fn setting(&self) -> String {
        format!("{}, {}", self.choice, self.refinement)
    }

    /// A cell for each of [`COLUMNS`].
    pub(super) fn cells(&self, uncertainty: f64) -> Vec<Cell> {
        let number = |of: &dyn Fn(&Numbers) -> f64| Cell::from(self.outcome.as_ref().ok().map(of));
        let count = |of: &dyn Fn(&Numbers) -> usize| Cell::from(self.outcome.as_ref().ok().map(of));
        vec![
            self.study.as_str().into(),
            self.setting().into(),
            number(&|numbers| numbers.error),
            number(&|numbers| numbers.cpu_seconds),
            self.choice.as_str().into(),
            self.refinement.as_str().into(),
            number(&|numbers| numbers.value),
            uncertainty.into(),
            count(&|numbers| numbers.unknowns),
            count(&|numbers| numbers.steps),
            count(&|numbers| numbers.coupling_iterations),
            count(&|numbers| numbers.newton_fluid),
            count(&|numbers| numbers.newton_structure),
            count(&|numbers| numbers.unconverged_steps),
            count(&|numbers| numbers.retries),
            self.outcome.as_ref().err().map(String::as_str).into(),
        ]
    }
}

/// What a study has found so far.
#[derive(Debug, Clone, PartialEq)]
pub struct Report {
    title: String,
    quantity: String,
    wanted: Option<f64>,
    /// Whether settings are missing because the study was stopped.
    pub interrupted: bool,
    /// How well the reference is known, in the unit of the error.
    pub uncertainty: f64,
    /// The settings that were run.
    pub rows: Vec<Row>,
}

impl Report {
    pub(super) fn new(study: &Study) -> Self {
        let kind = match study.quantity.measure {
            Measure::Relative => "relative error",
            Measure::Absolute => "error",
        };
        Self {
            title: study.title.clone(),
            quantity: format!("{kind} of the {}", study.quantity.name),
            wanted: study.wanted,
            interrupted: false,
            uncertainty: 0.0,
            rows: Vec::new(),
        }
    }

    /// The settings that were measured, as curves.
    #[must_use]
    pub fn curves(&self) -> Vec<Curve> {
        let mut curves: Vec<Curve> = Vec::new();
        for row in &self.rows {
            let Ok(Numbers { error, cpu_seconds, .. }) = row.outcome else { continue };
            let point = Point { name: row.refinement.clone(), error, cpu_seconds };
            match curves.last_mut().filter(|curve| curve.name == row.choice) {
                Some(curve) => curve.points.push(point),
                None => curves.push(Curve { name: row.choice.clone(), points: vec![point] }),
            }
        }
        curves
    }

    /// The work-precision diagram, if anything was measured.
    #[must_use]
    pub fn diagram(&self) -> Option<String> {
        let diagram = Diagram {
            title: &self.title,
            error: &self.quantity,
            curves: &self.curves(),
            uncertainty: self.uncertainty,
            wanted: self.wanted,
        };
        diagram.draw()
    }

    /// The rows as a table.
    #[must_use]
    pub fn table(&self) -> Table {
        let mut table = Table::new(["choice", "refinement", "error", "CPU [s]"]);
        for row in &self.rows {
            let outcome: [Cell; 2] = match &row.outcome {
                Ok(Numbers { error, cpu_seconds, .. }) => [(*error).into(), (*cpu_seconds).into()],
                Err(_) => ["failed".into(), Cell::Empty],
            };
            let [error, cpu] = outcome;
            table.push([row.choice.as_str().into(), row.refinement.as_str().into(), error, cpu]);
        }
        table
    }

    /// The answer: what a digit costs on each curve, and the cheapest setting that reaches the wanted error.
    #[must_use]
    pub fn answer(&self) -> String {
        let curves = self.curves();
        let mut text = String::new();
        for curve in &curves {
            line(&mut text, &format!("{}: {}", curve.name, self.trend(curve)));
        }
        if self.uncertainty > 0.0 {
            line(&mut text, &format!("the reference is known to {}", rounded(self.uncertainty, 2)));
        }
        if let Some(wanted) = self.wanted {
            line(&mut text, &self.choice(&curves, wanted));
        }
        text
    }

    /// What a digit costs on a curve, and where its error stops.
    fn trend(&self, curve: &Curve) -> String {
        let Trend { fit, floor } = curve.trend(self.uncertainty);
        let law = fit.map(|fit| {
            format!(
                "a tenth of the error costs {} times the time (from {} settings over {} digits)",
                rounded(fit.digit_factor(), 3),
                fit.points,
                rounded(fit.digits(), 2)
            )
        });
        let floor = floor.map(|floor| {
            let (from, error) = (&curve.points[floor.start].name, rounded(floor.error, 2));
            match (floor.kind, floor.start) {
                (FloorKind::OtherError, 0) => format!("refining does not change the error, {error}"),
                (FloorKind::OtherError, _) => format!("from {from} on the error no longer falls: {error}"),
                (FloorKind::Reference, 0) => format!("the reference is no better than the errors, {error}"),
                (FloorKind::Reference, _) => {
                    format!("from {from} on the reference is no better than the error: {error}")
                }
            }
        });
        let words: Vec<String> = law.into_iter().chain(floor).collect();
        if words.is_empty() {
            "too few settings tell what a digit costs".to_owned()
        } else {
            words.join("; ")
        }
    }

    fn choice(&self, curves: &[Curve], wanted: f64) -> String {
        let named = |curve: &Curve, point: &Point| {
            let [error, seconds] = [point.error, point.cpu_seconds].map(|number| rounded(number, 2));
            format!("{}, {}: error {error} in {seconds} s", curve.name, point.name)
        };
        let so_far = if self.interrupted { " so far" } else { "" };
        let wanted_text = rounded(wanted, 2);
        match (cheapest(curves, wanted), most_accurate(curves)) {
            (Some((curve, point)), _) => {
                format!("cheapest setting{so_far} that reaches {wanted_text}: {}", named(curve, point))
            }
            (None, Some((curve, point))) => {
                format!(
                    "no setting{so_far} reaches {wanted_text}; the most accurate is {}",
                    named(curve, point)
                )
            }
            (None, None) => "no setting could be run".to_owned(),
        }
    }
}

fn line(text: &mut String, words: &str) {
    writeln!(text, "{words}").expect("a String takes any text");
}
