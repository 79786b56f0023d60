//! One run of the release binary and what came of it.

use std::path::Path;
use std::process::{Command, Stdio};

use serde::{Deserialize, Serialize};

use super::case::Case;
use super::counts::Counts;
use super::setting::Setting;
use crate::task::{self, TaskError, shown};

/// Exit code of the program where a step could not be solved.
const STEP_FAILED: i32 = 3;

/// A run to be done: a scene with some of its keys changed.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Run {
    pub(crate) case: Case,
    pub(crate) setting: Setting,
    /// Further keys, `key=value`.
    pub(crate) changes: Vec<String>,
    /// Stop after so many steps.
    pub(crate) steps: Option<usize>,
}

impl Run {
    /// The whole run of a case at a setting.
    pub(crate) fn new(case: Case, setting: Setting) -> Self {
        Self { case, setting, changes: Vec::new(), steps: None }
    }

    /// The same with further keys of the scene changed.
    pub(crate) fn with(mut self, changes: &[String]) -> Self {
        self.changes.extend_from_slice(changes);
        self
    }

    /// What stands on the command line behind `run`, the output folder left out. No fields are written.
    pub(crate) fn arguments(&self) -> Vec<String> {
        let mut arguments = vec![format!("scenes/{}", self.case.scene())];
        let silent = ["output.fields_every=0", "output.checkpoint_every=0"].map(str::to_owned);
        for change in silent.iter().chain(&self.setting.overrides()).chain(&self.changes) {
            arguments.extend(["--set".to_owned(), change.clone()]);
        }
        if let Some(steps) = self.steps {
            arguments.extend(["--steps".to_owned(), steps.to_string()]);
        }
        arguments
    }
}

/// What is kept of a run.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(crate) struct Outcome {
    pub(crate) summary: Summary,
    /// Newton iterations of the longest fluid call.
    pub(crate) longest_fluid_call: usize,
    /// Newton iterations of the longest structure call.
    pub(crate) longest_structure_call: usize,
    /// What the program said when a step could not be solved.
    pub(crate) failure: Option<String>,
}

impl Outcome {
    /// The counts of a run that reached its end with every step converged.
    pub(crate) fn counts(&self) -> Option<Counts> {
        let Summary { coupling_iterations, newton_fluid, newton_structure, .. } = self.summary;
        self.summary.converged.then_some(Counts {
            coupling: coupling_iterations,
            fluid: newton_fluid,
            structure: newton_structure,
        })
    }
}

/// What is read of a run's `summary.json`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(crate) struct Summary {
    pub(crate) converged: bool,
    pub(crate) steps: usize,
    pub(crate) coupling_iterations: usize,
    pub(crate) newton_fluid: usize,
    pub(crate) newton_structure: usize,
    pub(crate) wall_seconds: f64,
    pub(crate) cpu_seconds: Option<f64>,
    pub(crate) seconds: Seconds,
}

/// Where the wall-clock time of a run went \[s\].
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub(crate) struct Seconds {
    pub(crate) fluid: f64,
    pub(crate) structure: f64,
    pub(crate) mesh_motion: f64,
    pub(crate) transfer: f64,
    pub(crate) acceleration: f64,
    pub(crate) output: f64,
}

/// Runs the program with these arguments and leaves its output in `folder`, which is replaced. Returns what the
/// program said if a step could not be solved.
pub(crate) fn start(
    root: &Path,
    binary: &Path,
    arguments: &[String],
    folder: &Path,
) -> Result<Option<String>, TaskError> {
    task::remove_folder(folder)?;
    let mut command = Command::new(binary);
    command.current_dir(root).arg("run").args(arguments).args(["--quiet", "--out"]).arg(folder);
    command.stdin(Stdio::null()).stdout(Stdio::null()).env("NO_COLOR", "1");
    let output = command.output().map_err(|source| TaskError::Start { command: shown(&command), source })?;
    if output.status.success() {
        return Ok(None);
    }
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    if output.status.code() == Some(STEP_FAILED) {
        return Ok(Some(said));
    }
    eprint!("{said}");
    Err(TaskError::Command { command: shown(&command), status: output.status })
}

/// Reads what a run left in its folder.
pub(crate) fn read_outcome(folder: &Path, failure: Option<String>) -> Result<Outcome, TaskError> {
    let path = folder.join("summary.json");
    let summary: Summary = serde_json::from_str(&task::read(&path)?)
        .map_err(|error| TaskError::Failed(format!("{}: {error}", path.display())))?;
    let path = folder.join("run.jsonl");
    let [longest_fluid_call, longest_structure_call] = longest_calls(&task::read(&path)?)
        .map_err(|error| TaskError::Failed(format!("{}: {error}", path.display())))?;
    Ok(Outcome { summary, longest_fluid_call, longest_structure_call, failure })
}

/// Most Newton iterations of a call of the fluid and of one of the structure, from the records of a run.
fn longest_calls(records: &str) -> Result<[usize; 2], serde_json::Error> {
    #[derive(Deserialize)]
    struct Line {
        iteration: Option<Iteration>,
    }
    #[derive(Deserialize)]
    struct Iteration {
        fields: [Call; 2],
    }
    #[derive(Deserialize)]
    struct Call {
        newton: usize,
    }
    let mut longest = [0; 2];
    for line in records.lines() {
        let Line { iteration: Some(iteration) } = serde_json::from_str(line)? else { continue };
        for (longest, call) in longest.iter_mut().zip(iteration.fields) {
            *longest = call.newton.max(*longest);
        }
    }
    Ok(longest)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::reproduce::setting::Limits;

    #[test]
    fn a_run_is_a_scene_and_keys() {
        let run = Run::new(Case::Beam, Setting::Fixed(Limits::of("1", "inf")));
        let run = Run { steps: Some(5), ..run.with(&["fluid.viscosity=2".to_owned()]) };
        assert_eq!(
            run.arguments().join(" "),
            "scenes/beam-in-channel --set output.fields_every=0 --set output.checkpoint_every=0 \
             --set coupling.newton.fixed.fluid=1 --set coupling.newton.fixed.structure=unlimited \
             --set fluid.viscosity=2 --steps 5"
        );
    }

    #[test]
    fn the_longest_calls_are_those_of_the_records() {
        let call = |newton: usize| format!(r#"{{"name":"x","newton":{newton},"changes":[]}}"#);
        let iteration = |fluid, structure| {
            format!(r#"{{"iteration":{{"step":1,"fields":[{},{}]}}}}"#, call(fluid), call(structure))
        };
        let step = r#"{"step":{"step":1,"fields":[{"newton":30},{"newton":40}]}}"#;
        let records = [iteration(3, 1), iteration(2, 4), step.to_owned()].join("\n");
        assert_eq!(longest_calls(&records).expect("records"), [3, 4]);
        assert_eq!(longest_calls("").expect("none"), [0, 0]);
        assert!(longest_calls("{\"iteration\":{\"st").is_err());
    }

    #[test]
    fn an_unconverged_run_has_no_counts() {
        let text = r#"{"converged":true,"ending":"completed","steps":5,"coupling_iterations":62,"newton_fluid":62,
            "newton_structure":61,"wall_seconds":0.25,"cpu_seconds":0.24,"seconds":{"fluid":0.1,"structure":0.1,
            "mesh_motion":0.01,"transfer":0.001,"acceleration":0.002,"output":0.003}}"#;
        let summary: Summary = serde_json::from_str(text).expect("a summary");
        let outcome = |converged| Outcome {
            summary: Summary { converged, ..summary.clone() },
            longest_fluid_call: 1,
            longest_structure_call: 1,
            failure: None,
        };
        assert_eq!(outcome(true).counts(), Some(Counts { coupling: 62, fluid: 62, structure: 61 }));
        assert_eq!(outcome(false).counts(), None);
    }
}
