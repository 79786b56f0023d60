//! Backward differentiation.

/// The order of a backward differentiation formula.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
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
#[derive(Debug, Clone, Copy, PartialEq)]
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

#[cfg(test)]
#[allow(clippy::float_cmp, reason = "these values are exact")]
mod tests {
    use super::*;
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
}
