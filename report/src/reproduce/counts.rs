//! Iteration counts, one setting's and a table's.

use std::collections::BTreeMap;

use super::setting::{Limit, Limits};

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

impl FromIterator<(Limits, Option<Counts>)> for Grid {
    fn from_iter<I: IntoIterator<Item = (Limits, Option<Counts>)>>(cells: I) -> Self {
        Self { cells: cells.into_iter().collect() }
    }
}
