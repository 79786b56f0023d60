//! One step after the other. The caller owns the time loop: signals, retries, checkpoints, output.

use serde::{Deserialize, Serialize};

use crate::accelerate::{Acceleration, Accelerator, AcceleratorState, DroppedColumn};
use crate::criterion::Criterion;
use crate::dirichlet_neumann::{Interface, solve_step};
use crate::error::{SetupError, StepError, StepFailure};
use crate::observe::Observer;
use crate::participant::{Participant, Step};
use crate::policy::{NewtonPolicy, Policy, PolicyState};
use crate::predict::{Past, Predictor};
use crate::record::{StepHistory, StepRecord};
use crate::transfer::{Transfer, Transfers};

/// What happens when a step reaches the iteration bound.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum AtLimit {
    /// The step fails, with its history.
    #[default]
    Fail,
    /// The step is accepted; its record says `converged: false`.
    Accept,
}

/// The choices of a coupled run, as a scene names them.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct CouplingSettings {
    /// From one iterate to the next.
    pub acceleration: Acceleration,
    /// Newton limits of the calls.
    pub policy: Policy,
    /// When a step is done.
    pub criterion: Criterion,
    /// Where a step starts.
    pub predictor: Predictor,
    /// Bound of the coupling iterations of one step.
    pub max_iterations: usize,
    /// What happens at the bound.
    pub at_limit: AtLimit,
}

impl CouplingSettings {
    /// Checks the settings and makes the objects they name, for an interface of `size` unknowns.
    ///
    /// # Errors
    /// When a setting is out of its range.
    pub fn build(&self, size: usize) -> Result<Choices, SetupError> {
        self.policy.validate()?;
        self.criterion.validate()?;
        if self.max_iterations == 0 {
            return Err(SetupError::setting("max_iterations", 0, "allow at least one coupling iteration"));
        }
        Ok(Choices {
            accelerator: self.acceleration.build(size)?,
            policy: Box::new(self.policy),
            criterion: self.criterion.clone(),
            predictor: self.predictor,
            max_iterations: self.max_iterations,
            at_limit: self.at_limit,
        })
    }
}

/// The choices of a coupled run, ready to work. Each can be exchanged without the others noticing.
pub struct Choices {
    /// From one iterate to the next.
    pub accelerator: Box<dyn Accelerator>,
    /// Newton limits of the calls.
    pub policy: Box<dyn NewtonPolicy>,
    /// When a step is done.
    pub criterion: Criterion,
    /// Where a step starts.
    pub predictor: Predictor,
    /// Bound of the coupling iterations of one step.
    pub max_iterations: usize,
    /// What happens at the bound.
    pub at_limit: AtLimit,
}

/// Which step comes next, and when.
///
/// While the size of the steps stays the same, times are `start + n dt` and gather no round-off.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Clock {
    /// Accepted steps.
    pub steps: usize,
    /// Time reached \[s\].
    pub time: f64,
    /// Size of the last steps \[s\]; 0 before the first.
    pub dt: f64,
    /// Where the row of equal steps began \[s\].
    pub since: f64,
    /// Accepted steps of that row.
    pub row: usize,
}

impl Clock {
    /// A clock that starts at `time` \[s\].
    #[must_use]
    pub fn new(time: f64) -> Self {
        Self { steps: 0, time, dt: 0.0, since: time, row: 0 }
    }

    /// The clock after one more step of size `dt` \[s\].
    #[must_use]
    pub fn after(self, dt: f64) -> Self {
        let same = dt.to_bits() == self.dt.to_bits();
        let (since, row) = if same { (self.since, self.row + 1) } else { (self.time, 1) };
        Self { steps: self.steps + 1, time: since + row as f64 * dt, dt, since, row }
    }
}

/// All coupling state between two steps; the participants' own states are not part of it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct MarchState {
    /// The clock.
    pub clock: Clock,
    /// Accepted interface displacements.
    pub past: Past,
    /// The accelerator's state.
    pub accelerator: AcceleratorState,
    /// The policy's state.
    pub policy: PolicyState,
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
        .map_err(|failure| (self.failed_iteration(&failure), failure))
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

    /// All coupling state, to be saved beside the participants' own.
    #[must_use]
    pub fn state(&self) -> MarchState {
        MarchState {
            clock: self.clock,
            past: self.past.clone(),
            accelerator: self.choices.accelerator.state(),
            policy: self.choices.policy.state(),
        }
    }

    /// Continues from a saved state, bit for bit.
    ///
    /// # Errors
    /// When the state belongs to other choices or another interface.
    pub fn restore(&mut self, state: &MarchState) -> Result<(), SetupError> {
        let (saved, here) = (state.past.newest().displacement.len(), self.interface.x.len());
        if saved != here {
            return Err(SetupError::state("interface", format!("{saved} unknowns, not {here}")));
        }
        self.choices.accelerator.restore(&state.accelerator)?;
        self.choices.policy.restore(&state.policy)?;
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

    /// Both participants, to restore their states or to change them between steps.
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
