//! `docs/inference.md`.

use std::path::Path;

use crate::csv::{Csv, Row};
use crate::markdown::{prose_table, table};
use crate::reproduce::case::Case;
use crate::reproduce::claims::CLAIMS;
use crate::reproduce::results;
use crate::task::{self, TaskError};

pub(super) const RESULTS: &str = "neighbours.csv";
pub(super) const FILE: &str = "docs/inference.md";

/// The page of the results.
pub(super) fn text(root: &Path) -> Result<String, TaskError> {
    let results = Csv::read(&results::folder(root).join(RESULTS))?;
    let mut text = INTRODUCTION.to_owned();
    for case in Case::ALL {
        let rows = rows_of(&results, case)?;
        text += &format!("\n## {}\n\n", case.scene());
        text += &counts(&rows)?;
        text += CLAIMS_ON_THESE;
        text += &claims(&rows)?;
    }
    Ok(text + "\n" + &task::read(&root.join("paper/remarks-inference.md"))?)
}

const INTRODUCTION: &str = "\
# What the paper does not give, inferred

<!-- Written by `cargo xtask infer` from paper/results and paper/remarks-inference.md. Do not edit. -->

How the values of the two scenes were found stands in [paper/inference.md](../paper/inference.md). This page shows how much
hangs on them: each row is the scene with one thing changed, at the limits 1, 2, 3 and inf of both fields and the three
settings of table 3. Compared are 38 published numbers a case, coupling iterations and Newton totals. The prediction error is
the root mean square deviation over the settings that took no part in the choice of the values.
";

const CLAIMS_ON_THESE: &str = "\nWhich claims hold on these settings:\n\n";

fn rows_of(table: &Csv, case: Case) -> Result<Vec<Row<'_>>, TaskError> {
    let mut rows = Vec::new();
    for row in table.rows() {
        if row.value::<Case>("case")? == case {
            rows.push(row);
        }
    }
    Ok(rows)
}

fn counts(rows: &[Row<'_>]) -> Result<String, TaskError> {
    let mut lines = Vec::new();
    for row in rows {
        let part = |column: &str| -> Result<String, TaskError> {
            Ok(format!("{:.1} %", 100.0 * row.value::<f64>(column)?))
        };
        let mut line = vec![row.text("configuration")?.to_owned()];
        for column in ["within_5", "within_10"] {
            line.push(format!("{} of {}", row.text(column)?, row.text("counts")?));
        }
        line.extend([part("worst")?, part("prediction_error")?]);
        lines.push(line);
    }
    Ok(table(&["", "within 5 %", "within 10 %", "worst", "prediction error"], &lines))
}

fn claims(rows: &[Row<'_>]) -> Result<String, TaskError> {
    let claims: Vec<&str> = CLAIMS.iter().map(|claim| claim.id).filter(|id| *id != "C9").collect();
    let mut lines = Vec::new();
    let mut held = vec![(0, 0); claims.len()];
    for row in rows {
        let mut line = vec![row.text("configuration")?.to_owned()];
        for (claim, (yes, all)) in claims.iter().zip(&mut held) {
            let word = row.text(claim)?;
            *all += usize::from(!word.is_empty());
            *yes += usize::from(word == "yes");
            line.push(word.to_owned());
        }
        lines.push(line);
    }
    let shares = held.iter().map(|(yes, all)| if *all == 0 { String::new() } else { format!("{yes}/{all}") });
    lines.push(std::iter::once("holds in".to_owned()).chain(shares).collect());
    let header: Vec<&str> = std::iter::once("").chain(claims).collect();
    Ok(prose_table(&header, &lines))
}
