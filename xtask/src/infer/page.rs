//! `docs/inference.md`.

use std::path::Path;

use crate::csv::{Csv, Row};
use crate::reproduce::case::Case;
use crate::reproduce::claims::CLAIMS;
use crate::reproduce::markdown::{percent, prose_table, table};
use crate::reproduce::results;
use crate::task::{self, TaskError};

pub(super) const SEARCHED: &str = "inference.csv";
pub(super) const ACCEPTED: &str = "inference_accepted.csv";
const FILE: &str = "docs/inference.md";
/// Best configurations shown.
const SHOWN: usize = 8;

pub(super) fn write(root: &Path) -> Result<(), TaskError> {
    task::write(&root.join(FILE), &text(root)?)
}

/// Fails where the page differs from the results.
pub(super) fn check(root: &Path) -> Result<(), TaskError> {
    if task::read(&root.join(FILE))? == text(root)? {
        return Ok(());
    }
    Err(TaskError::Failed(format!(
        "{FILE} does not say what paper/results says\nhint: `cargo xtask infer` writes it"
    )))
}

fn text(root: &Path) -> Result<String, TaskError> {
    let folder = results::folder(root);
    let (searched, accepted) = (Csv::read(&folder.join(SEARCHED))?, Csv::read(&folder.join(ACCEPTED))?);
    let mut text = INTRODUCTION.to_owned();
    for case in Case::ALL {
        text += &format!("\n## {}\n", case.scene());
        text += &best(&rows_of(&searched, case)?)?;
        text += &surface(&rows_of(&searched, case)?)?;
        text += &predictions(&rows_of(&accepted, case)?)?;
    }
    Ok(text + "\n" + &task::read(&root.join("paper/remarks-inference.md"))?)
}

const INTRODUCTION: &str = "\
# What the paper does not give, inferred

<!-- Written by `cargo xtask infer` from paper/results and paper/remarks-inference.md. Do not edit. -->

Search space, objective and selection rule stand in [paper/inference.md](../paper/inference.md), which was written before
the search ran. Fitted are the cells (1, 1) and (inf, inf) of tables 1 and 2 and nothing else; the misfit is the root mean
square deviation of their six counts.
";

fn rows_of(table: &Csv, case: Case) -> Result<Vec<Row<'_>>, TaskError> {
    let mut rows = Vec::new();
    for row in table.rows() {
        if row.value::<Case>("case")? == case {
            rows.push(row);
        }
    }
    Ok(rows)
}

fn best(rows: &[Row<'_>]) -> Result<String, TaskError> {
    let mut failed = 0;
    let mut shown = Vec::new();
    for row in rows {
        let Some(misfit) = row.optional::<f64>("misfit")? else {
            failed += 1;
            continue;
        };
        if shown.len() < SHOWN {
            let mut line = vec![row.text("configuration")?.to_owned(), format!("{:.1} %", 100.0 * misfit)];
            for cell in ["one", "inf"] {
                let count = |name: &str| row.text(&format!("{cell}_{name}")).map(str::to_owned);
                let counts = ["coupling", "newton_fluid", "newton_structure"].map(count);
                line.push(counts.into_iter().collect::<Result<Vec<_>, _>>()?.join(" / "));
            }
            shown.push(line);
        }
    }
    Ok(format!(
        "\n{} configurations were tried; in {failed} of them a step of a fitted run was not solved. The best, with coupling \
         / fluid / structure iterations:\n\n{}",
        rows.len(),
        table(&["configuration", "misfit", "(1, 1)", "(inf, inf)"], &shown)
    ))
}

/// Misfit over the first two factors of the first stage, least over the others.
fn surface(rows: &[Row<'_>]) -> Result<String, TaskError> {
    let mut points: Vec<(String, String, Option<f64>)> = Vec::new();
    for row in rows {
        if row.text("stage")? == "1" {
            let mut labels = row.text("configuration")?.split("; ").map(str::to_owned);
            let (Some(first), Some(second)) = (labels.next(), labels.next()) else { continue };
            points.push((first, second, row.optional("misfit")?));
        }
    }
    let distinct = |pick: fn(&(String, String, Option<f64>)) -> &String| {
        let mut labels: Vec<String> = points.iter().map(|point| pick(point).clone()).collect();
        labels.sort_by(|a, b| value(a).total_cmp(&value(b)));
        labels.dedup();
        labels
    };
    let (firsts, seconds) = (distinct(|point| &point.0), distinct(|point| &point.1));
    let mut lines = Vec::new();
    for first in &firsts {
        let cells = seconds.iter().map(|second| {
            let here = points.iter().filter(|(a, b, _)| a == first && b == second);
            let least = here.filter_map(|(_, _, misfit)| *misfit).reduce(f64::min);
            least.map_or_else(|| "fails".to_owned(), |misfit| format!("{:.1} %", 100.0 * misfit))
        });
        lines.push(std::iter::once(first.clone()).chain(cells).collect());
    }
    let header: Vec<String> = std::iter::once(String::new()).chain(seconds).collect();
    Ok(format!(
        "\nThe misfit over thickness \\[m\\] and Young's modulus \\[Pa\\], least over the other values of the first stage:\n\n{}",
        table(&header, &lines)
    ))
}

/// The number in a label such as `E 1e6`.
fn value(label: &str) -> f64 {
    label.split(' ').next_back().and_then(|number| number.parse().ok()).unwrap_or(f64::NAN)
}

fn predictions(rows: &[Row<'_>]) -> Result<String, TaskError> {
    let claims: Vec<&str> = CLAIMS.iter().map(|claim| claim.id).filter(|id| *id != "C9").collect();
    let mut lines = Vec::new();
    let mut held = vec![(0, 0); claims.len()];
    for (index, row) in rows.iter().enumerate() {
        let part = |column: &str| -> Result<String, TaskError> {
            Ok(row
                .optional::<f64>(column)?
                .map_or_else(|| "fails".to_owned(), |part| percent(part).replace('+', "")))
        };
        let mut line =
            vec![row.text("configuration")?.to_owned(), part("misfit")?, part("prediction_error")?];
        for (claim, (yes, all)) in claims.iter().zip(&mut held) {
            let word = row.text(claim)?;
            // The first row is the scene, which is no fit of this search.
            if index > 0 && !word.is_empty() {
                *all += 1;
                *yes += usize::from(word == "yes");
            }
            line.push(word.to_owned());
        }
        lines.push(line);
    }
    let mut share = vec![
        format!("share of the {} acceptable", rows.len().saturating_sub(1)),
        String::new(),
        String::new(),
    ];
    share
        .extend(held.iter().map(|(yes, all)| if *all == 0 { String::new() } else { format!("{yes}/{all}") }));
    lines.push(share);
    let header: Vec<&str> =
        ["configuration", "misfit", "prediction error"].into_iter().chain(claims).collect();
    Ok(format!(
        "\nHow well the other settings are predicted (limits 1, 2, inf of both fields and table 3, the fitted cells left out; \
         coupling iterations and Newton totals), and which claims hold on these settings:\n\n{}",
        prose_table(&header, &lines)
    ))
}
