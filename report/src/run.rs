//! One run of a scene, and what came of it.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use partita::output::{self, Ending, Seconds, Summary};
use partita::scene::{self, Resolved};
use partita_coupling::Record;
use partita_numerics::Field;
use serde::{Deserialize, Serialize};

use crate::csv::Csv;
use crate::program::Program;
use crate::task::{self, TaskError};

/// Checkpoints of a run, the older one second.
const CHECKPOINTS: [&str; 2] = ["checkpoint.bin", "checkpoint.previous.bin"];

/// A run to be done: a scene with some of its keys changed.
pub(crate) struct Run<'a> {
    /// What progress and messages call it.
    pub(crate) name: String,
    /// The scene's file or folder, from the root of the workspace.
    pub(crate) scene: String,
    /// Further keys, `key=value`.
    pub(crate) overrides: Vec<String>,
    pub(crate) stop: Stop<'a>,
}

/// Where a run ends.
#[derive(Clone, Copy)]
pub(crate) enum Stop<'a> {
    /// With its scene.
    AtTheEnd,
    /// After so many steps.
    After(usize),
    /// Where its folder shows that it has gone on long enough, or with its scene.
    When {
        /// Steps between two looks.
        every: usize,
        reached: &'a (dyn Fn(&Path) -> Result<bool, TaskError> + Sync),
    },
}

impl<'a> Run<'a> {
    /// The whole run of a scene.
    pub(crate) fn new(name: impl Into<String>, scene: impl Into<String>) -> Self {
        Self { name: name.into(), scene: scene.into(), overrides: Vec::new(), stop: Stop::AtTheEnd }
    }

    /// The same with further keys of the scene changed.
    pub(crate) fn with<S: AsRef<str>>(mut self, keys: &[S]) -> Self {
        self.overrides.extend(keys.iter().map(|key| key.as_ref().to_owned()));
        self
    }

    /// The same without files of fields and checkpoints.
    pub(crate) fn without_fields(self) -> Self {
        self.with(&["output.fields_every=0", "output.checkpoint_every=0"])
    }

    pub(crate) fn ending(self, stop: Stop<'a>) -> Self {
        Self { stop, ..self }
    }

    /// The scene as the run sees it.
    pub(crate) fn resolved(&self, root: &Path) -> Result<Resolved, TaskError> {
        scene::load(&root.join(&self.scene), &self.overrides)
            .map_err(|error| TaskError::Failed(format!("{}: {error}", self.name)))
    }

    /// The unknowns of both fields.
    pub(crate) fn unknowns(&self, root: &Path) -> Result<usize, TaskError> {
        let failed = |error| TaskError::Failed(format!("{}: {error}", self.name));
        let march = partita::build::march(&self.resolved(root)?).map_err(failed)?;
        let fluid = march.first().field().map_or(0, Field::unknowns);
        Ok(fluid + march.second().field().map_or(0, Field::unknowns))
    }

    /// Does the run and leaves its files in `out`. What was begun there before is taken up at its checkpoint, or begun again.
    pub(crate) fn perform(&self, program: &Program, out: &Path) -> Result<Outcome, TaskError> {
        let summary = || task::read_json::<Summary>(&out.join(output::SUMMARY));
        let mut failure = None;
        let mut before = None;
        loop {
            let done = summary().ok();
            if let Some(done) = &done
                && self.is_over(done, out)?
            {
                break;
            }
            let steps = done.map(|done| done.steps);
            if before.is_some() && steps == before {
                return Err(TaskError::Failed(format!("{}: it does not go on", self.name)));
            }
            before = steps;
            failure = program.call(&self.words(out, steps.unwrap_or(0))?)?;
            if failure.is_some() {
                break;
            }
        }
        let outcome =
            Outcome { summary: summary()?, longest_calls: longest_calls(out)?, failure, out: out.to_owned() };
        if !matches!(self.stop, Stop::When { .. }) {
            // The largest file, and nothing asks for it again.
            std::fs::remove_file(out.join(output::RECORDS))
                .map_err(|source| TaskError::File { path: out.to_owned(), source })?;
        }
        Ok(outcome)
    }

    /// The command line that begins or continues the run in `out`, which has `done` steps behind it.
    fn words(&self, out: &Path, done: usize) -> Result<Vec<String>, TaskError> {
        let out_word = out.display().to_string();
        let mut words = if CHECKPOINTS.iter().any(|name| out.join(name).is_file()) {
            vec!["resume".to_owned(), out_word]
        } else {
            task::remove_folder(out)?;
            let sets = self.overrides.iter().flat_map(|key| ["--set".to_owned(), key.clone()]);
            let head = ["run".to_owned(), self.scene.clone()].into_iter();
            head.chain(sets).chain(["--out".to_owned(), out_word]).collect()
        };
        words.push("--quiet".to_owned());
        let last = match self.stop {
            Stop::AtTheEnd => None,
            Stop::After(steps) => Some(steps),
            Stop::When { every, .. } => Some(done + every),
        };
        words.extend(last.into_iter().flat_map(|last| ["--steps".to_owned(), last.to_string()]));
        Ok(words)
    }

    /// Whether nothing is left to do.
    fn is_over(&self, summary: &Summary, out: &Path) -> Result<bool, TaskError> {
        match (summary.ending, self.stop) {
            (Ending::Completed, _) => Ok(true),
            (Ending::Stopped, Stop::After(steps)) => Ok(summary.steps >= steps),
            (Ending::Stopped, Stop::When { reached, .. }) => reached(out),
            _ => Ok(false),
        }
    }
}

/// What is kept of a run.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(crate) struct Outcome {
    pub(crate) summary: Summary,
    /// Newton iterations of the longest call of each field, by its name.
    longest_calls: BTreeMap<String, usize>,
    /// What the program said when a step could not be solved.
    pub(crate) failure: Option<String>,
    /// The folder of the run.
    #[serde(skip)]
    pub(crate) out: PathBuf,
}

impl Outcome {
    /// What a run without calls came to.
    #[cfg(test)]
    pub(crate) fn of(summary: Summary) -> Self {
        Self { summary, longest_calls: BTreeMap::new(), failure: None, out: PathBuf::new() }
    }

    /// The same of a run whose files are in this folder.
    pub(crate) fn in_folder(self, out: PathBuf) -> Self {
        Self { out, ..self }
    }

    /// Newton iterations of the longest call of a field.
    pub(crate) fn longest_call(&self, field: &str) -> usize {
        self.longest_calls.get(field).copied().unwrap_or(0)
    }

    /// What the run wrote at its probes.
    pub(crate) fn probes(&self) -> Result<Csv, TaskError> {
        Csv::read(&self.out.join(output::PROBES))
    }

    /// An error unless all steps are done, and each of them converged.
    pub(crate) fn converged(&self, run: &Run<'_>) -> Result<(), TaskError> {
        if self.failure.is_none() && self.summary.converged {
            return Ok(());
        }
        let said = self.failure.as_deref().unwrap_or("a step ended on the iteration bound");
        Err(TaskError::Failed(format!("{}: {said}", run.name)))
    }
}

/// Wall-clock time that was spent solving, output left out \[s\].
pub(crate) fn solving(seconds: &Seconds) -> f64 {
    let Seconds { fluid, structure, mesh_motion, transfer, acceleration, output: _ } = seconds;
    fluid + structure + mesh_motion + transfer + acceleration
}

fn longest_calls(out: &Path) -> Result<BTreeMap<String, usize>, TaskError> {
    let path = out.join(output::RECORDS);
    longest_calls_in(&task::read(&path)?)
        .map_err(|error| TaskError::Failed(format!("{}: {error}", path.display())))
}

fn longest_calls_in(records: &str) -> Result<BTreeMap<String, usize>, serde_json::Error> {
    let mut longest = BTreeMap::new();
    for line in records.lines() {
        let Record::Iteration(iteration) = serde_json::from_str(line)? else { continue };
        for call in &iteration.fields {
            let most = longest.entry(call.name.clone()).or_insert(0);
            *most = call.newton.max(*most);
        }
    }
    Ok(longest)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_run_is_a_scene_and_keys() {
        let folder = tempfile::tempdir().expect("a folder");
        let run = Run::new("flag", "scenes/flag")
            .without_fields()
            .with(&["fluid.viscosity=2"])
            .ending(Stop::After(5));
        let out = folder.path().join("out");
        let words = |run: &Run<'_>| run.words(&out, 7).expect("words").join(" ");
        let shown = out.display();
        assert_eq!(
            words(&run),
            format!(
                "run scenes/flag --set output.fields_every=0 --set output.checkpoint_every=0 --set fluid.viscosity=2 --out \
                 {shown} --quiet --steps 5"
            )
        );
        task::write(&out.join(CHECKPOINTS[1]), "").expect("written");
        assert_eq!(words(&run.ending(Stop::AtTheEnd)), format!("resume {shown} --quiet"));
        let reached: &(dyn Fn(&Path) -> Result<bool, TaskError> + Sync) = &|_| Ok(true);
        let run = Run::new("flag", "scenes/flag").ending(Stop::When { every: 100, reached });
        assert_eq!(words(&run), format!("resume {shown} --quiet --steps 107"));
    }

    #[test]
    fn damaged_records_are_refused() {
        assert!(longest_calls_in("").expect("none").is_empty());
        assert!(longest_calls_in("{\"iteration\":{\"st").is_err());
    }
}
