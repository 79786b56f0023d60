//! A map over two parameters as a picture: a panel for each choice, a cell for each pair of values.

use crate::axis::rounded;
use crate::svg::{Anchor, Colour, Svg};
use crate::text;

/// What is drawn.
#[derive(Debug, Clone, PartialEq)]
pub struct Map {
    /// Heading.
    pub title: String,
    /// The parameters of the rows and of the columns.
    pub axes: [MapAxis; 2],
    /// The panels.
    pub panels: Vec<MapPanel>,
}

/// A parameter.
#[derive(Debug, Clone, PartialEq)]
pub struct MapAxis {
    /// Its name.
    pub label: String,
    /// Its values, as they are written.
    pub values: Vec<String>,
}

/// One choice.
#[derive(Debug, Clone, PartialEq)]
pub struct MapPanel {
    /// Its name.
    pub name: String,
    /// Its cells, row by row.
    pub cells: Vec<MapCell>,
}

/// What a cell came to.
#[derive(Debug, Clone, PartialEq)]
pub enum MapCell {
    /// It converged, with this mean number of iterations per step.
    Converged(f64),
    /// It did not: the word that tables have for it.
    Other(String),
}

/// Words of tables, letters of cells, and what the key says.
const OUTCOMES: [(&str, &str, &str); 8] = [
    ("unconverged", "u", "steps accepted that did not converge"),
    ("energy_grows", "E", "energy grows"),
    ("iteration_bound", "N", "iteration bound reached"),
    ("diverged", "D", "coupling diverged"),
    ("field_failed", "F", "a field could not be solved"),
    ("out_of_budget", "B", "out of budget"),
    ("refused", "R", "cannot be built"),
    ("broken", "!", "error of the program"),
];

const CELL_HEIGHT: f64 = 22.0;
/// A cell is wider where the values below it are.
const LEAST_CELL_WIDTH: f64 = 34.0;
const MARGIN: f64 = 12.0;
const TOP: f64 = 80.0;
/// Between panels beside each other.
const GAP: f64 = 26.0;
/// Below a panel: the values of its columns, their name, and the name of the next panel.
const FOOT: f64 = 68.0;
/// The bar of colours with its labels.
const BAR: f64 = 60.0;
/// Panels in a row.
const ACROSS: usize = 2;
const TICKS: f64 = 9.0;
const NAMES: f64 = 11.0;
const PANELS: f64 = 12.0;
const TITLE: f64 = 14.0;

/// Where things stand.
struct Layout {
    cell: [f64; 2],
    panel: [f64; 2],
    /// Of the first panel.
    left: f64,
    /// From a panel to the next.
    pitch: [f64; 2],
    columns: usize,
    lines: usize,
}

impl Layout {
    fn of(map: &Map) -> Self {
        let widest = |texts: &[String], size: f64| {
            texts.iter().map(|text| text::width(text, size)).fold(0.0, f64::max)
        };
        let names: Vec<String> = map.panels.iter().map(|panel| panel.name.clone()).collect();
        let [down, across] = &map.axes;
        let cell = [LEAST_CELL_WIDTH.max(widest(&across.values, TICKS) + 8.0), CELL_HEIGHT];
        let panel = [across.values.len() as f64 * cell[0], down.values.len() as f64 * cell[1]];
        let width = panel[0].max(widest(&names, PANELS)).max(text::width(&across.label, NAMES));
        Self {
            cell,
            panel,
            left: MARGIN + 20.0 + widest(&down.values, TICKS) + 6.0,
            pitch: [width + GAP, panel[1] + FOOT],
            columns: map.panels.len().min(ACROSS),
            lines: map.panels.len().div_ceil(ACROSS),
        }
    }

    fn corner(&self, panel: usize) -> [f64; 2] {
        let [across, down] = [panel % ACROSS, panel / ACROSS];
        [self.left + across as f64 * self.pitch[0], TOP + down as f64 * self.pitch[1]]
    }

    fn right(&self) -> f64 {
        self.left + self.columns as f64 * self.pitch[0]
    }

    fn foot(&self) -> f64 {
        TOP + self.lines as f64 * self.pitch[1]
    }
}

impl Map {
    /// The drawing as SVG text: mean iterations of the cells that converged as colour and number, a letter in the others.
    #[must_use]
    pub fn draw(&self) -> String {
        const NOTE: &str = "numbers and colours: mean iterations per step";
        let layout = Layout::of(self);
        let keys = self.keys();
        let words = keys.iter().map(|key| text::width(key, NAMES));
        let words = words.chain([text::width(&self.title, TITLE), text::width(NOTE, NAMES)]);
        let width = words.map(|width| width + 2.0 * MARGIN).fold(layout.right() + BAR, f64::max);
        let mut svg = Svg::new(width, layout.foot() + 16.0 * keys.len() as f64, &self.title);
        svg.text([MARGIN, 22.0], TITLE, Anchor::Start, Colour::BLACK, &self.title);
        svg.text([MARGIN, 40.0], NAMES, Anchor::Start, Colour::GREY, NOTE);
        let most = self.most();
        for (index, panel) in self.panels.iter().enumerate() {
            let corner = layout.corner(index);
            svg.text([corner[0], corner[1] - 8.0], PANELS, Anchor::Start, Colour::BLACK, &panel.name);
            axes(&mut svg, self, &layout, index);
            let columns = self.axes[1].values.len().max(1);
            for (place, cell) in panel.cells.iter().enumerate() {
                let [down, across] = [place / columns, place % columns].map(|index| index as f64);
                let place = [corner[0] + across * layout.cell[0], corner[1] + down * layout.cell[1]];
                draw_cell(&mut svg, place, layout.cell, cell, most);
            }
        }
        let labels = [0.0, 0.5, 1.0].map(|part| (part, rounded(most.powf(part), 2)));
        svg.colour_bar([layout.right(), TOP], [12.0, layout.panel[1].min(140.0)], &labels);
        for (line, key) in keys.iter().enumerate() {
            let y = layout.foot() + 16.0 * line as f64;
            svg.text([MARGIN, y - 8.0], NAMES, Anchor::Start, Colour::BLACK, key);
        }
        svg.finish()
    }

    fn cells(&self) -> impl Iterator<Item = &MapCell> {
        self.panels.iter().flat_map(|panel| &panel.cells)
    }

    /// End of the scale of colours. Counts are compared by their ratios, and one iteration alone is no scale.
    fn most(&self) -> f64 {
        let means = self.cells().filter_map(|cell| match cell {
            MapCell::Converged(mean) => Some(*mean),
            MapCell::Other(_) => None,
        });
        means.fold(2.0, f64::max)
    }

    /// The letters that the reader has to be told.
    fn keys(&self) -> Vec<String> {
        let is_there =
            |word: &str| self.cells().any(|cell| matches!(cell, MapCell::Other(other) if other == word));
        let there = OUTCOMES.into_iter().filter(|(word, ..)| is_there(word));
        there.map(|(_, letter, phrase)| format!("{letter}  {phrase}")).collect()
    }
}

/// Values and names of the axes; those of the rows only beside the first panel of a line.
fn axes(svg: &mut Svg, map: &Map, layout: &Layout, panel: usize) {
    let [x, y] = layout.corner(panel);
    let [down, across] = &map.axes;
    for (index, value) in across.values.iter().enumerate() {
        let centre = x + (index as f64 + 0.5) * layout.cell[0];
        svg.text([centre, y + layout.panel[1] + 13.0], TICKS, Anchor::Middle, Colour::GREY, value);
    }
    let below = [x, y + layout.panel[1] + 29.0];
    svg.text(below, NAMES, Anchor::Start, Colour::BLACK, &across.label);
    if panel.is_multiple_of(ACROSS) {
        for (index, value) in down.values.iter().enumerate() {
            let line = y + (index as f64 + 0.5) * layout.cell[1] + 4.0;
            svg.text([x - 6.0, line], TICKS, Anchor::End, Colour::GREY, value);
        }
        svg.text_upwards([MARGIN + 10.0, y + 0.5 * layout.panel[1]], NAMES, Colour::BLACK, &down.label);
    }
}

fn draw_cell(svg: &mut Svg, corner: [f64; 2], size: [f64; 2], cell: &MapCell, most: f64) {
    let (colour, text) = match cell {
        MapCell::Converged(mean) => (Colour::on_scale(mean.ln() / most.ln()), format!("{mean:.0}")),
        MapCell::Other(word) => {
            let letter =
                OUTCOMES.iter().find(|(known, ..)| known == word).map_or("?", |(_, letter, _)| letter);
            (Colour::STEEL, letter.to_owned())
        }
    };
    svg.rectangle(corner, [size[0] - 1.0, size[1] - 1.0], colour);
    let place = [corner[0] + size[0] / 2.0, corner[1] + size[1] / 2.0 + 4.0];
    svg.text(place, 10.0, Anchor::Middle, colour.ink(), &text);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::legible::faults;

    fn map(panels: usize, columns: usize, name: &str, value: &str) -> Map {
        let values = |count: usize| (0..count).map(|k| format!("{value}{k}")).collect();
        let cells = |k: usize| -> Vec<MapCell> {
            let words = OUTCOMES.iter().cycle();
            let other = |(index, (word, ..)): (usize, &(&str, &str, &str))| match index % 3 {
                0 => MapCell::Other((*word).to_owned()),
                _ => MapCell::Converged((k + index) as f64),
            };
            words.enumerate().take(3 * columns).map(other).collect()
        };
        Map {
            title: "Swinging flag: amplitude against steps per swing".into(),
            axes: [
                MapAxis { label: "amplitude [m]".into(), values: values(3) },
                MapAxis { label: "steps per swing".into(), values: values(columns) },
            ],
            panels: (0..panels).map(|k| MapPanel { name: format!("{name} {k}"), cells: cells(k) }).collect(),
        }
    }

    #[test]
    fn maps_of_any_size_can_be_read() {
        for panels in [1, 2, 5] {
            for columns in [1, 3, 9] {
                for name in ["a", "elastic, chi = 1, from the last mesh, and then some more"] {
                    for value in ["", "0.00001"] {
                        let svg = map(panels, columns, name, value).draw();
                        assert_eq!(
                            faults(&svg),
                            Vec::<String>::new(),
                            "{panels}, {columns}, {name}, {value}"
                        );
                    }
                }
            }
        }
    }

    #[test]
    fn the_key_explains_the_letters_that_are_there() {
        let mut map = map(1, 2, "a", "");
        map.panels[0].cells = vec![MapCell::Converged(1.0), MapCell::Other("diverged".into())];
        let svg = map.draw();
        assert!(svg.contains(">D</text>") && svg.contains("D  coupling diverged") && !svg.contains("budget"));
        assert_eq!(faults(&svg), Vec::<String>::new(), "one iteration everywhere");
    }
}
