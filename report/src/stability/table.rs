//! A map as it is written, and the table that came of it.

use std::path::Path;

use partita_charts::map::{self, MapAxis, MapCell, MapPanel};
use serde::Deserialize;

use crate::csv::Csv;
use crate::task::{self, TaskError};

/// What the page says of a map file.
#[derive(Debug)]
pub(super) struct Map {
    pub(super) name: String,
    pub(super) title: String,
    /// Its scene, from the root of the workspace.
    pub(super) scene: String,
    pub(super) axes: [Axis; 2],
    pub(super) choices: Vec<Choice>,
    /// Prose.
    pub(super) remarks: String,
}

#[derive(Debug, Deserialize)]
pub(super) struct Axis {
    pub(super) name: String,
    label: Option<String>,
    pub(super) values: Vec<toml::Value>,
}

#[derive(Debug, Deserialize)]
pub(super) struct Choice {
    pub(super) name: String,
}

#[derive(Debug, Deserialize)]
struct File {
    title: String,
    scene: String,
    parameter: [Axis; 2],
    choice: Vec<Choice>,
}

impl Axis {
    pub(super) fn label(&self) -> &str {
        self.label.as_deref().unwrap_or(&self.name)
    }
}

impl Map {
    pub(super) fn read(root: &Path, name: &str) -> Result<Self, TaskError> {
        let path = root.join("maps").join(format!("{name}.toml"));
        let file: File = task::read_toml(&path)?;
        Ok(Self {
            name: name.to_owned(),
            title: file.title,
            scene: file.scene.trim_start_matches("../").to_owned(),
            axes: file.parameter,
            choices: file.choice,
            remarks: task::read(&path.with_extension("md"))?,
        })
    }
}

/// `docs/data/stability_<map>.csv`.
#[derive(Debug)]
pub(super) struct Table {
    /// Cells in the map's order.
    pub(super) cells: Vec<Cell>,
}

#[derive(Debug, Clone, PartialEq)]
pub(super) struct Cell {
    pub(super) choice: String,
    /// Values of both parameters.
    pub(super) values: [String; 2],
    pub(super) outcome: String,
    pub(super) mean_iterations: Option<f64>,
    pub(super) max_iterations: Option<usize>,
    pub(super) newton_iterations: usize,
    pub(super) retries: usize,
    pub(super) cause: String,
    pub(super) remedy: String,
    pub(super) pressure_oscillation: Option<f64>,
    pub(super) structure_displacement: Option<f64>,
    pub(super) mesh_quality: Option<f64>,
}

impl Table {
    /// The cells in a table.
    pub(super) fn read(table: &Csv) -> Result<Self, TaskError> {
        // The parameters have names of their own; they stand in the second and the third column.
        let [_, first, second, ..] = table.header() else {
            return Err(TaskError::Failed("this is no table of a map".to_owned()));
        };
        let cell = |row: crate::csv::Row<'_>| -> Result<Cell, TaskError> {
            Ok(Cell {
                choice: row.text("accelerator")?.to_owned(),
                values: [row.text(first)?.to_owned(), row.text(second)?.to_owned()],
                outcome: row.text("outcome")?.to_owned(),
                mean_iterations: row.optional("mean_iterations")?,
                max_iterations: row.optional("max_iterations")?,
                newton_iterations: row.value("newton_iterations")?,
                retries: row.value("retries")?,
                cause: row.text("cause")?.to_owned(),
                remedy: row.text("remedy")?.to_owned(),
                pressure_oscillation: row.optional("pressure_oscillation")?,
                structure_displacement: row.optional("structure_displacement")?,
                mesh_quality: row.optional("mesh_quality")?,
            })
        };
        Ok(Self { cells: table.rows().map(cell).collect::<Result<_, _>>()? })
    }

    /// The picture of this table of a map.
    pub(super) fn picture(&self, map: &Map) -> String {
        let first = || map.choices.iter().take(1).flat_map(|choice| self.of(&choice.name));
        let columns = map.axes[1].values.len();
        let across: Vec<String> = first().take(columns).map(|cell| cell.values[1].clone()).collect();
        let down: Vec<String> = first().step_by(columns).map(|cell| cell.values[0].clone()).collect();
        let axis = |axis: &Axis, values| MapAxis { label: axis.label().to_owned(), values };
        let cell = |cell: &Cell| match cell.mean_iterations {
            Some(mean) if cell.converged() => MapCell::Converged(mean),
            _ => MapCell::Other(cell.outcome.clone()),
        };
        let panel = |choice: &Choice| MapPanel {
            name: choice.name.clone(),
            cells: self.of(&choice.name).map(cell).collect(),
        };
        map::Map {
            title: map.title.clone(),
            axes: [axis(&map.axes[0], down), axis(&map.axes[1], across)],
            panels: map.choices.iter().map(panel).collect(),
        }
        .draw()
    }

    /// The cells of a choice.
    pub(super) fn of<'a>(&'a self, choice: &'a str) -> impl Iterator<Item = &'a Cell> + Clone {
        self.cells.iter().filter(move |cell| cell.choice == choice)
    }
}

impl Cell {
    pub(super) fn converged(&self) -> bool {
        self.outcome == "converged"
    }
}
