//! What a study has found: rows, table, diagram.

use partita::output::table::{Cell, Table, csv_header, csv_row};
use partita_charts::axis::rounded;
use partita_charts::work_precision::{Cost, Curve, Diagram, Point};

use super::quantity::Truth;
use super::{Setting, Study, series};
use crate::file::study::Measure;
use crate::result::RunResult;
use crate::sweep::Sweep;

/// Columns of the rows.
const COLUMNS: [&str; 16] = [
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
    /// Processor time of building and stepping the run \[s\], the least of some repeats where it is short; only where nothing else
    /// ran meanwhile.
    pub cpu_seconds: Option<f64>,
    /// Unknowns times Newton iterations, both fields.
    pub work: f64,
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
    /// What a result comes to against the truth.
    pub(super) fn of(
        study: &Study,
        name: &str,
        setting: &Setting,
        result: &RunResult,
        truth: &Truth,
    ) -> Self {
        let measured = || {
            if let Some(failure) = &result.failure {
                return Err(failure.what.clone());
            }
            let series = series(result);
            let value = study.quantity.of(series).map_err(|error| error.to_string())?;
            let error = study.quantity.error(series, truth).map_err(|error| error.to_string())?;
            Ok(Numbers::of(result, value, error))
        };
        let Setting { choice, refinement, .. } = setting;
        let (choice, refinement) = (choice.clone(), refinement.clone());
        Self { study: name.to_owned(), choice, refinement, outcome: measured() }
    }

    /// The row in a line of words.
    pub(super) fn line(&self) -> String {
        let setting = self.setting();
        match &self.outcome {
            Ok(Numbers { error, cpu_seconds: Some(seconds), .. }) => {
                format!("{setting}: error {}, {} s", rounded(*error, 2), rounded(*seconds, 2))
            }
            Ok(Numbers { error, .. }) => format!("{setting}: error {}", rounded(*error, 2)),
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
            Cell::from(self.outcome.as_ref().ok().and_then(|numbers| numbers.cpu_seconds)),
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

impl Numbers {
    fn of(result: &RunResult, value: f64, error: f64) -> Self {
        let RunResult { counts, unknowns, cpu_seconds, .. } = result;
        let work = unknowns[0] * counts.newton_fluid + unknowns[1] * counts.newton_structure;
        Self {
            error,
            cpu_seconds: *cpu_seconds,
            work: work as f64,
            value,
            unknowns: unknowns.iter().sum(),
            steps: counts.steps,
            coupling_iterations: counts.coupling_iterations,
            newton_fluid: counts.newton_fluid,
            newton_structure: counts.newton_structure,
            unconverged_steps: counts.unconverged_steps,
            retries: counts.retries,
        }
    }
}

/// What a study has found so far.
#[derive(Debug, Clone, PartialEq)]
pub struct Report {
    title: String,
    quantity: String,
    pub(super) wanted: Option<f64>,
    /// Whether settings are missing.
    pub interrupted: bool,
    /// How well the reference is known, in the unit of the error.
    pub uncertainty: f64,
    /// The settings that were run.
    pub rows: Vec<Row>,
}

impl Report {
    /// The report of the results that are there, against the truth and how well that is known.
    pub(crate) fn new(
        sweep: &Sweep,
        study: &Study,
        truth: Option<&(Truth, f64)>,
        result: &dyn Fn(usize) -> Option<RunResult>,
    ) -> Self {
        let kind = match study.quantity.measure {
            Measure::Relative => "relative error",
            Measure::Absolute => "error",
        };
        let row =
            |setting: &Setting| Some(Row::of(study, &sweep.name, setting, &result(setting.run)?, &truth?.0));
        let rows: Vec<Row> = study.settings.iter().filter_map(row).collect();
        Self {
            title: sweep.title.clone(),
            quantity: format!("{kind} of the {}", study.quantity.name),
            wanted: study.wanted,
            interrupted: rows.len() < study.settings.len(),
            uncertainty: truth.map_or(0.0, |(_, uncertainty)| *uncertainty),
            rows,
        }
    }

    /// What the diagram's axis and the answer count: seconds, or work where a setting has none.
    pub(super) fn cost(&self) -> Cost {
        let timed = |row: &Row| row.outcome.as_ref().map_or(true, |numbers| numbers.cpu_seconds.is_some());
        if self.rows.iter().all(timed) { Cost::CpuSeconds } else { Cost::Work }
    }

    /// `study.csv`.
    #[must_use]
    pub fn to_csv(&self) -> String {
        let rows = self.rows.iter().map(|row| csv_row(&row.cells(self.uncertainty)));
        std::iter::once(csv_header(&COLUMNS)).chain(rows).collect()
    }

    /// The settings that were measured, as curves.
    #[must_use]
    pub fn curves(&self) -> Vec<Curve> {
        let mut curves: Vec<Curve> = Vec::new();
        for row in &self.rows {
            let Ok(Numbers { error, cpu_seconds, work, .. }) = row.outcome else { continue };
            let cost = match self.cost() {
                Cost::CpuSeconds => cpu_seconds.unwrap_or(f64::NAN),
                Cost::Work => work,
            };
            let point = Point { name: row.refinement.clone(), error, cpu_seconds: cost };
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
        diagram.draw_over(self.cost())
    }

    /// The rows as a table.
    #[must_use]
    pub fn table(&self) -> Table {
        let cost = self.cost();
        let heading = match cost {
            Cost::CpuSeconds => "CPU [s]",
            Cost::Work => "unknowns solved for",
        };
        let mut table = Table::new(["choice", "refinement", "error", heading]);
        for row in &self.rows {
            let outcome: [Cell; 2] = match &row.outcome {
                Ok(Numbers { error, cpu_seconds, work, .. }) => match cost {
                    Cost::CpuSeconds => [(*error).into(), (*cpu_seconds).into()],
                    Cost::Work => [(*error).into(), (*work).into()],
                },
                Err(_) => ["failed".into(), Cell::Empty],
            };
            let [error, cost] = outcome;
            table.push([row.choice.as_str().into(), row.refinement.as_str().into(), error, cost]);
        }
        table
    }
}
