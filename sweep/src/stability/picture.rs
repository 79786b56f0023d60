//! A map as a picture.

use partita_charts::map::{self, MapAxis, MapCell, MapPanel};

use super::read::{Axis, Map};
use super::row::{Outcome, Row};

/// The picture of a map and of what its cells came to.
pub(super) fn draw(map: &Map, rows: &[Row]) -> String {
    let panel = |(choice, name): (usize, &String)| {
        let of_choice = map.cells.iter().zip(rows).filter(|(cell, _)| cell.choice == choice);
        MapPanel { name: name.clone(), cells: of_choice.map(|(_, row)| cell(row)).collect() }
    };
    map::Map {
        title: map.title.clone(),
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
