//! Error against cost: what was measured, what a further digit costs, and which setting is the cheapest.

mod diagram;
mod legend;
mod trend;

pub use diagram::Diagram;
pub use trend::{Fit, Floor, FloorKind, Trend};

/// One setting: what it cost and how far it is from the truth.
#[derive(Debug, Clone, PartialEq)]
pub struct Point {
    /// What was set.
    pub name: String,
    /// Distance from the truth, zero or above.
    pub error: f64,
    /// Processor time \[s\], or what else stands for the cost, see [`Cost`].
    pub cpu_seconds: f64,
}

/// What stands for the cost of a setting.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Cost {
    /// Processor time \[s\].
    CpuSeconds,
    /// Unknowns times Newton iterations, where no time was measured.
    Work,
}

impl Cost {
    /// The name of the axis.
    pub(crate) fn axis(self) -> &'static str {
        match self {
            Self::CpuSeconds => "CPU time [s]",
            Self::Work => "unknowns times Newton iterations",
        }
    }
}

/// Settings of one kind, from the coarsest to the finest.
#[derive(Debug, Clone, PartialEq)]
pub struct Curve {
    /// What they have in common.
    pub name: String,
    /// The settings.
    pub points: Vec<Point>,
}

impl Curve {
    /// How the error falls as more is spent, told by a reference that is itself known to `uncertainty`.
    #[must_use]
    pub fn trend(&self, uncertainty: f64) -> Trend {
        Trend::of(&self.points, uncertainty)
    }
}

/// The setting that reaches the wanted error in the least time, and its curve.
#[must_use]
pub fn cheapest(curves: &[Curve], wanted: f64) -> Option<(&Curve, &Point)> {
    all_points(curves)
        .filter(|(_, point)| point.error <= wanted)
        .min_by(|(_, one), (_, other)| one.cpu_seconds.total_cmp(&other.cpu_seconds))
}

/// The setting with the smallest error, and its curve.
#[must_use]
pub fn most_accurate(curves: &[Curve]) -> Option<(&Curve, &Point)> {
    all_points(curves).min_by(|(_, one), (_, other)| one.error.total_cmp(&other.error))
}

fn all_points(curves: &[Curve]) -> impl Iterator<Item = (&Curve, &Point)> {
    curves.iter().flat_map(|curve| curve.points.iter().map(move |point| (curve, point)))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn curve(name: &str, points: &[(f64, f64)]) -> Curve {
        let point = |&(error, cpu_seconds): &(f64, f64)| Point { name: String::new(), error, cpu_seconds };
        Curve { name: name.into(), points: points.iter().map(point).collect() }
    }

    #[test]
    fn the_cheapest_setting_reaches_the_error_and_no_other_does_for_less() {
        let curves =
            [curve("first", &[(0.1, 1.0), (0.01, 10.0)]), curve("second", &[(0.05, 2.0), (0.009, 8.0)])];
        let found =
            |wanted| cheapest(&curves, wanted).map(|(curve, point)| (curve.name.as_str(), point.error));
        assert_eq!(found(0.2), Some(("first", 0.1)));
        assert_eq!(found(0.01), Some(("second", 0.009)));
        assert_eq!(found(1e-3), None);
        assert_eq!(most_accurate(&curves).map(|(curve, _)| curve.name.as_str()), Some("second"));
        assert_eq!(most_accurate(&[]), None);
    }
}
