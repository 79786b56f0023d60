//! The claims on cases with other values than the scenes', each at three density ratios.

use std::path::Path;

use crate::csv::Csv;
use crate::infer::claim_words;
use crate::infer::neighbours::{Choice, thickness, viscosity, young};
use crate::kept::{self, COUNT, EXACT};
use crate::markdown::prose_table;
use crate::options::Abilities;
use crate::report::{File, Found, Report};
use crate::reproduce::Tables;
use crate::reproduce::case::Case;
use crate::reproduce::claims::CLAIMS;
use crate::reproduce::facts::Facts;
use crate::reproduce::results;
use crate::reproduce::setting::{Adaptive, Setting};
use crate::reproduce::study::{Study, carry_out_all};
use crate::runs::Runs;
use crate::task::TaskError;

const RESULTS: &str = "sensitivity.csv";

/// The scene, and scenes with other values that the paper does not exclude either.
pub(crate) fn variants(root: &Path, folder: &Path, case: Case) -> Result<Vec<Choice>, TaskError> {
    let scene = Choice { label: "the scene".to_owned(), keys: Vec::new() };
    let thickness = |value: f64| thickness(root, folder, case, value);
    Ok(match case {
        Case::Tank => vec![
            scene,
            joined([thickness(0.02)?, young(5e6)]),
            joined([thickness(0.1)?, young(1e6)]),
            viscosity(20.0),
            Choice {
                label: "spectral radius 0.5".to_owned(),
                keys: vec!["structure.time_scheme.generalized_alpha.spectral_radius=0.5".to_owned()],
            },
        ],
        Case::Beam => vec![scene, thickness(0.05)?, thickness(0.08)?, young(1.2e7), viscosity(0.1)],
    })
}

fn joined(choices: [Choice; 2]) -> Choice {
    let label = choices.each_ref().map(|choice| choice.label.as_str()).join("; ");
    Choice { label, keys: choices.into_iter().flat_map(|choice| choice.keys).collect() }
}

/// Density ratios fluid to solid, the paper's in the middle. At 0.2 constant relaxation of 0.8 is near its limit on the
/// beam; a decade each way leaves the tank solvable.
fn ratios(case: Case) -> [f64; 3] {
    match case {
        Case::Tank => [0.1, 1.0, 10.0],
        Case::Beam => [0.05, 0.1, 0.2],
    }
}

/// The claims on other cases.
pub(crate) struct Sensitivity;

impl Report for Sensitivity {
    fn abilities(&self) -> Abilities {
        Abilities::of("sensitivity")
    }

    fn found(&self, runs: Runs) -> Result<Found, TaskError> {
        let mut table = table();
        for case in Case::ALL {
            let mut cases = Vec::new();
            let mut studies = Vec::new();
            for variant in variants(&runs.root, &runs.supplies(), case)? {
                for ratio in ratios(case) {
                    let mut keys = variant.keys.clone();
                    keys.push(format!("structure.density={:?}", case.fluid_density() / ratio));
                    studies.push(Study::small(case, keys));
                    cases.push((variant.label.clone(), ratio));
                }
            }
            for ((label, ratio), facts) in cases.iter().zip(&carry_out_all(&runs, &studies)?) {
                table.push(row(case, label, *ratio, facts));
            }
        }
        Ok(Found { tables: vec![results::table(RESULTS, table, differences)], files: Vec::new() })
    }

    /// Its section is on the page of the reproduction.
    fn pages(&self, root: &Path) -> Result<Vec<File>, TaskError> {
        Tables::default().pages(root)
    }
}

const COUNTS: [&str; 5] = ["one_coupling", "one_newton", "inf_coupling", "inf_newton", "n1_cc_newton"];

fn differences(kept: &Csv, found: &Csv) -> Result<Vec<String>, TaskError> {
    let claims = CLAIMS.iter().map(|claim| (claim.id, EXACT));
    let columns: Vec<_> = claims.chain(COUNTS.map(|column| (column, COUNT))).collect();
    kept::differences(&["case", "variant", "density_ratio"], &columns, kept, found)
}

fn table() -> Csv {
    let ids = CLAIMS.iter().map(|claim| claim.id);
    Csv::new(["case", "variant", "density_ratio"].into_iter().chain(ids).chain(["cheapest"]).chain(COUNTS))
}

fn row(case: Case, variant: &str, ratio: f64, facts: &Facts) -> Vec<String> {
    let mut row = vec![case.to_string(), variant.to_owned(), ratio.to_string()];
    row.extend(claim_words(facts));
    row.push(facts.grid.cheapest().map(|(cells, _)| cells[0].to_string()).unwrap_or_default());
    for counts in [facts.one(), facts.unlimited()] {
        row.push(counts.map(|counts| counts.coupling.to_string()).unwrap_or_default());
        row.push(counts.map(|counts| counts.newton().to_string()).unwrap_or_default());
    }
    let n1_cc = facts.counts(Setting::Adaptive(Adaptive::N1Cc));
    row.push(n1_cc.map(|counts| counts.newton().to_string()).unwrap_or_default());
    row
}

/// The section of the page; nothing where the set was not run.
pub(crate) fn section(root: &Path) -> Result<String, TaskError> {
    let path = results::folder(root).join(RESULTS);
    if !path.is_file() {
        return Ok(String::new());
    }
    let claims: Vec<&str> = CLAIMS.iter().map(|claim| claim.id).filter(|id| *id != "C9").collect();
    let mut lines = Vec::new();
    let mut held = vec![(0, 0); claims.len()];
    for row in Csv::read(&path)?.rows() {
        let case: Case = row.value("case")?;
        let mut line = vec![
            case.short().to_owned(),
            row.text("variant")?.to_owned(),
            row.text("density_ratio")?.to_owned(),
        ];
        for (claim, (yes, all)) in claims.iter().zip(&mut held) {
            let word = row.text(claim)?;
            *all += usize::from(!word.is_empty());
            *yes += usize::from(word == "yes");
            line.push(word.to_owned());
        }
        line.push(row.text("cheapest")?.to_owned());
        lines.push(line);
    }
    let mut share = vec!["holds in".to_owned(), String::new(), String::new()];
    share.extend(held.iter().map(|(yes, all)| format!("{yes}/{all}")));
    share.push(String::new());
    lines.push(share);
    let header: Vec<&str> =
        ["", "values", "rho_f/rho_s"].into_iter().chain(claims).chain(["cheapest"]).collect();
    Ok(format!("{INTRODUCTION}{}", prose_table(&header, &lines)))
}

const INTRODUCTION: &str = "
## Sensitivity

The claims on cases with other values that the paper's text does not exclude, at three density ratios each (the solid's
density is changed). The limits are 1, 2 and inf of both fields and table 3; a claim whose runs do not all reach their end
counts as failing. The last column is the cell with the smallest Newton total. Written by `cargo xtask sensitivity`.

";
