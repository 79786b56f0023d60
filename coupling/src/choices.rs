//! What may be chosen for a coupled run: as settings, and as the objects that do it.

use serde::{Deserialize, Serialize};

use crate::accelerate::{Acceleration, Accelerator, QuasiNewton};
use crate::criterion::Criterion;
use crate::participant::NewtonLimit;
use crate::policy::Policy;
use crate::predict::Predictor;
use crate::setup::SetupError;

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

impl Default for CouplingSettings {
    /// IQN-IMVLS over the last five steps, every call to convergence, steps that end when every relative change is below 1e-5,
    /// a constant predictor, at most 100 iterations per step: the defaults of a scene, which has to name its acceleration.
    fn default() -> Self {
        Self {
            acceleration: Acceleration::IqnImvls(QuasiNewton::default()),
            policy: Policy::Fixed { first: NewtonLimit::ToConvergence, second: NewtonLimit::ToConvergence },
            criterion: Criterion::Changes { tolerance: 1e-5 },
            predictor: Predictor::Constant,
            max_iterations: 100,
            at_limit: AtLimit::Fail,
        }
    }
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
            is_custom: false,
            policy: self.policy,
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
    /// Whether the accelerator is none that settings can name, so that records have to.
    pub is_custom: bool,
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

impl Choices {
    /// The same choices with an accelerator of one's own; records name it.
    #[must_use]
    pub fn with_accelerator(self, accelerator: Box<dyn Accelerator>) -> Self {
        Self { accelerator, is_custom: true, ..self }
    }
}
