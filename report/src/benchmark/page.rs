//! `docs/benchmarks.md`: the rows as tables a person reads.

use std::fmt::Write;

use super::case::Case;
use super::row::{Row, number};

const HEAD: &str = "\
# Benchmarks

<!-- Generated from docs/data/benchmarks.csv and scenes/*/benchmark.toml: `cargo xtask benchmark --mode write` -->

Published numbers beside ours, level by level: every case is a scene with meshes (and time steps) that are refined
regularly, so that the trend tells what the last digits are worth. All rows, with unknowns, steps and times, are in
[data/benchmarks.csv](data/benchmarks.csv). Errors are relative to the reference; in the pictures of errors the
dashed lines are the targets, in those of signals the band is the mean of the reference with its amplitude. A run is repeated with `cargo xtask benchmark CASE`.

";

/// The page for `cases` with the rows that there are of them.
pub(super) fn markdown(cases: &[Case], rows: &[Row]) -> String {
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
    put(text, "| case | quantity | reference | ours | error | target |\n|---|---|---|---|---|---|");
    for case in cases {
        let of_case = || rows.iter().filter(|row| row.case == case.name);
        let finest = of_case().map(|row| row.level).max();
        for row in of_case().filter(|row| Some(row.level) == finest) {
            let Row { quantity, reference, ours, error_percent, target_percent, .. } = row;
            let mark = if row.meets_its_target() { "" } else { " (missed)" };
            put(
                text,
                &format!(
                    "| [{}](#{}) | {quantity} | {reference} | {ours} | {error_percent} % | {target_percent} %{mark} |",
                    case.name, case.name
                ),
            );
        }
    }
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
    let cells = |cell: &dyn Fn(&Row) -> String| {
        levels.iter().map(|row| cell(row)).fold(String::new(), |line, cell| line + " " + &cell + " |")
    };
    put(text, &format!("| | reference |{}", cells(&|row| format!("level {}", row.level))));
    put(text, &format!("|---|---|{}", "---|".repeat(levels.len())));
    for quantity in &case.quantities {
        let mut line = format!("| {} | {} |", quantity.name, quantity.reference);
        for level in &levels {
            let row = rows.iter().find(|row| row.level == level.level && row.quantity == quantity.name);
            let cell = row.map_or_else(String::new, |row| format!("{} ({} %)", row.ours, row.error_percent));
            write!(line, " {cell} |").expect("a String takes any text");
        }
        put(text, &line);
    }
    put(text, &format!("| unknowns | |{}", cells(&|row| row.dofs.to_string())));
    put(text, &format!("| steps | |{}", cells(&|row| row.steps.to_string())));
    if levels.iter().any(|row| !row.coupling_per_step.is_empty()) {
        put(
            text,
            &format!("| coupling iterations a step | |{}", cells(&|row| row.coupling_per_step.clone())),
        );
    }
    put(text, &format!("| processor time [s] | |{}", cells(&|row| row.cpu_seconds.clone())));
    if levels.iter().any(|row| row.steps > 1) {
        put(text, &format!("| ... a step | |{}", cells(&|row| per(row, row.steps as f64))));
    }
    if levels.iter().any(|row| !row.simulated_seconds.is_empty()) {
        put(
            text,
            &format!(
                "| ... a simulated second | |{}",
                cells(&|row| per(row, number(&row.simulated_seconds)))
            ),
        );
    }
    if levels.iter().any(|row| !row.repeats_percent.is_empty()) {
        let cell = |row: &Row| format!("{} %", row.repeats_percent);
        put(text, &format!("| last periods repeat to | |{}", cells(&cell)));
    }
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
    use super::super::case::{Quantity, Take};
    use super::*;

    fn row(level: usize, ours: &str, error: &str) -> Row {
        Row {
            case: "csm1".into(),
            level,
            quantity: "u_y".into(),
            reference: "-66.1".into(),
            ours: ours.into(),
            error_percent: error.into(),
            target_percent: "1".into(),
            dofs: 100 * level,
            steps: 1,
            cpu_seconds: "0.01".into(),
            coupling_per_step: String::new(),
            simulated_seconds: String::new(),
            repeats_percent: String::new(),
        }
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
        let page = markdown(&[case], &[row(1, "-64", "3.177"), row(2, "-65", "1.664")]);
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
