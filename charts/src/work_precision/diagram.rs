//! The work-precision diagram: error against CPU seconds, both on logarithmic axes.

use super::legend::Legend;
use super::{Cost, Curve, Point, cheapest};
use crate::axis::LogAxis;
use crate::style::Style;
use crate::svg::{Anchor, Colour, Dash, Svg};

/// What is drawn.
#[derive(Debug, Clone, Copy)]
pub struct Diagram<'a> {
    /// Heading.
    pub title: &'a str,
    /// What the error is of, with its unit.
    pub error: &'a str,
    /// The curves.
    pub curves: &'a [Curve],
    /// How well the reference is known, in the unit of the error.
    pub uncertainty: f64,
    /// The error that is wanted; the cheapest setting that reaches it is ringed.
    pub wanted: Option<f64>,
}

const LEAST_WIDTH: f64 = 780.0;
const LEFT: f64 = 72.0;
const RIGHT: f64 = 500.0;
const TOP: f64 = 44.0;
const BOTTOM: f64 = 380.0;
/// Below the axis and its name.
const FOOT: f64 = 44.0;
const SMALL: f64 = 11.0;
/// A reference that is known to less than this part of the smallest error stands below the drawing.
const FAR_BELOW: f64 = 0.1;

impl Diagram<'_> {
    /// The drawing as SVG text; `None` where no point has both an error and a time.
    ///
    /// Points on a floor are hollow, and the fitted law is drawn dashed through the others. Errors that the reference does not
    /// tell stand on grey.
    #[must_use]
    pub fn draw(&self) -> Option<String> {
        self.draw_over(Cost::CpuSeconds)
    }

    /// The same over what stands for the cost.
    #[must_use]
    pub fn draw_over(&self, cost: Cost) -> Option<String> {
        let points = || self.curves.iter().flat_map(|curve| &curve.points);
        let across = LogAxis::around(points().map(|point| point.cpu_seconds), [LEFT, RIGHT])?;
        let errors = points().map(|point| point.error).chain(self.wanted);
        let up = LogAxis::around(errors.chain(self.shown_uncertainty()), [BOTTOM, TOP])?;
        let legend = Legend::new(self, [RIGHT + 20.0, TOP]);
        let mut svg =
            Svg::new(legend.right().max(LEAST_WIDTH), (BOTTOM + FOOT).max(legend.bottom()), self.title);
        svg.text([LEFT, 24.0], 14.0, Anchor::Start, Colour::BLACK, self.title);
        if let Some(uncertainty) = self.shown_uncertainty() {
            let top = up.place(uncertainty);
            svg.rectangle([LEFT, top], [RIGHT - LEFT, BOTTOM - top], Colour::MIST);
        }
        frame(&mut svg, [&across, &up], [cost.axis(), self.error]);
        self.draw_wanted(&mut svg, &across, &up);
        for (index, curve) in self.curves.iter().enumerate() {
            self.draw_curve(&mut svg, &across, &up, curve, Style::of(index));
        }
        legend.draw(&mut svg);
        Some(svg.finish())
    }

    /// How well the reference is known, unless that is far below all errors.
    pub(super) fn shown_uncertainty(&self) -> Option<f64> {
        let errors = self.curves.iter().flat_map(|curve| &curve.points).map(|point| point.error);
        let smallest = errors.filter(|error| *error > 0.0).fold(f64::INFINITY, f64::min);
        Some(self.uncertainty).filter(|uncertainty| *uncertainty > FAR_BELOW * smallest)
    }

    fn draw_wanted(&self, svg: &mut Svg, across: &LogAxis, up: &LogAxis) {
        let Some(wanted) = self.wanted else { return };
        let y = up.place(wanted);
        svg.path(&[[LEFT, y], [RIGHT, y]], Colour::GREY, 1.0, Dash::Dots);
        if let Some((_, point)) = cheapest(self.curves, wanted).filter(|(_, point)| is_shown(point)) {
            svg.circle(place(across, up, point), 9.0, None, Colour::BLACK, 1.2);
        }
    }

    fn draw_curve(&self, svg: &mut Svg, across: &LogAxis, up: &LogAxis, curve: &Curve, style: Style) {
        let trend = curve.trend(self.uncertainty);
        let shown: Vec<[f64; 2]> = curve
            .points
            .iter()
            .filter(|point| is_shown(point))
            .map(|point| place(across, up, point))
            .collect();
        svg.series(&shown, &curve.name, style.colour, 1.0, style.dash);
        if let Some(fit) = trend.fit {
            let end = |error: f64| [across.place(across.clamp(fit.seconds(error))), up.place(error)];
            svg.path(&fit.errors.map(end), style.colour, 2.0, Dash::Long);
        }
        let floor = trend.floor.map_or(curve.points.len(), |floor| floor.start);
        for (index, point) in curve.points.iter().enumerate().filter(|(_, point)| is_shown(point)) {
            let fill = if index < floor { style.colour } else { Colour::WHITE };
            style.draw_mark(svg, place(across, up, point), 4.0, fill);
        }
    }
}

/// The box, its grid and its names.
fn frame(svg: &mut Svg, [across, up]: [&LogAxis; 2], [cost, error]: [&str; 2]) {
    for tick in across.ticks() {
        let x = across.place(tick.value);
        svg.path(&[[x, TOP], [x, BOTTOM]], Colour::PALE, 1.0, Dash::None);
        svg.tick([x, BOTTOM + 16.0], SMALL, Anchor::Middle, cost, &tick.label);
    }
    for tick in up.ticks() {
        let y = up.place(tick.value);
        svg.path(&[[LEFT, y], [RIGHT, y]], Colour::PALE, 1.0, Dash::None);
        svg.tick([LEFT - 6.0, y + 4.0], SMALL, Anchor::End, error, &tick.label);
    }
    svg.outline(&[[LEFT, TOP], [RIGHT, TOP], [RIGHT, BOTTOM], [LEFT, BOTTOM]], Colour::GREY, 1.0);
    let middle = [0.5 * (LEFT + RIGHT), 0.5 * (TOP + BOTTOM)];
    svg.text([middle[0], BOTTOM + 34.0], 12.0, Anchor::Middle, Colour::BLACK, cost);
    svg.text_upwards([18.0, middle[1]], 12.0, Colour::BLACK, error);
}

fn is_shown(point: &Point) -> bool {
    point.error > 0.0 && point.cpu_seconds > 0.0
}

fn place(across: &LogAxis, up: &LogAxis, point: &Point) -> [f64; 2] {
    [across.place(point.cpu_seconds), up.place(point.error)]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::legible::faults;

    fn curve(name: &str, points: &[(f64, f64)]) -> Curve {
        let point = |&(error, cpu_seconds): &(f64, f64)| Point { name: String::new(), error, cpu_seconds };
        Curve { name: name.into(), points: points.iter().map(point).collect() }
    }

    #[test]
    fn a_diagram_names_curves_slopes_and_what_is_wanted() {
        let curves = [
            curve("BDF1 & h", &[(0.1, 0.01), (0.01, 0.1), (0.001, 1.0)]),
            curve("BDF2", &[(0.1, 0.02), (0.001, 0.2), (0.0009, 0.4), (0.0, 0.8)]),
        ];
        let diagram = Diagram {
            title: "A < B",
            error: "error [-]",
            curves: &curves,
            uncertainty: 0.0,
            wanted: Some(0.02),
        };
        let svg = diagram.draw().expect("points");
        for needed in [
            "<svg ",
            "A &lt; B",
            "BDF1 &amp; h",
            "slope -1: a digit costs x 10",
            "error [-]",
            "CPU time [s]",
            "wanted: 0.02",
        ] {
            assert!(svg.contains(needed), "{needed} is not in the drawing");
        }
        assert!(!svg.contains("NaN") && !svg.contains("inf"), "{svg}");
        // The first curve is drawn with discs: its legend, three points with both numbers; the ring, and the hollow one of the
        // legend. The second curve has another mark.
        assert_eq!(svg.matches("<circle").count(), 1 + 3 + 1 + 1);
        assert!(!svg.contains("known"), "an exact reference needs no word");
        well_formed(&svg);
        assert_eq!(faults(&svg), Vec::<String>::new());
        assert_eq!(diagram.draw(), Some(svg));
    }

    #[test]
    fn diagrams_of_many_curves_and_short_ranges_can_be_read() {
        for count in [1, 8, 12] {
            for (high, late) in [(1.0001, 1.0001), (1.5, 2.0), (9.0, 11.0), (1e6, 1e3)] {
                let curves: Vec<Curve> = (0..count)
                    .map(|k| {
                        curve(
                            &format!("curve {k} of a name that is too long for one line"),
                            &[(high, 1.0), (1.0, late)],
                        )
                    })
                    .collect();
                let diagram = Diagram {
                    title: "A",
                    error: "error [-]",
                    curves: &curves,
                    uncertainty: 0.5,
                    wanted: Some(0.9),
                };
                assert_eq!(faults(&diagram.draw().expect("points")), Vec::<String>::new(), "{count}, {high}");
            }
        }
    }

    #[test]
    fn what_the_reference_does_not_tell_stands_on_grey_unless_it_is_far_below() {
        let curves = [curve("", &[(0.1, 1.0), (0.01, 10.0)])];
        let drawn = |uncertainty| {
            let diagram = Diagram { title: "", error: "", curves: &curves, uncertainty, wanted: None };
            diagram.draw().expect("points")
        };
        let [exact, far, near, above] = [0.0, 9e-4, 2e-3, 0.05].map(drawn);
        for (svg, grey) in [(&exact, 0), (&far, 0), (&near, 2), (&above, 2)] {
            assert_eq!(svg.matches("#f0f0f0").count(), grey, "{svg}");
        }
        assert!(near.contains("the reference is known to 0.002"), "{near}");
        assert!(far.contains("the reference is known to 9e-4") && !exact.contains("known"));
        well_formed(&above);
    }

    /// Every element that is opened is closed, and every attribute can be read.
    fn well_formed(svg: &str) {
        let mut reader = quick_xml::Reader::from_str(svg);
        loop {
            match reader.read_event().expect("well-formed XML") {
                quick_xml::events::Event::Eof => break,
                quick_xml::events::Event::Start(tag) | quick_xml::events::Event::Empty(tag) => {
                    assert!(tag.attributes().all(|attribute| attribute.is_ok()), "{tag:?}");
                }
                _ => {}
            }
        }
    }

    #[test]
    fn nothing_measured_is_nothing_drawn() {
        let diagram = Diagram {
            title: "",
            error: "",
            curves: &[curve("", &[(0.0, 1.0)])],
            uncertainty: 0.0,
            wanted: None,
        };
        assert_eq!(diagram.draw(), None);
    }
}
