//! Maps: one scene over two parameters and some choices, each cell a run of a few dozen steps, its outcome as data.
//!
//! ```toml
//! title = "Tank: added mass against step size"
//! scene = "../scenes/elastic-bottom"      # beside the map
//! steps = 30
//! set = ["fluid.tangent=full"]            # for all cells, as with --set
//!
//! [[parameter]]                           # the rows
//! name = "density_ratio"                  # a column of the table
//! label = "rho_f / rho_s"
//! values = [0.01, 1, 100]                 # numbers, or words
//! set = ["structure.density=$(1000/x)"]   # a formula of the value stands in $(...)
//!
//! [[parameter]]                           # the columns
//! name = "dt"
//! values = [1e-2, 1e-3]
//! set = ["time.step=$(x)"]
//!
//! [[choice]]
//! name = "IQN-IMVLS"
//! set = ["coupling.acceleration=iqn_imvls"]
//! ```
//!
//! Two more keys hold a cell in check: `newton_budget`, the Newton iterations it may take (20 000), and
//! `largest_energy_growth`, above which it is not called converged (100). Both count work, not time, so that the table is
//! the same on every machine and for any number of jobs. A cell ends at its first step that fails; the table then says
//! where, why, and what to change.

pub(crate) mod measure;
mod picture;
mod row;

use crate::result::RunResult;
pub(crate) use picture::draw;
pub(crate) use row::to_csv;
pub use row::{Outcome, Row};

/// What is special about a sweep that is a map.
#[derive(Debug, Clone)]
pub struct Map {
    /// Newton iterations, both fields together, that a cell may take.
    pub newton_budget: usize,
    /// A cell whose energy grows by more than this factor is not called converged.
    pub largest_energy_growth: f64,
    /// The two axes.
    pub axes: [Axis; 2],
    /// Names of the choices, accelerators as a rule.
    pub choices: Vec<String>,
    /// All cells: choice by choice, within it row by row of the first parameter. The run of a cell has its index.
    pub cells: Vec<Cell>,
}

/// One parameter.
#[derive(Debug, Clone)]
pub struct Axis {
    /// Its column in tables.
    pub name: String,
    /// How pictures call it.
    pub label: String,
    /// Its values, as they are written in tables.
    pub values: Vec<String>,
}

/// A place of a map.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Cell {
    /// Index of the choice.
    pub choice: usize,
    /// Indices of the values of both parameters.
    pub values: [usize; 2],
}

impl Map {
    /// The values of a cell, as written in tables.
    #[must_use]
    pub fn values(&self, cell: &Cell) -> [&str; 2] {
        [0, 1].map(|axis| self.axes[axis].values[cell.values[axis]].as_str())
    }

    /// What a cell sets, as names and values.
    pub(crate) fn labels(&self, cell: &Cell) -> Vec<(String, String)> {
        let names = ["choice", &self.axes[0].name, &self.axes[1].name];
        let [first, second] = self.values(cell);
        let values = [self.choices[cell.choice].as_str(), first, second];
        names.into_iter().zip(values).map(|(name, value)| (name.to_owned(), value.to_owned())).collect()
    }

    /// The rows of the results that are there, in the order of the cells.
    pub(crate) fn rows(&self, result: &dyn Fn(usize) -> Option<RunResult>) -> Vec<(Cell, Row)> {
        let row = |(index, cell): (usize, &Cell)| Some((*cell, Row::of(self, &result(index)?)));
        self.cells.iter().enumerate().filter_map(row).collect()
    }

    /// One line for each choice: how many cells converged, and what they cost.
    #[must_use]
    pub fn summary(&self, rows: &[(Cell, Row)]) -> String {
        let line = |(choice, name): (usize, &String)| {
            let cells: Vec<&Row> =
                rows.iter().filter(|(cell, _)| cell.choice == choice).map(|(_, row)| row).collect();
            let converged = || cells.iter().filter(|row| row.outcome == Outcome::Converged);
            let most = converged().filter_map(|row| row.max_iterations()).max().unwrap_or(0);
            let others = Outcome::ALL.into_iter().filter(|outcome| *outcome != Outcome::Converged);
            let others = others.filter_map(|outcome| {
                let count = cells.iter().filter(|row| row.outcome == outcome).count();
                (count > 0).then(|| format!(", {count} {}", outcome.word()))
            });
            format!(
                "{name}: {} of {} cells converged, at most {most} iterations a step{}\n",
                converged().count(),
                cells.len(),
                others.collect::<String>()
            )
        };
        self.choices.iter().enumerate().map(line).collect()
    }
}
