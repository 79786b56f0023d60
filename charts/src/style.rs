//! How the series of a drawing are told apart.

use crate::svg::{Colour, Dash, Svg};

/// The sign at the points of a series.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Mark {
    /// A disc.
    Disc,
    /// A square.
    Square,
    /// A square on its corner.
    Diamond,
}

/// The look of a series: no two of the first 24 are the same.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Style {
    /// Of line and marks.
    pub colour: Colour,
    /// Of the line.
    pub dash: Dash,
    /// At the points.
    pub mark: Mark,
}

impl Style {
    /// The look of the series with this number: another mark than its neighbours, colours first, then other dashes.
    #[must_use]
    pub fn of(series: usize) -> Self {
        const DASHES: [Dash; 3] = [Dash::None, Dash::Long, Dash::Dots];
        const MARKS: [Mark; 3] = [Mark::Disc, Mark::Square, Mark::Diamond];
        Self {
            colour: Colour::LINES[series % Colour::LINES.len()],
            dash: DASHES[series / Colour::LINES.len() % DASHES.len()],
            mark: MARKS[series % MARKS.len()],
        }
    }

    /// Width of the line of a series among `count`, drawn one over the other: an earlier one that coincides with a later one
    /// shows on both sides of it.
    #[must_use]
    pub fn width(series: usize, count: usize) -> f64 {
        let part = series as f64 / count.saturating_sub(1).max(1) as f64;
        3.0 - 1.8 * part.min(1.0)
    }

    /// Draws the mark, hollow where `fill` is white.
    pub fn draw_mark(&self, svg: &mut Svg, centre: [f64; 2], radius: f64, fill: Colour) {
        let [x, y] = centre;
        let corners = match self.mark {
            Mark::Disc => return svg.circle(centre, radius, Some(fill), self.colour, 1.5),
            Mark::Square => {
                let r = 0.85 * radius;
                [[x - r, y - r], [x + r, y - r], [x + r, y + r], [x - r, y + r]]
            }
            Mark::Diamond => {
                let r = 1.2 * radius;
                [[x - r, y], [x, y - r], [x + r, y], [x, y + r]]
            }
        };
        svg.polygon(&corners, fill);
        svg.outline(&corners, self.colour, 1.5);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn two_dozen_series_look_different() {
        let styles: Vec<Style> = (0..24).map(Style::of).collect();
        for (index, style) in styles.iter().enumerate() {
            assert!(!styles[index + 1..].contains(style), "series {index} has a twin");
        }
        assert_eq!(Style::of(24), Style::of(0));
    }
}
