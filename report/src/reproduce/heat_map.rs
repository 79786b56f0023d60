//! The paper's contour plots as heat maps, two side by side on one scale.

use super::counts::{Count, Grid};
use partita_charts::svg::{Anchor, Colour, Svg};
use partita_charts::text;

const CELL: [f64; 2] = [52.0, 34.0];
const LEFT: f64 = 50.0;
const TOP: f64 = 62.0;
const GAP: f64 = 60.0;

/// One count of two grids with the same settings, each below its heading.
pub(crate) fn side_by_side(title: &str, panels: [(&str, &Grid); 2], count: Count) -> String {
    let range = range(panels.map(|(_, grid)| grid), count);
    let (rows, columns) = (panels[0].1.fluid_limits().len(), panels[0].1.structure_limits().len());
    let panel_width = columns as f64 * CELL[0];
    let height = TOP + rows as f64 * CELL[1] + 34.0;
    let bar = LEFT + 2.0 * panel_width + GAP + 20.0;
    let mut svg = Svg::new((bar + 70.0).max(LEFT + text::width(title, 14.0) + 12.0), height, title);
    svg.text([LEFT, 18.0], 14.0, Anchor::Start, Colour::BLACK, title);
    for (index, (heading, grid)) in panels.into_iter().enumerate() {
        let x = LEFT + index as f64 * (panel_width + GAP);
        panel(&mut svg, [x, TOP], heading, grid, count, range);
    }
    let foot = [LEFT, TOP + rows as f64 * CELL[1] + 18.0];
    svg.text(foot, 11.0, Anchor::Start, Colour::GREY, "rows: N^f, columns: N^s");
    let (low, high) = range;
    let labels = [0.0, 0.5, 1.0].map(|part| {
        let value = low as f64 + part * (high - low) as f64;
        (part, format!("{value:.0}"))
    });
    svg.colour_bar([bar, TOP], [14.0, rows as f64 * CELL[1]], &labels);
    svg.finish()
}

fn range(grids: [&Grid; 2], count: Count) -> (usize, usize) {
    let values =
        || grids.iter().flat_map(|grid| grid.cells.values().flatten()).map(|&counts| count.of(counts));
    (values().min().unwrap_or(0), values().max().unwrap_or(0))
}

fn panel(
    svg: &mut Svg,
    [x, y]: [f64; 2],
    heading: &str,
    grid: &Grid,
    count: Count,
    (low, high): (usize, usize),
) {
    svg.text([x, y - 24.0], 12.0, Anchor::Start, Colour::BLACK, heading);
    let rows = grid.fluid_limits();
    for (column, limit) in grid.structure_limits().iter().enumerate() {
        let centre = x + (column as f64 + 0.5) * CELL[0];
        svg.text([centre, y - 6.0], 11.0, Anchor::Middle, Colour::GREY, &limit.to_string());
    }
    for (row, &fluid) in rows.iter().enumerate() {
        let top = y + row as f64 * CELL[1];
        svg.text([x - 14.0, top + 21.0], 11.0, Anchor::Middle, Colour::GREY, &fluid.to_string());
        for (column, &structure) in grid.structure_limits().iter().enumerate() {
            let left = x + column as f64 * CELL[0];
            let value = grid.get(super::setting::Limits { fluid, structure }).map(|counts| count.of(counts));
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
    use crate::reproduce::counts::Counts;
    use crate::reproduce::setting::Limits;
    use partita_charts::legible::faults;

    #[test]
    fn both_panels_share_one_scale_and_every_cell_is_written() {
        let grid = |low: usize| -> Grid {
            [("1", low), ("inf", low + 50)]
                .map(|(fluid, coupling)| {
                    (Limits::of(fluid, "1"), Some(Counts { coupling, fluid: 0, structure: 0 }))
                })
                .into_iter()
                .collect()
        };
        let text = side_by_side("t", [("published", &grid(100)), ("ours", &grid(150))], Count::Coupling);
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
