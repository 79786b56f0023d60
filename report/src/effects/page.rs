//! `docs/effects.md`: the rows as tables a person reads.

use super::family::{self, List, WHOLE};
use super::row::Row;
use crate::markdown;

const HEAD: &str = "\
# What each effect costs, and what it is worth

<!-- Generated from docs/data/effects.csv: `cargo xtask effects` -->

Partita runs the effects that a scene calls for and no others. `partita plan SCENE` says which these are, and why. What is
off is neither allocated, assembled nor solved: a fluid whose boundary stands still has no mesh motion, a flow without
convection and a linear structure are factored once as long as the step size stays, one-way coupling calls each field once
a step, a rigid wall has no structure behind it.

The family here is the [beam in channel flow](../scenes/beam-in-channel/README.md), 50 steps, solved more tightly than the
paper's scene and with quadratic convergence. Seconds are those of the solvers, without building and output; factorizations
and assemblies are those of the whole run, both fields together, those for the motion of the mesh included. The error is
the largest distance of the beam's tip from where the run with all effects has it, in parts of its largest displacement;
the error of the load is the same of the force on the beam. `cargo xtask effects --mode compare` repeats all runs and compares
counts and errors with [data/effects.csv](data/effects.csv).
";

/// The page of these rows.
pub(super) fn text(rows: &[Row]) -> String {
    let mut text = HEAD.to_owned();
    let of = |list: List| -> Vec<&Row> {
        let names: Vec<&str> =
            family::all().iter().filter(|member| member.list == list).map(|member| member.name).collect();
        rows.iter().filter(|row| names.contains(&row.name.as_str())).collect()
    };
    text = text + "\n## Switched on one by one\n\n" + &table(&of(List::Ladder), rows);
    text = text + "\n## All but one\n\n" + &table(&of(List::Without), rows);
    let ran: Vec<Vec<String>> = rows.iter().map(|row| vec![row.name.clone(), row.effects.clone()]).collect();
    text + "\n## What ran\n\n" + &markdown::prose_table(&["scene", "effects"], &ran)
}

fn table(rows: &[&Row], all: &[Row]) -> String {
    let seconds = |row: &Row| row.seconds_per_step.parse::<f64>().unwrap_or(f64::NAN);
    let whole = all.iter().find(|row| row.name == WHOLE).map_or(f64::NAN, seconds);
    let header = [
        "scene",
        "ms a step",
        "of the whole",
        "factorizations",
        "assemblies",
        "error of the tip",
        "of the load",
    ];
    let line = |row: &&Row| {
        vec![
            row.name.clone(),
            format!("{:.2}", 1e3 * seconds(row)),
            format!("{:.1} %", 100.0 * seconds(row) / whole),
            row.factorizations.to_string(),
            row.assemblies.to_string(),
            percent(&row.error),
            percent(&row.load_error),
        ]
    };
    markdown::table(&header, &rows.iter().map(line).collect::<Vec<_>>())
}

/// A relative error in per cent, two digits.
fn percent(error: &str) -> String {
    match error.parse::<f64>() {
        Ok(0.0) => "0".to_owned(),
        Ok(error) if error < 1e-4 => format!("{:.0e} %", 100.0 * error),
        Ok(error) => {
            let percent = 100.0 * error;
            let digits = if percent >= 10.0 {
                0
            } else if percent >= 1.0 {
                1
            } else {
                3
            };
            format!("{percent:.digits$} %")
        }
        Err(_) => error.to_owned(),
    }
}
