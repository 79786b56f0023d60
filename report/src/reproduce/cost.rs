//! Measured times: what an iteration costs, and whether counts put the settings in the order of their run time.

use super::counts::Count;
use super::facts::Cost;

/// Mean cost of an iteration over the settings of a table.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Prices {
    /// A Newton iteration of the fluid \[s\].
    pub(crate) fluid: f64,
    /// A Newton iteration of the structure \[s\].
    pub(crate) structure: f64,
    /// A coupling iteration outside the solvers: transfer and acceleration \[s\].
    pub(crate) transfer: f64,
    /// Motion of the fluid's mesh in a coupling iteration \[s\].
    pub(crate) mesh_motion: f64,
}

impl Prices {
    /// Over all settings; `None` without any, or without an iteration of each kind.
    pub(crate) fn of(costs: &[Cost]) -> Option<Self> {
        let sum = |part: fn(&Cost) -> f64| costs.iter().map(part).sum::<f64>();
        let count = |which: Count| costs.iter().map(|cost| which.of(cost.counts)).sum::<usize>();
        let price = |seconds: f64, count: usize| (count > 0).then(|| seconds / count as f64);
        Some(Self {
            fluid: price(sum(|cost| cost.seconds.fluid), count(Count::Fluid))?,
            structure: price(sum(|cost| cost.seconds.structure), count(Count::Structure))?,
            transfer: price(
                sum(|cost| cost.seconds.transfer + cost.seconds.acceleration),
                count(Count::Coupling),
            )?,
            mesh_motion: price(sum(|cost| cost.seconds.mesh_motion), count(Count::Coupling))?,
        })
    }
}

/// Rank correlation between wall time and Newton total over the settings.
pub(crate) fn time_follows_newton(costs: &[Cost]) -> Option<f64> {
    time_follows(costs, |cost| Count::Newton.of(cost.counts) as f64)
}

/// Rank correlation between wall time and any measure over the settings.
pub(crate) fn time_follows(costs: &[Cost], measure: impl Fn(&Cost) -> f64) -> Option<f64> {
    let times: Vec<f64> = costs.iter().map(|cost| cost.wall_seconds).collect();
    let measures: Vec<f64> = costs.iter().map(measure).collect();
    spearman(&times, &measures)
}

/// Spearman's rank correlation: Pearson's correlation of the ranks, equal values sharing the mean of theirs. `None`
/// for fewer than two values, or where one side is constant.
pub(crate) fn spearman(a: &[f64], b: &[f64]) -> Option<f64> {
    assert_eq!(a.len(), b.len(), "values come in pairs");
    let (a, b) = (ranks(a), ranks(b));
    // Ranks of n values sum to n (n + 1) / 2 whatever the ties.
    let mean = f64::midpoint(a.len() as f64, 1.0);
    let product =
        |x: &[f64], y: &[f64]| -> f64 { x.iter().zip(y).map(|(x, y)| (x - mean) * (y - mean)).sum() };
    let scale = (product(&a, &a) * product(&b, &b)).sqrt();
    (scale > 0.0).then(|| product(&a, &b) / scale)
}

/// The rank of each value, from 1.
fn ranks(values: &[f64]) -> Vec<f64> {
    let below = |value: f64| values.iter().filter(|other| **other < value).count() as f64;
    let equal = |value: f64| values.iter().filter(|other| **other <= value).count() as f64 - below(value);
    values.iter().map(|&value| below(value) + f64::midpoint(equal(value), 1.0)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ranks_share_ties() {
        assert_eq!(ranks(&[3.0, 1.0, 3.0, 2.0]), [3.5, 1.0, 3.5, 2.0]);
    }

    #[test]
    fn correlation_sees_order_alone() {
        let a = [1.0, 2.0, 3.0, 4.0, 5.0];
        let near = |value: Option<f64>, expected: f64| {
            assert!((value.expect("values vary") - expected).abs() < 1e-14, "{value:?}");
        };
        near(spearman(&a, &a.map(f64::exp)), 1.0);
        near(spearman(&a, &a.map(|x| -x * x)), -1.0);
        // 1 - 6 sum d^2 / (n (n^2 - 1)) with d = (0, 0, 0, 1, 1).
        near(spearman(&a, &[1.0, 2.0, 3.0, 5.0, 4.0]), 0.9);
        assert_eq!(spearman(&a, &[1.0; 5]), None);
        assert_eq!(spearman(&[], &[]), None);
    }
}
