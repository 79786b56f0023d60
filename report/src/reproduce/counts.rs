//! Iteration counts, one setting's and a table's.

use std::collections::BTreeMap;

use partita_charts::heat_map::{HeatMap, side_by_side};

use super::setting::{Limit, Limits};
use crate::run::Outcome;

/// Iterations of a whole run.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Counts {
    /// Coupling iterations.
    pub(crate) coupling: usize,
    /// Newton iterations of the fluid.
    pub(crate) fluid: usize,
    /// Newton iterations of the structure.
    pub(crate) structure: usize,
}

impl Counts {
    /// Newton iterations of both fields.
    pub(crate) fn newton(self) -> usize {
        self.fluid + self.structure
    }
}

/// The counts of a run that reached its end with every step converged.
pub(crate) fn counts_of(outcome: &Outcome) -> Option<Counts> {
    let summary = &outcome.summary;
    summary.converged.then_some(Counts {
        coupling: summary.coupling_iterations,
        fluid: summary.newton_fluid,
        structure: summary.newton_structure,
    })
}

/// Which of the four counts of a run.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Count {
    Coupling,
    Newton,
    Fluid,
    Structure,
}

impl Count {
    pub(crate) const ALL: [Self; 4] = [Self::Coupling, Self::Newton, Self::Fluid, Self::Structure];

    pub(crate) fn of(self, counts: Counts) -> usize {
        match self {
            Self::Coupling => counts.coupling,
            Self::Newton => counts.newton(),
            Self::Fluid => counts.fluid,
            Self::Structure => counts.structure,
        }
    }

    /// The column of a table's file.
    pub(crate) fn column(self) -> &'static str {
        match self {
            Self::Coupling => "coupling",
            Self::Newton => "newton_total",
            Self::Fluid => "newton_fluid",
            Self::Structure => "newton_structure",
        }
    }

    pub(crate) fn title(self) -> &'static str {
        match self {
            Self::Coupling => "Coupling iterations",
            Self::Newton => "Newton iterations, total",
            Self::Fluid => "Newton iterations, fluid",
            Self::Structure => "Newton iterations, structure",
        }
    }
}

/// The part by which `ours` lies above `reference`.
pub(crate) fn deviation(ours: usize, reference: usize) -> f64 {
    ours as f64 / reference as f64 - 1.0
}

/// Counts of the settings of a table; `None` where the run did not reach its end.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub(crate) struct Grid {
    pub(crate) cells: BTreeMap<Limits, Option<Counts>>,
}

impl Grid {
    pub(crate) fn get(&self, limits: Limits) -> Option<Counts> {
        self.cells.get(&limits).copied().flatten()
    }

    /// The limits N^f that occur, rising.
    pub(crate) fn fluid_limits(&self) -> Vec<Limit> {
        let mut limits: Vec<Limit> = self.cells.keys().map(|limits| limits.fluid).collect();
        limits.dedup();
        limits
    }

    /// The limits N^s that occur, rising.
    pub(crate) fn structure_limits(&self) -> Vec<Limit> {
        let mut limits: Vec<Limit> = self.cells.keys().map(|limits| limits.structure).collect();
        limits.sort_unstable();
        limits.dedup();
        limits
    }

    /// One count of all cells, as it is drawn.
    pub(crate) fn heat_map(&self, heading: &str, count: Count) -> HeatMap {
        let names = |limits: &[Limit]| limits.iter().map(ToString::to_string).collect();
        let (rows, columns) = (self.fluid_limits(), self.structure_limits());
        let cells =
            rows.iter().flat_map(|&fluid| columns.iter().map(move |&structure| Limits { fluid, structure }));
        HeatMap {
            heading: heading.to_owned(),
            values: cells.map(|limits| self.get(limits).map(|counts| count.of(counts))).collect(),
            rows: names(&rows),
            columns: names(&columns),
        }
    }

    /// The cells with one N^f, all of them or `None`.
    pub(crate) fn row(&self, fluid: Limit) -> Option<Vec<(Limit, Counts)>> {
        let cells = self.cells.iter().filter(|(limits, _)| limits.fluid == fluid);
        cells.map(|(limits, counts)| Some((limits.structure, (*counts)?))).collect()
    }

    /// The cells with one N^s, all of them or `None`.
    pub(crate) fn column(&self, structure: Limit) -> Option<Vec<(Limit, Counts)>> {
        let cells = self.cells.iter().filter(|(limits, _)| limits.structure == structure);
        cells.map(|(limits, counts)| Some((limits.fluid, (*counts)?))).collect()
    }

    /// The settings with the smallest Newton total, and that total; `None` while a cell is missing.
    pub(crate) fn cheapest(&self) -> Option<(Vec<Limits>, usize)> {
        let totals: Option<Vec<(Limits, usize)>> =
            self.cells.iter().map(|(&limits, counts)| Some((limits, (*counts)?.newton()))).collect();
        let totals = totals?;
        let least = totals.iter().map(|(_, total)| *total).min()?;
        Some((
            totals.into_iter().filter(|(_, total)| *total == least).map(|(limits, _)| limits).collect(),
            least,
        ))
    }
}

/// One count of two grids with the same settings, each below its heading.
pub(crate) fn heat_maps(title: &str, grids: [(&str, &Grid); 2], count: Count) -> String {
    let [first, second] = grids.map(|(heading, grid)| grid.heat_map(heading, count));
    side_by_side(title, [&first, &second], "rows: N^f, columns: N^s")
}

impl FromIterator<(Limits, Option<Counts>)> for Grid {
    fn from_iter<I: IntoIterator<Item = (Limits, Option<Counts>)>>(cells: I) -> Self {
        Self { cells: cells.into_iter().collect() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use partita::output::{Clock, Ending, Summary, Totals};

    #[test]
    fn an_unconverged_run_has_no_counts() {
        let counts = |unconverged_steps| {
            let totals = Totals {
                steps: 5,
                unconverged_steps,
                coupling_iterations: 62,
                newton_fluid: 63,
                newton_structure: 61,
                ..Totals::default()
            };
            let summary = Summary::new(Ending::Completed, &totals, &Clock::start().spent());
            counts_of(&Outcome::of(summary))
        };
        assert_eq!(counts(0), Some(Counts { coupling: 62, fluid: 63, structure: 61 }));
        assert_eq!(counts(1), None);
    }

    #[test]
    fn a_heat_map_has_the_cells_row_by_row() {
        let counts = |coupling| Some(Counts { coupling, fluid: 0, structure: 0 });
        let cells = [
            (("1", "1"), counts(1)),
            (("1", "2"), counts(2)),
            (("inf", "1"), None),
            (("inf", "2"), counts(4)),
        ];
        let grid: Grid = cells.map(|((f, s), counts)| (Limits::of(f, s), counts)).into_iter().collect();
        let map = grid.heat_map("ours", Count::Coupling);
        assert_eq!((map.rows.join(" "), map.columns.join(" ")), ("1 inf".to_owned(), "1 2".to_owned()));
        assert_eq!(map.values, [Some(1), Some(2), None, Some(4)]);
    }
}
