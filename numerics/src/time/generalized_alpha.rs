//! The generalized-alpha method.

/// Generalized-alpha for second-order systems (Chung and Hulbert 1993).
///
/// ```text
/// M a_{n+1-alpha_m} + f_int(d_{n+1-alpha_f}) = f_ext_{n+1-alpha_f}
/// q_{n+1-alpha} = (1 - alpha) q_{n+1} + alpha q_n
///
/// d_{n+1} = d_n + dt v_n + dt^2 ((1/2 - beta) a_n + beta a_{n+1})
/// v_{n+1} = v_n + dt ((1 - gamma) a_n + gamma a_{n+1})
/// ```
///
/// Source: J. Chung, G. M. Hulbert, *A time integration algorithm for structural dynamics with improved
/// numerical dissipation*, J. Appl. Mech. 60 (1993), equations (1)-(5), (17), (20) and (25).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GeneralizedAlpha {
    /// Weight of the old acceleration in the inertia.
    pub alpha_m: f64,
    /// Weight of the old displacement and load in the balance of forces.
    pub alpha_f: f64,
    /// Weight of the new acceleration in the velocity.
    pub gamma: f64,
    /// Weight of the new acceleration in the displacement.
    pub beta: f64,
}

/// A spectral radius outside [0, 1].
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error, miette::Diagnostic)]
#[error("generalized-alpha: spectral radius {radius} lies outside [0, 1]")]
#[diagnostic(help(
    "1 keeps all energy, 0 removes the highest frequencies within a step; 0.5 to 0.9 is common"
))]
pub struct SpectralRadiusError {
    /// The radius asked for.
    pub radius: f64,
}

impl GeneralizedAlpha {
    /// The second-order scheme with the least damping of low frequencies for the spectral radius `radius`
    /// at infinite frequency.
    ///
    /// ```text
    /// alpha_m = (2r - 1)/(r + 1),  alpha_f = r/(r + 1),  gamma = 1/2 - alpha_m + alpha_f,
    /// beta = (1 - alpha_m + alpha_f)^2 / 4
    /// ```
    ///
    /// ```
    /// use partita_numerics::time::GeneralizedAlpha;
    ///
    /// let midpoint = GeneralizedAlpha::from_spectral_radius(1.0)?;
    /// assert_eq!((midpoint.alpha_m, midpoint.alpha_f), (0.5, 0.5));
    /// assert_eq!((midpoint.gamma, midpoint.beta), (0.5, 0.25));
    /// # Ok::<(), partita_numerics::time::SpectralRadiusError>(())
    /// ```
    ///
    /// # Errors
    ///
    /// If `radius` lies outside [0, 1].
    pub fn from_spectral_radius(radius: f64) -> Result<Self, SpectralRadiusError> {
        if !(0.0..=1.0).contains(&radius) {
            return Err(SpectralRadiusError { radius });
        }
        let alpha_m = (2.0 * radius - 1.0) / (radius + 1.0);
        let alpha_f = radius / (radius + 1.0);
        let shift = 1.0 - alpha_m + alpha_f;
        Ok(Self { alpha_m, alpha_f, gamma: shift - 0.5, beta: shift * shift / 4.0 })
    }
}

/// The step of a free oscillator as a matrix, for the tests of every scheme.
#[cfg(test)]
pub(super) mod amplification {
    use super::GeneralizedAlpha;
    use nalgebra::Matrix3;

    /// Takes (d, dt v, dt^2 a) of a free oscillator over one step; `omega` is its frequency times dt.
    pub(in crate::time) fn matrix(scheme: GeneralizedAlpha, omega: f64) -> Matrix3<f64> {
        let GeneralizedAlpha { alpha_m, alpha_f, gamma, beta } = scheme;
        let stiffness = omega * omega;
        let inertia = 1.0 - alpha_m + stiffness * (1.0 - alpha_f) * beta;
        let columns = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]].map(|[d, v, a]| {
            let predicted = d + v + (0.5 - beta) * a;
            let new = -(alpha_m * a + stiffness * ((1.0 - alpha_f) * predicted + alpha_f * d)) / inertia;
            [predicted + beta * new, v + (1.0 - gamma) * a + gamma * new, new]
        });
        Matrix3::from_fn(|i, j| columns[j][i])
    }

    pub(in crate::time) fn spectral_radius(matrix: Matrix3<f64>) -> f64 {
        matrix.complex_eigenvalues().iter().map(|value| value.norm()).fold(0.0, f64::max)
    }
}

#[cfg(test)]
mod tests {
    use super::amplification::{self, spectral_radius};
    use miette::Diagnostic as _;

    use super::*;
    use approx::assert_relative_eq;

    fn scheme(radius: f64) -> GeneralizedAlpha {
        GeneralizedAlpha::from_spectral_radius(radius).unwrap()
    }

    #[test]
    fn known_radii_give_known_parameters() {
        let known = [
            (0.0, [-1.0, 0.0, 1.5, 1.0]),
            (0.5, [0.0, 1.0 / 3.0, 5.0 / 6.0, 4.0 / 9.0]),
            (1.0, [0.5, 0.5, 0.5, 0.25]),
        ];
        for (radius, [alpha_m, alpha_f, gamma, beta]) in known {
            let scheme = scheme(radius);
            assert_relative_eq!(scheme.alpha_m, alpha_m, epsilon = 1e-15);
            assert_relative_eq!(scheme.alpha_f, alpha_f, epsilon = 1e-15);
            assert_relative_eq!(scheme.gamma, gamma, epsilon = 1e-15);
            assert_relative_eq!(scheme.beta, beta, epsilon = 1e-15);
        }
    }

    #[test]
    fn every_radius_is_second_order_and_unconditionally_stable() {
        for radius in (0..=20).map(|i| f64::from(i) / 20.0) {
            let GeneralizedAlpha { alpha_m, alpha_f, gamma, beta } = scheme(radius);
            assert_relative_eq!(gamma, 0.5 - alpha_m + alpha_f, epsilon = 1e-15);
            assert!(alpha_m <= alpha_f + 1e-15 && alpha_f <= 0.5);
            assert!(beta >= 0.25 + 0.5 * (alpha_f - alpha_m) - 1e-15);
        }
    }

    #[test]
    fn spectral_radius_at_infinite_frequency_is_the_one_asked_for() {
        for radius in [0.0, 0.25, 0.5, 0.8, 1.0] {
            // The eigenvalue there is double or triple, so that round-off enters by its square or cube root.
            assert_relative_eq!(
                spectral_radius(amplification::matrix(scheme(radius), 1e9)),
                radius,
                epsilon = 1e-4
            );
        }
    }

    #[test]
    fn no_frequency_is_amplified() {
        for radius in [0.0, 0.25, 0.5, 0.8, 1.0] {
            for omega in (-40..=80).map(|k| 10_f64.powf(f64::from(k) / 10.0)) {
                let amplification = spectral_radius(amplification::matrix(scheme(radius), omega));
                // Towards infinity the eigenvalues meet: see above.
                assert!(amplification < 1.0 + 1e-4, "{amplification} at {omega}, radius {radius}");
            }
        }
    }

    #[test]
    fn gain_of_an_interface_load_is_that_of_the_coupling_theory() {
        for (radius, gain) in [(0.0, 0.5), (0.5, 8.0 / 27.0), (1.0, 0.25)] {
            let GeneralizedAlpha { alpha_m, alpha_f, beta, .. } = scheme(radius);
            assert_relative_eq!((1.0 - alpha_f) * beta / (1.0 - alpha_m), gain, epsilon = 1e-15);
        }
    }

    #[test]
    fn radius_outside_the_unit_interval_is_refused() {
        for radius in [-0.1, 1.1, f64::NAN] {
            let error = GeneralizedAlpha::from_spectral_radius(radius).unwrap_err();
            assert!(error.help().is_some());
        }
    }
}
