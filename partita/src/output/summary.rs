//! What a run came to: counts, times, memory.

use partita_coupling::WorkDetails;
use partita_coupling::record::{FieldSeconds, FieldTotals, StepRecord};
use serde::{Deserialize, Serialize};

use super::table::{Cell, Table};
use crate::clock::Spent;

/// How a run ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Ending {
    /// All its steps are done.
    Completed,
    /// It was asked to stop before the scene's last step; it can be resumed.
    Stopped,
    /// It was interrupted from outside; it can be resumed.
    Interrupted,
    /// A step could not be solved, or what it came to not be written.
    Failed,
}

/// Counts and times over the finished steps of a run.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Totals {
    /// Finished steps.
    pub steps: usize,
    /// Those among them whose criterion was not met.
    pub unconverged_steps: usize,
    /// Steps that failed and were repeated with half their size.
    pub retries: usize,
    /// Coupling iterations.
    pub coupling_iterations: usize,
    /// Newton iterations of the fluid.
    pub newton_fluid: usize,
    /// Newton iterations of the structure.
    pub newton_structure: usize,
    /// Work of the fluid.
    pub fluid: Work,
    /// Work of the structure.
    pub structure: Work,
    /// Fields of other names.
    pub others: Vec<OtherField>,
    /// Where the solvers' time went; `output` stays zero here.
    pub seconds: Seconds,
}

impl Totals {
    /// Adds a finished step.
    pub fn add(&mut self, step: &StepRecord) {
        self.steps += 1;
        self.unconverged_steps += usize::from(!step.converged);
        self.coupling_iterations += step.iterations;
        self.newton_fluid += step.newton_of("fluid");
        self.newton_structure += step.newton_of("structure");
        for (field, seconds) in step.fields.iter().zip(&step.seconds.fields) {
            match field.name.as_str() {
                "fluid" => self.fluid.add(field),
                "structure" => self.structure.add(field),
                name => {
                    let other = self.other(name);
                    other.work.add(field);
                    other.seconds += seconds.total - seconds.phases.mesh_motion;
                }
            }
            self.seconds.add_field(&field.name, seconds);
        }
        self.seconds.transfer += step.seconds.transfer;
        self.seconds.acceleration += step.seconds.acceleration;
    }

    /// The entry of a field of another name.
    fn other(&mut self, name: &str) -> &mut OtherField {
        let index = self.others.iter().position(|other| other.name == name).unwrap_or_else(|| {
            self.others.push(OtherField { name: name.to_owned(), ..OtherField::default() });
            self.others.len() - 1
        });
        &mut self.others[index]
    }
}

/// What a field did that is neither called `fluid` nor `structure`.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct OtherField {
    /// Its name.
    pub name: String,
    /// Its work.
    pub work: Work,
    /// Its calls \[s\].
    pub seconds: f64,
}

/// What one field did in the finished steps of a run.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
pub struct Work {
    /// Calls.
    pub calls: usize,
    /// Newton iterations.
    pub newton: usize,
    /// Assemblies of the residual.
    pub assemblies: usize,
    /// Numeric factorizations of the tangent.
    pub factorizations: usize,
    /// Linear solves with it.
    pub solves: usize,
    /// Calls that converged because their residual was round-off, above the bound or already at the entry; left out where there are none.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub at_round_off: usize,
    /// Steps in which the field never iterated although more than a thousandth of its load was not balanced; left out where
    /// there are none.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub idle_steps: usize,
    /// What stands behind these counts, and what they leave out.
    #[serde(flatten)]
    pub details: WorkDetails,
}

impl Work {
    fn add(&mut self, step: &FieldTotals) {
        self.calls += step.calls;
        self.newton += step.newton;
        self.assemblies += step.assemblies;
        self.factorizations += step.factorizations;
        self.solves += step.solves;
        self.at_round_off += step.at_round_off;
        self.idle_steps += usize::from(step.idle_under_load);
        self.details += step.details;
    }
}

#[expect(clippy::trivially_copy_pass_by_ref, reason = "the signature is serde's")]
fn is_zero(count: &usize) -> bool {
    *count == 0
}

/// Wall-clock seconds by what was done in them; no second is counted twice.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct Seconds {
    /// Calls of the fluid, mesh motion left out \[s\].
    pub fluid: f64,
    /// Calls of the structure \[s\].
    pub structure: f64,
    /// Motion of the fluid's mesh \[s\].
    pub mesh_motion: f64,
    /// Interface values between the fields \[s\].
    pub transfer: f64,
    /// The accelerator \[s\].
    pub acceleration: f64,
    /// Records, tables and fields \[s\].
    pub output: f64,
}

impl Seconds {
    fn add_field(&mut self, name: &str, seconds: &FieldSeconds) {
        let motion = seconds.phases.mesh_motion;
        self.mesh_motion += motion;
        match name {
            "fluid" => self.fluid += seconds.total - motion,
            "structure" => self.structure += seconds.total - motion,
            _ => {}
        }
    }
}

/// Largest resident memory of this process so far \[bytes\], where the system tells (Linux).
fn max_resident_bytes() -> Option<u64> {
    peak_in_status(&std::fs::read_to_string("/proc/self/status").ok()?)
}

fn peak_in_status(status: &str) -> Option<u64> {
    let value = status.lines().find_map(|line| line.strip_prefix("VmHWM:"))?;
    let kibibytes: u64 = value.trim().strip_suffix("kB")?.trim_end().parse().ok()?;
    Some(kibibytes * 1024)
}

/// `summary.json`. Whatever depends on the machine stands in the last four fields.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Summary {
    /// Whether the run did not fail and every step met its criterion.
    pub converged: bool,
    /// How it ended.
    pub ending: Ending,
    /// Why a failed run failed.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub cause: Option<String>,
    /// Finished steps, all sessions.
    pub steps: usize,
    /// Those among them that ended on the iteration bound and were accepted.
    pub unconverged_steps: usize,
    /// Steps that failed and were repeated with half their size, where there were any.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub retries: Option<usize>,
    /// Coupling iterations of these steps.
    pub coupling_iterations: usize,
    /// Newton iterations of the fluid.
    pub newton_fluid: usize,
    /// Newton iterations of the structure.
    pub newton_structure: usize,
    /// Work of the fluid.
    pub fluid: Work,
    /// Work of the structure.
    pub structure: Work,
    /// Fields of other names; left out where there are none.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub others: Vec<OtherField>,
    /// Largest resident memory \[bytes\], of the last session.
    pub max_resident_bytes: Option<u64>,
    /// Wall-clock time \[s\], all sessions.
    pub wall_seconds: f64,
    /// Time on processors \[s\], all sessions and threads.
    pub cpu_seconds: Option<f64>,
    /// Where the time went \[s\].
    pub seconds: Seconds,
}

impl Summary {
    /// The summary of the steps in `totals` that cost `spent`.
    #[must_use]
    pub fn new(ending: Ending, totals: &Totals, spent: &Spent) -> Self {
        Self {
            converged: ending != Ending::Failed && totals.unconverged_steps == 0,
            ending,
            cause: None,
            steps: totals.steps,
            unconverged_steps: totals.unconverged_steps,
            retries: (totals.retries > 0).then_some(totals.retries),
            coupling_iterations: totals.coupling_iterations,
            newton_fluid: totals.newton_fluid,
            newton_structure: totals.newton_structure,
            fluid: totals.fluid,
            structure: totals.structure,
            others: totals.others.clone(),
            max_resident_bytes: max_resident_bytes(),
            wall_seconds: spent.wall_seconds,
            cpu_seconds: spent.cpu_seconds,
            seconds: Seconds { output: spent.output_seconds, ..totals.seconds },
        }
    }

    /// The summary of a failed run, with its cause.
    #[must_use]
    pub fn failed(totals: &Totals, spent: &Spent, cause: String) -> Self {
        Self { cause: Some(cause), ..Self::new(Ending::Failed, totals, spent) }
    }

    pub(super) fn to_json(&self) -> String {
        serde_json::to_string_pretty(self).expect("a summary is plain data") + "\n"
    }

    /// The table that a run prints at its end.
    #[must_use]
    pub fn table(&self) -> Table {
        let Seconds { fluid, structure, mesh_motion, transfer, acceleration, output } = self.seconds;
        let mut table = Table::new(["", "total", "per step", "seconds"]);
        table.push(["steps".into(), self.steps.into(), Cell::Empty, self.wall_seconds.into()]);
        let mut row = |name: &str, count: Option<usize>, seconds: f64| {
            let per_step = count.map(|count| count as f64 / self.steps.max(1) as f64);
            table.push([name.into(), count.into(), per_step.into(), seconds.into()]);
        };
        row("coupling iterations", Some(self.coupling_iterations), transfer + acceleration);
        row("Newton iterations, fluid", Some(self.newton_fluid), fluid);
        row("Newton iterations, structure", Some(self.newton_structure), structure);
        for other in &self.others {
            row(&format!("Newton iterations, {}", other.name), Some(other.work.newton), other.seconds);
        }
        row("mesh motion", None, mesh_motion);
        row("output", None, output);
        table
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn peak_memory_is_read_from_the_status() {
        assert_eq!(
            peak_in_status("Name:\tpartita\nVmHWM:\t   12345 kB\nVmRSS:\t 1 kB\n"),
            Some(12345 * 1024)
        );
        assert_eq!(peak_in_status("Name:\tpartita\n"), None);
        assert_eq!(peak_in_status("VmHWM:\t 12 MB\n"), None);
    }

    #[test]
    fn a_failed_run_is_not_converged() {
        let totals = Totals { steps: 3, ..Totals::default() };
        let converged = |ending, totals: &Totals| Summary::new(ending, totals, &Spent::default()).converged;
        assert!(converged(Ending::Completed, &totals));
        assert!(converged(Ending::Interrupted, &totals));
        assert!(!converged(Ending::Failed, &totals));
        assert!(!converged(Ending::Completed, &Totals { unconverged_steps: 1, ..totals }));
    }
}
