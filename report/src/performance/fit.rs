//! Growth of a cost with the number of unknowns.

/// Fewer unknowns tell about overhead, not about growth.
const SMALLEST: f64 = 4000.0;

/// The exponent k of cost = c n^k, fitted by least squares to the logarithms; nothing for fewer than two sizes.
pub(super) fn exponent(costs: &[(usize, f64)]) -> Option<f64> {
    let points: Vec<(f64, f64)> = costs
        .iter()
        .map(|&(dofs, cost)| (dofs as f64, cost))
        .filter(|&(dofs, cost)| dofs >= SMALLEST && cost > 0.0)
        .map(|(dofs, cost)| (dofs.ln(), cost.ln()))
        .collect();
    let mean = |part: fn(&(f64, f64)) -> f64| points.iter().map(part).sum::<f64>() / points.len() as f64;
    let (x, y) = (mean(|point| point.0), mean(|point| point.1));
    let spread: f64 = points.iter().map(|point| (point.0 - x).powi(2)).sum();
    let product: f64 = points.iter().map(|point| (point.0 - x) * (point.1 - y)).sum();
    (points.len() > 1 && spread > 0.0).then(|| product / spread)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_power_is_found_and_small_sizes_do_not_count() {
        let costs =
            [(600, 7.0), (5_000, 5_f64.powf(1.5)), (20_000, 20_f64.powf(1.5)), (80_000, 80_f64.powf(1.5))];
        assert!((exponent(&costs).expect("three sizes") - 1.5).abs() < 1e-12);
        assert_eq!(exponent(&costs[..2]), None);
        assert_eq!(exponent(&[]), None);
    }
}
