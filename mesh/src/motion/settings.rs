//! What kind of body the mesh is taken for.

use super::MotionError;

/// How the nodes inside follow those on the boundary.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct MotionSettings {
    /// The body the mesh is taken for.
    pub law: MotionLaw,
    /// The configuration the motion starts from.
    pub mode: MotionMode,
}

/// The body the mesh is taken for; small cells are made stiffer by `(J_0 / J)^stiffening`, where `J` is a
/// cell's measure and `J_0` the mean one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum MotionLaw {
    /// Linear elasticity (plane strain in 2D).
    Elastic {
        /// Poisson's ratio of the mesh, in (-1, 0.5).
        poisson_ratio: f64,
        /// Exponent `chi` of the stiffening, 0 for none, about 1 to 2.
        stiffening: f64,
    },
    /// Each component of the displacement is harmonic.
    Harmonic {
        /// Exponent `chi` of the stiffening, 0 for none, about 1 to 2.
        stiffening: f64,
    },
}

impl Default for MotionLaw {
    fn default() -> Self {
        Self::Elastic { poisson_ratio: Self::DEFAULT_POISSON_RATIO, stiffening: Self::DEFAULT_STIFFENING }
    }
}

/// The configuration from which a step's motion is computed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum MotionMode {
    /// From the reference mesh: the matrix is constant and factored once a run. A mesh whose boundary
    /// returns to its place returns as well.
    #[default]
    Reference,
    /// From the committed mesh: assembled and factored again every step. Survives larger motions.
    Incremental,
}

impl MotionLaw {
    /// Poisson's ratio of the mesh where none is given.
    pub const DEFAULT_POISSON_RATIO: f64 = 0.3;
    /// Exponent of the stiffening where none is given.
    pub const DEFAULT_STIFFENING: f64 = 1.0;

    /// The exponent `chi` of `(J_0 / J)^chi`.
    #[must_use]
    pub const fn stiffening(&self) -> f64 {
        match *self {
            Self::Elastic { stiffening, .. } | Self::Harmonic { stiffening } => stiffening,
        }
    }
}

impl MotionSettings {
    pub(super) fn check(&self) -> Result<(), MotionError> {
        let stiffening = self.law.stiffening();
        if !(stiffening.is_finite() && stiffening >= 0.0) {
            return Err(MotionError::Stiffening { value: stiffening });
        }
        match self.law {
            MotionLaw::Elastic { poisson_ratio, .. } if !(poisson_ratio > -1.0 && poisson_ratio < 0.5) => {
                Err(MotionError::PoissonRatio { value: poisson_ratio })
            }
            _ => Ok(()),
        }
    }
}
