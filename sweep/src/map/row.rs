//! What a cell came to, as a row of the table.

use partita::output::table::{Cell as Entry, csv_header, csv_row};

use super::{Cell, Map, measure};
use crate::result::{FailureKind, Health, Measured, RunResult};

/// How a cell ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
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
#[derive(Debug, Clone, PartialEq)]
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
    /// Node-to-node oscillation of the fluid's pressure at the end.
    pub pressure_oscillation: Option<f64>,
    /// Largest displacement of the structure at the end \[m\].
    pub structure_displacement: Option<f64>,
    /// Smallest shape quality of the fluid's moved mesh over all steps, in (0, 1].
    pub mesh_quality: Option<f64>,
}

impl Row {
    /// What a result comes to.
    pub(super) fn of(map: &Map, result: &RunResult) -> Self {
        let none = Health::default();
        let health = if let Measured::Health(health) = &result.measured { health } else { &none };
        let mut row = Self {
            outcome: Outcome::Converged,
            iterations: health.iterations.clone(),
            cause: String::new(),
            remedy: String::new(),
            failing_step: None,
            newton_iterations: result.counts.newton,
            retries: result.counts.retries,
            energy_growth: measure::growth(&health.energies),
            pressure_oscillation: health.pressure_oscillation,
            structure_displacement: health.structure_displacement,
            mesh_quality: health.mesh_quality,
        };
        row.judge(map, health, result);
        row
    }

    /// How the cell ended, why, and what to change.
    fn judge(&mut self, map: &Map, health: &Health, result: &RunResult) {
        let too_large = |growth: &f64| growth.is_nan() || *growth > map.largest_energy_growth;
        if let Some(failure) = &result.failure {
            self.outcome = failure.kind.into();
            self.cause.clone_from(&failure.cause);
            self.remedy.clone_from(&failure.remedy);
            self.failing_step = failure.step.or(health.unconverged.map(|(step, _)| step));
        } else if let Some((step, residual)) = health.unconverged {
            self.outcome = Outcome::Unconverged;
            self.cause = format!("accepted at the iteration bound, |r| = {residual:.3e} m");
            self.failing_step = Some(step);
        } else if let Some(growth) = self.energy_growth.filter(too_large) {
            self.outcome = Outcome::EnergyGrows;
            self.cause = format!(
                "the largest energy of the last half of the steps is {growth:.1e} times that of the first"
            );
            "take a damped time scheme or another step size; compare with smaller steps before trusting it"
                .clone_into(&mut self.remedy);
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

/// The table: a header, then a line for each cell.
pub(crate) fn to_csv(map: &Map, rows: &[(Cell, Row)]) -> String {
    let [first, second] = map.axes.each_ref().map(|axis| axis.name.as_str());
    let columns = [
        "accelerator",
        first,
        second,
        "outcome",
        "mean_iterations",
        "max_iterations",
        "cause",
        "failing_step",
        "steps",
        "newton_iterations",
        "retries",
        "energy_growth",
        "pressure_oscillation",
        "structure_displacement",
        "mesh_quality",
        "remedy",
    ];
    let line = |(cell, row): &(Cell, Row)| {
        let [first, second] = map.values(cell);
        csv_row(&[
            map.choices[cell.choice].as_str().into(),
            first.into(),
            second.into(),
            row.outcome.word().into(),
            row.rounded_mean().into(),
            row.max_iterations().into(),
            row.cause.as_str().into(),
            row.failing_step.into(),
            row.iterations.len().into(),
            row.newton_iterations.into(),
            row.retries.into(),
            three_digits(row.energy_growth),
            three_digits(row.pressure_oscillation),
            three_digits(row.structure_displacement),
            three_digits(row.mesh_quality),
            row.remedy.as_str().into(),
        ])
    };
    std::iter::once(csv_header(&columns)).chain(rows.iter().map(line)).collect()
}

/// Three digits tell what a measure tells.
fn three_digits(value: Option<f64>) -> Entry {
    value.map(|value| format!("{value:.2e}")).into()
}

impl From<FailureKind> for Outcome {
    fn from(kind: FailureKind) -> Self {
        match kind {
            FailureKind::IterationBound => Self::IterationBound,
            FailureKind::Diverged => Self::Diverged,
            FailureKind::FieldFailed => Self::FieldFailed,
            FailureKind::OutOfBudget => Self::OutOfBudget,
            FailureKind::Refused => Self::Refused,
            FailureKind::Broken => Self::Broken,
        }
    }
}
