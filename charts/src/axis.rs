//! Logarithmic axes.

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

    /// The powers of ten on the axis, or where there are few the values 1, 2 and 5 of each decade.
    #[must_use]
    pub fn ticks(&self) -> Vec<Tick> {
        let decades = (self.high / self.low).log10();
        let steps: &[f64] = if decades < FEW_DECADES { &[1.0, 2.0, 5.0] } else { &[1.0] };
        let every = (decades / MOST_LABELS).ceil().max(1.0);
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
        assert_eq!(labels(1.0, 1.1), ["1"]);
        assert!(labels(1e-16, 1.0).len() <= 10);
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
