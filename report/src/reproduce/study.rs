//! The runs that the facts about a case need, and the facts they give.

use super::case::{Case, product};
use super::counts::counts_of;
use super::facts::{Cost, Facts, Relaxation};
use super::setting::{Adaptive, Limits, Setting};
use crate::run::{Outcome, Run};
use crate::runs::{Runs, Spent};
use crate::task::TaskError;

/// The whole run of a case at a setting, with some keys of its scene changed.
pub(crate) fn run(case: Case, setting: Setting, changes: &[String]) -> Run<'static> {
    let run = Run::new(format!("{} {setting}", case.short()), format!("scenes/{}", case.scene()));
    run.without_fields().with(&setting.overrides()).with(changes)
}

/// A case at a number of settings, with some keys of its scene changed.
#[derive(Debug, Clone)]
pub(crate) struct Study {
    pub(crate) case: Case,
    pub(crate) limits: Vec<Limits>,
    pub(crate) adaptive: Vec<Adaptive>,
    /// Whether constant relaxation is tried.
    pub(crate) relaxation: bool,
    pub(crate) changes: Vec<String>,
}

impl Study {
    /// The case's whole table.
    pub(crate) fn of_table(case: Case) -> Self {
        Self { case, limits: case.grid(), adaptive: Vec::new(), relaxation: true, changes: Vec::new() }
    }

    /// The case's part of table 3.
    pub(crate) fn of_adaptive(case: Case) -> Self {
        Self {
            limits: Vec::new(),
            adaptive: Adaptive::ALL.to_vec(),
            relaxation: false,
            ..Self::of_table(case)
        }
    }

    /// Limits 1, 2 and inf of both fields and table 3: the least that every claim can be judged on.
    pub(crate) fn small(case: Case, changes: Vec<String>) -> Self {
        let limits = product(&[1, 2], &[1, 2]);
        Self { limits, adaptive: Adaptive::ALL.to_vec(), changes, ..Self::of_table(case) }
    }

    fn settings(&self) -> impl Iterator<Item = Setting> {
        let fixed = self.limits.iter().copied().map(Setting::Fixed);
        fixed.chain(self.adaptive.iter().copied().map(Setting::Adaptive))
    }

    /// All runs; that with constant relaxation, which the beam has anyway, comes last.
    pub(crate) fn runs(&self) -> Vec<Run<'static>> {
        let mut runs: Vec<Run<'static>> =
            self.settings().map(|setting| run(self.case, setting, &self.changes)).collect();
        if self.relaxation && self.case == Case::Tank {
            // A scene has one acceleration: options of the one that is replaced go with it.
            let others = self.changes.iter().filter(|key| !key.starts_with("coupling.acceleration."));
            let others: Vec<String> = others.cloned().collect();
            let relaxed = run(self.case, Setting::Fixed(Limits::UNLIMITED), &others);
            runs.push(relaxed.with(&["coupling.acceleration.constant.relaxation=0.8"]));
        }
        runs
    }

    /// What the outcomes of [`runs`](Self::runs) say.
    pub(crate) fn facts(&self, outcomes: &[Outcome]) -> Facts {
        let seen: Vec<(Setting, &Outcome)> = self.settings().zip(outcomes).collect();
        let unlimited = seen.iter().find(|(setting, _)| *setting == Setting::Fixed(Limits::UNLIMITED));
        let relaxed = match self.case {
            Case::Tank => outcomes.get(seen.len()),
            Case::Beam => unlimited.map(|(_, outcome)| *outcome),
        };
        Facts {
            case: self.case,
            grid: seen
                .iter()
                .filter_map(|(setting, outcome)| match setting {
                    Setting::Fixed(limits) => Some((*limits, counts_of(outcome))),
                    Setting::Adaptive(_) => None,
                })
                .collect(),
            adaptive: seen
                .iter()
                .filter_map(|(setting, outcome)| match setting {
                    Setting::Fixed(_) => None,
                    Setting::Adaptive(adaptive) => Some((*adaptive, counts_of(outcome))),
                })
                .collect(),
            relaxation: self.relaxation.then(|| relaxed.map(Relaxation::seen)).flatten(),
            longest_structure_call: unlimited.map(|(_, outcome)| outcome.longest_call("structure")),
            costs: seen.iter().filter_map(|(setting, outcome)| Cost::seen(*setting, outcome)).collect(),
        }
    }
}

/// Does the runs of all studies in one batch, says what they cost, and returns the facts of each.
pub(crate) fn carry_out_all(runs: &Runs, studies: &[Study]) -> Result<Vec<Facts>, TaskError> {
    let wanted: Vec<Vec<Run<'static>>> = studies.iter().map(Study::runs).collect();
    let counts: Vec<usize> = wanted.iter().map(Vec::len).collect();
    let (outcomes, spent) = runs.all(&wanted.into_iter().flatten().collect::<Vec<_>>())?;
    let Spent { done, wall_seconds, cpu_seconds } = spent;
    eprintln!(
        "{done} runs done, the others remembered: {wall_seconds:.1} s, {cpu_seconds:.1} s of processor time"
    );
    let mut rest = outcomes.as_slice();
    let facts = |(study, count): (&Study, usize)| {
        let (own, others) = rest.split_at(count);
        rest = others;
        study.facts(own)
    };
    Ok(studies.iter().zip(counts).map(facts).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_run_is_a_scene_with_the_keys_of_a_setting() {
        let run = run(Case::Beam, Setting::Fixed(Limits::of("1", "inf")), &["fluid.viscosity=2".to_owned()]);
        assert_eq!((run.name.as_str(), run.scene.as_str()), ("beam 1/inf", "scenes/beam-in-channel"));
        assert_eq!(
            run.overrides.join(" "),
            "output.fields_every=0 output.checkpoint_every=0 coupling.newton.fixed.fluid=1 \
             coupling.newton.fixed.structure=unlimited fluid.viscosity=2"
        );
    }

    #[test]
    fn the_three_tables_are_sixty_six_runs() {
        let tables = Case::ALL.map(|case| Study { relaxation: false, ..Study::of_table(case) });
        let adaptive = Case::ALL.map(Study::of_adaptive);
        let count: usize = tables.iter().chain(&adaptive).map(|study| study.runs().len()).sum();
        assert_eq!(count, 66);
        assert_eq!(Study::of_table(Case::Tank).runs().len(), 37);
    }
}
