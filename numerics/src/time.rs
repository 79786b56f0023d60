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
