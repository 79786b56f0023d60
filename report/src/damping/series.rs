//! Vectors over time, and what is measured of them.

/// A vector at each of the common times.
pub(super) type Series = Vec<[f64; 2]>;

/// The values at every `stride`-th step, from the records of every step.
pub(super) fn sampled(all: &[[f64; 2]], stride: usize) -> Series {
    all.iter().skip(stride - 1).step_by(stride).copied().collect()
}

/// The mean of `|f_{n+1} - 2 f_n + f_{n-1}|` over all three neighbouring values; 0 of fewer than three.
pub(super) fn second_difference(values: &[[f64; 2]]) -> f64 {
    let at = |w: &[[f64; 2]], c: usize| w[2][c] - 2.0 * w[1][c] + w[0][c];
    let sum: f64 = values.windows(3).map(|window| at(window, 0).hypot(at(window, 1))).sum();
    sum / values.len().saturating_sub(2).max(1) as f64
}

/// Root mean square of `|a - b|` over that of `|b|`.
///
/// # Panics
/// When the series have different lengths.
pub(super) fn distance(a: &[[f64; 2]], b: &[[f64; 2]]) -> f64 {
    assert_eq!(a.len(), b.len(), "both have a value at each of the common times");
    let squares =
        |values: &mut dyn Iterator<Item = [f64; 2]>| values.map(|[x, y]| x * x + y * y).sum::<f64>();
    let apart = squares(&mut a.iter().zip(b).map(|(a, b)| [a[0] - b[0], a[1] - b[1]]));
    (apart / squares(&mut b.iter().copied())).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_sawtooth_has_four_times_its_amplitude_and_a_line_none() {
        let saw: Series = (0..7).map(|n| if n % 2 == 0 { [0.3, 0.4] } else { [-0.3, -0.4] }).collect();
        assert!((second_difference(&saw) - 2.0).abs() < 1e-15);
        let line: Series = (0..7).map(|n| [f64::from(n), -2.0 * f64::from(n)]).collect();
        assert!(second_difference(&line).abs() < 1e-300);
        assert!(second_difference(&line[..2]).abs() < 1e-300);
    }

    #[test]
    fn finer_steps_are_sampled_at_the_ends_of_coarse_ones() {
        let fine: Series = (1..=12).map(|n| [f64::from(n), 0.0]).collect();
        assert_eq!(sampled(&fine, 4), [[4.0, 0.0], [8.0, 0.0], [12.0, 0.0]]);
        assert_eq!(sampled(&fine, 1), fine);
    }

    #[test]
    fn distances_are_relative_to_the_second_series() {
        let (a, b) = ([[0.0, 0.0], [3.0, 0.0]], [[0.0, 0.0], [3.0, 4.0]]);
        assert!((distance(&a, &b) - 0.8).abs() < 1e-15);
    }
}
