//! What a run leaves: one file, `runs/<fingerprint>.json`.

use miette::Diagnostic;
use serde::{Deserialize, Serialize};

use crate::exact;

/// The result of a run that has ended, well or not.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct RunResult {
    /// Of the run, see [`crate::Run::fingerprint`].
    pub fingerprint: String,
    /// What was set, for a person who opens the file.
    pub run: String,
    /// Why it ended before its last step.
    pub failure: Option<Failure>,
    /// What it took.
    pub counts: Counts,
    /// Unknowns of the fluid and of the structure.
    pub unknowns: [usize; 2],
    /// Processor time of building and stepping \[s\]; only where the executor had nothing else to do meanwhile.
    pub cpu_seconds: Option<f64>,
    /// What was measured.
    pub measured: Measured,
}

/// Why a run ended early.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Failure {
    /// What kind of failure.
    pub kind: FailureKind,
    /// Where and what, in a line.
    pub what: String,
    /// What, in a line, without the step.
    pub cause: String,
    /// What to change.
    pub remedy: String,
    /// The step that failed, counted from 1.
    pub step: Option<usize>,
}

/// Kinds of failures.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum FailureKind {
    /// A step reached the iteration bound.
    IterationBound,
    /// The coupling iteration diverged.
    Diverged,
    /// A field could not be solved.
    FieldFailed,
    /// The Newton iterations that a run may take were used up.
    OutOfBudget,
    /// The scene cannot be built.
    Refused,
    /// An error of the program.
    Broken,
}

impl Failure {
    /// A failure before the first step.
    pub(crate) fn at_start(kind: FailureKind, what: &str, remedy: &str) -> Self {
        let first_line = what.lines().next().unwrap_or_default().to_owned();
        Self { kind, what: first_line, cause: one_line(what), remedy: one_line(remedy), step: None }
    }
}

/// Text on one line.
pub(crate) fn one_line(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// What to change, on one line.
pub(crate) fn remedy(error: &dyn Diagnostic) -> String {
    error.help().map(|help| one_line(&help.to_string())).unwrap_or_default()
}

/// Counts of a run.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
pub struct Counts {
    /// Finished steps.
    pub steps: usize,
    /// Those among them that ended on the iteration bound and were accepted.
    pub unconverged_steps: usize,
    /// Steps that failed and were repeated in halves.
    pub retries: usize,
    /// Coupling iterations of the finished steps.
    pub coupling_iterations: usize,
    /// Newton iterations of the fluid in them.
    pub newton_fluid: usize,
    /// Newton iterations of the structure in them.
    pub newton_structure: usize,
    /// Newton iterations of all fields, those of failed steps among them.
    pub newton: usize,
}

/// What is measured, by the kind of the sweep.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Measured {
    /// Of a study: a probed column.
    History(Series),
    /// Of a map.
    Health(Health),
}

/// Values of a column at the ends of the steps.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct Series {
    /// Times \[s\].
    pub times: Vec<f64>,
    /// Values then.
    #[serde(with = "exact::list")]
    pub values: Vec<f64>,
}

/// How the steps of a cell went.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct Health {
    /// Iterations of each finished step: of the coupling, or of Newton's method where there is but one field.
    pub iterations: Vec<usize>,
    /// Kinetic and strain energy of all fields after each of them \[J, in 2D J/m\].
    #[serde(with = "exact::list")]
    pub energies: Vec<f64>,
    /// The first step that was accepted at the iteration bound, and its residual \[m\].
    pub unconverged: Option<(usize, f64)>,
    /// Smallest shape quality of the fluid's moved mesh over all steps, in (0, 1].
    #[serde(with = "exact::option")]
    pub mesh_quality: Option<f64>,
    /// Node-to-node oscillation of the fluid's pressure at the end.
    #[serde(with = "exact::option")]
    pub pressure_oscillation: Option<f64>,
    /// Largest displacement of the structure at the end \[m\].
    #[serde(with = "exact::option")]
    pub structure_displacement: Option<f64>,
}
