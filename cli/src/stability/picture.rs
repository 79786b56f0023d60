//! A map as a picture: a panel for each choice, a cell for each pair of values.

use partita_charts::svg::{Anchor, Colour, Svg};

use super::read::Map;
use super::row::{Outcome, Row};

const CELL: [f64; 2] = [34.0, 22.0];
const LEFT: f64 = 84.0;
const TOP: f64 = 78.0;
const GAP: [f64; 2] = [26.0, 74.0];
/// Panels in a row.
const ACROSS: usize = 2;

/// The picture: mean iterations of the cells that converged as colour and number, a letter in those that did not.
pub(super) fn draw(map: &Map, rows: &[Row]) -> String {
    let [down, across] = map.axes.each_ref().map(|axis| axis.values.len());
    let panel = [across as f64 * CELL[0], down as f64 * CELL[1]];
    let columns = map.choices.len().min(ACROSS);
    let lines = map.choices.len().div_ceil(ACROSS);
    let width = LEFT + columns as f64 * (panel[0] + GAP[0]) + 60.0;
    let foot = TOP + lines as f64 * (panel[1] + GAP[1]);
    let letters = letters(rows);
    let mut svg = Svg::new(width.max(460.0), foot + 16.0 * letters.len() as f64 + 12.0, &map.title);
    svg.text([12.0, 22.0], 14.0, Anchor::Start, Colour::BLACK, &map.title);
    let note = format!(
        "rows: {}, columns: {}; numbers are mean iterations a step",
        map.axes[0].label, map.axes[1].label
    );
    svg.text([12.0, 40.0], 11.0, Anchor::Start, Colour::GREY, &note);
    let most = rows.iter().filter_map(shown).fold(1.0, f64::max);
    for (choice, name) in map.choices.iter().enumerate() {
        let corner = [
            LEFT + (choice % ACROSS) as f64 * (panel[0] + GAP[0]),
            TOP + (choice / ACROSS) as f64 * (panel[1] + GAP[1]),
        ];
        svg.text([corner[0], corner[1] - 8.0], 12.0, Anchor::Start, Colour::BLACK, name);
        labels(&mut svg, map, corner, choice.is_multiple_of(ACROSS));
        for (cell, row) in map.cells.iter().zip(rows).filter(|(cell, _)| cell.choice == choice) {
            let [down, across] = cell.values.map(|index| index as f64);
            draw_cell(&mut svg, [corner[0] + across * CELL[0], corner[1] + down * CELL[1]], row, most);
        }
    }
    let bar = LEFT + columns as f64 * (panel[0] + GAP[0]);
    svg.colour_bar([bar, TOP], [12.0, panel[1].min(140.0)], "1", &format!("{most:.0}"));
    for (line, outcome) in letters.into_iter().enumerate() {
        let text = format!("{}  {}", letter(outcome), outcome.phrase());
        svg.text([12.0, foot + 16.0 * line as f64], 11.0, Anchor::Start, Colour::BLACK, &text);
    }
    svg.finish()
}

/// Values of the axes; those of the rows only beside the first panel of a line.
fn labels(svg: &mut Svg, map: &Map, [x, y]: [f64; 2], beside: bool) {
    let height = map.axes[0].values.len() as f64 * CELL[1];
    for (index, value) in map.axes[1].values.iter().enumerate() {
        let centre = x + (index as f64 + 0.5) * CELL[0];
        svg.text([centre, y + height + 14.0], 9.0, Anchor::Middle, Colour::GREY, value);
    }
    for (index, value) in map.axes[0].values.iter().enumerate().filter(|_| beside) {
        let line = y + (index as f64 + 0.5) * CELL[1] + 4.0;
        svg.text([x - 6.0, line], 9.0, Anchor::End, Colour::GREY, value);
    }
}

fn draw_cell(svg: &mut Svg, corner: [f64; 2], row: &Row, most: f64) {
    let (colour, text) = match shown(row) {
        // Counts are compared by their ratios.
        Some(mean) => (Colour::on_scale(mean.ln() / most.ln().max(f64::MIN_POSITIVE)), format!("{mean:.0}")),
        None => (Colour::STEEL, letter(row.outcome).to_owned()),
    };
    svg.rectangle(corner, [CELL[0] - 1.0, CELL[1] - 1.0], colour);
    let place = [corner[0] + CELL[0] / 2.0, corner[1] + CELL[1] / 2.0 + 4.0];
    svg.text(place, 10.0, Anchor::Middle, colour.ink(), &text);
}

/// What a cell that converged shows.
fn shown(row: &Row) -> Option<f64> {
    row.mean_iterations().filter(|_| row.outcome == Outcome::Converged)
}

fn letter(outcome: Outcome) -> &'static str {
    match outcome {
        Outcome::Converged => "",
        Outcome::Unconverged => "u",
        Outcome::EnergyGrows => "E",
        Outcome::IterationBound => "N",
        Outcome::Diverged => "D",
        Outcome::FieldFailed => "F",
        Outcome::OutOfBudget => "B",
        Outcome::Refused => "R",
        Outcome::Broken => "!",
    }
}

/// The outcomes that the key has to explain.
fn letters(rows: &[Row]) -> Vec<Outcome> {
    let there =
        |outcome: &Outcome| *outcome != Outcome::Converged && rows.iter().any(|row| row.outcome == *outcome);
    Outcome::ALL.into_iter().filter(there).collect()
}
