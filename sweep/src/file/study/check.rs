//! What can be wrong with a study, and where.

use std::ops::Range;
use std::path::PathBuf;

use miette::Diagnostic;
use partita::{build, probe};
use partita_scene::spelling::nearest;
use partita_scene::{Resolved, SceneError};
use toml::Spanned;

use super::super::{Source, first_problem};
use super::{Choice, File, Measure, QuantityTable, Refinement, Take};
use crate::fingerprint::Fingerprint;
use crate::study::Quantity;

/// An override and where the study has it.
type Override<'a> = &'a Spanned<String>;

/// A run of a study that can be built.
pub(super) struct Checked {
    pub(super) overrides: Vec<String>,
    pub(super) fingerprint: String,
    steps: usize,
    step: f64,
    /// Its name in the study file.
    place: Range<usize>,
}

impl Checked {
    /// The end of the run \[s\].
    fn end(&self) -> f64 {
        self.steps as f64 * self.step
    }
}

/// What errors are measured against.
pub(super) enum Standard {
    Value { value: f64, uncertainty: f64 },
    Run { run: Box<Checked>, check: Option<Box<Checked>> },
}

/// Choice, refinement, and the run that they make.
pub(super) type Point = (String, String, Checked);

pub(super) struct Reader<'a> {
    source: &'a Source,
    file: &'a File,
    scene: PathBuf,
}

impl<'a> Reader<'a> {
    pub(super) fn new(source: &'a Source, file: &'a File) -> Self {
        Self { source, file, scene: source.beside(file.scene.get_ref()) }
    }

    /// What can be said without a scene.
    pub(super) fn numbers(&self) -> Result<(), SceneError> {
        let positive = |number: &Option<Spanned<f64>>, name: &str, hint: &str| match number {
            Some(value) if !(*value.get_ref() > 0.0 && value.get_ref().is_finite()) => {
                Err(self.source.error(
                    format!("{name}: {} is not a number above zero", value.get_ref()),
                    value.span(),
                    "out of range",
                    hint,
                ))
            }
            _ => Ok(()),
        };
        positive(&self.file.wanted, "wanted", "give the error that is to be reached, or leave it out")?;
        let reference = self.file.reference.get_ref();
        positive(&reference.uncertainty, "uncertainty", "give how well the value is known, or leave it out")?;
        let (from, to) = (&self.file.quantity.from, &self.file.quantity.to);
        match (from, to) {
            (Some(from), Some(to)) if from.get_ref() > to.get_ref() => Err(self.source.error(
                "the window ends before it begins",
                to.span(),
                format!("before from = {}", from.get_ref()),
                "give times with `from` below `to`, or leave one out",
            )),
            _ => Ok(()),
        }
    }

    pub(super) fn quantity(&self) -> Quantity {
        let QuantityTable { name, column, take, from, to, error } = &self.file.quantity;
        let time = |time: &Option<Spanned<f64>>, or| time.as_ref().map_or(or, |time| *time.get_ref());
        Quantity {
            name: name.clone(),
            column: column.get_ref().clone(),
            take: *take.get_ref(),
            window: [time(from, f64::NEG_INFINITY), time(to, f64::INFINITY)],
            measure: *error,
        }
    }

    /// Every refinement of every choice.
    pub(super) fn points(&self) -> Result<Vec<Point>, SceneError> {
        let choices = self.file.choice.get_ref();
        if choices.is_empty() {
            let hint = "add a curve: [[choice]] with a `name` and `refinements`";
            return Err(self.source.error("the study has no choice", self.file.choice.span(), "empty", hint));
        }
        let names = choices.iter().map(|choice| &choice.get_ref().name);
        self.source.differ(names, "two choices have this name")?;
        let mut points = Vec::new();
        for choice in choices {
            let refinements = self.refinements(choice)?;
            self.source.differ(
                refinements.iter().map(|refinement| &refinement.get_ref().name),
                "two refinements of a choice have this name",
            )?;
            for refinement in refinements {
                let Refinement { name, set } = refinement.get_ref();
                let overrides: Vec<Override> =
                    self.file.set.iter().chain(&choice.get_ref().set).chain(set).collect();
                let checked = self.check(&overrides, name.span())?;
                points.push((choice.get_ref().name.get_ref().clone(), name.get_ref().clone(), checked));
            }
        }
        Ok(points)
    }

    fn refinements(&self, choice: &'a Spanned<Choice>) -> Result<&'a [Spanned<Refinement>], SceneError> {
        let Choice { name, refinements, .. } = choice.get_ref();
        let Some(refinements) = refinements.as_ref().or(self.file.refinements.as_ref()) else {
            return Err(self.source.error(
                format!("the choice `{}` has no refinements", name.get_ref()),
                name.span(),
                "a curve without points",
                "give it `refinements`, or put some above all choices: a list of { name = \"...\", set = [..] }",
            ));
        };
        if refinements.get_ref().is_empty() {
            let hint = "a list of { name = \"...\", set = [..] }, from the coarsest to the finest";
            return Err(self.source.error("there are no refinements", refinements.span(), "empty", hint));
        }
        Ok(refinements.get_ref())
    }

    pub(super) fn standard(&self) -> Result<Standard, SceneError> {
        let reference = self.file.reference.get_ref();
        let place = self.file.reference.span();
        let wrong = |place: Range<usize>, what: &str, label: &str, hint: &str| {
            Err(self.source.error(what, place, label, hint))
        };
        match (&reference.set, &reference.value) {
            (None, None) => wrong(
                place,
                "[reference] gives neither a run nor a value",
                "nothing to measure against",
                "give `set`, the overrides of a finer run, or `value`",
            ),
            (Some(_), Some(value)) => wrong(
                value.span(),
                "[reference] gives both a run and a value",
                "`set` makes a run, too",
                "keep one of the two",
            ),
            (Some(set), None) => {
                if let Some(uncertainty) = &reference.uncertainty {
                    return wrong(
                        uncertainty.span(),
                        "the uncertainty of a run is measured",
                        "not for a run",
                        "give `check`, the overrides of a somewhat coarser run, instead",
                    );
                }
                let run = |set: &Spanned<Vec<Spanned<String>>>| {
                    let overrides: Vec<Override> = self.file.set.iter().chain(set.get_ref()).collect();
                    self.check(&overrides, set.span())
                };
                Ok(Standard::Run {
                    run: Box::new(run(set)?),
                    check: reference.check.as_ref().map(run).transpose()?.map(Box::new),
                })
            }
            (None, Some(value)) => self.value(value),
        }
    }

    fn value(&self, value: &Spanned<f64>) -> Result<Standard, SceneError> {
        let QuantityTable { take, error, .. } = &self.file.quantity;
        let reference = self.file.reference.get_ref();
        if let Some(check) = &reference.check {
            return Err(self.source.error(
                "a value needs no run that checks it",
                check.span(),
                "not for a value",
                "leave it out; `uncertainty` says how well the value is known",
            ));
        }
        if *take.get_ref() == Take::History {
            return Err(self.source.error(
                "a history cannot be measured against one value",
                take.span(),
                "needs a reference run",
                "give `set` under [reference], or take \"last\", \"max\", \"min\" or \"mean\"",
            ));
        }
        let number = *value.get_ref();
        if !number.is_finite() || (number == 0.0 && *error == Measure::Relative) {
            return Err(self.source.error(
                format!("an error relative to {number} is no number"),
                value.span(),
                "nothing to compare with",
                "give `error = \"absolute\"` under [quantity]",
            ));
        }
        let uncertainty = reference.uncertainty.as_ref().map_or(0.0, |known| *known.get_ref());
        let scale = if *error == Measure::Relative { number.abs() } else { 1.0 };
        Ok(Standard::Value { value: number, uncertainty: uncertainty / scale })
    }

    /// The scene under these overrides, built once to see that it can be; `place` is that of the setting.
    fn check(&self, overrides: &[Override], place: Range<usize>) -> Result<Checked, SceneError> {
        let load = |count: usize| {
            let words: Vec<String> = overrides[..count].iter().map(|word| word.get_ref().clone()).collect();
            partita_scene::load(&self.scene, &words)
        };
        let resolved = load(overrides.len()).map_err(|error| {
            let (what, hint) = first_problem(&error);
            // To blame is the last override without which, and without those behind it, the scene is sound.
            match (0..overrides.len()).rev().find(|&count| load(count).is_ok()) {
                Some(count) => {
                    self.source.error(what, overrides[count].span(), "this override does not fit", hint)
                }
                None => self.source.error(what, self.file.scene.span(), "in this scene", hint),
            }
        })?;
        self.column(&resolved)?;
        self.window(&resolved, place.clone())?;
        build::march(&resolved).map_err(|error| {
            let hint = error.help().map(|help| help.to_string()).unwrap_or_default();
            self.source.error(error.to_string(), place.clone(), "this setting cannot be built", hint)
        })?;
        let time = &resolved.scene.time;
        Ok(Checked {
            overrides: overrides.iter().map(|word| word.get_ref().clone()).collect(),
            fingerprint: Fingerprint::of(&resolved).and(self.file.quantity.column.get_ref()).text(),
            steps: time.steps.get(),
            step: time.step.get(),
            place,
        })
    }

    fn column(&self, resolved: &Resolved) -> Result<(), SceneError> {
        let column = &self.file.quantity.column;
        let known = probe::columns(&resolved.scene.output.probes);
        if known.iter().any(|name| name == column.get_ref()) {
            return Ok(());
        }
        let hint = match nearest(column.get_ref(), known.iter().map(String::as_str)) {
            Some(near) => format!("did you mean `{near}`?"),
            None if known.is_empty() => {
                "the scene has no probes: add one, here as an override of output.probes.<name>, or there"
                    .to_owned()
            }
            None => format!("the scene probes {}", known.join(", ")),
        };
        let what = format!("the scene has no column `{}`", column.get_ref());
        Err(self.source.error(what, column.span(), "not probed", hint))
    }

    /// Some step of a run ends in the window.
    fn window(&self, resolved: &Resolved, place: Range<usize>) -> Result<(), SceneError> {
        let (quantity, time) = (self.quantity(), &resolved.scene.time);
        if (1..=time.steps.get()).any(|step| quantity.counts(step as f64 * time.step.get())) {
            return Ok(());
        }
        let [from, to] = &quantity.window;
        Err(self.source.error(
            format!("no step ends between t = {from} s and t = {to} s"),
            place,
            format!("ends at t = {} s", time.steps.get() as f64 * time.step.get()),
            "change the window `from`, `to` under [quantity], or time.steps",
        ))
    }

    /// All runs end at the same time, where the quantity depends on it.
    pub(super) fn same_end(&self, points: &[Point], standard: &Standard) -> Result<(), SceneError> {
        if self.file.quantity.to.is_some() {
            return Ok(());
        }
        let expected = match standard {
            Standard::Run { run, .. } => run.end(),
            Standard::Value { .. } => points.first().map_or(0.0, |(_, _, first)| first.end()),
        };
        let other = points.iter().find(|(_, _, run)| (run.end() - expected).abs() > 1e-6 * expected);
        match other {
            None => Ok(()),
            Some((_, _, run)) => Err(self.source.error(
                format!("the runs end at different times: {expected} s and {} s", run.end()),
                run.place.clone(),
                format!("{} steps of {} s", run.steps, run.step),
                "set time.steps together with time.step, or say with `to` under [quantity] up to when values count",
            )),
        }
    }
}
