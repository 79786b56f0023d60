//! One time step: how velocity and acceleration follow from the unknown displacement.

use partita_numerics::time::GeneralizedAlpha;

use crate::error::StructureError;
use crate::state::StructureState;

/// How the structure goes from `t_n` to `t_{n+1}`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum TimeScheme {
    /// Chung and Hulbert (1993), with the unknown d_{n+1}:
    ///
    /// ```text
    /// M a_{n+1-alpha_m} + C v_{n+1-alpha_f} + f_int(d_{n+1-alpha_f}) = f_ext_{n+1-alpha_f}
    /// ```
    ///
    /// Of second order, also where the step size changes now and then (a step that is retried, say). The vector `a_n`
    /// is the acceleration of `t_n + (alpha_m - alpha_f) dt`: a size that changes at *every* step leaves first order,
    /// except at radius 1.
    GeneralizedAlpha {
        /// Spectral radius at infinite frequency, in [0, 1]: 1 keeps all energy, 0 removes it within a step.
        spectral_radius: f64,
    },
    /// Newmark (1959), with the unknown d_{n+1}: generalized-alpha with `alpha_m = alpha_f = 0`, so that
    ///
    /// ```text
    /// M a_{n+1} + C v_{n+1} + f_int(d_{n+1}) = f_ext_{n+1}
    /// ```
    ///
    /// Of second order for gamma = 1/2, where a linear vibration keeps its energy, else of first order; every size of
    /// step is stable. `a_n` belongs to `t_n`, so that step sizes may change at will. See
    /// [`GeneralizedAlpha::newmark`].
    Newmark {
        /// Weight of the new acceleration in the displacement, at least gamma/2: 1/4 is the average acceleration.
        beta: f64,
        /// Weight of the new acceleration in the velocity, at least 1/2, which is the average acceleration.
        gamma: f64,
    },
    /// No inertia: `C (d_{n+1} - d_n)/dt + f_int(d_{n+1}) = f_ext_{n+1}`.
    QuasiStatic,
}

impl Default for TimeScheme {
    /// Generalized-alpha with [`DEFAULT_SPECTRAL_RADIUS`](Self::DEFAULT_SPECTRAL_RADIUS).
    fn default() -> Self {
        Self::GeneralizedAlpha { spectral_radius: Self::DEFAULT_SPECTRAL_RADIUS }
    }
}

/// A scheme with its coefficients.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Scheme {
    /// Newmark's methods among them.
    GeneralizedAlpha(GeneralizedAlpha),
    QuasiStatic,
}

impl TimeScheme {
    /// The spectral radius of generalized-alpha where none is given.
    ///
    /// At 1 nothing damps the shortest waves of the mesh, and the force between fluid and structure swings from step to
    /// step after every jolt; `docs/damping.md` compares radii by that and by their errors.
    pub const DEFAULT_SPECTRAL_RADIUS: f64 = 0.5;

    /// Newmark with `beta = 1/4, gamma = 1/2`.
    pub const AVERAGE_ACCELERATION: Self = Self::Newmark {
        beta: GeneralizedAlpha::AVERAGE_ACCELERATION.beta,
        gamma: GeneralizedAlpha::AVERAGE_ACCELERATION.gamma,
    };

    pub(crate) fn coefficients(self) -> Result<Scheme, StructureError> {
        Ok(match self {
            Self::GeneralizedAlpha { spectral_radius } => {
                Scheme::GeneralizedAlpha(GeneralizedAlpha::from_spectral_radius(spectral_radius)?)
            }
            Self::Newmark { beta, gamma } => {
                Scheme::GeneralizedAlpha(GeneralizedAlpha::newmark(beta, gamma)?)
            }
            Self::QuasiStatic => Scheme::QuasiStatic,
        })
    }
}

/// A step of a scheme: everything that depends on the step size.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Step {
    scheme: Scheme,
    dt: f64,
}

/// Factors of M, C and K in the tangent dR/d(d_{n+1}).
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct TangentWeights {
    pub(crate) mass: f64,
    pub(crate) damping: f64,
    pub(crate) stiffness: f64,
}

impl Step {
    pub(crate) fn new(scheme: Scheme, dt: f64) -> Self {
        assert!(dt > 0.0 && dt.is_finite(), "a time step is positive and finite, not {dt} s");
        Self { scheme, dt }
    }

    /// Where accelerations are balanced: `alpha_m`.
    pub(crate) fn alpha_m(&self) -> f64 {
        match self.scheme {
            Scheme::GeneralizedAlpha(g) => g.alpha_m,
            Scheme::QuasiStatic => 0.0,
        }
    }

    /// Where displacements, velocities and loads are balanced: `alpha_f`.
    pub(crate) fn alpha_f(&self) -> f64 {
        match self.scheme {
            Scheme::GeneralizedAlpha(g) => g.alpha_f,
            Scheme::QuasiStatic => 0.0,
        }
    }

    /// Velocity and acceleration at t_{n+1} from the displacement there (Newmark's relations):
    ///
    /// ```text
    /// a_{n+1} = (d_{n+1} - d_n - dt v_n)/(beta dt^2) - (1/(2 beta) - 1) a_n
    /// v_{n+1} = v_n + dt ((1 - gamma) a_n + gamma a_{n+1})
    /// ```
    ///
    /// Quasi-static: `v_{n+1} = (d_{n+1} - d_n)/dt`, `a_{n+1} = 0`.
    pub(crate) fn follow(&self, old: &StructureState, new: &mut StructureState) {
        let dt = self.dt;
        for dof in 0..new.displacement.len() {
            let moved = new.displacement[dof] - old.displacement[dof];
            let (v_n, a_n) = (old.velocity[dof], old.acceleration[dof]);
            (new.velocity[dof], new.acceleration[dof]) = match self.scheme {
                Scheme::GeneralizedAlpha(GeneralizedAlpha { gamma, beta, .. }) => {
                    let a = (moved - dt * v_n) / (beta * dt * dt) - (0.5 / beta - 1.0) * a_n;
                    (v_n + dt * ((1.0 - gamma) * a_n + gamma * a), a)
                }
                Scheme::QuasiStatic => (moved / dt, 0.0),
            };
        }
    }

    /// Derivatives of a_{n+1-alpha_m}, v_{n+1-alpha_f} and d_{n+1-alpha_f} by d_{n+1}.
    pub(crate) fn tangent_weights(&self) -> TangentWeights {
        match self.scheme {
            Scheme::GeneralizedAlpha(GeneralizedAlpha { alpha_m, alpha_f, gamma, beta }) => TangentWeights {
                mass: (1.0 - alpha_m) / (beta * self.dt * self.dt),
                damping: (1.0 - alpha_f) * gamma / (beta * self.dt),
                stiffness: 1.0 - alpha_f,
            },
            Scheme::QuasiStatic => TangentWeights { mass: 0.0, damping: 1.0 / self.dt, stiffness: 1.0 },
        }
    }
}

/// between = (1 - alpha) new + alpha old
pub(crate) fn average(alpha: f64, new: &[f64], old: &[f64], between: &mut [f64]) {
    for ((q, new), old) in between.iter_mut().zip(new).zip(old) {
        *q = (1.0 - alpha) * new + alpha * old;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    fn state(d: f64, v: f64, a: f64) -> StructureState {
        let mut state = StructureState::at_rest(1, 0);
        (state.displacement[0], state.velocity[0], state.acceleration[0]) = (d, v, a);
        state
    }

    fn inertial_schemes() -> [TimeScheme; 5] {
        let [a, b, c] =
            [0.0, 0.5, 1.0].map(|spectral_radius| TimeScheme::GeneralizedAlpha { spectral_radius });
        [a, b, c, TimeScheme::AVERAGE_ACCELERATION, TimeScheme::Newmark { beta: 0.4, gamma: 0.6 }]
    }

    #[test]
    fn uniform_acceleration_is_followed_exactly() {
        for scheme in inertial_schemes() {
            let scheme = scheme.coefficients().unwrap();
            let (dt, a) = (0.3, -2.0);
            let old = state(1.0, 4.0, a);
            let mut new = state(1.0 + 4.0 * dt + 0.5 * a * dt * dt, 0.0, 0.0);
            Step::new(scheme, dt).follow(&old, &mut new);
            assert_relative_eq!(new.acceleration[0], a, max_relative = 1e-13);
            assert_relative_eq!(new.velocity[0], 4.0 + a * dt, max_relative = 1e-13);
        }
    }

    #[test]
    fn tangent_weights_are_derivatives_of_the_averaged_motion() {
        let old = state(0.1, -0.7, 0.4);
        for scheme in inertial_schemes().into_iter().chain([TimeScheme::QuasiStatic]) {
            let step = Step::new(scheme.coefficients().unwrap(), 0.25);
            let averaged = |d: f64| {
                let mut new = state(d, 0.0, 0.0);
                step.follow(&old, &mut new);
                let mut between = [0.0; 3];
                average(step.alpha_m(), &new.acceleration, &old.acceleration, &mut between[..1]);
                average(step.alpha_f(), &new.velocity, &old.velocity, &mut between[1..2]);
                average(step.alpha_f(), &new.displacement, &old.displacement, &mut between[2..]);
                between
            };
            let (ahead, behind) = (averaged(1.5), averaged(0.5));
            let TangentWeights { mass, damping, stiffness } = step.tangent_weights();
            assert_relative_eq!(mass, ahead[0] - behind[0], epsilon = 1e-12);
            assert_relative_eq!(damping, ahead[1] - behind[1], epsilon = 1e-12);
            assert_relative_eq!(stiffness, ahead[2] - behind[2], epsilon = 1e-12);
        }
    }

    #[test]
    #[should_panic(expected = "a time step is positive and finite")]
    fn a_step_of_no_length_is_refused() {
        let _ = Step::new(Scheme::QuasiStatic, 0.0);
    }
}
