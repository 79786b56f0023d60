//! Gauss-Legendre rules of any number of points.

use std::f64::consts::PI;

/// The Gauss-Legendre rule of `n` points on [0, 1]: (point, weight), points ascending.
///
/// Exact for polynomials of degree 2n - 1. On [-1, 1] the points x are the roots of the Legendre polynomial
/// `P_n`, found by Newton's method, with weights `2 / ((1 - x^2) P_n'(x)^2)`.
///
/// ```
/// use partita_numerics::gauss;
///
/// let cubic: f64 = gauss::line(2).iter().map(|(x, weight)| weight * x.powi(3)).sum();
/// assert!((cubic - 0.25).abs() < 1e-15);
/// ```
///
/// # Panics
///
/// If `n` is zero.
#[must_use]
pub fn line(n: usize) -> Vec<(f64, f64)> {
    assert!(n > 0, "a rule has at least one point");
    let mut rule = vec![(0.5, 0.0); n];
    for i in 0..n.div_ceil(2) {
        // Roots come from the right end; the rule is symmetric.
        let x = if 2 * i + 1 == n { 0.0 } else { legendre_root(n, i) };
        let (_, slope) = legendre(n, x);
        let weight = 1.0 / ((1.0 - x * x) * slope * slope);
        rule[i] = (0.5 * (1.0 - x), weight);
        rule[n - 1 - i] = (0.5 * (1.0 + x), weight);
    }
    rule
}

/// The i-th largest root of `P_n`.
fn legendre_root(n: usize, i: usize) -> f64 {
    let mut x = (PI * (i as f64 + 0.75) / (n as f64 + 0.5)).cos();
    // Quadratic convergence from a guess good to 1/n^2: this ends long before the limit.
    for _ in 0..20 {
        let (value, slope) = legendre(n, x);
        let step = value / slope;
        x -= step;
        if step.abs() < 1e-15 {
            break;
        }
    }
    x
}

/// `P_n(x)` and `P_n'(x)` for |x| < 1, by the three-term recurrence.
fn legendre(n: usize, x: f64) -> (f64, f64) {
    let (mut previous, mut value) = (1.0, x);
    for k in 2..=n {
        let k = k as f64;
        (previous, value) = (value, ((2.0 * k - 1.0) * x * value - (k - 1.0) * previous) / k);
    }
    (value, n as f64 * (previous - x * value) / (1.0 - x * x))
}

#[cfg(test)]
#[allow(clippy::float_cmp, reason = "these values are exact")]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    fn factorial(n: usize) -> f64 {
        (1..=n).map(|k| k as f64).product()
    }

    #[test]
    fn line_rules_are_exact_up_to_their_degree_and_not_beyond() {
        for n in 1..=20 {
            let rule = line(n);
            let integral = |degree: usize| {
                rule.iter().map(|(x, weight)| weight * x.powi(degree.try_into().unwrap())).sum::<f64>()
            };
            for degree in 0..2 * n {
                assert_relative_eq!(integral(degree), 1.0 / (degree + 1) as f64, max_relative = 2e-14);
            }
            // The error at degree 2n is (n!)^4 / ((2n + 1) (2n)!^2): visible while it is above round-off.
            let error = factorial(n).powi(4) / ((2 * n + 1) as f64 * factorial(2 * n).powi(2));
            assert_relative_eq!(1.0 / (2 * n + 1) as f64 - integral(2 * n), error, epsilon = 1e-15);
        }
    }

    #[test]
    fn line_rules_of_many_points_stay_accurate() {
        for n in [50, 101, 200] {
            let rule = line(n);
            assert!(rule.is_sorted_by(|a, b| a.0 < b.0) && rule[0].0 > 0.0 && rule[n - 1].0 < 1.0);
            let oscillation: f64 = rule.iter().map(|(x, weight)| weight * (20.0 * x).cos()).sum();
            assert_relative_eq!(oscillation, 20_f64.sin() / 20.0, epsilon = 1e-14);
        }
    }
}
