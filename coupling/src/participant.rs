//! One field of the coupled problem.

use std::borrow::Cow;
use std::ops::{AddAssign, Sub};

use serde::{Deserialize, Serialize};

use crate::port::Block;
use crate::setup::SetupError;

mod error;

pub use error::ParticipantError;

/// The time step from `t_n` to `t_{n+1}`.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Step {
    /// Number of the step, counted from 1.
    pub index: usize,
    /// The time at its end, `t_{n+1}` \[s\].
    pub time: f64,
    /// Its size \[s\].
    pub dt: f64,
}

/// How far the Newton loop of one call may go.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum NewtonLimit {
    /// At most this many Newton iterations; reaching the limit is no error.
    AtMost(usize),
    /// Until the field's own residual bound is met.
    ToConvergence,
    /// Until one Newton iteration changes the field's output by less than `tolerance`, relative to the
    /// output, or the residual bound is met. Before the first iteration counts the previous call's output.
    UntilOutputSettles {
        /// Bound of the relative change.
        tolerance: f64,
    },
}

/// Seconds that one call spent in its phases.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct PhaseTimes {
    /// Residual and tangent \[s\].
    pub assembly: f64,
    /// Numeric factorization \[s\].
    pub factorization: f64,
    /// Triangular solves \[s\].
    pub solve: f64,
    /// Mesh motion \[s\].
    pub mesh_motion: f64,
}

impl AddAssign for PhaseTimes {
    fn add_assign(&mut self, other: Self) {
        self.assembly += other.assembly;
        self.factorization += other.factorization;
        self.solve += other.solve;
        self.mesh_motion += other.mesh_motion;
    }
}

/// What stands behind the counts of assemblies and factorizations of one field, and what they leave out.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct WorkDetails {
    /// Assemblies that evaluated the tangent, too.
    pub tangents: usize,
    /// Factorizations whose factor turned out bad, so that a slower method had to factor the matrix again.
    pub fallbacks: usize,
    /// Factorizations for the motion of the mesh; one that serves the whole run is made before its first step and not
    /// counted.
    pub mesh_factorizations: usize,
    /// Linear solves for the motion of the mesh.
    pub mesh_solves: usize,
}

impl AddAssign for WorkDetails {
    fn add_assign(&mut self, other: Self) {
        self.tangents += other.tangents;
        self.fallbacks += other.fallbacks;
        self.mesh_factorizations += other.mesh_factorizations;
        self.mesh_solves += other.mesh_solves;
    }
}

/// Relative change of one part of a field's solution within one call.
///
/// `|s_exit - s_entry| / |s_exit|` over the free dofs of the part, 0/0 = 0, and 0 where the difference is round-off of the
/// field's natural scale: of a part that is at rest nothing but round-off changes. Entry is the exit of the last
/// call, at the first iteration of a step the solution the step starts from.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Change {
    /// Name of the part: `velocity`, `pressure`, `displacement`.
    pub part: Cow<'static, str>,
    /// The relative change.
    #[serde(with = "crate::record::finite_or_null")]
    pub value: f64,
}

impl Change {
    /// The change of the part named `part`.
    #[must_use]
    pub fn new(part: impl Into<Cow<'static, str>>, value: f64) -> Self {
        Self { part: part.into(), value }
    }
}

impl Sub for WorkDetails {
    type Output = Self;

    /// The work between two readings of counters.
    fn sub(self, before: Self) -> Self {
        Self {
            tangents: self.tangents - before.tangents,
            fallbacks: self.fallbacks - before.fallbacks,
            mesh_factorizations: self.mesh_factorizations - before.mesh_factorizations,
            mesh_solves: self.mesh_solves - before.mesh_solves,
        }
    }
}

/// What one call cost and reached.
#[expect(clippy::struct_excessive_bools, reason = "independent facts, each with its own name in records")]
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Effort {
    /// Newton iterations.
    pub newton: usize,
    /// Assemblies of the residual, with or without tangent.
    pub assemblies: usize,
    /// Numeric factorizations.
    pub factorizations: usize,
    /// Linear solves.
    pub solves: usize,
    /// Residual after the new input is imposed, before any iteration; relative or absolute as the field's
    /// bound says.
    pub entry_residual: f64,
    /// Residual at the last iterate, measured like `entry_residual`.
    pub residual: f64,
    /// Whether `entry_residual` met the field's bound, or was round-off.
    pub entry_converged: bool,
    /// Whether the field is below its own bound, as the field judges it.
    pub converged: bool,
    /// Whether it is so because its residual is round-off: above the bound, but as small as the arithmetic can make it.
    pub at_round_off: bool,
    /// Whether no iteration was made although a good part of the load, more than round-off or a tight bound explains, was
    /// not balanced.
    pub idle_under_load: bool,
    /// Relative change of every part of the solution.
    pub changes: Vec<Change>,
    /// Where the time went.
    pub time: PhaseTimes,
    /// More of its work.
    pub details: WorkDetails,
}

/// One field of the coupled problem: input at the interface in, output at the interface out.
///
/// [`begin_step`](Self::begin_step) opens a step, any number of [`advance`](Self::advance) calls work on it, and either
/// [`commit`](Self::commit) accepts it or [`rewind`](Self::rewind) gives it up. `rewind` may come at any time after
/// `begin_step`, also after an `Err`.
pub trait Participant {
    /// Name of the field, as records and messages use it.
    fn name(&self) -> &str;

    /// What the input of [`advance`](Self::advance) means.
    fn input(&self) -> &[Block];

    /// What the output of [`advance`](Self::advance) means.
    fn output(&self) -> &[Block];

    /// Norm below which a difference of two outputs is round-off of the field's natural scale, whatever their own size: a
    /// displacement of less than the last bit of the coordinates, a load of less than that of the pressure.
    fn resolution(&self) -> f64 {
        0.0
    }

    /// Opens the step: the solution starts from the committed one.
    ///
    /// # Errors
    /// When the field cannot start the step, for instance a boundary value that is no number.
    fn begin_step(&mut self, step: &Step) -> Result<(), ParticipantError>;

    /// Continues the Newton loop of this step from the latest iterate, under new interface data, within `limit`.
    ///
    /// The residual is evaluated anew under `input`; nothing is carried over from the last call but the
    /// iterate. Without a limit, outputs after different call histories agree to the solver's tolerance.
    ///
    /// # Errors
    /// When the field cannot be solved: divergence, an inverted element, a singular matrix.
    ///
    /// # Panics
    /// When a slice does not have the length its blocks say.
    fn advance(
        &mut self,
        input: &[f64],
        limit: NewtonLimit,
        output: &mut [f64],
    ) -> Result<Effort, ParticipantError>;

    /// Accepts the step: the trial state becomes the committed one.
    fn commit(&mut self);

    /// Gives the step up: back to the committed state.
    fn rewind(&mut self);

    /// The committed state and whatever else the next step depends on, in bytes that nobody else reads:
    /// [`state::encode`](crate::state::encode) makes them of plain data. Nothing unless the participant says otherwise.
    fn save(&self) -> Vec<u8> {
        Vec::new()
    }

    /// Continues from the bytes of [`save`](Self::save), bit for bit. A participant that saves nothing accepts nothing else.
    ///
    /// # Errors
    /// If the bytes belong to another participant or to another discretization.
    fn restore(&mut self, bytes: &[u8]) -> Result<(), SetupError> {
        crate::state::expect_none(self.name(), bytes)
    }
}

impl<P: Participant + ?Sized> Participant for Box<P> {
    fn name(&self) -> &str {
        (**self).name()
    }
    fn input(&self) -> &[Block] {
        (**self).input()
    }
    fn output(&self) -> &[Block] {
        (**self).output()
    }
    fn resolution(&self) -> f64 {
        (**self).resolution()
    }
    fn begin_step(&mut self, step: &Step) -> Result<(), ParticipantError> {
        (**self).begin_step(step)
    }
    fn advance(
        &mut self,
        input: &[f64],
        limit: NewtonLimit,
        output: &mut [f64],
    ) -> Result<Effort, ParticipantError> {
        (**self).advance(input, limit, output)
    }
    fn commit(&mut self) {
        (**self).commit();
    }
    fn rewind(&mut self) {
        (**self).rewind();
    }
    fn save(&self) -> Vec<u8> {
        (**self).save()
    }
    fn restore(&mut self, bytes: &[u8]) -> Result<(), SetupError> {
        (**self).restore(bytes)
    }
}
