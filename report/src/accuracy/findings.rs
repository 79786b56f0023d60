//! What the rows of a study tell: curves, laws, the cheapest setting, and how loose a tolerance may be.

use partita_charts::work_precision::{Curve, Diagram, Fit, Floor, Point, Trend};

use super::row::Row;
use super::study::Study;

/// A tolerance moves the answer where it adds more than this part of the error that steps and elements leave anyway.
pub(super) const MOVES: f64 = 0.1;
/// A law for the summary rests on as many settings at least; two of them fit any.
pub(super) const FIRM: usize = 3;

/// A study and what came of it.
pub(super) struct Findings {
    pub(super) study: Study,
    /// Its settings.
    pub(super) rows: Vec<Row>,
    /// Settings of other studies whose errors remain beside the ones here.
    pub(super) beside: Vec<Row>,
}

/// The loosest setting of a curve that does not move the answer, and the tightest one.
pub(super) struct Loosest<'a> {
    pub(super) choice: &'a str,
    /// `None` where even the tightest setting moves it.
    pub(super) row: Option<&'a Row>,
    pub(super) tightest: &'a Row,
}

impl Findings {
    /// Picks the rows of a study, and those beside it, from all.
    pub(super) fn new(study: Study, all: &[Row]) -> Self {
        let rows = all.iter().filter(|row| row.study == study.name).cloned().collect();
        let named = |title: &String| all.iter().find(|row| row.title() == *title).cloned();
        let beside = study.beside.iter().filter_map(named).collect();
        Self { study, rows, beside }
    }

    /// Where its picture stands, from `docs/`.
    pub(super) fn picture(&self) -> String {
        format!("figures/accuracy-{}.svg", self.study.name)
    }

    pub(super) fn uncertainty(&self) -> f64 {
        self.rows.first().map_or(0.0, |row| row.uncertainty)
    }

    /// The names of the choices, in their order.
    pub(super) fn choices(&self) -> Vec<&str> {
        let mut names: Vec<&str> = self.rows.iter().map(|row| row.choice.as_str()).collect();
        names.dedup();
        names
    }

    /// The settings of a choice that ran.
    pub(super) fn ran<'a>(&'a self, choice: &'a str) -> impl Iterator<Item = &'a Row> + 'a {
        self.rows.iter().filter(move |row| row.choice == choice && row.error.is_some())
    }

    pub(super) fn curve(&self, choice: &str) -> Curve {
        let point = |row: &Row| {
            let (error, cpu_seconds) = (row.error?, row.cpu_seconds?);
            Some(Point { name: row.setting.clone(), error, cpu_seconds })
        };
        Curve { name: choice.to_owned(), points: self.ran(choice).filter_map(point).collect() }
    }

    pub(super) fn curves(&self) -> Vec<Curve> {
        self.choices().into_iter().map(|choice| self.curve(choice)).collect()
    }

    pub(super) fn trend(&self, choice: &str) -> Trend {
        self.curve(choice).trend(self.uncertainty())
    }

    /// Whether a row lies where the error of its curve has stopped falling.
    pub(super) fn is_on_floor(&self, row: &Row) -> bool {
        let place = self.ran(&row.choice).position(|other| other == row);
        let floor = self.trend(&row.choice).floor;
        matches!((place, floor), (Some(place), Some(Floor { start, .. })) if place >= start)
    }

    /// The laws that rest on enough settings for the summary, with the names of their choices.
    pub(super) fn firm_laws(&self) -> Vec<(&str, Fit)> {
        let law = |choice| Some((choice, self.trend(choice).fit.filter(|fit| fit.points >= FIRM)?));
        self.choices().into_iter().filter_map(law).collect()
    }

    /// The setting that reaches the wanted error in the least time.
    pub(super) fn cheapest(&self) -> Option<&Row> {
        let reaches = |row: &&Row| row.error.is_some_and(|error| error <= self.study.wanted);
        let seconds = |row: &Row| row.cpu_seconds.unwrap_or(f64::INFINITY);
        self.rows.iter().filter(reaches).min_by(|a, b| seconds(a).total_cmp(&seconds(b)))
    }

    /// The setting with the smallest error.
    pub(super) fn most_accurate(&self) -> Option<&Row> {
        let error = |row: &Row| row.error.unwrap_or(f64::INFINITY);
        self.rows.iter().filter(|row| row.error.is_some()).min_by(|a, b| error(a).total_cmp(&error(b)))
    }

    /// The largest error that does not move the answer; `None` where no error stands beside.
    pub(super) fn harmless(&self) -> Option<f64> {
        let least = self.beside.iter().filter_map(|row| row.error).fold(f64::INFINITY, f64::min);
        Some(MOVES * least).filter(|bound| bound.is_finite())
    }

    /// For each choice the loosest setting from which on no error is above `bound`.
    pub(super) fn loosest(&self, bound: f64) -> Vec<Loosest<'_>> {
        let of = |choice| {
            let rows: Vec<&Row> = self.ran(choice).collect();
            let tightest = *rows.last()?;
            let calm = |row: &&&Row| row.error.is_some_and(|error| error <= bound);
            let row = rows.iter().rev().take_while(calm).last().copied();
            Some(Loosest { choice, row, tightest })
        };
        self.choices().into_iter().filter_map(of).collect()
    }

    /// The work-precision diagram, if anything was measured.
    pub(super) fn diagram(&self) -> Option<String> {
        let diagram = Diagram {
            title: &self.study.title,
            error: &self.study.error_of(),
            curves: &self.curves(),
            uncertainty: self.uncertainty(),
            wanted: Some(self.study.wanted),
        };
        diagram.draw()
    }
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;
    use crate::accuracy::row::tests::row;

    pub(crate) const STUDY: &str = "title = \"Made: steps\"\nremark = \"Made data.\"\nscene = \"../scenes/made\"\n\
                         wanted = 0.01\nbeside = [\"other, A, coarse\"]\n[quantity]\nname = \"tip\"\n";

    /// Error dt at a cost 1/dt^2, and a tolerance that stops at 2e-4; another study leaves 0.05.
    pub(crate) fn made() -> Findings {
        let steps = [(0.1, 0.01), (0.05, 0.04), (0.025, 0.16), (0.0125, 0.64)];
        let tight = [(0.02, 1.0), (2e-3, 1.1), (2.1e-4, 1.2), (2e-4, 1.3)];
        let curve = |choice: &'static str, points: [(f64, f64); 4]| {
            points.into_iter().enumerate().map(move |(index, (error, seconds))| {
                row("made", choice, &format!("level {index}"), error, seconds)
            })
        };
        let mut rows: Vec<Row> = curve("steps", steps).chain(curve("tolerance", tight)).collect();
        rows.push(row("other", "A", "coarse", 0.05, 1.0));
        let study: Study = toml::from_str(STUDY).expect("a study");
        Findings::new(Study { name: "made".to_owned(), ..study }, &rows)
    }

    /// The error falls by ten where the time grows by a hundred: slope -1/2, and 10^(1/|slope|) = 100.
    #[test]
    fn a_digit_costs_ten_to_the_inverse_of_the_slope() {
        let fit = made().trend("steps").fit.expect("a law");
        assert!((fit.slope() + 0.5).abs() < 1e-12, "{}", fit.slope());
        let cost = 10_f64.powf(1.0 / fit.slope().abs());
        assert!((cost - 100.0).abs() < 1e-9 && (fit.digit_factor() - cost).abs() < 1e-9, "{cost}");
    }

    #[test]
    fn a_floor_is_known_row_by_row_and_is_in_no_law() {
        let found = made();
        let floor: Vec<&str> =
            found.rows.iter().filter(|row| found.is_on_floor(row)).map(|row| row.setting.as_str()).collect();
        assert_eq!(floor, ["level 2", "level 3"]);
        let laws: Vec<&str> = found.firm_laws().into_iter().map(|(choice, _)| choice).collect();
        assert_eq!(laws, ["steps"], "two settings fit any law");
    }

    #[test]
    fn the_loosest_setting_is_one_from_which_on_nothing_moves() {
        let found = made();
        let bound = found.harmless().expect("an error beside");
        assert!((bound - 5e-3).abs() < 1e-15);
        let loosest = found.loosest(bound);
        let names: Vec<Option<&str>> =
            loosest.iter().map(|found| found.row.map(|row| row.setting.as_str())).collect();
        assert_eq!(names, [None, Some("level 1")]);
        assert_eq!(loosest[0].tightest.setting, "level 3");
        // A setting that happens to be good before a bad one does not count.
        let mut uneven = made();
        uneven.rows[6].error = Some(0.02);
        assert_eq!(uneven.loosest(bound)[1].row.map(|row| row.setting.as_str()), Some("level 3"));
    }

    #[test]
    fn the_cheapest_setting_reaches_the_wanted_error() {
        let found = made();
        assert_eq!(found.cheapest().map(Row::title), Some("made, tolerance, level 1".to_owned()));
        assert_eq!(found.most_accurate().map(Row::title), Some("made, tolerance, level 3".to_owned()));
        assert!(found.diagram().expect("points").contains("slope -0.5: a digit costs x 100"));
    }
}
