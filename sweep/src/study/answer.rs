//! The answer of a study in words.

use std::fmt::Write as _;

use partita_charts::axis::rounded;
use partita_charts::work_precision::{Cost, Curve, FloorKind, Point, Trend, cheapest, most_accurate};

use super::Report;

impl Report {
    /// The answer: what a digit costs on each curve, and the cheapest setting that reaches the wanted error.
    #[must_use]
    pub fn answer(&self) -> String {
        let curves = self.curves();
        let mut text = String::new();
        for curve in &curves {
            line(&mut text, &format!("{}: {}", curve.name, self.trend(curve)));
        }
        if self.uncertainty > 0.0 {
            line(&mut text, &format!("the reference is known to {}", rounded(self.uncertainty, 2)));
        }
        if let Some(wanted) = self.wanted {
            line(&mut text, &self.choice(&curves, wanted));
        }
        text
    }

    /// What a digit costs on a curve, and where its error stops.
    fn trend(&self, curve: &Curve) -> String {
        let Trend { fit, floor } = curve.trend(self.uncertainty);
        let cost = match self.cost() {
            Cost::CpuSeconds => "time",
            Cost::Work => "work",
        };
        let law = fit.map(|fit| {
            format!(
                "a tenth of the error costs {} times the {cost} (from {} settings over {} digits)",
                rounded(fit.digit_factor(), 3),
                fit.points,
                rounded(fit.digits(), 2)
            )
        });
        let floor = floor.map(|floor| {
            let (from, error) = (&curve.points[floor.start].name, rounded(floor.error, 2));
            match (floor.kind, floor.start) {
                (FloorKind::OtherError, 0) => format!("refining does not change the error, {error}"),
                (FloorKind::OtherError, _) => format!("from {from} on the error no longer falls: {error}"),
                (FloorKind::Reference, 0) => format!("the reference is no better than the errors, {error}"),
                (FloorKind::Reference, _) => {
                    format!("from {from} on the reference is no better than the error: {error}")
                }
            }
        });
        let words: Vec<String> = law.into_iter().chain(floor).collect();
        if words.is_empty() {
            "too few settings tell what a digit costs".to_owned()
        } else {
            words.join("; ")
        }
    }

    fn choice(&self, curves: &[Curve], wanted: f64) -> String {
        let cost = |cost: f64| match self.cost() {
            Cost::CpuSeconds => format!("in {} s", rounded(cost, 2)),
            Cost::Work => format!("with {} unknowns solved for", rounded(cost, 2)),
        };
        let named = |curve: &Curve, point: &Point| {
            let error = rounded(point.error, 2);
            format!("{}, {}: error {error} {}", curve.name, point.name, cost(point.cpu_seconds))
        };
        let so_far = if self.interrupted { " so far" } else { "" };
        let wanted_text = rounded(wanted, 2);
        match (cheapest(curves, wanted), most_accurate(curves)) {
            (Some((curve, point)), _) => {
                format!("cheapest setting{so_far} that reaches {wanted_text}: {}", named(curve, point))
            }
            (None, Some((curve, point))) => {
                format!(
                    "no setting{so_far} reaches {wanted_text}; the most accurate is {}",
                    named(curve, point)
                )
            }
            (None, None) => "no setting could be run".to_owned(),
        }
    }
}

fn line(text: &mut String, words: &str) {
    writeln!(text, "{words}").expect("a String takes any text");
}
