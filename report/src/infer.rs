//! What the paper does not give: how far the counts depend on the inferred values, as `paper/inference.md` asks.

pub(crate) mod neighbours;
mod page;

use std::path::Path;

use crate::csv::Csv;
use crate::kept::{self, COUNT, EXACT, Tolerance};
use crate::options::Abilities;
use crate::report::{File, Found, Report};
use crate::reproduce::case::{Case, product};
use crate::reproduce::claims::{CLAIMS, word};
use crate::reproduce::counts::{Count, deviation};
use crate::reproduce::facts::Facts;
use crate::reproduce::published::Published;
use crate::reproduce::results;
use crate::reproduce::setting::{Limits, Setting};
use crate::reproduce::study::{Study, carry_out_all};
use crate::runs::Runs;
use crate::task::TaskError;

/// The scenes with one thing changed at a time.
pub(crate) struct Infer;

impl Report for Infer {
    fn abilities(&self) -> Abilities {
        Abilities::of("infer")
    }

    fn found(&self, runs: Runs) -> Result<Found, TaskError> {
        let published = Published::read(&runs.root)?;
        let mut table = table();
        for case in Case::ALL {
            let choices = neighbours::all(&runs.root, &runs.supplies(), case)?;
            let studies: Vec<Study> = choices.iter().map(|choice| study(case, choice.keys.clone())).collect();
            for (choice, facts) in choices.iter().zip(&carry_out_all(&runs, &studies)?) {
                table.push(row(case, &choice.label, facts, published.of(case)));
            }
        }
        Ok(Found { tables: vec![results::table(page::RESULTS, table, differences)], files: Vec::new() })
    }

    fn pages(&self, root: &Path) -> Result<Vec<File>, TaskError> {
        Ok(vec![(page::FILE.to_owned(), page::text(root)?)])
    }
}

/// Deviations are parts of counts; how many of them are small follows from these.
fn differences(kept: &Csv, found: &Csv) -> Result<Vec<String>, TaskError> {
    let part = Tolerance { part: 0.0, least: COUNT.part };
    let columns = [("counts", EXACT), ("worst", part), ("predicted", EXACT), ("prediction_error", part)];
    let claims = CLAIMS.iter().map(|claim| (claim.id, EXACT));
    let columns: Vec<_> = columns.into_iter().chain(claims).collect();
    kept::differences(&["case", "configuration"], &columns, kept, found)
}

/// Limits 1, 2, 3 and inf of both fields and table 3.
fn study(case: Case, keys: Vec<String>) -> Study {
    Study { limits: product(&[1, 2, 3], &[1, 2, 3]), ..Study::small(case, keys) }
}

/// The cells that took part in the choice of the values; the beam's choice also looked at claim C10.
fn chosen_by(case: Case) -> Vec<Limits> {
    let three = Limits::at_most(3, 3);
    let structure_one = Limits { structure: Limits::ONE.structure, ..Limits::UNLIMITED };
    match case {
        Case::Tank => vec![Limits::ONE, Limits::UNLIMITED, structure_one, three],
        Case::Beam => vec![Limits::ONE, Limits::UNLIMITED],
    }
}

/// Relative deviations of coupling iterations and Newton totals from the published ones, over the settings that `keep`
/// says; 1 where a run failed.
fn deviations(facts: &Facts, published: &Facts, keep: impl Fn(Setting) -> bool) -> Vec<f64> {
    let fixed = facts.grid.cells.keys().copied().map(Setting::Fixed);
    let settings = fixed.chain(facts.adaptive.keys().copied().map(Setting::Adaptive));
    let of_setting = |setting: Setting| {
        let reference = published.counts(setting).expect("the published tables are complete");
        [Count::Coupling, Count::Newton].map(|count| {
            let ours = facts.counts(setting).map(|counts| deviation(count.of(counts), count.of(reference)));
            ours.unwrap_or(1.0)
        })
    };
    settings.filter(|setting| keep(*setting)).flat_map(of_setting).collect()
}

fn root_mean_square(values: &[f64]) -> f64 {
    (values.iter().map(|value| value * value).sum::<f64>() / values.len() as f64).sqrt()
}

fn within(values: &[f64], bound: f64) -> usize {
    values.iter().filter(|value| value.abs() <= bound).count()
}

/// A word for each claim; nothing where it is about the other case or about time.
pub(crate) fn claim_words(facts: &Facts) -> impl Iterator<Item = String> {
    CLAIMS.iter().map(|claim| {
        let verdict = claim.on(facts).filter(|_| claim.id != "C9");
        verdict.map(|verdict| word(verdict.holds).to_owned()).unwrap_or_default()
    })
}

fn table() -> Csv {
    let ids = CLAIMS.iter().map(|claim| claim.id);
    let numbers = ["counts", "within_5", "within_10", "worst", "predicted", "prediction_error"];
    Csv::new(["case", "configuration"].into_iter().chain(numbers).chain(ids))
}

fn row(case: Case, label: &str, facts: &Facts, published: &Facts) -> Vec<String> {
    let all = deviations(facts, published, |_| true);
    let chosen = chosen_by(case);
    let fresh = |setting| !matches!(setting, Setting::Fixed(limits) if chosen.contains(&limits));
    let predicted = deviations(facts, published, fresh);
    let worst = all.iter().fold(0.0, |worst: f64, value| worst.max(value.abs()));
    let mut row = vec![case.to_string(), label.to_owned()];
    row.extend([all.len(), within(&all, 0.05), within(&all, 0.1)].map(|count| count.to_string()));
    row.push(format!("{worst:.4}"));
    row.push(predicted.len().to_string());
    row.push(format!("{:.4}", root_mean_square(&predicted)));
    row.extend(claim_words(facts));
    row
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::task::workspace_root;

    #[test]
    fn the_published_counts_do_not_deviate_from_themselves() {
        let published = Published::read(workspace_root()).expect("the files are there");
        for facts in &published.facts {
            let settings = facts.grid.cells.len() + facts.adaptive.len();
            assert_eq!(deviations(facts, facts, |_| true), vec![0.0; 2 * settings]);
        }
    }

    #[test]
    fn thirty_eight_counts_are_compared_of_which_thirty_of_the_tank_are_predicted() {
        for (case, predicted) in [(Case::Tank, 15), (Case::Beam, 17)] {
            let study = study(case, Vec::new());
            assert_eq!(study.limits.len() + study.adaptive.len(), 19);
            let chosen = chosen_by(case);
            assert!(chosen.iter().all(|limits| study.limits.contains(limits)));
            assert_eq!(19 - chosen.len(), predicted);
        }
    }

    #[test]
    fn a_failed_run_predicts_nothing() {
        let published = Published::read(workspace_root()).expect("the files are there");
        let facts = published.of(Case::Beam);
        let mut failed = facts.clone();
        failed.grid.cells.insert(Limits::ONE, None);
        let found = deviations(&failed, facts, |setting| setting == Setting::Fixed(Limits::ONE));
        assert_eq!(found, [1.0, 1.0]);
    }
}
