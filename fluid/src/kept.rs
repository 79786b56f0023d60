//! The factor that outlives the iterate it was made at.

use partita_numerics::newton::{Coefficients, KeptFactor, KeptTangent};

use crate::error::FluidError;
use crate::solver::FluidSolver;

impl<const D: usize> FluidSolver<D> {
    /// Whether the equations are linear: their tangent then depends on the mesh and the size of the step alone.
    #[must_use]
    pub fn is_linear(&self) -> bool {
        !self.settings.convection
    }

    /// What the last factor is worth now.
    pub(crate) fn worth_of_factor(&self) -> KeptFactor {
        self.factor_log.worth(&self.coefficients(), self.is_linear())
    }

    /// Whether the factor of a step may serve in the next one.
    #[must_use]
    pub fn keeps_factor(&self) -> bool {
        self.settings.newton.reuse_factor.is_some() || (self.is_linear() && self.mesh_is_fixed)
    }

    /// The tangent whose factor the next step may use: what a checkpoint holds beside [`state`](Self::state).
    #[must_use]
    pub fn kept_tangent(&self) -> Option<KeptTangent> {
        self.keeps_factor().then(|| self.factor_log.tangent(&self.assembly.tangent)).flatten()
    }

    /// Factors a tangent that was kept, so that a run goes on from a checkpoint with the same bits. Comes after
    /// [`restore`](Self::restore), which leaves no factor.
    ///
    /// # Errors
    ///
    /// If the tangent belongs to another mesh or cannot be factored.
    pub fn restore_tangent(&mut self, kept: &KeptTangent) -> Result<(), FluidError> {
        let (found, expected) = (kept.values.len(), self.assembly.tangent.len());
        if found != expected {
            return Err(FluidError::StateMismatch { what: "entries of the kept tangent", found, expected });
        }
        self.assembly.tangent.copy_from_slice(&kept.values);
        let time = self.committed.time;
        self.factor
            .refactor(&self.assembly.tangent)
            .map_err(|source| FluidError::Factorization { time, source })?;
        self.factor_log.factored(kept.coefficients);
        Ok(())
    }

    /// What the tangent has from the time scheme.
    pub(crate) fn coefficients(&self) -> Coefficients {
        [self.trial.flow.rate, self.trial.flow.four_over_dt_squared, 0.0]
    }
}
