//! Curves over one common axis, in one panel or several below each other, with the legend beside them.

use crate::axis::{LinearAxis, LogAxis, Tick, rounded};
use crate::style::Style;
use crate::svg::{Anchor, Colour, Dash, Svg};
use crate::text;

/// What is drawn.
#[derive(Debug, Clone, PartialEq)]
pub struct Plot {
    /// Heading.
    pub title: String,
    /// What is drawn to the right, with its unit.
    pub across: String,
    /// Whether both axes are logarithmic.
    pub is_logarithmic: bool,
    /// Whether points are marked.
    pub has_marks: bool,
    /// Names of the series; a series has one look in all panels.
    pub series: Vec<String>,
    /// The panels, the upper one first.
    pub panels: Vec<Panel>,
    /// What the dashed lines of the panels are, if there are any.
    pub rules: Option<String>,
    /// What the bands of the panels are, if there are any.
    pub bands: Option<String>,
}

/// One panel.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Panel {
    /// What is drawn upwards, with its unit.
    pub up: String,
    /// The points of each series, in the order of their names.
    pub curves: Vec<Vec<[f64; 2]>>,
    /// Values that are marked by a dashed line, with what is written at its end.
    pub rules: Vec<(f64, String)>,
    /// A range of values that lies behind the curves.
    pub band: Option<[f64; 2]>,
}

const LEFT: f64 = 72.0;
const WIDTH: f64 = 500.0;
const HEAD: f64 = 40.0;
const FOOT: f64 = 46.0;
const GAP: f64 = 22.0;
/// Height of a panel that stands alone, and of one among others.
const ALONE: f64 = 320.0;
const AMONG: f64 = 130.0;
const SMALL: f64 = 11.0;
/// Lines of the legend.
const LINE: f64 = 16.0;
const SAMPLE: f64 = 24.0;
const WORDS: f64 = 32.0;
const MOST_WORDS: f64 = 250.0;
/// Least distance of the words at the ends of dashed lines.
const APART: f64 = 13.0;

enum Axis {
    Linear(LinearAxis),
    Log(LogAxis),
}

impl Axis {
    fn around(is_logarithmic: bool, values: impl Iterator<Item = f64>, places: [f64; 2]) -> Option<Self> {
        if is_logarithmic {
            LogAxis::around(values, places).map(Self::Log)
        } else {
            LinearAxis::around(values, places).map(Self::Linear)
        }
    }

    fn place(&self, value: f64) -> f64 {
        match self {
            Self::Linear(axis) => axis.place(value),
            Self::Log(axis) => axis.place(axis.clamp(value)),
        }
    }

    fn ticks(&self, most: usize) -> Vec<Tick> {
        match self {
            Self::Linear(axis) => axis.ticks(most),
            Self::Log(axis) => axis.ticks(),
        }
    }
}

impl Plot {
    /// The drawing as SVG text; `None` if there is no point to draw.
    #[must_use]
    pub fn draw(&self) -> Option<String> {
        let height = if self.panels.len() == 1 { ALONE } else { AMONG };
        let points = || self.panels.iter().flat_map(|panel| panel.curves.iter().flatten());
        let across = Axis::around(self.is_logarithmic, points().map(|[x, _]| *x), [LEFT, LEFT + WIDTH])?;
        let right = LEFT + WIDTH + self.words_of_rules();
        let legend = self.legend();
        let widest = legend.iter().flat_map(|(_, lines)| lines).map(|line| text::width(line, SMALL));
        let bottom = HEAD + self.panels.len() as f64 * (height + GAP) - GAP + FOOT;
        let lines: usize = legend.iter().map(|(_, lines)| lines.len()).sum();
        let sheet_width = (right + WORDS + widest.fold(0.0, f64::max) + 12.0)
            .max(LEFT + text::width(&self.title, 14.0) + 12.0);
        let sheet_height = bottom.max(HEAD + lines as f64 * LINE + 12.0);
        let mut svg = Svg::new(sheet_width, sheet_height, &self.title);
        svg.text([LEFT, 24.0], 14.0, Anchor::Start, Colour::BLACK, &self.title);
        for (index, panel) in self.panels.iter().enumerate() {
            let top = HEAD + index as f64 * (height + GAP);
            let is_last = index + 1 == self.panels.len();
            self.draw_panel(&mut svg, panel, &across, [top, top + height], is_last)?;
        }
        self.draw_legend(&mut svg, [right, HEAD], &legend);
        Some(svg.finish())
    }

    /// Room for what is written at the ends of dashed lines.
    fn words_of_rules(&self) -> f64 {
        let words = self.panels.iter().flat_map(|panel| &panel.rules).map(|(_, words)| words);
        words.map(|words| text::width(words, SMALL)).fold(0.0, f64::max) + 20.0
    }

    fn draw_panel(
        &self,
        svg: &mut Svg,
        panel: &Panel,
        across: &Axis,
        [top, bottom]: [f64; 2],
        is_last: bool,
    ) -> Option<()> {
        let [left, right] = [LEFT, LEFT + WIDTH];
        let values = panel.curves.iter().flatten().map(|[_, y]| *y);
        let marked = panel.rules.iter().map(|(value, _)| *value).chain(panel.band.into_iter().flatten());
        let up = Axis::around(self.is_logarithmic, values.chain(marked), [bottom, top])?;
        if let Some([low, high]) = panel.band {
            let [low, high] = [low, high].map(|value| up.place(value));
            svg.rectangle([left, high], [right - left, low - high], Colour::MIST);
        }
        for tick in across.ticks(9) {
            let x = across.place(tick.value);
            svg.path(&[[x, top], [x, bottom]], Colour::PALE, 1.0, Dash::None);
            if is_last {
                svg.tick([x, bottom + 16.0], SMALL, Anchor::Middle, &self.across, &tick.label);
            }
        }
        for tick in up.ticks(5) {
            let y = up.place(tick.value);
            svg.path(&[[left, y], [right, y]], Colour::PALE, 1.0, Dash::None);
            svg.tick([left - 6.0, y + 4.0], SMALL, Anchor::End, &panel.up, &tick.label);
        }
        svg.outline(&[[left, top], [right, top], [right, bottom], [left, bottom]], Colour::GREY, 1.0);
        draw_rules(svg, panel, &up);
        self.draw_curves(svg, panel, across, &up);
        svg.text_upwards([18.0, 0.5 * (top + bottom)], 12.0, Colour::BLACK, &panel.up);
        if is_last {
            let middle = [0.5 * (left + right), bottom + 34.0];
            svg.text(middle, 12.0, Anchor::Middle, Colour::BLACK, &self.across);
        }
        Some(())
    }

    fn draw_curves(&self, svg: &mut Svg, panel: &Panel, across: &Axis, up: &Axis) {
        for (index, (curve, name)) in panel.curves.iter().zip(&self.series).enumerate() {
            let style = Style::of(index);
            let finite = curve.iter().filter(|[x, y]| x.is_finite() && y.is_finite());
            let places: Vec<[f64; 2]> = finite.map(|[x, y]| [across.place(*x), up.place(*y)]).collect();
            svg.series(&places, name, style.colour, Style::width(index, self.series.len()), style.dash);
            if self.has_marks {
                for place in places {
                    style.draw_mark(svg, place, 3.5, style.colour);
                }
            }
        }
    }

    /// What the legend says, on lines that fit.
    fn legend(&self) -> Vec<(Sign, Vec<String>)> {
        let series = self.series.iter().enumerate().map(|(index, name)| (Sign::Series(index), name));
        let rules = self.rules.iter().map(|words| (Sign::Rule, words));
        let bands = self.bands.iter().map(|words| (Sign::Band, words));
        let entries = series.chain(rules).chain(bands);
        entries.map(|(sign, words)| (sign, text::lines(words, SMALL, MOST_WORDS))).collect()
    }

    fn draw_legend(&self, svg: &mut Svg, [left, top]: [f64; 2], entries: &[(Sign, Vec<String>)]) {
        let mut y = top + SMALL;
        for (sign, lines) in entries {
            let middle = y - 4.0;
            let sample = [[left, middle], [left + SAMPLE, middle]];
            match *sign {
                Sign::Series(index) => {
                    let style = Style::of(index);
                    let width = Style::width(index, self.series.len());
                    svg.series(&sample, &self.series[index], style.colour, width, style.dash);
                    if self.has_marks {
                        style.draw_mark(svg, [left + 0.5 * SAMPLE, middle], 3.5, style.colour);
                    }
                }
                Sign::Rule => svg.path(&sample, Colour::GREY, 1.2, Dash::Long),
                Sign::Band => svg.rectangle([left, middle - 5.0], [SAMPLE, 10.0], Colour::MIST),
            }
            for line in lines {
                svg.text([left + WORDS, y], SMALL, Anchor::Start, Colour::BLACK, line);
                y += LINE;
            }
        }
    }
}

#[derive(Debug, Clone, Copy)]
enum Sign {
    Series(usize),
    Rule,
    Band,
}

/// Dashed lines, their words pushed apart where the lines are close.
fn draw_rules(svg: &mut Svg, panel: &Panel, up: &Axis) {
    let mut rules: Vec<(f64, &str)> =
        panel.rules.iter().map(|(value, words)| (up.place(*value), words.as_str())).collect();
    rules.sort_by(|one, other| one.0.total_cmp(&other.0));
    let mut free = f64::NEG_INFINITY;
    for (y, words) in rules {
        svg.path(&[[LEFT, y], [LEFT + WIDTH, y]], Colour::GREY, 1.2, Dash::Long);
        let line = (y + 4.0).max(free);
        svg.text([LEFT + WIDTH + 5.0, line], SMALL, Anchor::Start, Colour::GREY, words);
        free = line + APART;
    }
}

/// `12 %`.
#[must_use]
pub fn percent(value: f64) -> String {
    format!("{} %", rounded(value, 3))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::legible::faults;

    fn plot(series: usize, panels: usize, is_logarithmic: bool) -> Plot {
        let curve = |k: usize| (1..20).map(|i| [f64::from(i), 1.0 + (k + 1) as f64 / f64::from(i)]).collect();
        let panel = Panel {
            up: "error [%]".into(),
            curves: (0..series).map(curve).collect(),
            rules: vec![(2.0, percent(2.0)), (2.01, percent(2.01)), (6.0, percent(6.0))],
            band: Some([1.5, 3.0]),
        };
        let up = |k: usize| format!("signal {k} [N/m]");
        Plot {
            title:
                "A < B, a title that is much longer than the panel below it would ever want to be, and longer"
                    .into(),
            across: "unknowns".into(),
            is_logarithmic,
            has_marks: true,
            series: (0..series).map(|k| format!("quantity {k} with many words in its name [mm]")).collect(),
            panels: (0..panels).map(|k| Panel { up: up(k), ..panel.clone() }).collect(),
            rules: Some("target".into()),
            bands: Some("reference: mean and amplitude".into()),
        }
    }

    #[test]
    fn plots_of_any_size_can_be_read() {
        for series in [1, 3, 8, 20] {
            for panels in [1, 2, 4] {
                for is_logarithmic in [false, true] {
                    let plot = plot(series, panels, is_logarithmic);
                    let svg = plot.draw().expect("points");
                    assert_eq!(faults(&svg), Vec::<String>::new(), "{series} series, {panels} panels");
                    assert!(!svg.contains("NaN") && svg.contains("A &lt; B"));
                    assert_eq!(plot.draw(), Some(svg));
                }
            }
        }
    }

    #[test]
    fn axes_of_short_ranges_have_ticks_too() {
        for high in [1.001, 1.3, 3.0, 12.0, 90.0, 4e5] {
            for is_logarithmic in [false, true] {
                let mut plot = plot(1, 1, is_logarithmic);
                plot.panels[0] = Panel {
                    up: "y".into(),
                    curves: vec![vec![[1.0, 1.0], [high, high]]],
                    ..Panel::default()
                };
                assert_eq!(faults(&plot.draw().expect("points")), Vec::<String>::new(), "1 to {high}");
            }
        }
    }

    #[test]
    fn nothing_to_show_is_nothing_drawn() {
        assert_eq!(Plot { panels: vec![Panel::default()], ..plot(1, 1, false) }.draw(), None);
    }
}
