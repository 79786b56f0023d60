//! Dirichlet-Neumann coupling of black-box participants.
//!
//! This crate couples two fields that exchange data at an interface. It knows no mesh, no fluid and no
//! structure: it sees vectors, and things that can be advanced.
//!
//! * [`participant`] and [`port`]: what a field has to offer, and what its vectors mean.
//! * [`transfer`]: from the points of one field to the points of the other, and back by the transpose.
//! * [`accelerate`]: relaxation and interface quasi-Newton methods.
//! * [`policy`]: how many Newton iterations each call may run. [`criterion`]: when a step is done.
//! * [`predict`]: where a step starts.
//! * [`dirichlet_neumann`]: one time step, the one loop of this crate. [`divergence`]: when it has gone astray.
//!   [`march`]: step after step.
//! * [`record`] and [`observe`]: what a run leaves behind. [`state`]: what it must remember.
//! * [`conformance`]: checks for everybody who implements a trait of this crate.
//! * [`models`]: an elastic tube and a linear tank, small enough to debug a method in milliseconds.
//!
//! The interface unknown is `x`, the output of the second participant (displacement). One coupling
//! iteration is one call of both participants; its residual is `r = x_tilde - x`.
//!
//! ```
//! use partita_coupling::models::tube::Tube;
//! use partita_coupling::{Acceleration, CouplingSettings, IdentityTransfer, March};
//!
//! let acceleration = Acceleration::Aitken { omega_0: 0.05 };
//! let settings = CouplingSettings { acceleration, ..CouplingSettings::default() };
//! let tube = Tube::default();
//! let (flow, wall) = tube.participants()?;
//! let transfer = IdentityTransfer::new(tube.cells);
//! let mut march = March::new(flow, wall, vec![Box::new(transfer)], &settings, 0.0)?;
//! for _ in 0..5 {
//!     let record = march.step(1e-3, &mut ())?;
//!     println!("t = {} s: {} coupling iterations", record.time, record.iterations);
//! }
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

pub mod accelerate;
pub mod choices;
pub mod clock;
pub mod conformance;
pub mod criterion;
pub mod dirichlet_neumann;
pub mod divergence;
pub mod error;
pub mod march;
pub mod models;
pub mod observe;
pub mod participant;
pub mod policy;
pub mod port;
pub mod predict;
pub mod record;
pub mod retry;
pub mod setup;
pub mod state;
pub mod transfer;
mod vector;

pub use accelerate::{Acceleration, Accelerator, Answer, DroppedColumn, Filter, Proposal, QuasiNewton};
pub use choices::{AtLimit, Choices, CouplingSettings};
pub use clock::Clock;
pub use criterion::{Bound, Criterion};
pub use divergence::Growth;
pub use error::{StepError, StepFailure};
pub use march::{March, MarchState};
pub use observe::Observer;
pub use participant::{
    Change, Effort, NewtonLimit, Participant, ParticipantError, PhaseTimes, Step, WorkDetails,
};
pub use policy::{Limits, Policy};
pub use port::{Block, Quantity};
pub use predict::Predictor;
pub use record::{FieldRecord, IterationRecord, Record, RetryRecord, StepHistory, StepRecord};
pub use retry::StepSizes;
pub use setup::SetupError;
pub use state::Saved;
pub use transfer::{IdentityTransfer, MatrixTransfer, Transfer};
