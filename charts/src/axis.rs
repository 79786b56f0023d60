//! Axes: places of values, and ticks, at least three on each.

/// A logarithmic axis: values between `low` and `high`, places between `start` and `end` \[pixels\].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LogAxis {
    low: f64,
    high: f64,
    start: f64,
    end: f64,
}

/// A value that an axis marks.
#[derive(Debug, Clone, PartialEq)]
pub struct Tick {
    /// The value.
    pub value: f64,
    /// What is written beside it.
    pub label: String,
}

/// Fewer decades than these are marked at 2 and 5, too.
const FEW_DECADES: f64 = 2.0;
/// Labels that an axis has room for.
const MOST_LABELS: f64 = 9.0;
/// Labels between which a short axis is cut evenly.
const FEW_LABELS: usize = 5;
/// An axis with fewer ticks tells no scale.
const FEWEST_TICKS: usize = 3;

impl LogAxis {
    /// An axis that shows all `values` with a margin, at least a factor of two; what is not positive and finite is not
    /// shown. `None` where nothing is left.
    #[must_use]
    pub fn around(values: impl IntoIterator<Item = f64>, [start, end]: [f64; 2]) -> Option<Self> {
        let shown = values.into_iter().filter(|value| *value > 0.0 && value.is_finite());
        let (low, high) =
            shown.fold((f64::INFINITY, 0.0_f64), |(low, high), value| (low.min(value), high.max(value)));
        if low > high {
            return None;
        }
        let margin = (0.06 * (high / low).ln()).exp().max(1.25);
        Some(Self { low: low / margin, high: high * margin, start, end })
    }

    /// Where a value stands.
    #[must_use]
    pub fn place(&self, value: f64) -> f64 {
        let part = (value / self.low).ln() / (self.high / self.low).ln();
        self.start + part * (self.end - self.start)
    }

    /// The value, moved onto the axis where it lies outside.
    #[must_use]
    pub fn clamp(&self, value: f64) -> f64 {
        value.clamp(self.low, self.high)
    }

    /// The powers of ten on the axis, or where there are few the values 1, 2 and 5 of each decade; where the axis spans
    /// hardly more than one of these, round values of equal distance.
    #[must_use]
    pub fn ticks(&self) -> Vec<Tick> {
        let decades = (self.high / self.low).log10();
        let every = (decades / MOST_LABELS).ceil().max(1.0);
        let steps: &[f64] = if decades < FEW_DECADES { &[1.0, 2.0, 5.0] } else { &[1.0] };
        let ticks = self.ticks_of(steps, every);
        if ticks.len() >= FEWEST_TICKS {
            return ticks;
        }
        let ticks = self.ticks_of(&[1.0, 2.0, 5.0], 1.0);
        if ticks.len() >= FEWEST_TICKS { ticks } else { round_values(self.low, self.high, FEW_LABELS) }
    }

    /// These multiples of every so manieth power of ten.
    fn ticks_of(&self, steps: &[f64], every: f64) -> Vec<Tick> {
        let mut ticks = Vec::new();
        let mut decade = (self.low.log10() / every).floor() * every;
        while decade <= self.high.log10() {
            for step in steps {
                // Through text: the power function may miss the number by a bit.
                let value: f64 = format!("{step}e{decade}").parse().unwrap_or(f64::NAN);
                if (self.low..=self.high).contains(&value) {
                    ticks.push(Tick { value, label: number(value) });
                }
            }
            decade += every;
        }
        ticks
    }
}

/// A linear axis: values between `low` and `high`, places between `start` and `end` \[pixels\].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LinearAxis {
    low: f64,
    high: f64,
    start: f64,
    end: f64,
}

impl LinearAxis {
    /// An axis that shows all `values` with a margin; what is not finite is not shown. `None` if nothing is left.
    #[must_use]
    pub fn around(values: impl IntoIterator<Item = f64>, places: [f64; 2]) -> Option<Self> {
        let [low, high] = range(values)?;
        // A constant has room on both sides, so that its axis has ticks.
        let margin = if high > low { 0.1 * (high - low) } else { 0.1 * high.abs().max(1.0) };
        Some(Self { low: low - margin, high: high + margin, start: places[0], end: places[1] })
    }

    /// An axis from the smallest value to the largest, without a margin.
    #[must_use]
    pub fn over(low: f64, high: f64, [start, end]: [f64; 2]) -> Self {
        Self { low, high, start, end }
    }

    /// Where a value stands.
    #[must_use]
    pub fn place(&self, value: f64) -> f64 {
        self.start + (value - self.low) / (self.high - self.low) * (self.end - self.start)
    }

    /// Round values of equal distance, at most `most`, or three if that is less.
    #[must_use]
    pub fn ticks(&self, most: usize) -> Vec<Tick> {
        round_values(self.low, self.high, most)
    }
}

/// Smallest and largest of the values that are finite.
fn range(values: impl IntoIterator<Item = f64>) -> Option<[f64; 2]> {
    let finite = values.into_iter().filter(|value| value.is_finite());
    let [low, high] = finite
        .fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], value| [low.min(value), high.max(value)]);
    (low <= high).then_some([low, high])
}

/// The multiples of 1, 2 or 5 times a power of ten between two numbers: of the coarsest such step that gives at least three
/// and at most `most` of them, or of the next finer one.
fn round_values(low: f64, high: f64, most: usize) -> Vec<Tick> {
    let mut exponent = (high - low).log10().ceil();
    let mut best = Vec::new();
    for _ in 0..4 {
        for digit in [5.0, 2.0, 1.0] {
            let ticks = multiples(low, high, digit, exponent);
            if ticks.len() > most && best.len() >= FEWEST_TICKS {
                return best;
            }
            best = ticks;
        }
        exponent -= 1.0;
    }
    best
}

/// The multiples of `digit` times ten to the `exponent` in a range.
fn multiples(low: f64, high: f64, digit: f64, exponent: f64) -> Vec<Tick> {
    let step: f64 = format!("{digit}e{exponent}").parse().unwrap_or(f64::NAN);
    let mut ticks = Vec::new();
    let mut count = (low / step).ceil();
    while count * step <= high {
        // Through text: 3 times 0.1 is 0.30000000000000004, and no number is -0.
        let value: f64 = format!("{}e{exponent}", count * digit + 0.0).parse().unwrap_or(f64::NAN);
        ticks.push(Tick { value, label: number(value) });
        count += 1.0;
    }
    ticks
}

/// A number of few digits as people write it: `0.02`, `500`, `2e-7`.
#[must_use]
pub fn number(value: f64) -> String {
    if value == 0.0 || (1e-3..1e5).contains(&value.abs()) { format!("{value}") } else { format!("{value:e}") }
}

/// A number cut to `digits` significant ones, as people write it: `0.0214`, `3.2`, `120`, `2.1e-7`.
#[must_use]
pub fn rounded(value: f64, digits: usize) -> String {
    let short = format!("{value:.*e}", digits.saturating_sub(1));
    short.parse().map_or(short, number)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn labels(low: f64, high: f64) -> Vec<String> {
        let axis = LogAxis::around([low, high], [0.0, 100.0]).expect("two values");
        axis.ticks().into_iter().map(|tick| tick.label).collect()
    }

    #[test]
    fn many_decades_are_marked_at_powers_of_ten_and_few_in_between() {
        assert_eq!(labels(0.02, 70.0), ["0.1", "1", "10", "100"]);
        assert_eq!(labels(1e-4, 9e-4), ["1e-4", "2e-4", "5e-4", "0.001"]);
        assert_eq!(labels(1.0, 1.1), ["0.8", "1", "1.2"]);
        assert_eq!(labels(1000.0, 50_000.0), ["1000", "2000", "5000", "10000", "20000", "50000"]);
        assert!(labels(1e-16, 1.0).len() <= 10);
    }

    #[test]
    fn every_axis_has_three_ticks_or_more_and_not_too_many() {
        for power in -12..=12 {
            for span in 1..300 {
                let low = 1.7 * 10_f64.powi(power);
                let high = low * (1.0 + 0.03 * f64::from(span) * f64::from(span));
                let axis = LogAxis::around([low, high], [0.0, 400.0]).expect("two values");
                let count = axis.ticks().len();
                assert!((3..=10).contains(&count), "{count} from {low} to {high}");
                for axis in [
                    LinearAxis::around([low, high], [0.0, 400.0]).expect("two values"),
                    LinearAxis::around([-low, high], [0.0, 400.0]).expect("two values"),
                    LinearAxis::around([low], [0.0, 400.0]).expect("a value"),
                ] {
                    let count = axis.ticks(6).len();
                    assert!((3..=8).contains(&count), "{count} from {low} to {high}");
                }
            }
        }
    }

    #[test]
    fn ticks_of_a_linear_axis_are_round_and_zero_has_no_sign() {
        let labels = |low, high, most| -> Vec<String> {
            LinearAxis::over(low, high, [0.0, 1.0]).ticks(most).into_iter().map(|tick| tick.label).collect()
        };
        assert_eq!(labels(-0.19, 0.31, 9), ["-0.1", "0", "0.1", "0.2", "0.3"]);
        assert_eq!(labels(404.0, 490.0, 5), ["420", "440", "460", "480"]);
        assert_eq!(labels(-250.0, 250.0, 5), ["-200", "-100", "0", "100", "200"]);
        assert_eq!(labels(0.0, 1.0, 3), ["0", "0.5", "1"]);
        assert_eq!(LinearAxis::around([f64::NAN], [0.0, 1.0]), None);
        let axis = LinearAxis::over(2.0, 4.0, [300.0, 0.0]);
        assert!((axis.place(3.0) - 150.0).abs() < 1e-9);
    }

    #[test]
    fn values_stand_between_the_ends_in_their_order() {
        let axis = LogAxis::around([1.0, f64::NAN, 0.0, 100.0, -3.0], [300.0, 0.0]).expect("two are shown");
        assert!((axis.place(10.0) - 150.0).abs() < 1e-9);
        assert!(axis.place(1.0) < 300.0 && axis.place(1.0) > axis.place(100.0) && axis.place(100.0) > 0.0);
        assert!((axis.place(axis.clamp(1e9)) - 0.0).abs() < 1e-9);
        assert_eq!(LogAxis::around([0.0, -1.0], [0.0, 1.0]), None);
    }

    #[test]
    fn numbers_are_short() {
        let cut = |value| rounded(value, 2);
        assert_eq!([0.02137, 3.24, 118.0, 2.14e-7, 0.0].map(cut), ["0.021", "3.2", "120", "2.1e-7", "0"]);
        assert_eq!(number(1e5), "1e5");
    }
}
