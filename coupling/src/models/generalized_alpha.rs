//! Generalized-alpha in time (Chung and Hulbert 1993), for the walls of the models.

use serde::{Deserialize, Serialize};

use crate::setup::SetupError;

/// The parameters by spectral radius `r`:
/// `alpha_m = (2r - 1)/(r + 1)`, `alpha_f = r/(r + 1)`, `gamma = 1/2 - alpha_m + alpha_f`,
/// `beta = (1 - alpha_m + alpha_f)^2 / 4`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct GeneralizedAlpha {
    pub(super) alpha_m: f64,
    pub(super) alpha_f: f64,
    gamma: f64,
    beta: f64,
}

impl GeneralizedAlpha {
    pub(super) fn new(spectral_radius: f64) -> Result<Self, SetupError> {
        if !(0.0..=1.0).contains(&spectral_radius) {
            return Err(SetupError::setting("spectral_radius", spectral_radius, "take a number from 0 to 1"));
        }
        let alpha_m = (2.0 * spectral_radius - 1.0) / (spectral_radius + 1.0);
        let alpha_f = spectral_radius / (spectral_radius + 1.0);
        let gamma = 0.5 - alpha_m + alpha_f;
        let beta = (1.0 - alpha_m + alpha_f).powi(2) / 4.0;
        Ok(Self { alpha_m, alpha_f, gamma, beta })
    }

    /// `d a_{n+1-alpha_m} / d d_{n+1} = (1 - alpha_m) / (beta dt^2)` \[1/s²\].
    pub(super) fn mass_factor(&self, dt: f64) -> f64 {
        (1.0 - self.alpha_m) / (self.beta * dt * dt)
    }

    /// `a_{n+1}` of one dof from its new displacement (Newmark).
    pub(super) fn acceleration(&self, dt: f64, new: f64, old: Dof) -> f64 {
        (new - old.displacement - dt * old.velocity) / (self.beta * dt * dt)
            - (0.5 / self.beta - 1.0) * old.acceleration
    }

    /// `v_{n+1}` of one dof from its new acceleration (Newmark).
    pub(super) fn velocity(&self, dt: f64, new_acceleration: f64, old: Dof) -> f64 {
        old.velocity + dt * ((1.0 - self.gamma) * old.acceleration + self.gamma * new_acceleration)
    }
}

/// Motion of one dof at one time.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct Dof {
    /// Displacement \[m\].
    pub displacement: f64,
    /// Velocity \[m/s\].
    pub velocity: f64,
    /// Acceleration \[m/s²\].
    pub acceleration: f64,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn radius_one_is_the_midpoint_rule_and_constant_acceleration_is_exact() {
        let scheme = GeneralizedAlpha::new(1.0).unwrap();
        assert!((scheme.alpha_m - 0.5).abs() < 1e-15 && (scheme.alpha_f - 0.5).abs() < 1e-15);
        for radius in [0.0, 0.5, 1.0] {
            let scheme = GeneralizedAlpha::new(radius).unwrap();
            let old = Dof { displacement: 1.0, velocity: 2.0, acceleration: 3.0 };
            let acceleration = scheme.acceleration(0.1, 1.0 + 0.2 + 0.015, old);
            assert!((acceleration - 3.0).abs() < 1e-12);
            assert!((scheme.velocity(0.1, acceleration, old) - 2.3).abs() < 1e-12);
        }
    }
}
