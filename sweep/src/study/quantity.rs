//! From values in time to one number, and to an error.

use thiserror::Error;

use crate::file::study::{Measure, Take};
use crate::result::Series;

/// Why a run has no error.
#[derive(Debug, Error)]
pub(crate) enum MeasureError {
    /// What was probed is no number.
    #[error("what the probe shows is not finite")]
    NotFinite,
    /// It shares no time with the reference.
    #[error("it has no time in common with the reference run")]
    NoCommonTime,
}

/// What is measured.
#[derive(Debug, Clone)]
pub(crate) struct Quantity {
    pub(crate) name: String,
    pub(crate) column: String,
    pub(crate) take: Take,
    /// First and last time that count \[s\].
    pub(crate) window: [f64; 2],
    pub(crate) measure: Measure,
}

/// What errors are measured against.
#[derive(Debug, Clone)]
pub(crate) enum Truth {
    Value(f64),
    Run(Series),
}

/// Times that are this part of their size apart are the same.
const SAME_TIME: f64 = 1e-6;

impl Quantity {
    /// Whether a time counts.
    pub(crate) fn counts(&self, time: f64) -> bool {
        let slack = SAME_TIME * time.abs();
        (self.window[0] - slack..=self.window[1] + slack).contains(&time)
    }

    /// The number that the values come to; for a history its last one.
    pub(crate) fn of(&self, series: &Series) -> Result<f64, MeasureError> {
        let inside: Vec<[f64; 2]> = series
            .times
            .iter()
            .zip(&series.values)
            .map(|(&time, &value)| [time, value])
            .filter(|&[time, _]| self.counts(time))
            .collect();
        let values = || inside.iter().map(|&[_, value]| value);
        let found = match self.take {
            Take::Last | Take::History => values().next_back(),
            Take::Max => values().reduce(f64::max),
            Take::Min => values().reduce(f64::min),
            Take::Mean => mean(&inside),
        };
        found.filter(|_| values().all(f64::is_finite)).ok_or(MeasureError::NotFinite)
    }

    /// Distance of a run from the truth.
    pub(crate) fn error(&self, series: &Series, truth: &Truth) -> Result<f64, MeasureError> {
        let (distance, scale) = match truth {
            Truth::Value(value) => ((self.of(series)? - value).abs(), value.abs()),
            Truth::Run(run) if self.take == Take::History => self.largest_distance(series, run)?,
            Truth::Run(run) => {
                let value = self.of(run)?;
                ((self.of(series)? - value).abs(), value.abs())
            }
        };
        let error = match self.measure {
            Measure::Relative => distance / scale,
            Measure::Absolute => distance,
        };
        if error.is_finite() { Ok(error) } else { Err(MeasureError::NotFinite) }
    }

    /// Largest distance at a time that both have, and largest magnitude of `truth` at these times.
    fn largest_distance(&self, series: &Series, truth: &Series) -> Result<(f64, f64), MeasureError> {
        let (mut distance, mut scale) = (0.0_f64, 0.0_f64);
        let mut common = 0;
        let mut at = 0;
        for (&time, &value) in series.times.iter().zip(&series.values).filter(|(time, _)| self.counts(**time))
        {
            let slack = SAME_TIME * time.abs();
            while truth.times.get(at).is_some_and(|other| *other < time - slack) {
                at += 1;
            }
            if truth.times.get(at).is_some_and(|other| *other <= time + slack) {
                common += 1;
                scale = scale.max(truth.values[at].abs());
                // A sum of what is no number stays so; the maximum would hide it.
                if !(value - truth.values[at]).is_finite() {
                    return Err(MeasureError::NotFinite);
                }
                distance = distance.max((value - truth.values[at]).abs());
            }
        }
        if common == 0 { Err(MeasureError::NoCommonTime) } else { Ok((distance, scale)) }
    }
}

/// Mean over time of the straight lines through the values; a single value is its own mean.
fn mean(inside: &[[f64; 2]]) -> Option<f64> {
    let (first, last) = (inside.first()?, inside.last()?);
    if inside.len() == 1 {
        return Some(first[1]);
    }
    let area: f64 =
        inside.windows(2).map(|pair| 0.5 * (pair[0][1] + pair[1][1]) * (pair[1][0] - pair[0][0])).sum();
    Some(area / (last[0] - first[0]))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn quantity(take: Take, window: [f64; 2], measure: Measure) -> Quantity {
        Quantity { name: String::new(), column: String::new(), take, window, measure }
    }

    fn series(steps: i32, value: impl Fn(f64) -> f64) -> Series {
        let times: Vec<f64> = (1..=steps).map(|step| f64::from(step) / f64::from(steps)).collect();
        Series { values: times.iter().map(|&time| value(time)).collect(), times }
    }

    #[test]
    fn a_window_and_a_word_make_a_number() {
        let ramp = series(10, |t| 2.0 * t);
        let take = |take, window| quantity(take, window, Measure::Absolute).of(&ramp).expect("values");
        let all = [0.0, f64::INFINITY];
        for (found, expected) in [
            (take(Take::Last, all), 2.0),
            (take(Take::Max, [0.0, 0.5]), 1.0),
            (take(Take::Min, all), 0.2),
            (take(Take::Mean, [0.2, 0.6]), 0.8),
            (take(Take::Mean, [0.35, 0.45]), 0.8),
        ] {
            assert!((found - expected).abs() < 1e-12, "{found} {expected}");
        }
    }

    #[test]
    fn a_history_is_compared_where_both_have_a_time() {
        let history = quantity(Take::History, [0.0, 1.0], Measure::Relative);
        let truth = Truth::Run(series(100, |t| 4.0 * t));
        let coarse = series(10, |t| 4.0 * t + if (t - 0.3).abs() < 0.01 { 0.5 } else { 0.01 });
        let error = history.error(&coarse, &truth).expect("times in common");
        assert!((error - 0.5 / 4.0).abs() < 1e-12, "{error}");
        let other_times = Series { times: vec![0.333], values: vec![1.0] };
        assert!(matches!(history.error(&other_times, &truth), Err(MeasureError::NoCommonTime)));
    }

    #[test]
    fn an_error_is_relative_or_absolute() {
        let value = series(4, |_| 5.5);
        let error = |measure| {
            quantity(Take::Last, [0.0, 9.0], measure).error(&value, &Truth::Value(-5.0)).expect("a number")
        };
        assert!((error(Measure::Absolute) - 10.5).abs() < 1e-12);
        assert!((error(Measure::Relative) - 2.1).abs() < 1e-12);
    }

    #[test]
    fn what_is_no_number_is_no_error() {
        let broken = series(4, |t| if t > 0.6 { f64::NAN } else { 1.0 });
        for take in [Take::Last, Take::Max, Take::Mean, Take::History] {
            let quantity = quantity(take, [0.0, 1.0], Measure::Absolute);
            let error = quantity.error(&broken, &Truth::Run(series(4, |_| 1.0)));
            assert!(matches!(error, Err(MeasureError::NotFinite)), "{take:?}");
        }
    }
}
