//! What a run leaves behind: one record a coupling iteration, one a step.
//!
//! Records are plain data with a fixed order of fields, made for JSON lines. Everything that depends on the
//! machine's speed stands in the fields named `seconds`, and `without_seconds` strips it.

use std::ops::AddAssign;

use serde::{Deserialize, Serialize};

use crate::accelerate::{Answer, DroppedColumn, Proposal};
use crate::participant::{Change, Effort, NewtonLimit, PhaseTimes, Step, WorkDetails};

mod retry;

pub use retry::RetryRecord;

/// One line of a run's record: `{"iteration": {...}}`, `{"step": {...}}` or `{"retry": {...}}`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Record {
    /// A coupling iteration.
    Iteration(IterationRecord),
    /// A finished step.
    Step(StepRecord),
    /// A step that failed and is repeated with half its size.
    Retry(RetryRecord),
}

/// One call of one field.
#[expect(clippy::struct_excessive_bools, reason = "independent facts, each with its own name in records")]
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct FieldRecord {
    /// The field.
    pub name: String,
    /// The limit it was given.
    pub limit: NewtonLimit,
    /// Newton iterations.
    pub newton: usize,
    /// Assemblies of the residual.
    pub assemblies: usize,
    /// Numeric factorizations.
    pub factorizations: usize,
    /// Linear solves.
    pub solves: usize,
    /// Residual at entry, as the field's bound measures it.
    #[serde(with = "finite_or_null")]
    pub entry_residual: f64,
    /// Residual at exit.
    #[serde(with = "finite_or_null")]
    pub residual: f64,
    /// Whether the field met its bound at entry, or was at round-off.
    pub entry_converged: bool,
    /// Whether the field meets its bound at exit, or is at round-off.
    pub converged: bool,
    /// Whether it converged because its residual was round-off, above its bound or already at the entry; left out of the record where not.
    #[serde(default, skip_serializing_if = "is_false")]
    pub at_round_off: bool,
    /// Whether it did not iterate although a good part of its load was not balanced; left out of the record where not.
    #[serde(default, skip_serializing_if = "is_false")]
    pub idle_under_load: bool,
    /// Relative change of every part of the solution.
    pub changes: Vec<Change>,
    /// More of its work; nothing in records of older versions.
    #[serde(default)]
    pub details: WorkDetails,
}

impl FieldRecord {
    /// The record of a call of `name` under `limit`.
    #[must_use]
    pub fn new(name: &str, limit: NewtonLimit, effort: Effort) -> Self {
        Self {
            name: name.to_owned(),
            limit,
            newton: effort.newton,
            assemblies: effort.assemblies,
            factorizations: effort.factorizations,
            solves: effort.solves,
            entry_residual: effort.entry_residual,
            residual: effort.residual,
            entry_converged: effort.entry_converged,
            converged: effort.converged,
            at_round_off: effort.at_round_off,
            idle_under_load: effort.idle_under_load,
            changes: effort.changes,
            details: effort.details,
        }
    }

    /// Whether the output is the field's answer to this input: not where the field entered its call converged and took no
    /// iteration. A field without Newton iterations, which assembles nothing, always answers.
    #[must_use]
    pub fn answers(&self) -> bool {
        self.newton > 0 || !self.entry_converged || self.assemblies == 0
    }
}

/// One coupling iteration: one call of both fields.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct IterationRecord {
    /// Number of the step, counted from 1.
    pub step: usize,
    /// Number of the coupling iteration, counted from 1.
    pub iteration: usize,
    /// `|x_tilde - x|` \[m\].
    pub residual: f64,
    /// `|x_tilde - x| / |x_tilde|`, 0/0 = 0, and 0 where the difference is round-off of the structure's size.
    #[serde(with = "finite_or_null")]
    pub relative_residual: f64,
    /// `|f . (H x) - F . x| / (|f| |H x|)`: the virtual work lost in the transfer, 0/0 = 0.
    pub work_defect: f64,
    /// The calls of the first and of the second field.
    pub fields: [FieldRecord; 2],
    /// What the acceleration did; nothing in the last iteration of a step.
    pub acceleration: Option<Proposal>,
    /// Where the time went.
    pub seconds: Seconds,
}

impl IterationRecord {
    /// Largest relative change of any part of any field.
    #[must_use]
    pub fn largest_change(&self) -> f64 {
        self.fields.iter().flat_map(|field| &field.changes).map(|change| change.value).fold(0.0, f64::max)
    }

    /// What the residual is worth as evidence.
    pub(crate) fn answer(&self) -> Answer {
        Answer { answered: self.fields.iter().all(FieldRecord::answers) }
    }

    /// The record without its times.
    #[must_use]
    pub fn without_seconds(&self) -> Self {
        Self { seconds: Seconds::default(), ..self.clone() }
    }
}

/// Sums over the calls of one field.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct FieldTotals {
    /// The field.
    pub name: String,
    /// Calls.
    pub calls: usize,
    /// Newton iterations.
    pub newton: usize,
    /// Assemblies of the residual.
    pub assemblies: usize,
    /// Numeric factorizations.
    pub factorizations: usize,
    /// Linear solves.
    pub solves: usize,
    /// More of its work; nothing in records of older versions.
    #[serde(default)]
    pub details: WorkDetails,
    /// Calls that converged because their residual was round-off; left out of the record where there are none.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub at_round_off: usize,
    /// Whether the field never iterated in the step although a good part of its load was not balanced; left out of the
    /// record where not.
    #[serde(default, skip_serializing_if = "is_false")]
    pub idle_under_load: bool,
}

/// One finished step.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct StepRecord {
    /// Number of the step, counted from 1.
    pub step: usize,
    /// The time at its end \[s\].
    pub time: f64,
    /// Its size \[s\].
    pub dt: f64,
    /// Whether the criterion was met; `false` only where steps at the iteration bound are accepted.
    pub converged: bool,
    /// Coupling iterations.
    pub iterations: usize,
    /// `|r|` of the last iteration \[m\].
    pub residual: f64,
    /// Largest relative change of the last iteration.
    #[serde(with = "finite_or_null")]
    pub largest_change: f64,
    /// Secant columns dropped in the step, for whatever reason, those of its last iteration included.
    #[serde(default)]
    pub dropped_columns: usize,
    /// Sums over the calls of the first and of the second field.
    pub fields: [FieldTotals; 2],
    /// Where the time went.
    pub seconds: Seconds,
}

impl StepRecord {
    /// Newton iterations of the field of this name; none where there is no such field.
    #[must_use]
    pub fn newton_of(&self, field: &str) -> usize {
        self.fields.iter().find(|known| known.name == field).map_or(0, |known| known.newton)
    }

    /// The summary of the iterations of a step, whose last one made the accelerator drop columns, too.
    ///
    /// # Panics
    /// When the history is empty.
    #[must_use]
    pub fn new(history: &StepHistory, converged: bool, dropped: &[DroppedColumn]) -> Self {
        let last = history.last().expect("a finished step has at least one iteration");
        let mut seconds = Seconds::default();
        for iteration in &history.iterations {
            seconds += iteration.seconds;
        }
        let proposals = history.iterations.iter().filter_map(|iteration| iteration.acceleration.as_ref());
        Self {
            step: history.step.index,
            time: history.step.time,
            dt: history.step.dt,
            converged,
            iterations: history.iterations.len(),
            residual: last.residual,
            largest_change: last.largest_change(),
            dropped_columns: proposals.map(|proposal| proposal.dropped.len()).sum::<usize>() + dropped.len(),
            fields: [history.totals(0), history.totals(1)],
            seconds: seconds.to_the_microsecond(),
        }
    }

    /// The record without its times.
    #[must_use]
    pub fn without_seconds(&self) -> Self {
        Self { seconds: Seconds::default(), ..self.clone() }
    }
}

/// The iterations of one step so far.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct StepHistory {
    /// The step.
    pub step: Step,
    /// Its iterations, oldest first.
    pub iterations: Vec<IterationRecord>,
}

impl StepHistory {
    /// The history of a step that has not begun to iterate.
    #[must_use]
    pub fn new(step: Step) -> Self {
        Self { step, iterations: Vec::new() }
    }

    /// The latest iteration.
    #[must_use]
    pub fn last(&self) -> Option<&IterationRecord> {
        self.iterations.last()
    }

    fn totals(&self, field: usize) -> FieldTotals {
        let mut totals = FieldTotals::default();
        for call in self.iterations.iter().map(|iteration| &iteration.fields[field]) {
            totals.name.clone_from(&call.name);
            totals.calls += 1;
            totals.newton += call.newton;
            totals.assemblies += call.assemblies;
            totals.factorizations += call.factorizations;
            totals.solves += call.solves;
            totals.details += call.details;
            totals.at_round_off += usize::from(call.at_round_off);
            totals.idle_under_load |= call.idle_under_load;
        }
        totals.idle_under_load &= totals.newton == 0;
        totals
    }
}

/// Wall-clock seconds of one call, and the phases the field itself measured.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct FieldSeconds {
    /// The whole call \[s\].
    pub total: f64,
    /// Phases inside it.
    pub phases: PhaseTimes,
}

/// Wall-clock seconds of an iteration or a step.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct Seconds {
    /// The first and the second field.
    pub fields: [FieldSeconds; 2],
    /// `H x` and `H^T f` \[s\].
    pub transfer: f64,
    /// The accelerator \[s\].
    pub acceleration: f64,
}

impl Seconds {
    /// The same to the microsecond: a clock knows no more, and a fifth of a record's bytes would be such digits.
    #[must_use]
    pub fn to_the_microsecond(mut self) -> Self {
        let round = |seconds: &mut f64| *seconds = (*seconds * 1e6).round() / 1e6;
        for FieldSeconds { total, phases } in &mut self.fields {
            let PhaseTimes { assembly, factorization, solve, mesh_motion } = phases;
            [total, assembly, factorization, solve, mesh_motion].into_iter().for_each(round);
        }
        [&mut self.transfer, &mut self.acceleration].into_iter().for_each(round);
        self
    }
}

impl AddAssign for Seconds {
    fn add_assign(&mut self, other: Self) {
        for (sum, field) in self.fields.iter_mut().zip(other.fields) {
            sum.total += field.total;
            sum.phases += field.phases;
        }
        self.transfer += other.transfer;
        self.acceleration += other.acceleration;
    }
}

#[expect(clippy::trivially_copy_pass_by_ref, reason = "the signature is serde's")]
fn is_false(flag: &bool) -> bool {
    !flag
}

#[expect(clippy::trivially_copy_pass_by_ref, reason = "the signature is serde's")]
fn is_zero(count: &usize) -> bool {
    *count == 0
}

/// JSON knows no infinity: a ratio to zero is written as `null` and read back as infinity.
pub(crate) mod finite_or_null {
    use serde::{Deserialize, Deserializer, Serialize, Serializer};

    #[expect(clippy::trivially_copy_pass_by_ref, reason = "the signature is serde's")]
    pub(crate) fn serialize<S: Serializer>(value: &f64, serializer: S) -> Result<S::Ok, S::Error> {
        value.is_finite().then_some(*value).serialize(serializer)
    }

    pub(crate) fn deserialize<'de, D: Deserializer<'de>>(deserializer: D) -> Result<f64, D::Error> {
        Ok(Option::<f64>::deserialize(deserializer)?.unwrap_or(f64::INFINITY))
    }
}

#[cfg(test)]
pub(crate) mod samples {
    use super::*;

    /// A step after one iteration in which both fields changed by `changes`.
    pub(crate) fn history(changes: [f64; 2], entry_converged: bool, converged: bool) -> StepHistory {
        let mut history = StepHistory::new(Step { index: 1, time: 0.01, dt: 0.01 });
        let field = |name: &str, part: &'static str, value: f64| {
            let effort = Effort {
                newton: 2,
                assemblies: 3,
                factorizations: 2,
                solves: 2,
                entry_residual: 0.5,
                residual: 1e-12,
                entry_converged,
                converged,
                at_round_off: false,
                idle_under_load: false,
                changes: vec![Change::new(part, value)],
                time: PhaseTimes::default(),
                details: WorkDetails { tangents: 2, mesh_solves: 1, ..WorkDetails::default() },
            };
            FieldRecord::new(name, NewtonLimit::AtMost(2), effort)
        };
        history.iterations.push(IterationRecord {
            step: 1,
            iteration: 1,
            residual: 0.25,
            relative_residual: 0.125,
            work_defect: 0.0,
            fields: [field("fluid", "velocity", changes[0]), field("structure", "displacement", changes[1])],
            acceleration: Some(Proposal::relaxation(0.5)),
            seconds: Seconds::default(),
        });
        history
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn iteration_is_one_line_with_a_fixed_order_of_fields() {
        let history = samples::history([0.5, 0.25], false, true);
        let line = serde_json::to_string(&Record::Iteration(history.iterations[0].clone())).unwrap();
        let broken = ["{\"name", "\"changes", "\"details", "\"acceleration\":{", "\"seconds", "{\"total"]
            .iter()
            .fold(line, |line, start| line.replace(start, &format!("\n{start}")));
        insta::assert_snapshot!(broken, @r#"
        {"iteration":{"step":1,"iteration":1,"residual":0.25,"relative_residual":0.125,"work_defect":0.0,"fields":[
        {"name":"fluid","limit":{"at_most":2},"newton":2,"assemblies":3,"factorizations":2,"solves":2,"entry_residual":0.5,"residual":1e-12,"entry_converged":false,"converged":true,
        "changes":[{"part":"velocity","value":0.5}],
        "details":{"tangents":2,"fallbacks":0,"mesh_factorizations":0,"mesh_solves":1}},
        {"name":"structure","limit":{"at_most":2},"newton":2,"assemblies":3,"factorizations":2,"solves":2,"entry_residual":0.5,"residual":1e-12,"entry_converged":false,"converged":true,
        "changes":[{"part":"displacement","value":0.25}],
        "details":{"tangents":2,"fallbacks":0,"mesh_factorizations":0,"mesh_solves":1}}],
        "acceleration":{"omega":0.5,"columns":0,"dropped":[]},
        "seconds":{"fields":[
        {"total":0.0,"phases":{"assembly":0.0,"factorization":0.0,"solve":0.0,"mesh_motion":0.0}},
        {"total":0.0,"phases":{"assembly":0.0,"factorization":0.0,"solve":0.0,"mesh_motion":0.0}}],"transfer":0.0,"acceleration":0.0}}}
        "#);
    }

    #[test]
    fn step_sums_its_iterations() {
        let mut history = samples::history([0.5, 0.25], false, true);
        history.iterations.push(history.iterations[0].clone());
        history.iterations[1].seconds.transfer = 2.0;
        let record = StepRecord::new(&history, true, &[]);
        assert_eq!((record.iterations, record.fields[0].newton, record.fields[1].assemblies), (2, 4, 6));
        assert_eq!(record.fields[1].name, "structure");
        assert_eq!((record.fields[0].details.tangents, record.fields[0].details.mesh_solves), (4, 2));
        assert_eq!(record.seconds.transfer.to_bits(), 2.0_f64.to_bits());
        assert_eq!(record.without_seconds().seconds, Seconds::default());
    }

    #[test]
    fn seconds_are_rounded_to_the_microsecond() {
        let phases = PhaseTimes { assembly: 0.002_449_383_999_999_999_8, ..PhaseTimes::default() };
        let field = FieldSeconds { total: 1.234_567_89, phases };
        let seconds = Seconds { fields: [field; 2], transfer: 4e-7, acceleration: 6e-7 };
        let line = serde_json::to_string(&seconds.to_the_microsecond()).unwrap();
        for needed in
            ["\"total\":1.234568,", "\"assembly\":0.002449,", "\"transfer\":0.0,", "\"acceleration\":1e-6"]
        {
            assert!(line.contains(needed), "{needed} is not in {line}");
        }
    }

    #[test]
    fn a_field_is_idle_in_a_step_if_it_never_iterated_under_its_load() {
        let mut history = samples::history([0.0, 0.0], true, true);
        let call = &mut history.iterations[0].fields[1];
        (call.newton, call.idle_under_load, call.at_round_off) = (0, true, true);
        history.iterations.push(history.iterations[0].clone());
        let [fluid, structure] = StepRecord::new(&history, true, &[]).fields;
        assert_eq!((fluid.idle_under_load, fluid.at_round_off), (false, 0));
        assert_eq!((structure.idle_under_load, structure.at_round_off), (true, 2));
        history.iterations[1].fields[1].newton = 1;
        assert!(
            !StepRecord::new(&history, true, &[]).fields[1].idle_under_load,
            "it moved in the second iteration"
        );
    }

    #[test]
    fn what_hardly_ever_happens_is_left_out_of_a_line_and_read_back() {
        let mut record = samples::history([0.5, 0.25], false, true).iterations.remove(0);
        let line = serde_json::to_string(&record).unwrap();
        assert!(!line.contains("at_round_off") && !line.contains("idle_under_load"), "{line}");
        (record.fields[0].at_round_off, record.fields[1].idle_under_load) = (true, true);
        let line = serde_json::to_string(&record).unwrap();
        assert_eq!(serde_json::from_str::<IterationRecord>(&line).unwrap(), record);
    }

    #[test]
    fn infinite_change_survives_json() {
        let record = samples::history([f64::INFINITY, 0.0], false, true).iterations.remove(0);
        let line = serde_json::to_string(&record).unwrap();
        assert!(line.contains("{\"part\":\"velocity\",\"value\":null}"));
        assert_eq!(serde_json::from_str::<IterationRecord>(&line).unwrap(), record);
    }
}
