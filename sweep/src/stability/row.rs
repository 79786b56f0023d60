//! What a cell came to, as a row of the table.

use serde::{Deserialize, Serialize};

use super::read::Map;

/// How a cell ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Outcome {
    /// All its steps, each within its criterion.
    Converged,
    /// All its steps, but some only because the scene accepts steps at the iteration bound.
    Unconverged,
    /// All its steps, but its energy grows without measure.
    EnergyGrows,
    /// A step reached the iteration bound.
    IterationBound,
    /// The coupling iteration diverged.
    Diverged,
    /// A field could not be solved.
    FieldFailed,
    /// The Newton iterations that a cell may take were used up.
    OutOfBudget,
    /// The scene cannot be built.
    Refused,
    /// An error of the program.
    Broken,
}

impl Outcome {
    /// All of them.
    pub const ALL: [Self; 9] = [
        Self::Converged,
        Self::Unconverged,
        Self::EnergyGrows,
        Self::IterationBound,
        Self::Diverged,
        Self::FieldFailed,
        Self::OutOfBudget,
        Self::Refused,
        Self::Broken,
    ];

    /// As tables have it.
    #[must_use]
    pub fn word(self) -> &'static str {
        match self {
            Self::Converged => "converged",
            Self::Unconverged => "unconverged",
            Self::EnergyGrows => "energy_grows",
            Self::IterationBound => "iteration_bound",
            Self::Diverged => "diverged",
            Self::FieldFailed => "field_failed",
            Self::OutOfBudget => "out_of_budget",
            Self::Refused => "refused",
            Self::Broken => "broken",
        }
    }
}

/// One cell of a map.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Row {
    /// How it ended.
    pub outcome: Outcome,
    /// Iterations of each finished step: of the coupling, or of Newton's method where there is but one field.
    pub iterations: Vec<usize>,
    /// Why it did not converge: what and where.
    pub cause: String,
    /// What to change then.
    pub remedy: String,
    /// The first step that failed, counted from 1.
    pub failing_step: Option<usize>,
    /// Newton iterations of all fields.
    pub newton_iterations: usize,
    /// Steps that were repeated in halves.
    pub retries: usize,
    /// Largest energy of the last half of the steps over that of the first half.
    pub energy_growth: Option<f64>,
    /// Node-to-node oscillation of the fluid's pressure at the end, see [`super::measure`].
    pub pressure_oscillation: Option<f64>,
    /// Largest displacement of the structure at the end \[m\].
    pub structure_displacement: Option<f64>,
    /// Smallest shape quality of the fluid's moved mesh over all steps, in (0, 1].
    pub mesh_quality: Option<f64>,
}

impl Row {
    /// A row of a cell that did no step.
    pub(super) fn empty(outcome: Outcome, cause: &str, remedy: &str) -> Self {
        Self {
            outcome,
            iterations: Vec::new(),
            cause: cause.to_owned(),
            remedy: remedy.to_owned(),
            failing_step: None,
            newton_iterations: 0,
            retries: 0,
            energy_growth: None,
            pressure_oscillation: None,
            structure_displacement: None,
            mesh_quality: None,
        }
    }

    /// Mean over the finished steps.
    #[must_use]
    pub fn mean_iterations(&self) -> Option<f64> {
        let count = self.iterations.len();
        (count > 0).then(|| self.iterations.iter().sum::<usize>() as f64 / count as f64)
    }

    /// The mean as tables have it.
    pub(super) fn rounded_mean(&self) -> Option<String> {
        self.mean_iterations().map(|mean| format!("{mean:.2}"))
    }

    /// Largest of the finished steps.
    #[must_use]
    pub fn max_iterations(&self) -> Option<usize> {
        self.iterations.iter().copied().max()
    }
}

/// The table: a header, then a line a cell, in the map's order.
#[must_use]
pub fn to_csv(map: &Map, rows: &[Row]) -> String {
    let [first, second] = &map.axes;
    let mut text = format!(
        "accelerator,{},{},outcome,mean_iterations,max_iterations,cause,failing_step,steps,newton_iterations,retries,\
         energy_growth,pressure_oscillation,structure_displacement,mesh_quality,remedy\n",
        first.name, second.name
    );
    for (cell, row) in map.cells.iter().zip(rows) {
        let [first, second] = map.values(cell);
        let values = [
            map.choices[cell.choice].clone(),
            first.to_owned(),
            second.to_owned(),
            row.outcome.word().to_owned(),
            row.rounded_mean().unwrap_or_default(),
            row.max_iterations().map(|most| most.to_string()).unwrap_or_default(),
            row.cause.clone(),
            row.failing_step.map(|step| step.to_string()).unwrap_or_default(),
            row.iterations.len().to_string(),
            row.newton_iterations.to_string(),
            row.retries.to_string(),
            number(row.energy_growth),
            number(row.pressure_oscillation),
            number(row.structure_displacement),
            number(row.mesh_quality),
            row.remedy.clone(),
        ];
        text.push_str(&values.map(|value| quoted(&value)).join(","));
        text.push('\n');
    }
    text
}

/// Three digits tell what a measure tells.
fn number(value: Option<f64>) -> String {
    value.map(|value| format!("{value:.2e}")).unwrap_or_default()
}

fn quoted(value: &str) -> String {
    if value.contains([',', '"', '\n']) {
        format!("\"{}\"", value.replace('"', "\"\""))
    } else {
        value.to_owned()
    }
}
