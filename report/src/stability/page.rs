//! `docs/stability.md`: maps, tables and remarks as a person reads them.

use super::table::{Cell, Map, Table};
use super::{data, figure};
use crate::markdown;

const HEAD: &str = include_str!("head.md");

/// The page.
pub(super) fn text(maps: &[(Map, Table)]) -> String {
    let mut text = HEAD.to_owned();
    for (map, table) in maps {
        section(&mut text, map, table);
    }
    text
}

fn section(text: &mut String, map: &Map, table: &Table) {
    let Map { name, title, scene, axes: [rows, columns], .. } = map;
    text.push_str(&format!("\n## {title}\n\n"));
    text.push_str(&format!(
        "Map [maps/{name}.toml](../maps/{name}.toml) over [{scene}](../{scene}/README.md): {} in the rows, {} in the columns; \
         {} cells. All of them: [{}]({}).\n\n![{title}]({})\n\n",
        rows.label(),
        columns.label(),
        table.cells.len(),
        data(name).trim_start_matches("docs/"),
        data(name).trim_start_matches("docs/"),
        figure(name),
    ));
    summary(text, map, table);
    failures(text, map, table);
    text.push('\n');
    text.push_str(&filled(map, table));
}

/// A line for each choice.
fn summary(text: &mut String, map: &Map, table: &Table) {
    let has = |measure: fn(&Cell) -> Option<f64>| table.cells.iter().any(|cell| measure(cell).is_some());
    let (oscillates, moves) = (has(|cell| cell.pressure_oscillation), has(|cell| cell.mesh_quality));
    let retried = table.cells.iter().any(|cell| cell.retries > 0);
    let mut header = vec!["choice", "converged", "iterations a step, mean", "most"];
    let more = [
        (retried, "steps halved"),
        (oscillates, "largest pressure oscillation"),
        (moves, "worst cell shape"),
    ];
    header.extend(more.iter().filter(|(there, _)| *there).map(|(_, name)| *name));
    let mut lines = Vec::new();
    for choice in &map.choices {
        let cells = table.of(&choice.name);
        let good: Vec<&Cell> = cells.clone().filter(|cell| cell.converged()).collect();
        let means: Vec<f64> = good.iter().filter_map(|cell| cell.mean_iterations).collect();
        let mean = means.iter().sum::<f64>() / means.len().max(1) as f64;
        let most = good.iter().filter_map(|cell| cell.max_iterations).max().unwrap_or(0);
        let mut line = vec![
            choice.name.clone(),
            format!("{} of {}", good.len(), cells.clone().count()),
            format!("{mean:.1}"),
            most.to_string(),
        ];
        if retried {
            line.push(cells.clone().map(|cell| cell.retries).sum::<usize>().to_string());
        }
        if oscillates {
            let worst = good.iter().filter_map(|cell| cell.pressure_oscillation).fold(0.0, f64::max);
            line.push(format!("{worst:.3}"));
        }
        if moves {
            let worst = good.iter().filter_map(|cell| cell.mesh_quality).fold(1.0, f64::min);
            line.push(format!("{worst:.3}"));
        }
        lines.push(line);
    }
    text.push_str(&markdown::table(&header, &lines));
}

/// What did not converge: for each choice and outcome how often, and its first cell in the program's words.
fn failures(text: &mut String, map: &Map, table: &Table) {
    let mut lines = String::new();
    for choice in &map.choices {
        let mut seen: Vec<&str> = Vec::new();
        for cell in table.of(&choice.name).filter(|cell| !cell.converged()) {
            if seen.contains(&cell.outcome.as_str()) {
                continue;
            }
            seen.push(&cell.outcome);
            let count = table.of(&choice.name).filter(|other| other.outcome == cell.outcome).count();
            let [first, second] = &cell.values;
            let Cell { outcome, cause, remedy, .. } = cell;
            let hint = if remedy.is_empty() { String::new() } else { format!("; hint: {remedy}") };
            lines.push_str(&format!(
                "| {} | {outcome} | {count} | {first}, {second} | {}{} |\n",
                choice.name,
                cause.replace('|', "\\|"),
                hint.replace('|', "\\|")
            ));
        }
    }
    if !lines.is_empty() {
        text.push_str(
            "\nWhat does not converge, each with its first cell and what the program says there:\n\n",
        );
        text.push_str(
            "| choice | outcome | cells | the first one | what it says |\n|---|---|---:|---|---|\n",
        );
        text.push_str(&lines);
    }
}

/// The remarks with a table in place of each line `{column}`.
fn filled(map: &Map, table: &Table) -> String {
    let line = |line: &str| match line {
        "{pressure_oscillation}" => measures(map, table, |cell| cell.pressure_oscillation),
        "{structure_displacement}" => measures(map, table, |cell| cell.structure_displacement),
        other => format!("{other}\n"),
    };
    map.remarks.lines().map(line).collect()
}

/// A measure in all cells: choices and rows one below the other.
fn measures(map: &Map, table: &Table, measure: fn(&Cell) -> Option<f64>) -> String {
    let [rows, columns] = &map.axes;
    let count = columns.values.len();
    let values = table.cells.iter().take(count).map(|cell| cell.values[1].clone());
    let corner = format!("{} \\ {}", rows.label(), columns.label());
    let header: Vec<String> = ["choice".to_owned(), corner].into_iter().chain(values).collect();
    let line = |line: &[Cell]| -> Vec<String> {
        let values = line.iter().map(|cell| match measure(cell).filter(|_| cell.converged()) {
            Some(value) => three_digits(value),
            None => "-".to_owned(),
        });
        [line[0].choice.clone(), line[0].values[0].clone()].into_iter().chain(values).collect()
    };
    markdown::table(&header, &table.cells.chunks(count).map(line).collect::<Vec<_>>())
}

fn three_digits(value: f64) -> String {
    if value >= 1e-3 || value == 0.0 { format!("{value:.3}") } else { format!("{value:.1e}") }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn small_values_keep_their_digits() {
        assert_eq!([0.0, 0.0234, 1.4, 2e-5].map(three_digits), ["0.000", "0.023", "1.400", "2.0e-5"]);
    }
}
