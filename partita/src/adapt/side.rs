//! One side of a coupled run: one of our solvers, somebody else's participant, or nothing.

use miette::Diagnostic;

use partita_coupling::{Block, Effort, NewtonLimit, Participant, ParticipantError, SetupError, Step};

use partita_fluid::FluidSolver;
use partita_numerics::field::{Field, StateMismatch};
use partita_structure::StructureSolver;

use super::{Adapter, backflow};

/// One side of the coupling.
///
/// A run of one field alone is a coupled run whose other side exchanges no data, costs nothing and is always converged;
/// so one time loop serves all runs.
pub enum Side<F> {
    /// A solver of Partita.
    Solver(Box<Adapter<F>>),
    /// Any other participant.
    Other(Box<dyn Participant + Send>),
    /// Nothing.
    Absent,
}

impl<F: Field> Side<F> {
    /// The solver, if this side has one of Partita's.
    #[must_use]
    pub fn field(&self) -> Option<&F> {
        match self {
            Self::Solver(adapter) => Some(adapter.field()),
            Self::Other(_) | Self::Absent => None,
        }
    }
}

impl From<FluidSolver<2>> for Side<FluidSolver<2>> {
    fn from(fluid: FluidSolver<2>) -> Self {
        Self::Solver(Box::new(Adapter::new(fluid, Vec::new(), Vec::new()).with_suspect(backflow)))
    }
}

impl From<StructureSolver<2>> for Side<StructureSolver<2>> {
    fn from(structure: StructureSolver<2>) -> Self {
        Self::Solver(Box::new(Adapter::new(structure, Vec::new(), Vec::new())))
    }
}

impl<F, P: Participant + Send + 'static> From<Box<P>> for Side<F> {
    fn from(participant: Box<P>) -> Self {
        Self::Other(participant)
    }
}

impl<F> Side<F>
where
    F: Field,
    F::Error: Diagnostic + From<StateMismatch> + Send + Sync + 'static,
{
    fn participant(&self) -> Option<&dyn Participant> {
        match self {
            Self::Solver(adapter) => Some(adapter.as_ref()),
            Self::Other(other) => Some(other.as_ref()),
            Self::Absent => None,
        }
    }

    fn participant_mut(&mut self) -> Option<&mut dyn Participant> {
        match self {
            Self::Solver(adapter) => Some(adapter.as_mut()),
            Self::Other(other) => Some(other.as_mut()),
            Self::Absent => None,
        }
    }
}

impl<F> Participant for Side<F>
where
    F: Field,
    F::Error: Diagnostic + From<StateMismatch> + Send + Sync + 'static,
{
    fn name(&self) -> &str {
        match self {
            Self::Other(other) => other.name(),
            Self::Solver(_) | Self::Absent => F::NAME,
        }
    }

    fn input(&self) -> &[Block] {
        self.participant().map_or(&[], Participant::input)
    }

    fn output(&self) -> &[Block] {
        self.participant().map_or(&[], Participant::output)
    }

    fn resolution(&self) -> f64 {
        self.participant().map_or(0.0, Participant::resolution)
    }

    fn begin_step(&mut self, step: &Step) -> Result<(), ParticipantError> {
        self.participant_mut().map_or(Ok(()), |participant| participant.begin_step(step))
    }

    fn advance(
        &mut self,
        input: &[f64],
        limit: NewtonLimit,
        output: &mut [f64],
    ) -> Result<Effort, ParticipantError> {
        match self.participant_mut() {
            Some(participant) => participant.advance(input, limit, output),
            None => Ok(Effort { entry_converged: true, converged: true, ..Effort::default() }),
        }
    }

    fn commit(&mut self) {
        if let Some(participant) = self.participant_mut() {
            participant.commit();
        }
    }

    fn rewind(&mut self) {
        if let Some(participant) = self.participant_mut() {
            participant.rewind();
        }
    }

    fn save(&self) -> Vec<u8> {
        self.participant().map_or_else(Vec::new, Participant::save)
    }

    fn restore(&mut self, bytes: &[u8]) -> Result<(), SetupError> {
        match self {
            Self::Solver(_) if bytes.is_empty() => {
                Err(SetupError::state(F::NAME, "it is empty: that run had none"))
            }
            Self::Solver(adapter) => adapter.restore(bytes),
            Self::Other(other) => other.restore(bytes),
            Self::Absent if bytes.is_empty() => Ok(()),
            Self::Absent => Err(SetupError::state(F::NAME, "this run has none")),
        }
    }
}
