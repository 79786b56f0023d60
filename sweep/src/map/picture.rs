//! A map as a picture.

use partita_charts::map::{self, MapAxis, MapCell, MapPanel};

use super::{Axis, Cell, Map, Outcome, Row};

/// The picture of a map all of whose cells have a row.
pub(crate) fn draw(title: &str, map: &Map, rows: &[(Cell, Row)]) -> String {
    let panel = |(choice, name): (usize, &String)| {
        let of_choice = rows.iter().filter(|(cell, _)| cell.choice == choice);
        MapPanel { name: name.clone(), cells: of_choice.map(|(_, row)| cell(row)).collect() }
    };
    map::Map {
        title: title.to_owned(),
        axes: map.axes.each_ref().map(axis),
        panels: map.choices.iter().enumerate().map(panel).collect(),
    }
    .draw()
}

fn axis(axis: &Axis) -> MapAxis {
    MapAxis { label: axis.label.clone(), values: axis.values.clone() }
}

/// With the mean as tables have it: whoever draws from a table draws the same.
fn cell(row: &Row) -> MapCell {
    match (row.outcome, row.rounded_mean()) {
        (Outcome::Converged, Some(mean)) => MapCell::Converged(mean.parse().unwrap_or(f64::NAN)),
        (outcome, _) => MapCell::Other(outcome.word().to_owned()),
    }
}
