//! Whether a map has come out as it did before.
//!
//! On one machine a table is the same to the last digit. Another processor rounds otherwise; an iteration that is close to
//! its bound then ends one earlier or later. So outcomes must be the same, the mean of a cell may differ by [`CELL`], and
//! the Newton iterations of all the converged cells of a choice by [`CHOICE`], as in the reproduction of the paper.

use super::table::{Cell, Table};
use crate::csv::Csv;
use crate::task::TaskError;

/// Largest difference of a cell's mean iterations: half an iteration, or this part of it.
const CELL: f64 = 0.1;
/// Largest relative difference of the Newton iterations of a choice.
const CHOICE: f64 = 0.02;

/// What differs, a line each.
pub(super) fn differences(kept: &Csv, found: &Csv) -> Result<Vec<String>, TaskError> {
    Ok(between(&Table::read(kept)?, &Table::read(found)?))
}

fn between(kept: &Table, found: &Table) -> Vec<String> {
    let place = |cell: &Cell| (cell.choice.clone(), cell.values.clone());
    let mut all = Vec::new();
    if kept.cells.iter().map(place).ne(found.cells.iter().map(place)) {
        all.push("its cells are not those of the table kept".to_owned());
        return all;
    }
    for (kept, found) in kept.cells.iter().zip(&found.cells) {
        let [first, second] = &found.values;
        let name = format!("{} at {first}, {second}", found.choice);
        if kept.outcome != found.outcome {
            all.push(format!("{name}: {}, before {}; {}", found.outcome, kept.outcome, found.cause));
        } else if found.converged() && apart(kept.mean_iterations, found.mean_iterations) {
            let mean = |cell: &Cell| cell.mean_iterations.unwrap_or(0.0);
            all.push(format!("{name}: {} iterations a step, before {}", mean(found), mean(kept)));
        }
    }
    let mut choices: Vec<&str> = found.cells.iter().map(|cell| cell.choice.as_str()).collect();
    choices.dedup();
    for choice in choices {
        let newton = |table: &Table| -> usize {
            table.of(choice).filter(|cell| cell.converged()).map(|cell| cell.newton_iterations).sum()
        };
        let (kept, found) = (newton(kept), newton(found));
        if kept.abs_diff(found) as f64 > CHOICE * kept as f64 {
            all.push(format!("{choice}: {found} Newton iterations, before {kept}"));
        }
    }
    all
}

fn apart(kept: Option<f64>, found: Option<f64>) -> bool {
    match (kept, found) {
        (Some(kept), Some(found)) => (kept - found).abs() > (CELL * kept).max(0.5),
        (kept, found) => kept.is_some() != found.is_some(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn cell(value: &str, outcome: &str, mean: f64, newton: usize) -> Cell {
        Cell {
            choice: "Aitken".to_owned(),
            values: [value.to_owned(), "1".to_owned()],
            outcome: outcome.to_owned(),
            mean_iterations: Some(mean),
            max_iterations: Some(9),
            newton_iterations: newton,
            retries: 0,
            cause: String::new(),
            remedy: String::new(),
            pressure_oscillation: None,
            structure_displacement: None,
            mesh_quality: None,
        }
    }

    fn table(cells: &[Cell]) -> Table {
        Table { cells: cells.to_vec() }
    }

    #[test]
    fn outcomes_are_the_same_and_counts_almost() {
        let kept = table(&[cell("1", "converged", 5.0, 1000), cell("2", "diverged", 3.0, 50)]);
        let found = |cells: &[Cell]| between(&kept, &table(cells)).len();
        assert_eq!(found(&[cell("1", "converged", 5.4, 1019), cell("2", "diverged", 9.0, 90)]), 0);
        assert_eq!(found(&[cell("1", "converged", 5.6, 1000), cell("2", "diverged", 3.0, 50)]), 1);
        assert_eq!(found(&[cell("1", "converged", 5.0, 1021), cell("2", "diverged", 3.0, 50)]), 1);
        assert_eq!(found(&[cell("1", "converged", 5.0, 1000), cell("2", "field_failed", 3.0, 50)]), 1);
        assert_eq!(found(&[cell("1", "converged", 5.0, 1000)]), 1);
    }
}
