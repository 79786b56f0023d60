//! Coefficients of time-integration schemes, without any state.

use serde::{Deserialize, Serialize};

/// The order of a backward differentiation formula.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum BdfOrder {
    /// Implicit Euler.
    #[default]
    One,
    /// Two steps back.
    Two,
}

/// Backward differentiation on steps of any two sizes.
///
/// ```text
/// D_t u = c0 u^{n+1} + c1 u^n + c2 u^{n-1}
///
/// one step:   c = (1, -1, 0) / dt
/// two steps:  c0 = (1 + 2r) / ((1 + r) dt),  c1 = -(1 + r) / dt,  c2 = r^2 / ((1 + r) dt),  r = dt / dt_previous
/// ```
///
/// Source: Hairer, Norsett, Wanner, *Solving Ordinary Differential Equations I*, section III.5.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Bdf {
    /// The factors of u^{n+1}, u^n and u^{n-1} (1/s).
    pub c: [f64; 3],
    /// The step from `t_n` to `t_{n+1}` (s).
    pub dt: f64,
}

impl Bdf {
    /// First order: implicit Euler with the step `dt` (s).
    ///
    /// # Panics
    ///
    /// If `dt` is not positive and finite.
    #[must_use]
    pub fn first(dt: f64) -> Self {
        assert_step(dt);
        Self { c: [1.0 / dt, -1.0 / dt, 0.0], dt }
    }

    /// Second order: the step `dt` (s) after a step `dt_previous` (s).
    ///
    /// # Panics
    ///
    /// If a step is not positive and finite.
    #[must_use]
    pub fn second(dt: f64, dt_previous: f64) -> Self {
        assert_step(dt);
        assert_step(dt_previous);
        let ratio = dt / dt_previous;
        let newest = (1.0 + 2.0 * ratio) / (1.0 + ratio);
        let oldest = ratio * ratio / (1.0 + ratio);
        Self { c: [newest / dt, -(1.0 + ratio) / dt, oldest / dt], dt }
    }

    /// The formula of `order` where it can be had: the first step of a run has no step before it and is of
    /// first order.
    ///
    /// # Panics
    ///
    /// If a step is not positive and finite.
    #[must_use]
    pub fn of_order(order: BdfOrder, dt: f64, dt_previous: Option<f64>) -> Self {
        match (order, dt_previous) {
            (BdfOrder::Two, Some(dt_previous)) => Self::second(dt, dt_previous),
            (BdfOrder::One, _) | (BdfOrder::Two, None) => Self::first(dt),
        }
    }

    /// `D_t u` from u^{n+1}, u^n and u^{n-1}: their unit over seconds.
    #[inline]
    #[must_use]
    pub fn derivative(&self, newest: f64, current: f64, previous: f64) -> f64 {
        self.c[0] * newest + self.c[1] * current + self.c[2] * previous
    }
}

fn assert_step(dt: f64) {
    assert!(dt > 0.0 && dt.is_finite(), "a time step is positive and finite, not {dt} s");
}

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
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
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
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[error(
    "generalized-alpha: spectral radius {radius} lies outside [0, 1]\n\
     hint: 1 keeps all energy, 0 removes the highest frequencies within a step; 0.5 to 0.9 is common"
)]
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

#[cfg(test)]
#[allow(clippy::float_cmp, reason = "these values are exact")]
mod tests {
    use super::*;
    use approx::assert_relative_eq;
    use nalgebra::Matrix3;
    use proptest::prelude::*;

    /// `D_t` of t^degree at t = 1 s from its values at the last time levels.
    fn derivative_of_power(bdf: &Bdf, dt_previous: f64, degree: i32) -> f64 {
        let power = |t: f64| t.powi(degree);
        bdf.derivative(power(1.0), power(1.0 - bdf.dt), power(1.0 - bdf.dt - dt_previous))
    }

    proptest! {
        #[test]
        fn first_order_is_exact_for_linear_functions_only(dt in 1e-3..1.0) {
            let bdf = Bdf::first(dt);
            prop_assert!((derivative_of_power(&bdf, dt, 0)).abs() < 1e-12);
            prop_assert!((derivative_of_power(&bdf, dt, 1) - 1.0).abs() < 1e-12);
            prop_assert!((derivative_of_power(&bdf, dt, 2) - 2.0 + dt).abs() < 1e-12);
        }

        #[test]
        fn second_order_is_exact_for_quadratic_functions_only(dt in 1e-3..1.0, dt_previous in 1e-3..1.0) {
            let bdf = Bdf::second(dt, dt_previous);
            let round_off = 1e-15 * bdf.c.iter().map(|c| c.abs()).sum::<f64>() + 1e-14;
            for (degree, exact) in [(0, 0.0), (1, 1.0), (2, 2.0), (3, 3.0 - dt * (dt + dt_previous))] {
                let derivative = derivative_of_power(&bdf, dt_previous, degree);
                prop_assert!((derivative - exact).abs() < round_off, "degree {degree}: {derivative}");
            }
        }
    }

    #[test]
    fn equal_steps_give_the_textbook_coefficients() {
        assert_eq!(Bdf::second(0.5, 0.5).c, [3.0, -4.0, 1.0]);
        assert_eq!(Bdf::first(0.5).c, [2.0, -2.0, 0.0]);
    }

    #[test]
    fn first_step_is_of_first_order() {
        assert_eq!(Bdf::of_order(BdfOrder::Two, 0.1, None), Bdf::first(0.1));
        assert_eq!(Bdf::of_order(BdfOrder::Two, 0.1, Some(0.2)), Bdf::second(0.1, 0.2));
        assert_eq!(Bdf::of_order(BdfOrder::One, 0.1, Some(0.2)), Bdf::first(0.1));
    }

    #[test]
    #[should_panic(expected = "positive and finite")]
    fn step_of_no_length_is_refused() {
        let _ = Bdf::second(0.1, 0.0);
    }

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

    /// Takes (d, dt v, dt^2 a) of a free oscillator over one step; `omega` is its frequency times dt.
    fn amplification(scheme: GeneralizedAlpha, omega: f64) -> Matrix3<f64> {
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

    fn spectral_radius(matrix: Matrix3<f64>) -> f64 {
        matrix.complex_eigenvalues().iter().map(|value| value.norm()).fold(0.0, f64::max)
    }

    #[test]
    fn spectral_radius_at_infinite_frequency_is_the_one_asked_for() {
        for radius in [0.0, 0.25, 0.5, 0.8, 1.0] {
            // The eigenvalue there is double or triple, so that round-off enters by its square or cube root.
            assert_relative_eq!(spectral_radius(amplification(scheme(radius), 1e9)), radius, epsilon = 1e-4);
        }
    }

    #[test]
    fn no_frequency_is_amplified() {
        for radius in [0.0, 0.25, 0.5, 0.8, 1.0] {
            for omega in (-40..=80).map(|k| 10_f64.powf(f64::from(k) / 10.0)) {
                let amplification = spectral_radius(amplification(scheme(radius), omega));
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
            assert!(error.to_string().contains("\nhint: "));
        }
    }
}
