//! Fitted orders of convergence.

/// The slope of log(error) over log(h) by least squares: error = C h^order.
///
/// Works the same for mesh widths, time steps and Newton residuals against their predecessors.
///
/// ```
/// use partita_numerics::rates::fitted_order;
///
/// let order = fitted_order(&[0.4, 0.2, 0.1], &[0.16, 0.04, 0.01]);
/// assert!((order - 2.0).abs() < 1e-12);
/// ```
///
/// # Panics
///
/// If the lengths differ, fewer than two points are given, an entry is not positive and finite, or all
/// `h` are the same.
#[must_use]
pub fn fitted_order(h: &[f64], error: &[f64]) -> f64 {
    assert_eq!(h.len(), error.len(), "one error for each h");
    assert!(h.len() >= 2, "an order needs at least two points");
    assert!(
        h.iter().chain(error).all(|&value| value > 0.0 && value.is_finite()),
        "h and error are positive and finite: h = {h:?}, error = {error:?}"
    );
    let mean = |x: &[f64]| x.iter().map(|x| x.ln()).sum::<f64>() / x.len() as f64;
    let (mean_h, mean_error) = (mean(h), mean(error));
    let (mut covariance, mut variance) = (0.0, 0.0);
    for (h, error) in h.iter().zip(error) {
        let distance = h.ln() - mean_h;
        covariance += distance * (error.ln() - mean_error);
        variance += distance * distance;
    }
    assert!(variance > 0.0, "all h are the same: {h:?}");
    covariance / variance
}

/// The order between each two neighbouring points: `log(e_i / e_{i+1}) / log(h_i / h_{i+1})`.
///
/// # Panics
///
/// As [`fitted_order`], for each pair of neighbours.
#[must_use]
pub fn stepwise_orders(h: &[f64], error: &[f64]) -> Vec<f64> {
    assert_eq!(h.len(), error.len(), "one error for each h");
    h.windows(2).zip(error.windows(2)).map(|(h, error)| fitted_order(h, error)).collect()
}

#[cfg(test)]
#[allow(clippy::float_cmp, reason = "these values are exact")]
mod tests {
    use super::*;
    use approx::assert_relative_eq;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn order_of_a_power_law_is_its_exponent(
            order in -4.0..4.0, factor in 1e-6..1e6, h in prop::collection::vec(1e-6..1.0, 2..8)
        ) {
            prop_assume!(h.iter().any(|x: &f64| (x / h[0] - 1.0).abs() > 0.1));
            let error: Vec<f64> = h.iter().map(|h: &f64| factor * h.powf(order)).collect();
            prop_assert!((fitted_order(&h, &error) - order).abs() < 1e-9);
        }
    }

    #[test]
    fn fit_lies_between_the_stepwise_orders() {
        let (h, error) = ([0.4, 0.2, 0.1], [0.5, 0.1, 0.03]);
        let stepwise = stepwise_orders(&h, &error);
        assert_relative_eq!(stepwise[0], 5_f64.log2(), max_relative = 1e-14);
        assert_relative_eq!(fitted_order(&h, &error), (0.5_f64 / 0.03).log2() / 2.0, max_relative = 1e-14);
    }

    #[test]
    #[should_panic(expected = "positive and finite")]
    fn an_exact_result_has_no_order() {
        let _ = fitted_order(&[0.2, 0.1], &[1e-3, 0.0]);
    }
}
