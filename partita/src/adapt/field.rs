//! The primitives that the adapter composes, under one name for both fields.

use partita_coupling::WorkDetails;
use partita_numerics::newton::{self, KeptTangent, Problem};
use partita_numerics::phases::PhaseSeconds;
use serde::Serialize;
use serde::de::DeserializeOwned;

/// A known cause of failures, to be named beside the error.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Suspect {
    /// What is so, and what to do about it.
    pub advice: String,
    /// Whether it comes before the advice of the error itself.
    pub comes_first: bool,
}

/// A field solver as the adapter sees it: imposed interface data in, one Newton iteration at a time, interface
/// output out. The solvers themselves know neither this trait nor the coupling.
pub trait Field: Problem {
    /// What the field remembers between steps, as plain data.
    type State: Clone + Serialize + DeserializeOwned;

    /// Name in records and messages.
    const NAME: &'static str;

    /// Starts the step that ends at `time` \[s\] with size `dt` \[s\] from the committed state.
    ///
    /// # Errors
    /// When the field cannot start a step of this size.
    fn begin_step(&mut self, time: f64, dt: f64) -> Result<(), Self::Error>;

    /// Imposes interface data on the trial state; the iterate is otherwise kept.
    ///
    /// # Errors
    /// When the data leads to an impossible state, such as an inverted element of the fluid mesh.
    fn impose(&mut self, input: &[f64]) -> Result<(), Self::Error>;

    /// Whether a converged iterate is a state that can be.
    ///
    /// # Errors
    /// When it is not, such as matter turned inside out.
    fn verify(&mut self) -> Result<(), Self::Error>;

    /// The equation that misses its balance most after the last assembly, in words.
    fn worst_equation(&self) -> Option<String>;

    /// What in the committed state is known to end runs, whatever the error of the step says.
    fn suspect(&self) -> Option<Suspect>;

    /// Interface output of the last assembled iterate.
    fn output(&self, output: &mut [f64]);

    /// The trial state becomes the committed one.
    fn commit(&mut self);

    /// The trial state is given up.
    fn rewind(&mut self);

    /// The committed state.
    fn state(&self) -> Self::State;

    /// Continues from a saved state, bit for bit.
    ///
    /// # Errors
    /// When the state belongs to another discretization.
    fn restore(&mut self, state: &Self::State) -> Result<(), Self::Error>;

    /// Most entries of a tangent that a checkpoint will hold.
    fn most_kept(&self) -> usize;

    /// The tangent whose factor the next step may use.
    fn kept_tangent(&self) -> Option<KeptTangent>;

    /// Factors such a tangent; comes after [`restore`](Self::restore).
    ///
    /// # Errors
    /// When it belongs to another discretization, or cannot be factored.
    fn restore_tangent(&mut self, kept: &KeptTangent) -> Result<(), Self::Error>;

    /// The current iterate, all dofs.
    fn values(&self) -> &[f64];

    /// Number of parts whose change is judged separately.
    fn part_count(&self) -> usize;

    /// Name and free dofs of a part.
    fn part(&self, index: usize) -> (&'static str, &[usize]);

    /// Norm of a change of a part that is round-off of the field's natural scale: of lengths for a displacement, of lengths over
    /// the time step for a velocity beside a moving interface.
    fn resolution(&self, part: usize) -> f64;

    /// The same of the interface output of the last assembled iterate.
    fn output_resolution(&self) -> f64;

    /// Settings of the Newton loop.
    fn newton(&self) -> &newton::Settings;

    /// Work since the solver was built that a Newton loop does not count; `tangents` stays zero.
    fn work(&self) -> WorkDetails;

    /// Seconds spent in each phase since the solver was built.
    fn phases(&self) -> PhaseSeconds;
}
