//! One step after the other. The caller owns the time loop: signals, retries, checkpoints, output.

use serde::{Deserialize, Serialize};

use crate::accelerate::{Accelerator, DroppedColumn};
use crate::choices::{Choices, CouplingSettings};
use crate::clock::Clock;
use crate::dirichlet_neumann::{Interface, solve_step};
use crate::error::{StepError, StepFailure};
use crate::observe::Observer;
use crate::participant::{Participant, Step};
use crate::predict::{Past, Predictor};
use crate::record::{StepHistory, StepRecord};
use crate::setup::SetupError;
use crate::state::Saved;
use crate::transfer::{Transfer, Transfers};

/// Everything that a coupled run remembers between two steps.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct MarchState {
    /// The clock.
    pub clock: Clock,
    /// Accepted interface displacements.
    pub past: Past,
    /// What the accelerator saves.
    pub accelerator: Saved,
    /// What the first and the second participant save.
    pub participants: [Saved; 2],
}

/// A coupled run: two participants, their transfers and the choices.
pub struct March<A, B> {
    first: A,
    second: B,
    transfers: Transfers,
    choices: Choices,
    clock: Clock,
    past: Past,
    interface: Interface,
    history: StepHistory,
    /// Work at the interface over the last accepted step.
    work: f64,
}

impl<A: Participant, B: Participant> March<A, B> {
    /// A run that starts at `time` \[s\] with zero interface displacement.
    ///
    /// `first` takes displacements and returns loads, `second` takes loads and returns displacements;
    /// `transfers` holds one operator a block, in the order of the blocks.
    ///
    /// # Errors
    /// When blocks and transfers do not fit, or a setting is out of its range.
    pub fn new(
        first: A,
        second: B,
        transfers: Vec<Box<dyn Transfer>>,
        settings: &CouplingSettings,
        time: f64,
    ) -> Result<Self, SetupError> {
        let choices = settings.build(crate::port::total_len(second.output()))?;
        Self::with_choices(first, second, transfers, choices, time)
    }

    /// Like [`new`](Self::new), with choices of one's own making.
    ///
    /// # Errors
    /// When blocks and transfers do not fit.
    pub fn with_choices(
        first: A,
        second: B,
        transfers: Vec<Box<dyn Transfer>>,
        choices: Choices,
        time: f64,
    ) -> Result<Self, SetupError> {
        if first.name() == second.name() {
            return Err(SetupError::SameName { name: first.name().to_owned() });
        }
        let transfers = Transfers::between(&first, &second, transfers)?;
        let interface = Interface::new(&first, &second);
        let past = Past::new(time, interface.x.clone());
        let history = StepHistory::new(Step { index: 0, time, dt: 0.0 });
        Ok(Self {
            first,
            second,
            transfers,
            choices,
            clock: Clock::new(time),
            past,
            interface,
            history,
            work: 0.0,
        })
    }

    /// Replaces the interface displacement \[m\] the run starts from.
    ///
    /// # Panics
    /// When steps were made already, or the length is not that of the interface.
    #[must_use]
    pub fn starting_from(mut self, displacement: &[f64]) -> Self {
        assert_eq!(self.clock.steps, 0, "the run has started already");
        assert_eq!(displacement.len(), self.interface.x.len(), "initial displacement of wrong length");
        self.past = Past::new(self.clock.time, displacement.to_vec());
        self
    }

    /// Makes one step of size `dt` \[s\] and commits it.
    ///
    /// # Errors
    /// When the step cannot be finished. Both participants and all choices are then back where the step
    /// began, and a step of another size can be tried.
    ///
    /// # Panics
    /// When `dt` is not positive.
    pub fn step(&mut self, dt: f64, observer: &mut dyn Observer) -> Result<StepRecord, StepError> {
        assert!(dt > 0.0 && dt.is_finite(), "step size {dt} s is not positive");
        let clock = self.clock.after(dt);
        self.history = StepHistory::new(Step { index: clock.steps, time: clock.time, dt });
        match self.attempt(observer) {
            Ok(converged) => {
                let dropped = self.accept(clock);
                let record = StepRecord::new(&self.history, converged, &dropped);
                observer.step_finished(&record);
                Ok(record)
            }
            Err((iteration, cause)) => {
                self.give_up();
                let step = self.history.step;
                let (cause, history) = (Box::new(cause), Box::new(self.history.clone()));
                Err(StepError { step, iteration, coupled: self.is_coupled(), cause, history })
            }
        }
    }

    /// Opens the step and iterates; an error comes with the number of the iteration, 0 while opening.
    fn attempt(&mut self, observer: &mut dyn Observer) -> Result<bool, (usize, StepFailure)> {
        let step = self.history.step;
        self.first.begin_step(&step).map_err(|error| (0, error.into()))?;
        self.second.begin_step(&step).map_err(|error| (0, error.into()))?;
        self.choices.predictor.predict(&self.past, step.time, &mut self.interface.x);
        solve_step(
            &mut self.first,
            &mut self.second,
            &self.transfers,
            &mut self.choices,
            &mut self.interface,
            &mut self.history,
            observer,
        )
        .map_err(|failure| (self.failed_iteration(&failure), self.with_predictor(failure)))
    }

    /// Says so where the first call of a step that is not the run's first failed on what a constant predictor gave it: it
    /// stops the interface at the start of the step, and the flow that is stopped loads the structure with `rho v / dt`.
    fn with_predictor(&self, failure: StepFailure) -> StepFailure {
        let stopped = self.choices.predictor == Predictor::Constant && self.clock.steps > 0;
        match failure {
            StepFailure::Participant(error) if stopped && self.is_coupled() && self.history.iterations.is_empty() => {
                error.and_hint("a constant `predictor` stops the interface at the start of each step: a linear one starts closer").into()
            }
            other => other,
        }
    }

    fn failed_iteration(&self, failure: &StepFailure) -> usize {
        let finished = self.history.iterations.len();
        match failure {
            StepFailure::TooManyIterations { .. } | StepFailure::Diverges { field: None, .. } => finished,
            StepFailure::Participant(_)
            | StepFailure::NotFinite { .. }
            | StepFailure::Diverges { field: Some(_), .. } => finished + 1,
        }
    }

    /// Whether displacements come back to the first participant, so that there is something to iterate on.
    fn is_coupled(&self) -> bool {
        !self.interface.x.is_empty()
    }

    /// Commits the step; returns the columns that its last iteration made the accelerator drop.
    fn accept(&mut self, clock: Clock) -> Vec<DroppedColumn> {
        self.first.commit();
        self.second.commit();
        let last = self.history.last().expect("a finished step has at least one iteration");
        let answer = last.answer();
        let dropped = self.choices.accelerator.step_converged(&self.interface.x, &self.interface.r, answer);
        self.work = self.interface.work_since(&self.past.newest().displacement);
        self.past.push(clock.time, &self.interface.x_tilde);
        self.clock = clock;
        dropped
    }

    fn give_up(&mut self) {
        self.first.rewind();
        self.second.rewind();
        self.choices.accelerator.step_failed();
    }

    /// All state between two steps.
    #[must_use]
    pub fn state(&self) -> MarchState {
        let accelerator = &self.choices.accelerator;
        MarchState {
            clock: self.clock,
            past: self.past.clone(),
            accelerator: Saved::new(accelerator.name(), accelerator.save()),
            participants: [
                Saved::new(self.first.name(), self.first.save()),
                Saved::new(self.second.name(), self.second.save()),
            ],
        }
    }

    /// Continues from a saved state, bit for bit.
    ///
    /// # Errors
    /// If the state belongs to other choices, other participants or another interface. The run is of no use then.
    pub fn restore(&mut self, state: &MarchState) -> Result<(), SetupError> {
        let accelerator = &mut self.choices.accelerator;
        let learned = state.accelerator.bytes_of(accelerator.name())?;
        let [first, second] = &state.participants;
        let [first, second] = [first.bytes_of(self.first.name())?, second.bytes_of(self.second.name())?];
        let (saved, here) = (state.past.newest().displacement.len(), self.interface.x.len());
        if saved != here {
            return Err(SetupError::state("interface", format!("{saved} unknowns, not {here}")));
        }
        accelerator.restore(learned)?;
        self.first.restore(first)?;
        self.second.restore(second)?;
        self.past.clone_from(&state.past);
        self.clock = state.clock;
        self.work = 0.0;
        Ok(())
    }

    /// The first participant.
    #[must_use]
    pub fn first(&self) -> &A {
        &self.first
    }

    /// The second participant.
    #[must_use]
    pub fn second(&self) -> &B {
        &self.second
    }

    /// Exchanges the accelerator for one of the caller's own, which records name.
    ///
    /// # Panics
    /// If steps were made already.
    pub fn set_accelerator(&mut self, accelerator: Box<dyn Accelerator>) {
        assert_eq!(self.clock.steps, 0, "the run has started already");
        (self.choices.accelerator, self.choices.is_custom) = (accelerator, true);
    }

    /// The accelerator.
    #[must_use]
    pub fn accelerator(&self) -> &dyn Accelerator {
        self.choices.accelerator.as_ref()
    }

    /// Exchanges all choices.
    ///
    /// # Panics
    /// If steps were made already.
    pub fn set_choices(&mut self, choices: Choices) {
        assert_eq!(self.clock.steps, 0, "the run has started already");
        self.choices = choices;
    }

    /// Exchanges the transfers.
    ///
    /// # Errors
    /// If they do not fit the blocks.
    pub fn set_transfers(&mut self, transfers: Vec<Box<dyn Transfer>>) -> Result<(), SetupError> {
        self.transfers = Transfers::between(&self.first, &self.second, transfers)?;
        Ok(())
    }

    /// Both participants, to change them between steps.
    pub fn participants_mut(&mut self) -> (&mut A, &mut B) {
        (&mut self.first, &mut self.second)
    }

    /// The time and number of the accepted steps.
    #[must_use]
    pub fn clock(&self) -> Clock {
        self.clock
    }

    /// The vectors at the interface after the last iteration.
    #[must_use]
    pub fn interface(&self) -> &Interface {
        &self.interface
    }

    /// Work of the first participant's load on the second one over the last accepted step \[J, in 2D J/m\]:
    ///
    /// ```text
    /// F_{n+1} . (x_tilde_{n+1} - x_tilde_n)
    /// ```
    ///
    /// It is what a first participant gives that moves its boundary by backward Euler. A second one that balances
    /// the load at `n+1-alpha_f` gets `alpha_f (F_{n+1} - F_n) . (x_tilde_{n+1} - x_tilde_n)` less. Zero before the
    /// first step, and after [`restore`](Self::restore) until the next one.
    #[must_use]
    pub fn interface_work(&self) -> f64 {
        self.work
    }

    /// The iterations of the last step, finished or failed.
    #[must_use]
    pub fn history(&self) -> &StepHistory {
        &self.history
    }
}
