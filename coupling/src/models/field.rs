//! What the models share: three owned things, one Newton loop, one participant.

use serde::Serialize;
use serde::de::DeserializeOwned;

use crate::participant::ParticipantError;
use crate::participant::{Change, Effort, NewtonLimit, Participant, Step};
use crate::port::Block;
use crate::setup::SetupError;
use crate::state;
use crate::vector::{norm, ratio, subtract};

/// A small field with a Newton method. `self` holds settings and workspace; the states are kept outside.
pub trait Field {
    /// The solution at one time, as plain data.
    type State: Clone + Serialize + DeserializeOwned;

    /// Name of the field.
    fn name(&self) -> &'static str;

    /// Prepares the step from `committed`.
    fn begin_step(&mut self, step: &Step, committed: &Self::State, trial: &mut Self::State);

    /// Puts the interface data into the trial state.
    ///
    /// # Errors
    /// A sentence with the place, when the data make no sense.
    fn impose(&mut self, input: &[f64], trial: &mut Self::State) -> Result<(), String>;

    /// Assembles the residual at the trial state and returns its norm, relative to its largest terms.
    fn residual(&mut self, committed: &Self::State, trial: &Self::State) -> f64;

    /// Solves with the tangent at the trial state and adds the increment.
    fn solve_and_update(&mut self, committed: &Self::State, trial: &mut Self::State);

    /// Reads the output off the trial state.
    fn output(&self, committed: &Self::State, trial: &Self::State, output: &mut [f64]);

    /// The parts of the solution whose changes are recorded.
    fn parts<'a>(&self, trial: &'a Self::State) -> Vec<(&'static str, &'a [f64])>;

    /// Completes the trial state before it becomes the committed one.
    fn finish_step(&mut self, committed: &Self::State, trial: &mut Self::State);
}

/// Newton iterations after which an unlimited call gives up.
const MAX_NEWTON: usize = 50;

/// A field as a participant.
#[derive(Debug, Clone)]
pub struct Model<F: Field> {
    field: F,
    committed: F::State,
    trial: F::State,
    input: [Block; 1],
    output: [Block; 1],
    /// Bound of the relative residual.
    bound: f64,
    /// Output of the last call or the last Newton iteration.
    last_output: Vec<f64>,
    /// The same at the end of the last accepted step.
    committed_output: Vec<f64>,
}

impl<F: Field> Model<F> {
    pub(super) fn new(field: F, start: F::State, input: Block, output: Block, bound: f64) -> Self {
        let last_output = vec![0.0; output.len()];
        let (input, output) = ([input], [output]);
        let committed_output = last_output.clone();
        Self {
            field,
            committed: start.clone(),
            trial: start,
            input,
            output,
            bound,
            last_output,
            committed_output,
        }
    }

    /// The solution of the last accepted step.
    #[must_use]
    pub fn state(&self) -> &F::State {
        &self.committed
    }

    fn error(&self, message: impl Into<String>) -> ParticipantError {
        ParticipantError::new(self.field.name(), message)
    }

    fn assemble(&mut self, effort: &mut Effort) -> Result<(), ParticipantError> {
        effort.assemblies += 1;
        effort.residual = self.field.residual(&self.committed, &self.trial);
        effort.converged = effort.residual < self.bound;
        if effort.residual.is_finite() {
            return Ok(());
        }
        Err(self
            .error(format!("the residual is {} after {} Newton iterations", effort.residual, effort.newton))
            .with_hint("the interface data are too wild; relax more"))
    }

    /// Whether one Newton iteration changed the output by less than `tolerance`.
    fn output_settled(&mut self, tolerance: f64, output: &mut [f64]) -> bool {
        self.field.output(&self.committed, &self.trial, output);
        let mut change = vec![0.0; output.len()];
        subtract(output, &self.last_output, &mut change);
        self.last_output.copy_from_slice(output);
        ratio(norm(&change), norm(output)) < tolerance
    }

    fn newton(&mut self, limit: NewtonLimit, output: &mut [f64]) -> Result<Effort, ParticipantError> {
        let mut effort = Effort::default();
        self.assemble(&mut effort)?;
        effort.entry_residual = effort.residual;
        effort.entry_converged = effort.converged;
        while !effort.converged {
            match limit {
                NewtonLimit::AtMost(most) if effort.newton >= most => break,
                NewtonLimit::ToConvergence if effort.newton >= MAX_NEWTON => {
                    let message =
                        format!("residual {:.3e} after {MAX_NEWTON} Newton iterations", effort.residual);
                    return Err(self.error(message).with_hint("the residual bound may be below round-off"));
                }
                _ => {}
            }
            self.field.solve_and_update(&self.committed, &mut self.trial);
            effort.newton += 1;
            effort.details.tangents += 1;
            effort.factorizations += 1;
            effort.solves += 1;
            self.assemble(&mut effort)?;
            if let NewtonLimit::UntilOutputSettles { tolerance } = limit
                && (self.output_settled(tolerance, output) || effort.newton >= MAX_NEWTON)
            {
                break;
            }
        }
        Ok(effort)
    }
}

impl<F: Field> Participant for Model<F> {
    fn name(&self) -> &str {
        self.field.name()
    }

    fn input(&self) -> &[Block] {
        &self.input
    }

    fn output(&self) -> &[Block] {
        &self.output
    }

    fn begin_step(&mut self, step: &Step) -> Result<(), ParticipantError> {
        self.field.begin_step(step, &self.committed, &mut self.trial);
        Ok(())
    }

    fn advance(
        &mut self,
        input: &[f64],
        limit: NewtonLimit,
        output: &mut [f64],
    ) -> Result<Effort, ParticipantError> {
        assert_eq!(input.len(), self.input[0].len(), "{}: input of wrong length", self.field.name());
        assert_eq!(output.len(), self.output[0].len(), "{}: output of wrong length", self.field.name());
        let entry = self.trial.clone();
        self.field.impose(input, &mut self.trial).map_err(|message| self.error(message))?;
        let mut effort = self.newton(limit, output)?;
        self.field.output(&self.committed, &self.trial, output);
        self.last_output.copy_from_slice(output);
        effort.changes = self
            .field
            .parts(&entry)
            .into_iter()
            .zip(self.field.parts(&self.trial))
            .map(|((part, before), (_, after))| Change::new(part, relative_change(before, after)))
            .collect();
        Ok(effort)
    }

    fn commit(&mut self) {
        self.field.finish_step(&self.committed, &mut self.trial);
        self.committed.clone_from(&self.trial);
        self.committed_output.copy_from_slice(&self.last_output);
    }

    fn rewind(&mut self) {
        self.trial.clone_from(&self.committed);
        self.last_output.copy_from_slice(&self.committed_output);
    }

    fn save(&self) -> Vec<u8> {
        state::encode(&(&self.committed, &self.committed_output))
    }

    fn restore(&mut self, bytes: &[u8]) -> Result<(), SetupError> {
        let (committed, last_output): (F::State, Vec<f64>) = state::decode(self.field.name(), bytes)?;
        let (saved, here) = (last_output.len(), self.last_output.len());
        if saved != here {
            return Err(SetupError::state(
                self.field.name(),
                format!("{saved} values at the interface, not {here}"),
            ));
        }
        self.trial.clone_from(&committed);
        self.committed = committed;
        self.committed_output.clone_from(&last_output);
        self.last_output = last_output;
        Ok(())
    }
}

/// `|after - before| / |after|`, 0/0 = 0.
fn relative_change(before: &[f64], after: &[f64]) -> f64 {
    let mut difference = vec![0.0; after.len()];
    subtract(after, before, &mut difference);
    ratio(norm(&difference), norm(after))
}
