//! Newmark's method: generalized-alpha without any averaging.

use super::GeneralizedAlpha;

/// Parameters with which Newmark's method amplifies some frequency, or cannot be stepped implicitly.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error, miette::Diagnostic)]
pub enum NewmarkError {
    /// Below gamma = 1/2 every frequency is amplified, however short the step; NaN and infinity are refused, too.
    #[error(
        "Newmark: gamma = {gamma} is not a number of at least 0.5, and would feed energy into every frequency"
    )]
    #[diagnostic(help(
        "0.5 is of second order and keeps the energy of linear vibrations; above it vibrations are damped \
         at first order"
    ))]
    Gamma {
        /// The gamma asked for.
        gamma: f64,
    },
    /// Below 2 beta = gamma only steps with omega dt < `limit` are stable, and a mesh has frequencies without bound.
    #[error("Newmark: beta = {beta} is below gamma/2 = {}, and stable only while omega dt < {limit:.3} for the highest \
         frequency of the mesh", 0.5 * gamma)]
    #[diagnostic(help(
        "0.25 belongs to gamma = 0.5 (average acceleration); (gamma + 0.5)^2/4 damps \
         the highest frequencies most"
    ))]
    Beta {
        /// The beta asked for.
        beta: f64,
        /// The gamma asked for.
        gamma: f64,
        /// The largest omega dt that is not amplified, `1/sqrt(gamma/2 - beta)`; 0 where beta is no finite number.
        limit: f64,
    },
}

impl GeneralizedAlpha {
    /// Average acceleration, `beta = 1/4, gamma = 1/2`: of second order; a linear vibration keeps its energy.
    pub const AVERAGE_ACCELERATION: Self = Self { alpha_m: 0.0, alpha_f: 0.0, gamma: 0.5, beta: 0.25 };

    /// Newmark's method, which balances forces at the end of the step: `alpha_m = alpha_f = 0`.
    ///
    /// ```text
    /// M a_{n+1} + f_int(d_{n+1}) = f_ext_{n+1}
    /// d_{n+1} = d_n + dt v_n + dt^2 ((1/2 - beta) a_n + beta a_{n+1})
    /// v_{n+1} = v_n + dt ((1 - gamma) a_n + gamma a_{n+1})
    /// ```
    ///
    /// Of second order for gamma = 1/2, else of first order with the numerical damping ratio
    /// `(gamma - 1/2) omega dt/2` of low frequencies. Stable for steps of any length if `2 beta >= gamma >= 1/2`: only
    /// such parameters are taken.
    ///
    /// Source: T. J. R. Hughes, *The Finite Element Method* (2000), sections 9.1.1 and 9.1.2; N. M. Newmark, *A method of
    /// computation for structural dynamics*, J. Eng. Mech. Div. ASCE 85 (1959).
    ///
    /// ```
    /// use partita_numerics::time::GeneralizedAlpha;
    ///
    /// assert_eq!(GeneralizedAlpha::newmark(0.25, 0.5), Ok(GeneralizedAlpha::AVERAGE_ACCELERATION));
    /// let message = GeneralizedAlpha::newmark(1.0 / 6.0, 0.5).unwrap_err().to_string();
    /// assert!(message.contains("omega dt < 3.464"));
    /// ```
    ///
    /// # Errors
    ///
    /// If gamma is below 1/2 or beta below gamma/2, or one of them is not finite.
    pub fn newmark(beta: f64, gamma: f64) -> Result<Self, NewmarkError> {
        if !(gamma >= 0.5 && gamma.is_finite()) {
            return Err(NewmarkError::Gamma { gamma });
        }
        if !(beta >= 0.5 * gamma && beta.is_finite()) {
            let limit = if beta.is_finite() { 1.0 / (0.5 * gamma - beta).sqrt() } else { 0.0 };
            return Err(NewmarkError::Beta { beta, gamma, limit });
        }
        Ok(Self { alpha_m: 0.0, alpha_f: 0.0, gamma, beta })
    }
}

#[cfg(test)]
mod tests {
    use super::super::generalized_alpha::amplification::{self, spectral_radius};
    use miette::Diagnostic as _;

    use super::*;
    use crate::rates::fitted_order;
    use approx::assert_relative_eq;
    use nalgebra::Vector3;

    /// Displacement and velocity at t = 1 s of an oscillator with omega = 4 1/s that is released from d = 1.
    fn released(scheme: GeneralizedAlpha, steps: u32) -> [f64; 2] {
        let dt = 1.0 / f64::from(steps);
        let step = amplification::matrix(scheme, 4.0 * dt);
        let mut state = Vector3::new(1.0, 0.0, -(4.0 * dt).powi(2));
        for _ in 0..steps {
            state = step * state;
        }
        [state[0], state[1] / dt]
    }

    fn orders(scheme: GeneralizedAlpha) -> [f64; 2] {
        let steps = [100, 200, 400];
        let errors = steps.map(|steps| {
            let [d, v] = released(scheme, steps);
            [(d - 4_f64.cos()).abs(), (v + 4.0 * 4_f64.sin()).abs() / 4.0]
        });
        [0, 1].map(|part| {
            fitted_order(&steps.map(|steps| 1.0 / f64::from(steps)), &errors.map(|error| error[part]))
        })
    }

    #[test]
    fn average_acceleration_is_of_second_order() {
        for order in orders(GeneralizedAlpha::AVERAGE_ACCELERATION) {
            assert!((order - 2.0).abs() < 0.02, "order {order}");
        }
        // Phase error omega^2 dt^2/12: of cos(4) at 100 steps 4 * 0.04^2/12 * |sin(4)|.
        let [d, _] = released(GeneralizedAlpha::AVERAGE_ACCELERATION, 100);
        assert_relative_eq!(
            (d - 4_f64.cos()).abs(),
            4.0 * 0.04_f64.powi(2) / 12.0 * 0.7568,
            max_relative = 0.01
        );
    }

    #[test]
    fn gamma_above_one_half_is_of_first_order_and_damps() {
        let scheme = GeneralizedAlpha::newmark(0.36, 0.7).unwrap();
        for order in orders(scheme) {
            assert!((order - 1.0).abs() < 0.1, "order {order}");
        }
        // Damping ratio (gamma - 1/2) omega dt/2: per step the amplitude falls by exp(-zeta omega dt).
        let omega_dt: f64 = 0.01;
        let decay = -spectral_radius(amplification::matrix(scheme, omega_dt)).ln();
        assert_relative_eq!(decay, 0.2 * 0.5 * omega_dt * omega_dt, max_relative = 1e-3);
    }

    #[test]
    fn average_acceleration_keeps_the_energy_of_an_oscillator() {
        let energy = |omega_dt: f64, state: Vector3<f64>| (omega_dt * state[0]).powi(2) + state[1].powi(2);
        for omega_dt in [0.1, 1.0, 30.0] {
            let step = amplification::matrix(GeneralizedAlpha::AVERAGE_ACCELERATION, omega_dt);
            let start = Vector3::new(0.3, 0.7, -omega_dt * omega_dt * 0.3);
            let mut state = start;
            for _ in 0..10_000 {
                state = step * state;
            }
            assert_relative_eq!(energy(omega_dt, state), energy(omega_dt, start), max_relative = 1e-10);
        }
    }

    #[test]
    fn no_frequency_is_amplified_on_the_bound_of_stability_and_some_are_below_it() {
        for gamma in [0.5, 0.6, 0.9, 1.5] {
            let on_the_bound = GeneralizedAlpha::newmark(0.5 * gamma, gamma).unwrap();
            for omega_dt in (-30..=60).map(|k| 10_f64.powf(f64::from(k) / 10.0)) {
                let radius = spectral_radius(amplification::matrix(on_the_bound, omega_dt));
                assert!(radius < 1.0 + 1e-6, "gamma {gamma}: {radius} at {omega_dt}");
            }
            let beta = 0.5 * gamma - 0.04;
            let NewmarkError::Beta { limit, .. } = GeneralizedAlpha::newmark(beta, gamma).unwrap_err() else {
                panic!("beta below gamma/2 is refused");
            };
            let below = GeneralizedAlpha { beta, ..on_the_bound };
            let radius_at = |omega_dt| spectral_radius(amplification::matrix(below, omega_dt));
            assert!(radius_at(0.99 * limit) < 1.0 + 1e-12, "gamma {gamma}");
            assert!(radius_at(1.01 * limit) > 1.0 + 1e-3, "gamma {gamma}");
        }
    }

    #[test]
    fn unstable_parameters_are_refused_with_a_remedy() {
        for (beta, gamma) in [(0.25, 0.4), (0.25, f64::NAN), (0.25, f64::INFINITY)] {
            let error = GeneralizedAlpha::newmark(beta, gamma).unwrap_err();
            assert!(matches!(error, NewmarkError::Gamma { .. }), "{error}");
            assert!(error.help().is_some());
        }
        for (beta, gamma) in [(0.0, 0.5), (0.25, 0.6), (f64::NAN, 0.5), (f64::INFINITY, 0.5)] {
            let error = GeneralizedAlpha::newmark(beta, gamma).unwrap_err();
            assert!(matches!(error, NewmarkError::Beta { .. }), "{error}");
            assert!(error.help().is_some());
        }
    }
}
