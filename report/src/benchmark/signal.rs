//! Mean, amplitude and frequency of the last period of a signal, as Turek and Hron (2006) define them.

/// A periodic signal in three numbers, in the units of its values and times.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Swing {
    /// (max + min)/2 over the last period.
    pub(super) mean: f64,
    /// (max - min)/2 over the last period.
    pub(super) amplitude: f64,
    /// 1 / the last period.
    pub(super) frequency: f64,
}

/// How far from the middle a signal must have been, as part of its half range, for its next crossing to count: what rides
/// on the swing crosses the middle too.
const SWUNG: f64 = 0.3;

/// The last whole period of samples `values` at increasing `times`; nothing where there is no whole one.
///
/// The period lies between the last two upward crossings of the middle between the extremes of the last fifth of the
/// run; crossings are interpolated on a line, extremes by a parabola through three samples.
pub(super) fn last_period(times: &[f64], values: &[f64]) -> Option<Swing> {
    let crossings = crossings(times, values);
    let [.., begin, end] = crossings[..] else { return None };
    between(times, values, begin, end)
}

/// The same of a signal that swings with another one, `lead`: over the last whole period of that one.
///
/// Drag, say, swings twice while a flag swings once, and its two swings are not quite alike: only both together are a period.
/// The frequency is the number of swings in it over its length.
pub(super) fn last_period_with(times: &[f64], values: &[f64], lead: &[f64]) -> Option<Swing> {
    let crossings = crossings(times, lead);
    let [.., begin, end] = crossings[..] else { return None };
    let swing = between(times, values, begin, end)?;
    let period = end.0 - begin.0;
    // Counted over more than the period, for a crossing may coincide with either end of it.
    let own: Vec<f64> = upward_crossings(times, values, swing.mean, SWUNG * swing.amplitude)
        .into_iter()
        .map(|(time, _)| time)
        .filter(|time| *time > begin.0 - 1.5 * period)
        .collect();
    let each = (own.last()? - own.first()?) / (own.len() - 1) as f64;
    let swings = (period / each).round();
    (swings >= 1.0 && swings.is_finite()).then_some(Swing { frequency: swings / period, ..swing })
}

/// How well the last so many periods repeat each other \[%\]: the largest difference of amplitude or length from the last
/// one's. Nothing where there are fewer.
pub(super) fn repetition(times: &[f64], values: &[f64], periods: usize) -> Option<f64> {
    let crossings = crossings(times, values);
    let recent = &crossings[crossings.len().checked_sub(periods + 1)?..];
    let swings: Vec<Swing> =
        recent.windows(2).map(|pair| between(times, values, pair[0], pair[1])).collect::<Option<_>>()?;
    let last = swings.last()?;
    let differences = swings.iter().flat_map(|swing| {
        [swing.amplitude / last.amplitude - 1.0, last.frequency / swing.frequency - 1.0].map(f64::abs)
    });
    Some(100.0 * differences.fold(0.0, f64::max))
}

/// First sample of the last so many periods, or of all where there are fewer, and the time at which the last one begins.
pub(super) fn last_samples(times: &[f64], values: &[f64], periods: usize) -> Option<(usize, f64)> {
    let crossings = crossings(times, values);
    let [.., begin, _] = crossings[..] else { return None };
    Some((crossings[crossings.len().saturating_sub(periods + 1)].1, begin.0))
}

/// Where periods begin: upward crossings of the middle of the last fifth of the run. Before it, a transient may overshoot.
fn crossings(times: &[f64], values: &[f64]) -> Vec<(f64, usize)> {
    let settled = &values[4 * values.len() / 5..];
    let Some((low, high)) = range(settled.iter().copied()) else { return Vec::new() };
    upward_crossings(times, values, 0.5 * (low + high), SWUNG * 0.5 * (high - low))
}

/// The period between two crossings.
fn between(times: &[f64], values: &[f64], begin: (f64, usize), end: (f64, usize)) -> Option<Swing> {
    let extremes = (begin.1..=end.1).flat_map(|i| [values[i], at_the_top(times, values, i)]);
    let (low, high) = range(extremes)?;
    Some(Swing {
        mean: 0.5 * (high + low),
        amplitude: 0.5 * (high - low),
        frequency: 1.0 / (end.0 - begin.0),
    })
}

/// Smallest and largest of some numbers, if there are two different ones.
fn range(numbers: impl Iterator<Item = f64>) -> Option<(f64, f64)> {
    let (low, high) = numbers
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), number| (low.min(number), high.max(number)));
    (low < high).then_some((low, high))
}

/// Time of each upward crossing of `level` and the first sample after it. Between two of them the signal has been
/// `margin` above and below the level.
fn upward_crossings(times: &[f64], values: &[f64], level: f64, margin: f64) -> Vec<(f64, usize)> {
    let mut crossings = Vec::new();
    let mut was_below = false;
    let mut candidate = None;
    for i in 1..values.len() {
        let (before, now) = (values[i - 1] - level, values[i] - level);
        was_below |= now < -margin;
        if before < 0.0 && now >= 0.0 {
            candidate = Some((times[i - 1] + (times[i] - times[i - 1]) * before / (before - now), i));
        }
        if was_below && now > margin {
            crossings.extend(candidate);
            was_below = false;
        }
    }
    crossings
}

/// The vertex of the parabola through sample `i` and its neighbours, where the sample is an extreme among them.
fn at_the_top(times: &[f64], values: &[f64], i: usize) -> f64 {
    if i == 0 || i + 1 >= values.len() {
        return values[i];
    }
    let (left, right) = (times[i] - times[i - 1], times[i + 1] - times[i]);
    let (fall, rise) = ((values[i] - values[i - 1]) / left, (values[i + 1] - values[i]) / right);
    if fall * rise >= 0.0 {
        return values[i];
    }
    let curvature = (rise - fall) / (left + right);
    let slope = fall + curvature * left;
    values[i] - 0.25 * slope * slope / curvature
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use super::*;

    fn sampled(step: f64, count: usize, signal: impl Fn(f64) -> f64) -> Option<Swing> {
        let times: Vec<f64> = (0..count).map(|i| step * i as f64).collect();
        let values: Vec<f64> = times.iter().map(|&t| signal(t)).collect();
        last_period(&times, &values)
    }

    fn close(swing: Swing, [mean, amplitude, frequency]: [f64; 3], bound: f64) {
        for (found, expected) in
            [(swing.mean, mean), (swing.amplitude, amplitude), (swing.frequency, frequency)]
        {
            assert!(
                (found - expected).abs() < bound,
                "{swing:?}, expected {mean} +- {amplitude} [{frequency}]"
            );
        }
    }

    #[test]
    fn a_sine_has_its_mean_amplitude_and_frequency() {
        let swing = sampled(0.01, 1000, |t| 3.0 - 2.0 * (TAU * 1.1 * t).sin()).expect("periods");
        close(swing, [3.0, 2.0, 1.1], 1e-4);
    }

    /// Mean and amplitude are those of the extremes, not of the average: (1 - cos) / 2 squared has the average 3/8.
    #[test]
    fn the_mean_lies_between_the_extremes() {
        let swing = sampled(0.005, 2000, |t| (0.5 - 0.5 * (TAU * 0.7 * t).cos()).powi(2)).expect("periods");
        close(swing, [0.5, 0.5, 0.7], 1e-4);
    }

    #[test]
    fn the_last_period_counts_and_not_the_transient() {
        let swing = sampled(0.01, 2000, |t| {
            -1.0 + (0.5 + 3.0 * (-t).exp()) * (TAU * 2.0 * t).cos() + 8.0 * (-2.0 * t).exp()
        });
        close(swing.expect("periods"), [-1.0, 0.5, 2.0], 1e-3);
    }

    /// The ripple falls where the swing rises, so that every crossing of the middle is three. Half a ripple beside the
    /// top of the swing lies the extreme, near cos(pi / 13) + 0.1.
    #[test]
    fn ripples_on_the_swing_are_no_periods() {
        let swing = sampled(0.01, 1500, |t| (TAU * t).sin() - 0.1 * (TAU * 13.0 * t).sin()).expect("periods");
        close(swing, [0.0, (TAU / 26.0).cos() + 0.1, 1.0], 5e-3);
    }

    /// Samples miss the top of a fast swing by 5 %; the parabola finds it.
    #[test]
    fn extremes_between_samples_are_found() {
        let swing = sampled(0.1, 400, |t| (TAU * t + 0.2).sin()).expect("periods");
        close(swing, [0.0, 1.0, 1.0], 6e-3);
    }

    /// Twice while the lead swings once, the second time lower: a period holds both.
    #[test]
    fn a_signal_that_swings_twice_is_taken_over_the_whole_period_of_its_lead() {
        let times: Vec<f64> = (0..2000).map(|i| 0.005 * f64::from(i)).collect();
        let lead: Vec<f64> = times.iter().map(|&t| (TAU * 1.2 * t).sin()).collect();
        let values: Vec<f64> =
            times.iter().map(|&t| 5.0 + (TAU * 2.4 * t).sin() + 0.2 * (TAU * 1.2 * t).sin()).collect();
        let swing = last_period_with(&times, &values, &lead).expect("periods");
        assert!((swing.frequency - 2.4).abs() < 2e-3, "{swing:?}");
        let (low, high) = range(values.iter().copied()).expect("it swings");
        assert!((swing.mean - 0.5 * (low + high)).abs() < 2e-3, "{swing:?}");
        assert!((swing.amplitude - 0.5 * (high - low)).abs() < 2e-3, "{swing:?}");
        assert_eq!(last_period_with(&times, &values, &times), None);
        assert_eq!(last_period_with(&times, &times, &lead), None);
    }

    #[test]
    fn repetition_is_the_largest_difference_of_the_last_periods() {
        let times: Vec<f64> = (0..2000).map(|i| 0.005 * f64::from(i)).collect();
        let steady: Vec<f64> = times.iter().map(|&t| (TAU * t).sin()).collect();
        assert!(repetition(&times, &steady, 4).expect("periods") < 0.1);
        // It grows by 1 % from period to period: three of them differ by 2 % from first to last.
        let growing: Vec<f64> = times.iter().map(|&t| 1.01_f64.powf(t) * (TAU * t).sin()).collect();
        let found = repetition(&times, &growing, 3).expect("periods");
        assert!((found - 2.0).abs() < 0.2, "{found}");
        assert_eq!(repetition(&times, &growing, 20), None);
        assert_eq!(repetition(&times, &times, 1), None);
    }

    #[test]
    fn the_last_samples_begin_at_a_crossing() {
        let times: Vec<f64> = (0..1000).map(|i| 0.01 * f64::from(i)).collect();
        let values: Vec<f64> = times.iter().map(|&t| (TAU * (t - 0.255)).sin()).collect();
        let (first, last) = last_samples(&times, &values, 2).expect("periods");
        assert!((times[first] - 7.26).abs() < 1e-9 && (last - 8.255).abs() < 1e-3, "{} {last}", times[first]);
        assert_eq!(last_samples(&times, &values, 99).expect("all").0, 26);
    }

    #[test]
    fn a_rest_or_half_a_swing_has_no_period() {
        assert_eq!(sampled(0.1, 100, |_| 2.0), None);
        assert_eq!(sampled(0.01, 60, |t| (TAU * t).sin()), None);
        assert_eq!(last_period(&[], &[]), None);
    }
}
