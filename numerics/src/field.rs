//! What every field of a coupled problem can do, whatever its equations are.
//!
//! A field solver implements [`Field`] on top of [`Problem`]. Whoever drives it, a coupled run or a test, needs no other
//! words:
//!
//! ```text
//! begin_step(t, dt)                      the trial state starts from the committed one
//!   impose(input)                        interface data of t, as often as they change
//!   advance(limit)                       Newton iterations from the latest iterate
//!   output(..)                           interface data of the latest iterate
//! commit()  or  rewind()                 the trial state becomes the committed one, or is given up
//! ```

mod mismatch;
mod residual;
#[cfg(test)]
mod tests;

use serde::Serialize;
use serde::de::DeserializeOwned;

use crate::newton::{
    self, Coefficients, FactorLog, Failure, Limit, Problem, Report, ReusableTangent, Verdict,
};
use crate::{Pattern, PhaseSeconds};

pub use mismatch::StateMismatch;
pub use residual::LargestResidual;

/// Unknowns whose change is judged on its own.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Part {
    /// Its name: `velocity`, say.
    pub name: &'static str,
    /// Its free dofs in [`Field::values`].
    pub dofs: Vec<usize>,
}

/// Work that no Newton loop counts, since the solver was built.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct FieldWork {
    /// Factorizations that had to be repeated by a slower or more robust method.
    pub fallbacks: usize,
    /// Factorizations of the equations that move the mesh.
    pub mesh_factorizations: usize,
    /// Solutions of them.
    pub mesh_solves: usize,
}

/// A field that is solved step after step, by Newton's method, under data at its interface.
///
/// Committed state, trial state and workspace are apart: [`rewind`](Self::rewind) may come at any time after
/// [`begin_step`](Self::begin_step), also after an error, and leaves nothing of the step behind.
pub trait Field: Problem {
    /// What the field remembers between steps, as plain data.
    type State: Clone + Serialize + DeserializeOwned;

    /// Its name in records and messages.
    const NAME: &'static str;

    /// Starts the step of size `dt` \[s\] that ends at `time` \[s\] from the committed state, with the prescribed values and
    /// loads of `time`, and the interface data that were committed.
    ///
    /// # Errors
    /// When the step's size is not positive and finite, or the prescribed data of `time` lead to no possible state.
    fn begin_step(&mut self, time: f64, dt: f64) -> Result<(), Self::Error>;

    /// Imposes interface data of `time` on the trial state; the iterate is otherwise kept.
    ///
    /// # Errors
    /// When the data lead to an impossible state, such as an inverted element of a mesh.
    ///
    /// # Panics
    /// When `input` has the wrong length, or outside a step.
    fn impose(&mut self, input: &[f64]) -> Result<(), Self::Error>;

    /// Interface output of the last assembled iterate.
    ///
    /// # Panics
    /// When `output` has the wrong length.
    fn output(&self, output: &mut [f64]);

    /// Whether a converged iterate is a state that can be.
    ///
    /// # Errors
    /// When it is not, such as matter turned inside out.
    fn verify(&mut self) -> Result<(), Self::Error> {
        Ok(())
    }

    /// Accepts the step: the trial state becomes the committed one.
    ///
    /// # Panics
    /// Outside a step.
    fn commit(&mut self);

    /// Gives the step up: back to the committed state, without a factor.
    fn rewind(&mut self);

    /// The committed state.
    fn state(&self) -> &Self::State;

    /// Continues from a saved state, bit for bit; no factor is left.
    ///
    /// # Errors
    /// When the state belongs to another discretization.
    fn restore(&mut self, state: &Self::State) -> Result<(), Self::Error>;

    /// The latest iterate, all dofs.
    fn values(&self) -> &[f64];

    /// The parts of [`values`](Self::values) whose change is judged.
    fn parts(&self) -> &[Part];

    /// How many unknowns are solved for.
    fn unknowns(&self) -> usize {
        self.parts().iter().map(|part| part.dofs.len()).sum()
    }

    /// Norm of a change of a part that is round-off of the field's natural scale.
    fn resolution(&self, part: usize) -> f64;

    /// The same of the interface output of the last assembled iterate; 0 where no change of it is judged.
    fn output_resolution(&self) -> f64 {
        0.0
    }

    /// The free equation that misses its balance most after the last assembly; one that is not finite is the worst.
    fn largest_residual(&self) -> Option<LargestResidual>;

    /// When the Newton loop ends.
    fn newton_settings(&self) -> &newton::Settings;

    /// Seconds spent in each phase since the solver was built.
    fn phases(&self) -> PhaseSeconds;

    /// Work since the solver was built that a Newton loop does not count.
    fn work(&self) -> FieldWork;

    /// Whether the equations are linear: then the tangent depends on the [coefficients](Self::coefficients) alone, and on what
    /// [outdates](FactorLog::outdate) its factor.
    fn is_linear(&self) -> bool;

    /// Whether the factor of a step may serve in the next one.
    fn keeps_factor(&self) -> bool;

    /// What the tangent has from the time scheme.
    fn coefficients(&self) -> Coefficients;

    /// What the field remembers of its last factor.
    fn factor_log(&self) -> &FactorLog;

    /// Pattern and values of the tangent of the last assembly that asked for it, over the free equations.
    fn tangent(&self) -> (&Pattern, &[f64]);

    /// Takes these values for those of the tangent, factors them and notes that they belong to `coefficients`.
    ///
    /// # Errors
    /// When they cannot be factored.
    ///
    /// # Panics
    /// When there is not one value for each entry of the pattern.
    fn factor_tangent(&mut self, values: &[f64], coefficients: Coefficients) -> Result<(), Self::Error>;

    /// The tangent whose factor the next step may use: what a checkpoint holds beside [`state`](Self::state).
    fn reusable_tangent(&self) -> Option<ReusableTangent> {
        self.keeps_factor().then(|| self.factor_log().tangent(self.tangent().1)).flatten()
    }

    /// Factors a tangent that was kept, so that a run goes on from a checkpoint with the same bits. Comes after
    /// [`restore`](Self::restore), which leaves no factor.
    ///
    /// # Errors
    /// When the tangent belongs to another discretization, or cannot be factored.
    fn restore_tangent(&mut self, tangent: &ReusableTangent) -> Result<(), Self::Error>
    where
        Self::Error: From<StateMismatch>,
    {
        let (found, expected) = (tangent.values.len(), self.tangent().1.len());
        StateMismatch::check("entries of the kept tangent", found, expected)?;
        self.factor_tangent(&tangent.values, tangent.coefficients)
    }

    /// Newton iterations from the latest iterate under the data imposed last.
    ///
    /// # Errors
    /// See [`newton::solve`].
    fn advance(&mut self, limit: Limit) -> Result<Report, Failure<Self::Error>>
    where
        Self: Sized,
    {
        let settings = *self.newton_settings();
        newton::solve(self, &settings, limit, |_, _| Verdict::Continue)
    }

    /// One whole step of the field alone, of size `dt` \[s\] to `time` \[s\]: Newton iterations to convergence, then
    /// [`verify`](Self::verify) and [`commit`](Self::commit). A step that fails is given up.
    ///
    /// # Errors
    /// When the step cannot begin, Newton's method fails, or the solution is no possible state.
    fn step_alone(&mut self, time: f64, dt: f64) -> Result<Report, Failure<Self::Error>>
    where
        Self: Sized,
    {
        let at = |iteration| move |source| Failure::Problem { iteration, source };
        let report = self.begin_step(time, dt).map_err(at(0)).and_then(|()| {
            let report = self.advance(Limit::ToConvergence)?;
            self.verify().map(|()| report).map_err(at(report.iterations))
        });
        match report {
            Ok(_) => self.commit(),
            Err(_) => self.rewind(),
        }
        report
    }
}
