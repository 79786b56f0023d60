//! What stands beside the diagram: the curves with their laws, and what the other signs mean.

use super::{Diagram, Fit};
use crate::axis::rounded;
use crate::svg::{Anchor, Colour, Dash, Svg};

/// Letters of a name that fit on a line.
const LETTERS: usize = 32;
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
    Curve(Colour),
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
        for (curve, colour) in diagram.curves.iter().zip(Colour::LINES.into_iter().cycle()) {
            let fit = curve.trend(diagram.uncertainty).fit;
            let note = fit.as_ref().map_or_else(|| "no law".to_owned(), law);
            entries.push(Entry { sign: Sign::Curve(colour), name: lines(&curve.name), note });
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
            Self::Curve(colour) => {
                svg.path(&line, colour, 2.0, Dash::None);
                svg.circle(middle, 4.0, Some(colour), colour, 1.5);
            }
            Self::Law => svg.path(&line, Colour::GREY, 2.0, Dash::Long),
            Self::Floor => svg.circle(middle, 4.0, Some(Colour::WHITE), Colour::GREY, 1.5),
            Self::Wanted => svg.path(&line, Colour::GREY, 1.0, Dash::Dots),
            Self::Grey => svg.rectangle([x, y - 5.0], [SAMPLE, 10.0], Colour::MIST),
            Self::Nothing => {}
        }
    }
}

/// A name on lines that fit, broken between words.
fn lines(name: &str) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for word in name.split(' ') {
        match lines.last_mut() {
            Some(line) if line.chars().count() + 1 + word.chars().count() <= LETTERS => {
                line.push(' ');
                line.push_str(word);
            }
            _ => lines.push(word.to_owned()),
        }
    }
    lines
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn long_names_are_broken_between_words_and_none_is_lost() {
        let name = "constant 0.8, N^f = 2, N^s = 1, bounds of the fields";
        let broken = lines(name);
        assert_eq!(broken, ["constant 0.8, N^f = 2, N^s = 1,", "bounds of the fields"]);
        assert_eq!(broken.join(" "), name);
        assert_eq!(lines("BDF1"), ["BDF1"]);
        let long = "x".repeat(50);
        assert_eq!(lines(&format!("a {long} b")), ["a", &long, "b"]);
    }
}
