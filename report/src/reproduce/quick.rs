//! The first steps at a few settings, beside the counts they had before.

use std::path::Path;

use super::case::Case;
use super::counts::{Count, counts_of};
use super::setting::{Adaptive, Limit, Limits, Setting};
use super::{QUICK, results, study};
use crate::csv::Csv;
use crate::options::Abilities;
use crate::report::{File, Found, Report};
use crate::run::{Outcome, Stop};
use crate::runs::Runs;
use crate::task::TaskError;

const STEPS: usize = 5;

/// Corners, one cell inside, and the policies that decide as they go.
const SETTINGS: [Setting; 6] = [
    Setting::Fixed(Limits::ONE),
    Setting::Fixed(Limits { fluid: Limit::AtMost(2), structure: Limit::AtMost(3) }),
    Setting::Fixed(Limits { fluid: Limit::ToConvergence, structure: Limit::AtMost(1) }),
    Setting::Fixed(Limits::UNLIMITED),
    Setting::Adaptive(Adaptive::N1Cc),
    Setting::Adaptive(Adaptive::InterfaceData),
];

/// The first steps, one and several runs at a time, which must not change a count.
pub(crate) struct Quick;

impl Report for Quick {
    fn abilities(&self) -> Abilities {
        QUICK
    }

    fn found(&self, runs: Runs) -> Result<Found, TaskError> {
        let cells: Vec<(Case, Setting)> =
            Case::ALL.into_iter().flat_map(|case| SETTINGS.map(|setting| (case, setting))).collect();
        let first =
            |&(case, setting): &(Case, Setting)| study::run(case, setting, &[]).ending(Stop::After(STEPS));
        let wanted: Vec<_> = cells.iter().map(first).collect();
        let runs = runs.again(1);
        let (outcomes, _) = runs.all(&wanted)?;
        let (again, _) = runs.again(2).all(&wanted)?;
        let rows = table(&cells, &outcomes)?;
        if rows != table(&cells, &again)? {
            return Err(TaskError::Failed(
                "the same runs gave other counts when two went at a time".to_owned(),
            ));
        }
        Ok(Found {
            tables: vec![results::table("quick.csv", rows, results::same_settings)],
            files: Vec::new(),
        })
    }

    fn pages(&self, _: &Path) -> Result<Vec<File>, TaskError> {
        Ok(Vec::new())
    }
}

/// A row a run; a run that does not converge is an error.
fn table(cells: &[(Case, Setting)], outcomes: &[Outcome]) -> Result<Csv, TaskError> {
    let mut table = Csv::new(["case", "setting"].into_iter().chain(Count::ALL.map(Count::column)));
    for ((case, setting), outcome) in cells.iter().zip(outcomes) {
        let counts = counts_of(outcome).filter(|_| outcome.summary.steps == STEPS).ok_or_else(|| {
            let said = outcome.failure.as_deref().unwrap_or("a step ended on the iteration bound");
            TaskError::Failed(format!("{case} {setting}: {said}"))
        })?;
        let mut row = vec![case.to_string(), setting.to_string()];
        row.extend(Count::ALL.map(|count| count.of(counts).to_string()));
        table.push(row);
    }
    Ok(table)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn counts_may_differ_by_two_percent() {
        let counts = |coupling: usize, fluid: usize| {
            let mut table = Csv::new(["case", "setting"].into_iter().chain(Count::ALL.map(Count::column)));
            let counts = [coupling, fluid + 50, fluid, 50].map(|count| count.to_string());
            table.push(["elastic_bottom", "1/1"].map(str::to_owned).into_iter().chain(counts).collect());
            table
        };
        let kept = counts(60, 200);
        for (coupling, fluid, expected) in
            [(60, 200, 0), (61, 204, 0), (60, 205, 1), (62, 200, 1), (58, 194, 3)]
        {
            let found = results::same_settings(&kept, &counts(coupling, fluid)).expect("the same settings");
            assert_eq!(found.len(), expected, "{found:?}");
        }
    }
}
