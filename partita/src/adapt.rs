//! From a field solver to a participant of the coupling.
//!
//! The fields do not know the coupling and the coupling does not know the fields; [`Adapter`] stands between them. It
//! composes one call from the primitives of a [`Field`] and the one Newton loop, and measures what the call changed and
//! what it cost. It holds no numerics of its own.

mod backflow;
mod side;
mod suspect;

use miette::Diagnostic;
use partita_coupling::port::total_len;
use partita_coupling::{
    Block, Change, Effort, NewtonLimit, Participant, ParticipantError, PhaseTimes, SetupError, Step,
    WorkDetails, state,
};
use partita_numerics::field::{Field, FieldWork, Part, StateMismatch};
use partita_numerics::newton::{self, Bound, Failure, Limit, Report, ResidualNorm, ReusableTangent, Verdict};
use partita_numerics::norms::{norm2, relative, relative_change};
use partita_numerics::phases::PhaseSeconds;
use serde::{Deserialize, Serialize};

pub(crate) use backflow::suspect as backflow;
pub use side::Side;
pub use suspect::Suspect;

/// A field as a participant of the coupling.
pub struct Adapter<F> {
    field: F,
    input: Vec<Block>,
    output: Vec<Block>,
    /// The iterate at the exit of the last call, or the start of the step.
    entry: Vec<f64>,
    /// The interface output of the last call, for calls that run until it settles.
    last_output: Vec<f64>,
    /// The field's work that records have told of already. What a step does before its first call belongs to that call.
    told: FieldWork,
    /// What in the committed state is known to end runs, whatever the error of a step says.
    suspect: fn(&F) -> Option<Suspect>,
}

/// What an adapter and its field remember between steps.
#[derive(Serialize, Deserialize)]
struct AdapterState<S> {
    /// The field's own state.
    field: S,
    /// The interface output of the last call.
    last_output: Vec<f64>,
    /// The tangent whose factor the next step may use.
    tangent: Option<ReusableTangent>,
}

impl<F: Field> Adapter<F> {
    /// A participant of `field` whose interface vectors are made of these blocks.
    #[must_use]
    pub fn new(field: F, input: Vec<Block>, output: Vec<Block>) -> Self {
        let entry = field.values().to_vec();
        let last_output = vec![0.0; total_len(&output)];
        let told = field.work();
        Self { field, input, output, entry, last_output, told, suspect: |_| None }
    }

    /// Lets errors name a known cause of failures that `suspect` finds in the committed state.
    #[must_use]
    pub fn with_suspect(self, suspect: fn(&F) -> Option<Suspect>) -> Self {
        Self { suspect, ..self }
    }

    /// The field solver.
    #[must_use]
    pub fn field(&self) -> &F {
        &self.field
    }

    /// Makes the interface vectors of other blocks.
    pub(crate) fn set_blocks(&mut self, input: Vec<Block>, output: Vec<Block>) {
        self.last_output = vec![0.0; total_len(&output)];
        (self.input, self.output) = (input, output);
    }

    fn changes(&self) -> Vec<Change> {
        let change = |(index, part): (usize, &Part)| {
            let resolution = self.field.resolution(index);
            Change::new(part.name, relative_change(&self.entry, self.field.values(), &part.dofs, resolution))
        };
        self.field.parts().iter().enumerate().map(change).collect()
    }
}

impl<F> Participant for Adapter<F>
where
    F: Field,
    F::Error: Diagnostic + From<StateMismatch> + Send + Sync + 'static,
{
    fn name(&self) -> &str {
        F::NAME
    }

    fn input(&self) -> &[Block] {
        &self.input
    }

    fn output(&self) -> &[Block] {
        &self.output
    }

    fn resolution(&self) -> f64 {
        self.field.output_resolution()
    }

    fn begin_step(&mut self, step: &Step) -> Result<(), ParticipantError> {
        self.field.begin_step(step.time, step.dt).map_err(|error| field_error::<F>(&error))?;
        self.entry.copy_from_slice(self.field.values());
        Ok(())
    }

    fn advance(
        &mut self,
        input: &[f64],
        limit: NewtonLimit,
        output: &mut [f64],
    ) -> Result<Effort, ParticipantError> {
        let before = self.field.phases();
        // Without data the step is as `begin_step` left it.
        if !self.input.is_empty() {
            self.field.impose(input).map_err(|error| field_error::<F>(&error))?;
        }
        let (limit, settles) = loop_limit(limit);
        let settings = *self.field.newton_settings();
        let last_output = &mut self.last_output;
        let report = newton::solve(&mut self.field, &settings, limit, |field, _| {
            let Some(tolerance) = settles else { return Verdict::Continue };
            field.output(output);
            let change = output_change(last_output, output);
            last_output.copy_from_slice(output);
            if change < tolerance { Verdict::Stop } else { Verdict::Continue }
        })
        .map_err(|failure| newton_error(&self.field, &failure, (self.suspect)(&self.field)))?;
        if report.converged {
            self.field.verify().map_err(|error| field_error::<F>(&error))?;
        }
        if !self.output.is_empty() {
            self.field.output(output);
            self.last_output.copy_from_slice(output);
        }
        let changes = self.changes();
        self.entry.copy_from_slice(self.field.values());
        let mut effort = effort(&report, settings.bound, changes, self.field.phases() - before);
        let work = self.field.work();
        effort.details += details(work, std::mem::replace(&mut self.told, work));
        Ok(effort)
    }

    fn commit(&mut self) {
        self.field.commit();
    }

    fn rewind(&mut self) {
        self.field.rewind();
        self.entry.copy_from_slice(self.field.values());
    }

    fn save(&self) -> Vec<u8> {
        state::encode(&AdapterState {
            field: self.field.state().clone(),
            last_output: self.last_output.clone(),
            tangent: self.field.reusable_tangent(),
        })
    }

    fn restore(&mut self, bytes: &[u8]) -> Result<(), SetupError> {
        let saved: AdapterState<F::State> = state::decode(F::NAME, bytes)?;
        let (there, here) = (saved.last_output.len(), self.last_output.len());
        if there != here {
            return Err(SetupError::state(F::NAME, format!("{there} values at the interface, not {here}")));
        }
        let misfit = |error: F::Error| SetupError::state(F::NAME, error.to_string());
        self.field.restore(&saved.field).map_err(misfit)?;
        if let Some(tangent) = &saved.tangent {
            self.field.restore_tangent(tangent).map_err(misfit)?;
        }
        self.last_output = saved.last_output;
        self.told = self.field.work();
        Ok(())
    }
}

/// `|now - last| / |now|`, 0/0 = 0.
fn output_change(last: &[f64], now: &[f64]) -> f64 {
    let squares = last.iter().zip(now).map(|(last, now)| (now - last) * (now - last));
    relative(squares.sum::<f64>().sqrt(), norm2(now))
}

/// The limit of the Newton loop, and the tolerance of the output where the output decides.
fn loop_limit(limit: NewtonLimit) -> (Limit, Option<f64>) {
    match limit {
        NewtonLimit::AtMost(iterations) => (Limit::AtMost(iterations), None),
        NewtonLimit::ToConvergence => (Limit::ToConvergence, None),
        NewtonLimit::UntilOutputSettles { tolerance } => (Limit::ToConvergence, Some(tolerance)),
    }
}

/// A residual above this part of the largest term of its equations is a load that nothing balances.
const BALANCED: f64 = 1e-3;

fn effort(report: &Report, bound: Bound, changes: Vec<Change>, phases: PhaseSeconds) -> Effort {
    let measured = |norm: &ResidualNorm| match bound {
        Bound::Relative(_) => norm.relative,
        Bound::Absolute(_) => norm.absolute,
    };
    Effort {
        newton: report.iterations,
        assemblies: report.assemblies,
        factorizations: report.factorizations,
        solves: report.solves,
        entry_residual: measured(&report.entry),
        residual: measured(&report.exit),
        entry_converged: report.entry_converged,
        converged: report.converged,
        at_round_off: report.at_round_off,
        idle_under_load: report.iterations == 0 && !report.at_round_off && report.entry.relative > BALANCED,
        changes,
        time: PhaseTimes {
            assembly: phases.assembly,
            factorization: phases.factorization,
            solve: phases.solve,
            mesh_motion: phases.motion,
        },
        details: WorkDetails { tangents: report.tangents, ..WorkDetails::default() },
    }
}

/// What a field did between two readings of its work.
fn details(now: FieldWork, then: FieldWork) -> WorkDetails {
    WorkDetails {
        fallbacks: now.fallbacks - then.fallbacks,
        mesh_factorizations: now.mesh_factorizations - then.mesh_factorizations,
        mesh_solves: now.mesh_solves - then.mesh_solves,
        ..WorkDetails::default()
    }
}

/// The field's error in its own words.
fn field_error<F: Field>(error: &F::Error) -> ParticipantError
where
    F::Error: Diagnostic,
{
    participant_error(F::NAME, error)
}

/// A failed Newton loop: where the field itself failed inside, its words follow; otherwise the place of the largest
/// residual.
fn newton_error<F: Field>(
    field: &F,
    failure: &Failure<F::Error>,
    suspect: Option<Suspect>,
) -> ParticipantError
where
    F::Error: Diagnostic + 'static,
{
    let mut error = match failure {
        Failure::Problem { iteration, source } => {
            let mut error = field_error::<F>(source);
            error.message = format!("Newton iteration {iteration}: {}", error.message);
            return with_suspect(error, suspect);
        }
        other => participant_error(F::NAME, other),
    };
    if let Some(largest) = field.largest_residual() {
        error.message = format!("{}; it is largest for {largest}", error.message);
    }
    if let Some(hint) = key_of(F::NAME, failure) {
        error.hint = Some(hint);
    }
    with_suspect(error, suspect)
}

/// The advice of a failed loop with the keys of the scene, where there are some to turn.
fn key_of<E>(field: &str, failure: &Failure<E>) -> Option<String> {
    match failure {
        Failure::TooManyIterations { .. } => Some(format!(
            "a residual that still falls needs a larger `{field}.newton.max_iterations`, one that does not a smaller time step"
        )),
        Failure::Stagnated { .. } => Some(format!(
            "look for a nearly singular state (buckling, a piece that is hardly held); where such a residual is good enough, \
             raise `{field}.newton.tolerance`"
        )),
        Failure::Problem { .. } | Failure::NotFinite { .. } | Failure::Diverged { .. } => None,
    }
}

/// Names a known cause of failures beside the advice of the error itself.
fn with_suspect(mut error: ParticipantError, suspect: Option<Suspect>) -> ParticipantError {
    if let Some(Suspect { advice, comes_first }) = suspect {
        error.hint = Some(match error.hint {
            None => advice,
            Some(hint) if comes_first => format!("{advice}; otherwise {hint}"),
            Some(hint) => format!("{hint}; {advice}"),
        });
    }
    error
}

/// Messages of the fields may begin with their name, perhaps after the time; the coupling says where and when.
fn participant_error(field: &str, error: &dyn Diagnostic) -> ParticipantError {
    let message = error.to_string();
    let message = match message.split_once(&format!("{field}: ")) {
        Some((before, rest)) if before.is_empty() || before.starts_with("t = ") => rest,
        _ => &message,
    };
    let hint = error.help().map(|help| help.to_string());
    ParticipantError { hint, ..ParticipantError::new(field, message) }
}
