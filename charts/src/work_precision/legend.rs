//! What stands beside the diagram: the curves with their laws, and what the other signs mean.

use super::{Diagram, Fit};
use crate::axis::rounded;
use crate::style::Style;
use crate::svg::{Anchor, Colour, Dash, Svg};
use crate::text;

/// Width of a line.
const MOST: f64 = 218.0;
const NAME: f64 = 12.0;
const SMALL: f64 = 11.0;
/// From a line of an entry to the next, and what an entry leaves free below itself.
const LINE: f64 = 14.0;
const GAP: f64 = 7.0;
/// Length of a sample, and where its words begin.
const SAMPLE: f64 = 24.0;
const WORDS: f64 = 32.0;

/// The entries, in their order.
pub(super) struct Legend {
    corner: [f64; 2],
    entries: Vec<Entry>,
}

struct Entry {
    sign: Sign,
    /// In black.
    name: Vec<String>,
    /// In grey, below.
    note: String,
}

#[derive(Clone, Copy)]
enum Sign {
    /// Of the curve with this number.
    Curve(usize),
    Law,
    Floor,
    Wanted,
    /// Known too little.
    Grey,
    Nothing,
}

impl Legend {
    /// The legend of a diagram; `corner` is its upper left one.
    pub(super) fn new(diagram: &Diagram<'_>, corner: [f64; 2]) -> Self {
        let mut entries = Vec::new();
        for (index, curve) in diagram.curves.iter().enumerate() {
            let fit = curve.trend(diagram.uncertainty).fit;
            let note = fit.as_ref().map_or_else(|| "no law".to_owned(), law);
            entries.push(Entry {
                sign: Sign::Curve(index),
                name: text::lines(&curve.name, NAME, MOST),
                note,
            });
        }
        let mut note =
            |sign, note: &str| entries.push(Entry { sign, name: Vec::new(), note: note.to_owned() });
        note(Sign::Law, "fitted law");
        note(Sign::Floor, "not fitted: the error has stopped falling");
        if let Some(wanted) = diagram.wanted {
            note(Sign::Wanted, &format!("wanted: {}; ringed: cheapest", rounded(wanted, 2)));
        }
        if diagram.uncertainty > 0.0 {
            let sign = diagram.shown_uncertainty().map_or(Sign::Nothing, |_| Sign::Grey);
            note(sign, &format!("the reference is known to {}", rounded(diagram.uncertainty, 2)));
        }
        Self { corner, entries }
    }

    /// Where it ends.
    pub(super) fn bottom(&self) -> f64 {
        self.corner[1] + self.entries.iter().map(Entry::height).sum::<f64>()
    }

    /// Where its widest line ends, with a margin.
    pub(super) fn right(&self) -> f64 {
        let names = self.entries.iter().flat_map(|entry| &entry.name).map(|line| text::width(line, NAME));
        let notes = self.entries.iter().map(|entry| text::width(&entry.note, SMALL));
        self.corner[0] + WORDS + names.chain(notes).fold(0.0, f64::max) + 12.0
    }

    pub(super) fn draw(&self, svg: &mut Svg) {
        let [x, mut y] = self.corner;
        for entry in &self.entries {
            entry.draw(svg, [x, y]);
            y += entry.height();
        }
    }
}

impl Entry {
    fn height(&self) -> f64 {
        (self.name.len() as f64 + 1.0) * LINE + GAP
    }

    fn draw(&self, svg: &mut Svg, [x, top]: [f64; 2]) {
        let mut y = top + NAME;
        self.sign.draw(svg, [x, y - 4.0]);
        for line in &self.name {
            svg.text([x + WORDS, y], NAME, Anchor::Start, Colour::BLACK, line);
            y += LINE;
        }
        svg.text([x + WORDS, y], SMALL, Anchor::Start, Colour::GREY, &self.note);
    }
}

impl Sign {
    fn draw(self, svg: &mut Svg, [x, y]: [f64; 2]) {
        let line = [[x, y], [x + SAMPLE, y]];
        let middle = [x + 0.5 * SAMPLE, y];
        match self {
            Self::Curve(index) => {
                let style = Style::of(index);
                svg.path(&line, style.colour, 2.0, style.dash);
                style.draw_mark(svg, middle, 4.0, style.colour);
            }
            Self::Law => svg.path(&line, Colour::GREY, 2.0, Dash::Long),
            Self::Floor => svg.circle(middle, 4.0, Some(Colour::WHITE), Colour::GREY, 1.5),
            Self::Wanted => svg.path(&line, Colour::GREY, 1.0, Dash::Dots),
            Self::Grey => svg.rectangle([x, y - 5.0], [SAMPLE, 10.0], Colour::MIST),
            Self::Nothing => {}
        }
    }
}

/// Slope and price of a digit.
fn law(fit: &Fit) -> String {
    /// A steeper curve is upright: its slope is the noise of the clock.
    const UPRIGHT: f64 = 30.0;
    let factor = rounded(fit.digit_factor(), 3);
    if fit.slope().abs() > UPRIGHT || fit.decades_per_digit <= 0.0 {
        return "upright: a digit costs next to nothing".to_owned();
    }
    format!("slope {}: a digit costs x {factor}", rounded(fit.slope(), 2))
}
