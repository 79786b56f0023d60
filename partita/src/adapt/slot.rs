//! A place for a field that a scene may leave out.

use std::error::Error;

use miette::Diagnostic;
use partita_coupling::{Block, Effort, NewtonLimit, Participant, ParticipantError, Step};

use partita_numerics::field::{Field, StateMismatch};

use super::{Adapter, AdapterState};

/// What a [`Slot`] remembers between steps.
pub type SlotState<S> = Option<AdapterState<S>>;

/// A saved state that does not belong to this run.
#[derive(Debug, thiserror::Error)]
pub enum Misfit<E: Error> {
    /// The field refuses it.
    #[error(transparent)]
    Field(E),
    /// It lacks a field that the run has.
    #[error("it holds no {field}")]
    Missing {
        /// The field.
        field: &'static str,
    },
    /// It has a field that the run lacks.
    #[error("it holds a {field}, the scene has none")]
    Unknown {
        /// The field.
        field: &'static str,
    },
}

/// One side of the coupling: a field, or nothing.
///
/// A scene with one field alone is a coupled run whose other side exchanges no data, costs nothing and is always
/// converged; so one time loop serves all scenes.
pub struct Slot<F>(Option<Adapter<F>>);

impl<F> Slot<F> {
    /// A side with a field, or without.
    #[must_use]
    pub fn new(adapter: Option<Adapter<F>>) -> Self {
        Self(adapter)
    }
}

impl<F: Field> Slot<F> {
    /// The field solver, where there is one.
    #[must_use]
    pub fn field(&self) -> Option<&F> {
        self.0.as_ref().map(Adapter::field)
    }

    /// What must be saved to continue.
    #[must_use]
    pub fn state(&self) -> SlotState<F::State> {
        self.0.as_ref().map(Adapter::state)
    }

    /// Continues from a saved state, bit for bit.
    ///
    /// # Errors
    /// When the state belongs to another discretization, or to a scene with another set of fields.
    pub fn restore(&mut self, state: &SlotState<F::State>) -> Result<(), Misfit<F::Error>>
    where
        F::Error: Error + From<StateMismatch>,
    {
        match (&mut self.0, state) {
            (Some(adapter), Some(state)) => adapter.restore(state).map_err(Misfit::Field),
            (None, None) => Ok(()),
            (Some(_), None) => Err(Misfit::Missing { field: F::NAME }),
            (None, Some(_)) => Err(Misfit::Unknown { field: F::NAME }),
        }
    }
}

impl<F> Participant for Slot<F>
where
    F: Field,
    F::Error: Diagnostic + Send + Sync + 'static,
{
    fn name(&self) -> &str {
        F::NAME
    }

    fn input(&self) -> &[Block] {
        self.0.as_ref().map_or(&[], Participant::input)
    }

    fn output(&self) -> &[Block] {
        self.0.as_ref().map_or(&[], Participant::output)
    }

    fn resolution(&self) -> f64 {
        self.0.as_ref().map_or(0.0, Participant::resolution)
    }

    fn begin_step(&mut self, step: &Step) -> Result<(), ParticipantError> {
        self.0.as_mut().map_or(Ok(()), |adapter| adapter.begin_step(step))
    }

    fn advance(
        &mut self,
        input: &[f64],
        limit: NewtonLimit,
        output: &mut [f64],
    ) -> Result<Effort, ParticipantError> {
        match &mut self.0 {
            Some(adapter) => adapter.advance(input, limit, output),
            None => Ok(Effort { entry_converged: true, converged: true, ..Effort::default() }),
        }
    }

    fn commit(&mut self) {
        if let Some(adapter) = &mut self.0 {
            adapter.commit();
        }
    }

    fn rewind(&mut self) {
        if let Some(adapter) = &mut self.0 {
            adapter.rewind();
        }
    }
}
