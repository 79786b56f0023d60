//! Norms and relative changes.

/// The Euclidean norm, without overflow or underflow on the way.
///
/// Not finite when an entry is not finite.
///
/// ```
/// use partita_numerics::norms::norm2;
///
/// assert_eq!(norm2(&[3.0, -4.0]), 5.0);
/// assert!((norm2(&[3e200, 4e200]) / 5e200 - 1.0).abs() < 1e-15);
/// ```
#[must_use]
pub fn norm2(x: &[f64]) -> f64 {
    norm2_of(x.iter().copied())
}

/// The Euclidean norm of the entries of `x` listed in `dofs`.
///
/// # Panics
///
/// If a dof lies outside `x`.
#[must_use]
pub fn norm2_at(x: &[f64], dofs: &[usize]) -> f64 {
    norm2_of(dofs.iter().map(|&dof| x[dof]))
}

/// |exit - entry|_2 / |exit|_2 over the listed `dofs`; 0/0 = 0, and 0 where |exit - entry|_2 is not above `resolution`, the
/// round-off of the natural scale of these values.
///
/// ```
/// use partita_numerics::norms::relative_change;
///
/// assert_eq!(relative_change(&[1.0, 7.0], &[2.0, 9.0], &[0], 0.0), 0.5);
/// assert_eq!(relative_change(&[0.0], &[0.0], &[0], 0.0), 0.0);
/// assert_eq!(relative_change(&[1e-17], &[3e-17], &[0], 1e-16), 0.0);
/// ```
///
/// # Panics
///
/// If a dof lies outside `entry` or `exit`.
#[must_use]
pub fn relative_change(entry: &[f64], exit: &[f64], dofs: &[usize], resolution: f64) -> f64 {
    let change = norm2_of(dofs.iter().map(|&dof| exit[dof] - entry[dof]));
    if change <= resolution {
        return 0.0;
    }
    relative(change, norm2_at(exit, dofs))
}

/// The first of the listed `dofs` whose entry of `x` is not finite, or else the one of the largest magnitude; nothing
/// where no dof is listed.
///
/// ```
/// use partita_numerics::norms::largest_at;
///
/// assert_eq!(largest_at(&[9.0, -3.0, 2.0], &[1, 2]), Some(1));
/// assert_eq!(largest_at(&[9.0, f64::NAN, f64::INFINITY], &[0, 1, 2]), Some(1));
/// ```
///
/// # Panics
///
/// If a dof lies outside `x`.
#[must_use]
pub fn largest_at(x: &[f64], dofs: &[usize]) -> Option<usize> {
    let size = |dof: usize| if x[dof].is_finite() { x[dof].abs() } else { f64::INFINITY };
    dofs.iter().copied().reduce(|largest, dof| if size(dof) > size(largest) { dof } else { largest })
}

/// value / scale with 0/0 = 0.
#[must_use]
pub fn relative(value: f64, scale: f64) -> f64 {
    if value == 0.0 && scale == 0.0 { 0.0 } else { value / scale }
}

/// The largest extent of some points along an axis; 0 without points.
///
/// ```
/// use partita_numerics::norms::extent;
///
/// assert_eq!(extent(&[[1.0, 7.0], [3.0, 4.0]]), 3.0);
/// ```
#[must_use]
pub fn extent<const D: usize>(points: &[[f64; D]]) -> f64 {
    let along = |c: usize| {
        let ends = points.iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], point| {
            [low.min(point[c]), high.max(point[c])]
        });
        ends[1] - ends[0]
    };
    (0..D).map(along).fold(0.0, f64::max)
}

fn norm2_of(entries: impl Iterator<Item = f64> + Clone) -> f64 {
    let square: f64 = entries.clone().map(|x| x * x).sum();
    // The plain sum is exact enough wherever no square has left the range of normal numbers.
    if square.is_nan() || (square > 1e-280 && square < f64::MAX) {
        return square.sqrt();
    }
    let largest = entries.clone().fold(0.0, |largest: f64, x| largest.max(x.abs()));
    if largest == 0.0 || largest.is_infinite() {
        return largest;
    }
    largest * entries.map(|x| (x / largest).powi(2)).sum::<f64>().sqrt()
}

#[cfg(test)]
#[allow(clippy::float_cmp, reason = "these values are exact")]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    #[test]
    fn norm_survives_the_whole_range_of_numbers() {
        for scale in [1e-300, 1e-150, 1.0, 1e150, 1e300] {
            assert_relative_eq!(norm2(&[3.0 * scale, 4.0 * scale]), 5.0 * scale, max_relative = 1e-15);
        }
        assert_eq!(norm2(&[]), 0.0);
        assert_eq!(norm2(&[0.0, -0.0]), 0.0);
    }

    #[test]
    fn norm_shows_what_is_not_finite() {
        assert!(norm2(&[1.0, f64::NAN]).is_nan());
        assert!(norm2(&[0.0, f64::NAN, 1e300]).is_nan());
        assert_eq!(norm2(&[1.0, f64::NEG_INFINITY]), f64::INFINITY);
    }

    #[test]
    fn change_counts_listed_dofs_only() {
        let (entry, exit) = ([0.0, 5.0, 0.0], [3.0, 9.0, 4.0]);
        assert_relative_eq!(relative_change(&entry, &exit, &[0, 2], 0.0), 1.0);
        assert_relative_eq!(relative_change(&entry, &exit, &[1], 0.0), 4.0 / 9.0);
        assert_eq!(relative_change(&entry, &exit, &[], 0.0), 0.0);
    }

    #[test]
    fn change_from_something_to_zero_is_infinite() {
        assert_eq!(relative_change(&[1.0], &[0.0], &[0], 0.0), f64::INFINITY);
    }
}
