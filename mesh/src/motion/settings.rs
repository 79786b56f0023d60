//! What kind of body the mesh is taken for.

use serde::{Deserialize, Serialize};

use super::MotionError;

/// How the nodes inside follow those on the boundary.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct MotionSettings {
    /// The body the mesh is taken for.
    pub law: MotionLaw,
    /// The configuration the motion starts from.
    pub mode: MotionMode,
}

/// The body the mesh is taken for; small cells are made stiffer by `(J_0 / J)^stiffening`, where `J` is a
/// cell's measure and `J_0` the mean one.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum MotionLaw {
    /// Linear elasticity (plane strain in 2D).
    Elastic {
        /// Poisson's ratio of the mesh, in (-1, 0.5).
        #[serde(default = "poisson_ratio")]
        poisson_ratio: f64,
        /// Exponent `chi` of the stiffening, 0 for none, about 1 to 2.
        #[serde(default = "stiffening")]
        stiffening: f64,
    },
    /// Each component of the displacement is harmonic.
    Harmonic {
        /// Exponent `chi` of the stiffening, 0 for none, about 1 to 2.
        #[serde(default = "stiffening")]
        stiffening: f64,
    },
}

impl Default for MotionLaw {
    fn default() -> Self {
        Self::Elastic { poisson_ratio: poisson_ratio(), stiffening: stiffening() }
    }
}

/// The configuration from which a step's motion is computed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum MotionMode {
    /// From the reference mesh: the matrix is constant and factored once a run. A mesh whose boundary
    /// returns to its place returns as well.
    #[default]
    Reference,
    /// From the committed mesh: assembled and factored again every step. Survives larger motions.
    Incremental,
}

const fn poisson_ratio() -> f64 {
    0.3
}

const fn stiffening() -> f64 {
    1.0
}

impl MotionLaw {
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
