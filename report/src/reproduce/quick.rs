//! The first steps at a few settings, beside the counts they had before.

use std::path::Path;

use super::case::Case;
use super::counts::{Count, Counts};
use super::results;
use super::run::{Outcome, Run};
use super::setting::{Adaptive, Limit, Limits, Setting};
use super::workshop::Workshop;
use crate::csv::Csv;
use crate::options::Mode;
use crate::task::{self, TaskError};

const STEPS: usize = 5;

/// Processors differ in the instructions that the dense kernels choose, and rounding moves counts by so much.
const BETWEEN_MACHINES: f64 = 0.02;

/// Corners, one cell inside, and the policies that decide as they go.
const SETTINGS: [Setting; 6] = [
    Setting::Fixed(Limits::ONE),
    Setting::Fixed(Limits { fluid: Limit::AtMost(2), structure: Limit::AtMost(3) }),
    Setting::Fixed(Limits { fluid: Limit::ToConvergence, structure: Limit::AtMost(1) }),
    Setting::Fixed(Limits::UNLIMITED),
    Setting::Adaptive(Adaptive::N1Cc),
    Setting::Adaptive(Adaptive::InterfaceData),
];

/// Runs them one at a time and again several at a time, which must not change a count, and compares with the counts
/// that are kept; `write` keeps these instead.
pub(crate) fn run(root: &Path, workshop: &Workshop<'_>, mode: Mode) -> Result<(), TaskError> {
    let runs: Vec<Run> = Case::ALL
        .into_iter()
        .flat_map(|case| SETTINGS.map(|setting| Run { steps: Some(STEPS), ..Run::new(case, setting) }))
        .collect();
    let (outcomes, _) = workshop.anew(1).run_all(&runs)?;
    let (again, _) = workshop.anew(2).run_all(&runs)?;
    let table = table(&runs, &outcomes)?;
    print!("{}", table.to_text());
    if table != self::table(&runs, &again)? {
        return Err(TaskError::Failed("the same runs gave other counts when two went at a time".to_owned()));
    }
    let path = results::folder(root).join("quick.csv");
    match mode {
        Mode::Write => task::write(&path, &table.to_text()),
        Mode::Print | Mode::Page => Ok(()),
        Mode::Check => {
            let found = differences(&Csv::read(&path)?, &table)?;
            if found.is_empty() {
                return Ok(());
            }
            Err(TaskError::Failed(format!(
                "counts differ from {} by more than {} %:\n{}\nhint: where the change is meant, keep the new counts \
                 with `cargo xtask reproduce --quick --mode write` and say why",
                path.display(),
                100.0 * BETWEEN_MACHINES,
                found.join("\n")
            )))
        }
    }
}

/// A row a run; a run that does not converge is an error.
fn table(runs: &[Run], outcomes: &[Outcome]) -> Result<Csv, TaskError> {
    let columns = Count::ALL.map(Count::column);
    let mut table = Csv::new(["case", "setting"].into_iter().chain(columns));
    for (run, outcome) in runs.iter().zip(outcomes) {
        let counts: Counts =
            outcome.counts().filter(|_| outcome.summary.steps == STEPS).ok_or_else(|| {
                let said = outcome.failure.as_deref().unwrap_or("a step ended on the iteration bound");
                TaskError::Failed(format!("{} {}: {said}", run.case, run.setting))
            })?;
        let mut row = vec![run.case.to_string(), run.setting.to_string()];
        row.extend(Count::ALL.map(|count| count.of(counts).to_string()));
        table.push(row);
    }
    Ok(table)
}

/// Where the counts are further apart than two machines may be.
fn differences(kept: &Csv, now: &Csv) -> Result<Vec<String>, TaskError> {
    if kept.rows().count() != now.rows().count() {
        return Err(TaskError::Failed("other settings than those whose counts are kept".to_owned()));
    }
    let mut found = Vec::new();
    for (kept, now) in kept.rows().zip(now.rows()) {
        for count in Count::ALL {
            let column = count.column();
            let (before, after): (usize, usize) = (kept.value(column)?, now.value(column)?);
            // A count that rounding can move at all moves by one at least.
            let allowed = (BETWEEN_MACHINES * before as f64).max(1.0);
            if before.abs_diff(after) as f64 > allowed {
                let (case, setting) = (now.text("case")?, now.text("setting")?);
                found.push(format!("{case} {setting} {column}: {after}, before {before}"));
            }
        }
    }
    Ok(found)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn counts(coupling: usize, fluid: usize) -> Csv {
        let mut table = Csv::new(["case", "setting"].into_iter().chain(Count::ALL.map(Count::column)));
        let row = [
            "elastic_bottom",
            "1/1",
            &coupling.to_string(),
            &(fluid + 50).to_string(),
            &fluid.to_string(),
            "50",
        ];
        table.push(row.map(str::to_owned).to_vec());
        table
    }

    #[test]
    fn counts_may_differ_by_two_percent() {
        let kept = counts(60, 200);
        for (coupling, fluid, expected) in
            [(60, 200, 0), (61, 204, 0), (60, 205, 1), (62, 200, 1), (58, 194, 3)]
        {
            let found = differences(&kept, &counts(coupling, fluid)).expect("the same settings");
            assert_eq!(found.len(), expected, "{found:?}");
        }
    }
}
