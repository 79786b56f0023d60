//! Records of the coupling as JSON lines and as rows of tables.
//!
//! Times stand in the object `seconds` of a line and in columns whose names end in `_seconds`; nothing else depends on
//! the machine.

use partita_coupling::RetryRecord;
use partita_coupling::participant::{NewtonLimit, PhaseTimes, WorkDetails};
use partita_coupling::record::{
    FieldRecord, FieldSeconds, FieldTotals, IterationRecord, Seconds, StepRecord,
};
use serde::Serialize;

use super::csv::Column;
use super::table::Cell;

/// Names of the two fields, in the order of their columns.
pub(super) type FieldNames = [String; 2];

/// The names that the fields of a scene have.
pub(super) fn scene_fields() -> FieldNames {
    ["fluid", "structure"].map(str::to_owned)
}

/// A line of `run.jsonl`, to be read back as a [`partita_coupling::Record`].
#[derive(Serialize)]
#[serde(rename_all = "snake_case")]
pub(super) enum Line<'a> {
    /// A coupling iteration.
    Iteration(&'a IterationRecord),
    /// A finished step.
    Step(&'a StepRecord),
    /// A step that failed and is repeated with half its size.
    Retry(&'a RetryRecord),
}

impl Line<'_> {
    /// The line with its end.
    pub(super) fn to_json(&self) -> Vec<u8> {
        let mut json = serde_json::to_vec(self).expect("a record is plain data");
        json.push(b'\n');
        json
    }
}

/// A row of `probes.csv`.
pub(super) struct ProbeRow {
    pub(super) step: usize,
    pub(super) time: f64,
    pub(super) values: Vec<f64>,
}

/// Columns of `probes.csv`: step, time \[s\], then a column a name.
pub(super) fn probe_columns(names: &[String]) -> Vec<Column<ProbeRow>> {
    let probe = |(index, name): (usize, &String)| Column::new(name, move |row: &ProbeRow| row.values[index]);
    let place =
        [Column::new("step", |row: &ProbeRow| row.step), Column::new("time", |row: &ProbeRow| row.time)];
    place.into_iter().chain(names.iter().enumerate().map(probe)).collect()
}

/// Columns of the table of all iterations.
///
/// `limit` is a number, `inf` (to convergence) or `settled` (until the output settles); `change` is the largest
/// relative change of any part of the field's solution.
pub(super) fn iteration_columns(fields: &FieldNames) -> Vec<Column<IterationRecord>> {
    type R = IterationRecord;
    let mut columns = vec![
        Column::new("step", |r: &R| r.step),
        Column::new("iteration", |r: &R| r.iteration),
        Column::new("residual", |r: &R| r.residual),
        Column::new("relative_residual", |r: &R| r.relative_residual),
        Column::new("work_defect", |r: &R| r.work_defect),
    ];
    for name in fields {
        let mut add = |quantity: &str, value: fn(&FieldRecord) -> Cell| {
            let wanted = name.clone();
            let cell = move |r: &R| r.fields.iter().find(|field| field.name == wanted).map(value);
            columns.push(Column::new(format!("{name}_{quantity}"), cell));
        };
        add("limit", |field| limit(field.limit));
        add("newton", |field| field.newton.into());
        add("assemblies", |field| field.assemblies.into());
        add("factorizations", |field| field.factorizations.into());
        add("solves", |field| field.solves.into());
        add("entry_residual", |field| field.entry_residual.into());
        add("exit_residual", |field| field.residual.into());
        add("change", |field| field.changes.iter().map(|change| change.value).fold(0.0, f64::max).into());
    }
    columns.extend([
        Column::new("relaxation", |r: &R| r.acceleration.as_ref().and_then(|proposal| proposal.omega)),
        Column::new("secant_columns", |r: &R| r.acceleration.as_ref().map(|proposal| proposal.columns)),
        Column::new("dropped_columns", |r: &R| {
            r.acceleration.as_ref().map(|proposal| proposal.dropped.len())
        }),
    ]);
    columns.extend(seconds_columns(fields));
    columns.extend(detail_columns(fields, |r: &R, name| {
        r.fields.iter().find(|field| field.name == name).map(|field| field.details)
    }));
    columns
}

/// Columns of `steps.csv`.
pub(super) fn step_columns(fields: &FieldNames) -> Vec<Column<StepRecord>> {
    type R = StepRecord;
    let mut columns = vec![
        Column::new("step", |r: &R| r.step),
        Column::new("time", |r: &R| r.time),
        Column::new("dt", |r: &R| r.dt),
        Column::new("converged", |r: &R| r.converged),
        Column::new("coupling_iterations", |r: &R| r.iterations),
        Column::new("residual", |r: &R| r.residual),
        Column::new("largest_change", |r: &R| r.largest_change),
    ];
    for name in fields {
        let mut add = |quantity: &str, count: fn(&FieldTotals) -> usize| {
            let wanted = name.clone();
            let cell = move |r: &R| r.fields.iter().find(|field| field.name == wanted).map(count);
            columns.push(Column::new(format!("{name}_{quantity}"), cell));
        };
        add("calls", |field| field.calls);
        add("newton", |field| field.newton);
        add("assemblies", |field| field.assemblies);
        add("factorizations", |field| field.factorizations);
        add("solves", |field| field.solves);
    }
    columns
}

/// Columns of the table of all steps: those of `steps.csv`, then times and more of each field's work.
pub(super) fn all_step_columns(fields: &FieldNames) -> Vec<Column<StepRecord>> {
    let mut columns = step_columns(fields);
    columns.push(Column::new("dropped_columns", |r: &StepRecord| r.dropped_columns));
    columns.extend(seconds_columns(fields));
    columns.extend(detail_columns(fields, |r: &StepRecord, name| {
        r.fields.iter().find(|field| field.name == name).map(|field| field.details)
    }));
    columns
}

/// The last columns of a table: more of each field's work.
fn detail_columns<R: 'static>(
    fields: &FieldNames,
    details: fn(&R, &str) -> Option<WorkDetails>,
) -> Vec<Column<R>> {
    type Count = fn(WorkDetails) -> usize;
    let counts: [(&str, Count); 4] = [
        ("tangents", |details| details.tangents),
        ("fallbacks", |details| details.fallbacks),
        ("mesh_factorizations", |details| details.mesh_factorizations),
        ("mesh_solves", |details| details.mesh_solves),
    ];
    let of = |name: &String| {
        let column = |(quantity, count): (&str, Count)| {
            let wanted = name.clone();
            Column::new(format!("{name}_{quantity}"), move |r: &R| details(r, &wanted).map(count))
        };
        counts.map(column)
    };
    fields.iter().flat_map(of).collect()
}

fn limit(limit: NewtonLimit) -> Cell {
    match limit {
        NewtonLimit::AtMost(count) => count.into(),
        NewtonLimit::ToConvergence => "inf".into(),
        NewtonLimit::UntilOutputSettles { .. } => "settled".into(),
    }
}

/// A record that tells where the time went.
trait Timed {
    /// Seconds of the field of this name.
    fn field_seconds(&self, name: &str) -> Option<&FieldSeconds>;
    fn seconds(&self) -> &Seconds;
}

impl Timed for IterationRecord {
    fn field_seconds(&self, name: &str) -> Option<&FieldSeconds> {
        let index = self.fields.iter().position(|field| field.name == name)?;
        Some(&self.seconds.fields[index])
    }
    fn seconds(&self) -> &Seconds {
        &self.seconds
    }
}

impl Timed for StepRecord {
    fn field_seconds(&self, name: &str) -> Option<&FieldSeconds> {
        let index = self.fields.iter().position(|field| field.name == name)?;
        Some(&self.seconds.fields[index])
    }
    fn seconds(&self) -> &Seconds {
        &self.seconds
    }
}

/// Columns of times: whole calls, their phases, and what lies between the calls.
fn seconds_columns<R: Timed + 'static>(fields: &FieldNames) -> Vec<Column<R>> {
    let mut columns = Vec::new();
    for name in fields {
        let wanted = name.clone();
        columns.push(Column::new(format!("{name}_seconds"), move |r: &R| {
            r.field_seconds(&wanted).map(|seconds| seconds.total)
        }));
        let mut add = |phase: &str, time: fn(&PhaseTimes) -> f64| {
            let wanted = name.clone();
            let cell = move |r: &R| r.field_seconds(&wanted).map(|seconds| time(&seconds.phases));
            columns.push(Column::new(format!("{name}_{phase}_seconds"), cell));
        };
        add("assembly", |phases| phases.assembly);
        add("factorization", |phases| phases.factorization);
        add("solve", |phases| phases.solve);
        add("mesh_motion", |phases| phases.mesh_motion);
    }
    columns.push(Column::new("transfer_seconds", |r: &R| r.seconds().transfer));
    columns.push(Column::new("acceleration_seconds", |r: &R| r.seconds().acceleration));
    columns
}
