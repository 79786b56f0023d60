//! The factor that outlives the iterate it was made at.

use partita_numerics::newton::{Coefficients, KeptFactor, KeptTangent};

use crate::error::StructureError;
use crate::solver::StructureSolver;

impl<const D: usize> StructureSolver<D> {
    /// Whether the equations are linear: their tangent then depends on the size of the step alone.
    #[must_use]
    pub fn is_linear(&self) -> bool {
        self.model.material.is_linear()
    }

    /// What the last factor is worth now.
    pub(crate) fn worth_of_factor(&self) -> KeptFactor {
        self.factor_log.worth(&self.coefficients(), self.is_linear())
    }

    /// Whether the factor of a step may serve in the next one.
    #[must_use]
    pub fn keeps_factor(&self) -> bool {
        self.is_linear() || self.settings.newton.reuse_factor.is_some()
    }

    /// The tangent whose factor the next step may use: what a checkpoint holds beside [`state`](Self::state).
    #[must_use]
    pub fn kept_tangent(&self) -> Option<KeptTangent> {
        self.keeps_factor().then(|| self.factor_log.tangent(&self.work.tangent)).flatten()
    }

    /// Factors a tangent that was kept, so that a run goes on from a checkpoint with the same bits. Comes after
    /// [`restore`](Self::restore), which leaves no factor.
    ///
    /// # Errors
    /// When the tangent belongs to another structure or cannot be factored.
    pub fn restore_tangent(&mut self, kept: &KeptTangent) -> Result<(), StructureError> {
        let (found, expected) = (kept.values.len(), self.work.tangent.len());
        if found != expected {
            let quantity = "the kept tangent";
            return Err(StructureError::StateOfAnotherStructure { quantity, found, expected });
        }
        self.work.tangent.copy_from_slice(&kept.values);
        self.factor.refactor(self.assembly.pattern(), &self.work.tangent)?;
        self.factor_log.factored(kept.coefficients);
        Ok(())
    }

    /// What the tangent has from the time scheme.
    pub(crate) fn coefficients(&self) -> Coefficients {
        let weights = self.step().tangent_weights();
        [weights.mass, weights.damping, weights.stiffness]
    }
}
