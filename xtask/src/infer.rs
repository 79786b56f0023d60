//! Inference of what the paper does not give, as `paper/inference.md` describes it.

mod page;
pub(crate) mod space;

use std::path::Path;

use crate::csv::Csv;
use crate::options::{Mode, Options};
use crate::reproduce::case::Case;
use crate::reproduce::claims::{CLAIMS, word};
use crate::reproduce::counts::{Count, Counts, deviation};
use crate::reproduce::facts::Facts;
use crate::reproduce::published::Published;
use crate::reproduce::results;
use crate::reproduce::run::Run;
use crate::reproduce::setting::{Limits, Setting};
use crate::reproduce::study::{Study, carry_out};
use crate::reproduce::workshop::Workshop;
use crate::task::{self, TaskError};
use space::Configuration;

/// Largest misfit of an acceptable configuration.
const ACCEPTABLE: f64 = 0.05;
/// No more acceptable configurations than these.
const MOST: usize = 8;
/// Configurations of the first stage round which the second varies.
const CENTRES: usize = 3;

const FITTED: [Limits; 2] = [Limits::ONE, Limits::UNLIMITED];

/// A configuration and what its two fitted cells came to.
struct Tried {
    stage: usize,
    configuration: Configuration,
    counts: [Option<Counts>; 2],
    misfit: Option<f64>,
}

/// The task as its options say.
pub(crate) fn run(root: &Path, options: &Options) -> Result<(), TaskError> {
    let mode = options.mode.unwrap_or(Mode::Write);
    match mode {
        Mode::Check => return page::check(root),
        Mode::Page => return page::write(root),
        Mode::Write | Mode::Print => {}
    }
    let workshop = Workshop::open(root, options.jobs, !options.fresh)?;
    let published = Published::read(root)?;
    let (mut tried, mut accepted) = (searched_table(), accepted_table());
    for case in Case::ALL {
        let found = search(root, &workshop, case, published.of(case))?;
        for one in &found {
            tried.push(searched_row(case, one));
        }
        for row in judge_accepted(&workshop, case, &found, published.of(case))? {
            accepted.push(row);
        }
    }
    if mode == Mode::Print {
        print!("{}{}", tried.to_text(), accepted.to_text());
        return Ok(());
    }
    let folder = results::folder(root);
    task::write(&folder.join(page::SEARCHED), &tried.to_text())?;
    task::write(&folder.join(page::ACCEPTED), &accepted.to_text())?;
    page::write(root)
}

/// All stages, best first; configurations that fail come last.
fn search(
    root: &Path,
    workshop: &Workshop<'_>,
    case: Case,
    published: &Facts,
) -> Result<Vec<Tried>, TaskError> {
    let grid = space::grid(root, &workshop.supplies(), case)?;
    let mut tried = attempt(workshop, case, 1, grid, published)?;
    sort(&mut tried);
    let centres: Vec<Configuration> =
        tried.iter().take(CENTRES).map(|one| one.configuration.clone()).collect();
    let variations = space::variations(case);
    let second = centres.iter().flat_map(|centre| variations.iter().map(|choice| centre.with(choice)));
    tried.extend(attempt(workshop, case, 2, second.collect(), published)?);
    tried.extend(attempt(workshop, case, 3, space::refined(case), published)?);
    sort(&mut tried);
    Ok(tried)
}

fn sort(tried: &mut [Tried]) {
    let misfit = |one: &Tried| one.misfit.unwrap_or(f64::INFINITY);
    tried.sort_by(|a, b| misfit(a).total_cmp(&misfit(b)));
}

/// Runs the fitted cells of some configurations.
fn attempt(
    workshop: &Workshop<'_>,
    case: Case,
    stage: usize,
    configurations: Vec<Configuration>,
    published: &Facts,
) -> Result<Vec<Tried>, TaskError> {
    let runs: Vec<Run> = configurations
        .iter()
        .flat_map(|configuration| {
            FITTED.map(|limits| Run::new(case, Setting::Fixed(limits)).with(&configuration.keys()))
        })
        .collect();
    let (outcomes, _) = workshop.run_all(&runs)?;
    let (pairs, _) = outcomes.as_chunks::<2>();
    Ok(configurations
        .into_iter()
        .zip(pairs)
        .map(|(configuration, pair)| {
            let counts = [pair[0].counts(), pair[1].counts()];
            let misfit = misfit(counts, published);
            Tried { stage, configuration, counts, misfit }
        })
        .collect())
}

/// Root mean square of the relative deviations of the six fitted numbers; `None` if a run failed.
fn misfit(counts: [Option<Counts>; 2], published: &Facts) -> Option<f64> {
    let mut deviations = Vec::new();
    for (limits, counts) in FITTED.into_iter().zip(counts) {
        let reference = published.grid.get(limits).expect("the published tables are complete");
        for count in [Count::Coupling, Count::Fluid, Count::Structure] {
            deviations.push(deviation(count.of(counts?), count.of(reference)));
        }
    }
    Some(root_mean_square(&deviations))
}

fn root_mean_square(values: &[f64]) -> f64 {
    (values.iter().map(|value| value * value).sum::<f64>() / values.len() as f64).sqrt()
}

/// Prediction error over the settings of `facts` that were not fitted, and how many those are.
fn prediction(facts: &Facts, published: &Facts) -> (f64, usize) {
    let fixed = facts.grid.cells.keys().filter(|limits| !FITTED.contains(limits)).copied();
    let settings: Vec<Setting> =
        fixed.map(Setting::Fixed).chain(facts.adaptive.keys().copied().map(Setting::Adaptive)).collect();
    let mut deviations = Vec::new();
    for &setting in &settings {
        let reference = published.counts(setting).expect("the published tables are complete");
        for count in [Count::Coupling, Count::Newton] {
            // A run that fails predicts nothing: as wrong as twice the number.
            let ours = facts.counts(setting).map(|counts| deviation(count.of(counts), count.of(reference)));
            deviations.push(ours.unwrap_or(1.0));
        }
    }
    (root_mean_square(&deviations), settings.len())
}

/// The scene before the search and each acceptable configuration, with predictions and claims.
fn judge_accepted(
    workshop: &Workshop<'_>,
    case: Case,
    tried: &[Tried],
    published: &Facts,
) -> Result<Vec<Vec<String>>, TaskError> {
    let acceptable: Vec<&Tried> =
        tried.iter().filter(|one| one.misfit.is_some_and(|misfit| misfit <= ACCEPTABLE)).take(MOST).collect();
    let mut studies = vec![Study::small(case, Configuration::start(case).keys())];
    studies.extend(acceptable.iter().map(|one| Study::small(case, one.configuration.keys())));
    let (found, _) = carry_out(workshop, &studies)?;
    let labels = std::iter::once("the scene before the search".to_owned())
        .chain(acceptable.iter().map(|one| one.configuration.label()));
    Ok(labels
        .zip(&found)
        .map(|(label, facts)| {
            let fit = misfit(FITTED.map(|limits| facts.grid.get(limits)), published);
            let mut row = vec![case.to_string(), label];
            row.push(fit.map(|misfit| format!("{misfit:.4}")).unwrap_or_default());
            row.push(format!("{:.4}", prediction(facts, published).0));
            row.extend(claim_words(facts));
            row
        })
        .collect())
}

/// A word for each claim; nothing where it is about the other case or about time.
pub(crate) fn claim_words(facts: &Facts) -> impl Iterator<Item = String> {
    CLAIMS.iter().map(|claim| {
        let verdict = claim.on(facts).filter(|_| claim.id != "C9");
        verdict.map(|verdict| word(verdict.holds).to_owned()).unwrap_or_default()
    })
}

fn accepted_table() -> Csv {
    let ids = CLAIMS.iter().map(|claim| claim.id);
    Csv::new(["case", "configuration", "misfit", "prediction_error"].into_iter().chain(ids))
}

fn searched_table() -> Csv {
    let cells = ["one", "inf"].into_iter().flat_map(|cell| {
        ["coupling", "newton_fluid", "newton_structure"].map(|count| format!("{cell}_{count}"))
    });
    Csv::new(["case", "stage", "configuration", "misfit"].into_iter().map(str::to_owned).chain(cells))
}

fn searched_row(case: Case, tried: &Tried) -> Vec<String> {
    let mut row = vec![case.to_string(), tried.stage.to_string(), tried.configuration.label()];
    row.push(tried.misfit.map(|misfit| format!("{misfit:.4}")).unwrap_or_default());
    for counts in tried.counts {
        let numbers = [Count::Coupling, Count::Fluid, Count::Structure]
            .map(|count| counts.map(|counts| count.of(counts).to_string()).unwrap_or_default());
        row.extend(numbers);
    }
    row
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::task::workspace_root;

    #[test]
    fn the_published_counts_have_no_misfit_and_a_failure_has_none_at_all() {
        let published = Published::read(workspace_root()).expect("the files are there");
        for facts in &published.facts {
            let exact = FITTED.map(|limits| facts.grid.get(limits));
            assert_eq!(misfit(exact, facts), Some(0.0));
            assert_eq!(misfit([exact[0], None], facts), None);
            assert_eq!(prediction(facts, facts), (0.0, facts.grid.cells.len() - 2 + 3));
        }
    }

    #[test]
    fn misfit_is_the_mean_of_six_deviations() {
        let published = Published::read(workspace_root()).expect("the files are there");
        let facts = published.of(Case::Beam);
        let mut counts = FITTED.map(|limits| facts.grid.get(limits));
        // 1026 + 102.6 structural iterations: one deviation of a tenth among six.
        counts[0].as_mut().expect("published").structure = 1129;
        let expected = (1129.0 / 1026.0 - 1.0) / 6.0_f64.sqrt();
        assert!((misfit(counts, facts).expect("complete") - expected).abs() < 1e-15);
    }
}
