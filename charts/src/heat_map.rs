//! Tables of counts as heat maps, two side by side on one scale.

use crate::svg::{Anchor, Colour, Svg};
use crate::text;

const CELL: [f64; 2] = [52.0, 34.0];
const LEFT: f64 = 50.0;
const TOP: f64 = 62.0;
const GAP: f64 = 60.0;

/// A table of counts below its heading.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct HeatMap {
    /// What it is of.
    pub heading: String,
    /// Names of the rows.
    pub rows: Vec<String>,
    /// Names of the columns.
    pub columns: Vec<String>,
    /// Counts row by row; `None` where there is none.
    pub values: Vec<Option<usize>>,
}

/// Two tables with the same rows and columns as SVG text; `foot` says what rows and columns are.
#[must_use]
pub fn side_by_side(title: &str, maps: [&HeatMap; 2], foot: &str) -> String {
    let range = range(maps);
    let (rows, columns) = (maps[0].rows.len(), maps[0].columns.len());
    let panel_width = columns as f64 * CELL[0];
    let height = TOP + rows as f64 * CELL[1] + 34.0;
    let bar = LEFT + 2.0 * panel_width + GAP + 20.0;
    let mut svg = Svg::new((bar + 70.0).max(LEFT + text::width(title, 14.0) + 12.0), height, title);
    svg.text([LEFT, 18.0], 14.0, Anchor::Start, Colour::BLACK, title);
    for (index, map) in maps.into_iter().enumerate() {
        panel(&mut svg, [LEFT + index as f64 * (panel_width + GAP), TOP], map, range);
    }
    let below = [LEFT, TOP + rows as f64 * CELL[1] + 18.0];
    svg.text(below, 11.0, Anchor::Start, Colour::GREY, foot);
    let (low, high) = range;
    let labels = [0.0, 0.5, 1.0].map(|part| {
        let value = low as f64 + part * (high - low) as f64;
        (part, format!("{value:.0}"))
    });
    svg.colour_bar([bar, TOP], [14.0, rows as f64 * CELL[1]], &labels);
    svg.finish()
}

fn range(maps: [&HeatMap; 2]) -> (usize, usize) {
    let values = || maps.into_iter().flat_map(|map| map.values.iter().copied().flatten());
    (values().min().unwrap_or(0), values().max().unwrap_or(0))
}

fn panel(svg: &mut Svg, [x, y]: [f64; 2], map: &HeatMap, (low, high): (usize, usize)) {
    svg.text([x, y - 24.0], 12.0, Anchor::Start, Colour::BLACK, &map.heading);
    for (column, name) in map.columns.iter().enumerate() {
        let centre = x + (column as f64 + 0.5) * CELL[0];
        svg.text([centre, y - 6.0], 11.0, Anchor::Middle, Colour::GREY, name);
    }
    for (row, (name, values)) in map.rows.iter().zip(map.values.chunks(map.columns.len())).enumerate() {
        let top = y + row as f64 * CELL[1];
        svg.text([x - 14.0, top + 21.0], 11.0, Anchor::Middle, Colour::GREY, name);
        for (column, &value) in values.iter().enumerate() {
            let left = x + column as f64 * CELL[0];
            let colour = value.map_or(Colour::GREY, |value| {
                Colour::on_scale((value - low) as f64 / (high - low).max(1) as f64)
            });
            svg.rectangle([left, top], CELL, colour);
            let number = value.map_or_else(|| "-".to_owned(), |value| value.to_string());
            svg.text([left + CELL[0] / 2.0, top + 21.0], 11.0, Anchor::Middle, colour.ink(), &number);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::legible::faults;

    #[test]
    fn both_panels_share_one_scale_and_every_cell_is_written() {
        let map = |heading: &str, low: usize| HeatMap {
            heading: heading.to_owned(),
            rows: vec!["1".to_owned(), "inf".to_owned()],
            columns: vec!["1".to_owned()],
            values: vec![Some(low), Some(low + 50)],
        };
        let text = side_by_side("t", [&map("published", 100), &map("ours", 150)], "rows and columns");
        assert_eq!(faults(&text), Vec::<String>::new());
        for value in [">100<", ">150<", ">200<"] {
            assert!(text.contains(value), "{value}");
        }
        // 150 is the end of one panel and the start of the other: the same colour.
        let colour = |needle: &str| -> Vec<&str> {
            let lines: Vec<&str> = text.lines().collect();
            (0..lines.len() - 1)
                .filter(|&i| lines[i].contains("width=\"52.00\"") && lines[i + 1].contains(needle))
                .map(|i| lines[i].split("fill=").nth(1).expect("a fill"))
                .collect()
        };
        let colours = colour(">150<");
        assert!(colours.len() == 2 && colours[0] == colours[1], "{colours:?}");
    }
}
