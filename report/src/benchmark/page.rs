//! `docs/benchmarks.md`: the rows as tables a person reads.

use std::fmt::Write;

use super::case::{Case, Quantity};
use super::row::{Row, number};
use crate::markdown;

const HEAD: &str = "\
# Benchmarks

<!-- Generated from docs/data/benchmarks.csv and scenes/*/benchmark.toml: `cargo xtask benchmark` -->

Published numbers beside ours, level by level: every case is a scene with meshes (and time steps) that are refined
regularly, so that the trend tells what the last digits are worth. All rows, with unknowns, steps and times, are in
[data/benchmarks.csv](data/benchmarks.csv). Errors are relative to the reference; in the pictures of errors the
dashed lines are the targets, in those of signals the band is the mean of the reference with its amplitude. `cargo xtask benchmark CASE --mode compare` repeats
the runs of a case.

";

/// The page for `cases` with the rows that there are of them.
pub(super) fn text(cases: &[Case], rows: &[Row]) -> String {
    let mut text = HEAD.to_owned();
    overview(&mut text, cases, rows);
    for case in cases {
        let of_case: Vec<&Row> = rows.iter().filter(|row| row.case == case.name).collect();
        if !of_case.is_empty() {
            section(&mut text, case, &of_case);
        }
    }
    text
}

/// The finest level of every case in one table.
fn overview(text: &mut String, cases: &[Case], rows: &[Row]) {
    let mut lines = Vec::new();
    for case in cases {
        let of_case = || rows.iter().filter(|row| row.case == case.name);
        let finest = of_case().map(|row| row.level).max();
        for row in of_case().filter(|row| Some(row.level) == finest) {
            let Row { quantity, reference, ours, error_percent, target_percent, .. } = row;
            let mark = if row.meets_its_target() { "" } else { " (missed)" };
            lines.push(vec![
                format!("[{0}](#{0})", case.name),
                quantity.clone(),
                reference.clone(),
                ours.clone(),
                format!("{error_percent} %"),
                format!("{target_percent} %{mark}"),
            ]);
        }
    }
    *text += &markdown::prose_table(&["case", "quantity", "reference", "ours", "error", "target"], &lines);
}

fn section(text: &mut String, case: &Case, rows: &[&Row]) {
    let folder = case.scene.file_name().unwrap_or_default().to_string_lossy();
    put(text, &format!("\n## {}\n", case.name));
    put(
        text,
        &format!("{} ([scene](../scenes/{folder}/README.md)). Reference: {}.\n", case.title, case.source),
    );
    let mut levels: Vec<&Row> = rows.to_vec();
    levels.sort_by_key(|row| row.level);
    levels.dedup_by_key(|row| row.level);
    text.push_str(&table(case, rows, &levels));
    let missing: Vec<String> = (1..=case.levels.len())
        .filter(|number| levels.iter().all(|row| row.level != *number))
        .map(|number| number.to_string())
        .collect();
    if !missing.is_empty() {
        put(text, &format!("\nLevel {} has not been run.", missing.join(" and ")));
    }
    if levels.len() > 1 {
        put(text, &format!("\n![Errors of {0} over unknowns](benchmarks/{0}.svg)", case.name));
    }
    if case.until.is_some() {
        put(text, &format!("\n![Last periods of {0}](benchmarks/{0}-signals.svg)", case.name));
    }
    if !case.remark.is_empty() {
        put(text, &format!("\n{}", case.remark.trim()));
    }
}

/// A column for each level: quantities, then what they cost.
fn table(case: &Case, rows: &[&Row], levels: &[&Row]) -> String {
    let line = |name: &str, reference: String, cell: &dyn Fn(&Row) -> String| -> Vec<String> {
        [name.to_owned(), reference].into_iter().chain(levels.iter().map(|row| cell(row))).collect()
    };
    let of_quantity = |quantity: &Quantity| {
        line(&quantity.name, quantity.reference.to_string(), &|level| {
            let row = rows.iter().find(|row| row.level == level.level && row.quantity == quantity.name);
            row.map_or_else(String::new, |row| format!("{} ({} %)", row.ours, row.error_percent))
        })
    };
    let mut lines: Vec<Vec<String>> = case.quantities.iter().map(of_quantity).collect();
    let has = |is_there: fn(&Row) -> bool| levels.iter().any(|row| is_there(row));
    let mut add = |is_there: bool, name: &str, cell: &dyn Fn(&Row) -> String| {
        lines.extend(is_there.then(|| line(name, String::new(), cell)));
    };
    add(true, "unknowns", &|row| row.dofs.to_string());
    add(true, "steps", &|row| row.steps.to_string());
    let coupled = has(|row| !row.coupling_per_step.is_empty());
    add(coupled, "coupling iterations a step", &|row| row.coupling_per_step.clone());
    add(true, "processor time [s]", &|row| row.cpu_seconds.clone());
    add(has(|row| row.steps > 1), "... a step", &|row| per(row, row.steps as f64));
    let timed = has(|row| !row.simulated_seconds.is_empty());
    add(timed, "... a simulated second", &|row| per(row, number(&row.simulated_seconds)));
    let repeats = has(|row| !row.repeats_percent.is_empty());
    add(repeats, "last periods repeat to", &|row| format!("{} %", row.repeats_percent));
    let header = line("", "reference".to_owned(), &|row| format!("level {}", row.level));
    // The cells beside names and below the reference are left blank, and narrow.
    markdown::prose_table(&header, &lines)
        .lines()
        .map(|line| line.replacen("|  |", "| |", 1) + "\n")
        .collect()
}

/// Processor time for each of so many \[s\].
fn per(row: &Row, count: f64) -> String {
    let each = number(&row.cpu_seconds) / count;
    if each.is_finite() { format!("{each:.3}") } else { String::new() }
}

fn put(text: &mut String, line: &str) {
    writeln!(text, "{line}").expect("a String takes any text");
}

#[cfg(test)]
mod tests {
    use super::super::case::Take;
    use super::*;

    fn row(level: usize, ours: &str, error: &str) -> Row {
        let of = super::super::row::tests::row(level, ours, error);
        Row { quantity: "u_y".into(), dofs: 100 * level, ..of }
    }

    #[test]
    fn a_missed_target_is_marked_and_the_levels_stand_side_by_side() {
        let case = Case {
            name: "csm1".into(),
            title: "A flag".into(),
            source: "A paper".into(),
            remark: "What limits it.".into(),
            set: vec![],
            levels: vec![vec![], vec![]],
            quantities: vec![Quantity {
                name: "u_y".into(),
                column: "tip".into(),
                take: Take::Last,
                scale: 1.0,
                reference: -66.1,
                around: None,
                target_percent: 1.0,
            }],
            until: None,
            scene: "scenes/flag".into(),
        };
        let page = text(&[case], &[row(1, "-64", "3.177"), row(2, "-65", "1.664")]);
        let body = page.strip_prefix(HEAD).expect("the head comes first");
        let expected = "\
| case | quantity | reference | ours | error | target |
|---|---|---|---|---|---|
| [csm1](#csm1) | u_y | -66.1 | -65 | 1.664 % | 1 % (missed) |

## csm1

A flag ([scene](../scenes/flag/README.md)). Reference: A paper.

| | reference | level 1 | level 2 |
|---|---|---|---|
| u_y | -66.1 | -64 (3.177 %) | -65 (1.664 %) |
| unknowns | | 100 | 200 |
| steps | | 1 | 1 |
| processor time [s] | | 0.01 | 0.01 |

![Errors of csm1 over unknowns](benchmarks/csm1.svg)

What limits it.
";
        assert_eq!(body, expected);
    }
}
