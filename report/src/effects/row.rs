//! One row of `docs/data/effects.csv`.

use crate::csv::{self, Csv};
use crate::task::TaskError;

/// What one run came to.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Row {
    /// What is switched on or left out.
    pub(super) name: String,
    /// The effects that ran, as `partita plan` names them.
    pub(super) effects: String,
    pub(super) seconds_per_step: String,
    /// Of both fields, the whole run.
    pub(super) factorizations: usize,
    pub(super) assemblies: usize,
    /// `max_t |d - d_all| / max_t |d_all|` of the beam's tip; 1 where it does not move.
    pub(super) error: String,
    /// The same of the force on the beam.
    pub(super) load_error: String,
}

const COLUMNS: [&str; 7] =
    ["scene", "effects", "seconds_per_step", "factorizations", "assemblies", "error", "load_error"];

pub(super) fn to_csv(rows: &[Row]) -> Csv {
    let mut table = Csv::new(COLUMNS);
    for row in rows {
        table.push(vec![
            row.name.clone(),
            row.effects.clone(),
            row.seconds_per_step.clone(),
            row.factorizations.to_string(),
            row.assemblies.to_string(),
            row.error.clone(),
            row.load_error.clone(),
        ]);
    }
    table
}

impl Row {
    pub(super) fn read(row: &csv::Row<'_>) -> Result<Self, TaskError> {
        Ok(Self {
            name: row.text("scene")?.to_owned(),
            effects: row.text("effects")?.to_owned(),
            seconds_per_step: row.text("seconds_per_step")?.to_owned(),
            factorizations: row.value("factorizations")?,
            assemblies: row.value("assemblies")?,
            error: row.text("error")?.to_owned(),
            load_error: row.text("load_error")?.to_owned(),
        })
    }
}
