//! A scalar field on a moved mesh, and the structure beside it, in one drawing.

use crate::axis::{LinearAxis, rounded};
use crate::svg::{Anchor, Colour, Dash, Svg};
use crate::text;

/// Longer side of what is drawn, in pixels.
const EXTENT: f64 = 620.0;
/// Left of it and below it stand axes.
const LEFT: f64 = 64.0;
const FOOT: f64 = 48.0;
const HEAD: f64 = 40.0;
/// The bar of colours with its labels.
const BAR: f64 = 110.0;
const SMALL: f64 = 11.0;

/// Cells in the plane.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Grid {
    /// Places \[m\].
    pub points: Vec<[f64; 2]>,
    /// Corners of each cell.
    pub cells: Vec<Vec<usize>>,
}

/// A scalar field and the range of its colours.
#[derive(Debug, Clone, PartialEq)]
pub struct Scale {
    label: String,
    values: Vec<f64>,
    low: f64,
    high: f64,
}

impl Scale {
    /// Colours from the smallest to the largest value; there is one value for each point.
    #[must_use]
    pub fn new(name: &str, unit: &str, values: Vec<f64>) -> Self {
        let low = values.iter().copied().fold(f64::INFINITY, f64::min);
        let high = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        Self { label: format!("{name} [{unit}]"), values, low, high }
    }

    /// The value at a part of the range, to three digits of it.
    fn number(&self, part: f64) -> String {
        let value = self.low + part * (self.high - self.low);
        let negligible = value.abs() < 1e-3 * (self.high - self.low);
        rounded(if negligible { 0.0 } else { value }, 3)
    }

    fn colour(&self, value: f64) -> Colour {
        let span = self.high - self.low;
        Colour::on_scale(if span > 0.0 { (value - self.low) / span } else { 0.0 })
    }
}

/// From metres to pixels.
struct View {
    left: f64,
    top: f64,
    pixels: f64,
}

impl View {
    fn place(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        [LEFT + (x - self.left) * self.pixels, HEAD + (self.top - y) * self.pixels]
    }
}

/// The fluid's triangles coloured by the mean of the field at their corners, and the structure, both where they are.
#[must_use]
pub fn deformed(title: &str, fluid: &Grid, structure: &Grid, scale: &Scale) -> String {
    let points = || fluid.points.iter().chain(&structure.points);
    let least = |axis: usize| points().map(|point| point[axis]).fold(f64::INFINITY, f64::min);
    let most = |axis: usize| points().map(|point| point[axis]).fold(f64::NEG_INFINITY, f64::max);
    let (width, height) = (most(0) - least(0), most(1) - least(1));
    let view = View { left: least(0), top: most(1), pixels: EXTENT / width.max(height) };
    let (width, height) = (width * view.pixels, height * view.pixels);
    let sheet = (LEFT + width + BAR).max(LEFT + text::width(title, 14.0) + 12.0);
    let mut svg = Svg::new(sheet, HEAD + height + FOOT, title);
    svg.text([LEFT, 22.0], 14.0, Anchor::Start, Colour::BLACK, title);
    for cell in &fluid.cells {
        triangle(&mut svg, &view, cell, fluid, scale);
    }
    for cell in &structure.cells {
        let corners: Vec<[f64; 2]> =
            cell.iter().map(|&corner| view.place(structure.points[corner])).collect();
        svg.polygon(&corners, Colour::STEEL);
    }
    let low = [view.left, view.top - height / view.pixels];
    axes(&mut svg, low, [view.left + width / view.pixels, view.top], [width, height]);
    let bar = LEFT + width + 16.0;
    svg.text([bar, HEAD + 10.0], SMALL, Anchor::Start, Colour::BLACK, &scale.label);
    let labels = [0.0, 0.5, 1.0].map(|part| (part, scale.number(part)));
    svg.colour_bar([bar, HEAD + 24.0], [14.0, 160.0], &labels);
    svg.finish()
}

/// Axes in metres, left and below, a little off the drawing.
fn axes(svg: &mut Svg, low: [f64; 2], high: [f64; 2], [width, height]: [f64; 2]) {
    const OFF: f64 = 6.0;
    let (left, bottom) = (LEFT - OFF, HEAD + height + OFF);
    let across = LinearAxis::over(low[0], high[0], [LEFT, LEFT + width]);
    svg.path(&[[LEFT, bottom], [LEFT + width, bottom]], Colour::GREY, 1.0, Dash::None);
    for tick in across.ticks(8) {
        let x = across.place(tick.value);
        svg.path(&[[x, bottom], [x, bottom + 4.0]], Colour::GREY, 1.0, Dash::None);
        svg.tick([x, bottom + 16.0], SMALL, Anchor::Middle, "x [m]", &tick.label);
    }
    svg.text([LEFT + 0.5 * width, bottom + 33.0], SMALL, Anchor::Middle, Colour::BLACK, "x [m]");
    let up = LinearAxis::over(low[1], high[1], [HEAD + height, HEAD]);
    svg.path(&[[left, HEAD], [left, HEAD + height]], Colour::GREY, 1.0, Dash::None);
    for tick in up.ticks(8) {
        let y = up.place(tick.value);
        svg.path(&[[left - 4.0, y], [left, y]], Colour::GREY, 1.0, Dash::None);
        svg.tick([left - 7.0, y + 4.0], SMALL, Anchor::End, "y [m]", &tick.label);
    }
    svg.text_upwards([16.0, HEAD + 0.5 * height], SMALL, Colour::BLACK, "y [m]");
}

/// The colour of a triangle, then its edges.
fn triangle(svg: &mut Svg, view: &View, cell: &[usize], fluid: &Grid, scale: &Scale) {
    let &[a, b, c] = cell else { return };
    let corners = [a, b, c].map(|corner| view.place(fluid.points[corner]));
    let mean = [a, b, c].iter().map(|&corner| scale.values[corner]).sum::<f64>() / 3.0;
    svg.polygon(&corners, scale.colour(mean));
    svg.outline(&corners, Colour::GREY, 0.35);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::legible::faults;

    /// A unit square in two triangles.
    fn square() -> Grid {
        Grid {
            points: vec![[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]],
            cells: vec![vec![0, 1, 2], vec![0, 2, 3]],
        }
    }

    #[test]
    fn every_triangle_is_coloured_and_outlined_within_the_sheet() {
        let grid = square();
        let scale = Scale::new("pressure", "Pa", vec![0.0, 1.0, 1.0, 0.0]);
        let text = deformed("square", &grid, &grid, &scale);
        let count = |needle: &str| text.matches(needle).count();
        assert_eq!(faults(&text), Vec::<String>::new());
        let outlines =
            text.lines().filter(|line| line.starts_with("<polygon") && line.contains("fill=\"none\""));
        assert_eq!(outlines.count(), 2, "an outline for each triangle");
        assert_eq!(count("<polygon"), 2 + 2 + grid.cells.len());
        // The corner at the origin lies below left.
        assert!(text.contains(&format!("{:.1},{:.1}", LEFT, HEAD + EXTENT)), "{text}");
    }

    #[test]
    fn a_constant_field_has_one_colour() {
        let scale = Scale::new("pressure", "Pa", vec![2.0; 3]);
        assert_eq!(scale.colour(2.0), Colour::on_scale(0.0));
    }
}
