//! What is known about a case, and what claims are judged on.

use std::collections::BTreeMap;

use partita::output::Seconds;

use super::case::Case;
use super::counts::{Counts, Grid, counts_of};
use super::setting::{Adaptive, Limits, Setting};
use crate::run::Outcome;

/// Counts and observations of one case, the paper's or ours.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Facts {
    pub(crate) case: Case,
    /// Its table of (N^f, N^s).
    pub(crate) grid: Grid,
    /// Its part of table 3; `None` where the run did not reach its end.
    pub(crate) adaptive: BTreeMap<Adaptive, Option<Counts>>,
    /// What constant relaxation with 0.8 does.
    pub(crate) relaxation: Option<Relaxation>,
    /// Newton iterations of the longest structure call at (inf, inf).
    pub(crate) longest_structure_call: Option<usize>,
    /// Measured cost of its settings, where times were measured.
    pub(crate) costs: Vec<Cost>,
}

impl Facts {
    /// Takes over what newer facts know, and keeps the rest.
    pub(crate) fn take(&mut self, newer: Self) {
        let is_newer = |cost: &Cost| newer.costs.iter().any(|other| other.setting == cost.setting);
        self.costs.retain(|cost| !is_newer(cost));
        self.costs.extend(newer.costs);
        self.costs.sort_by_key(|cost| cost.setting);
        self.adaptive.extend(newer.adaptive);
        if !newer.grid.cells.is_empty() {
            self.grid = newer.grid;
            self.relaxation = newer.relaxation;
            self.longest_structure_call = newer.longest_structure_call;
        }
    }

    /// Costs of the settings of its table of (N^f, N^s).
    pub(crate) fn table_costs(&self) -> Vec<Cost> {
        self.costs.iter().filter(|cost| matches!(cost.setting, Setting::Fixed(_))).copied().collect()
    }

    pub(crate) fn counts(&self, setting: Setting) -> Option<Counts> {
        match setting {
            Setting::Fixed(limits) => self.grid.get(limits),
            Setting::Adaptive(adaptive) => self.adaptive.get(&adaptive).copied().flatten(),
        }
    }

    pub(crate) fn one(&self) -> Option<Counts> {
        self.grid.get(Limits::ONE)
    }

    pub(crate) fn unlimited(&self) -> Option<Counts> {
        self.grid.get(Limits::UNLIMITED)
    }
}

/// What constant relaxation with 0.8 does to a case.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Relaxation {
    Converges,
    /// A step, if one is known, cannot be solved.
    Fails {
        step: Option<usize>,
    },
}

impl Relaxation {
    /// What a run with it shows.
    pub(crate) fn seen(outcome: &Outcome) -> Self {
        if outcome.summary.converged {
            Self::Converges
        } else {
            Self::Fails { step: Some(outcome.summary.steps + 1) }
        }
    }
}

/// What a setting took, measured.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Cost {
    pub(crate) setting: Setting,
    pub(crate) counts: Counts,
    /// Wall-clock time of the run \[s\].
    pub(crate) wall_seconds: f64,
    /// Processor time of the run \[s\].
    pub(crate) cpu_seconds: f64,
    /// Where the wall-clock time went \[s\].
    pub(crate) seconds: Seconds,
}

impl Cost {
    /// Of a run that reached its end.
    pub(crate) fn seen(setting: Setting, outcome: &Outcome) -> Option<Self> {
        let summary = &outcome.summary;
        Some(Self {
            setting,
            counts: counts_of(outcome)?,
            wall_seconds: summary.wall_seconds,
            cpu_seconds: summary.cpu_seconds.unwrap_or(summary.wall_seconds),
            seconds: summary.seconds,
        })
    }
}
