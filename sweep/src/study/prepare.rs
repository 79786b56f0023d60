//! From the text of a study to settings that can be run, or to the place that is wrong.

use std::ops::Range;
use std::path::{Path, PathBuf};

use miette::Diagnostic;
use toml::Spanned;

use super::conduct::{Setting, Standard, Study};
use super::error::{Source, StudyError, first_problem};
use super::file::{self, Choice, File, Measure, Refinement, Take};
use super::quantity::Quantity;
use partita::{build, probe};
use partita_scene::Resolved;
use partita_scene::file_kind::FileKind;
use partita_scene::spelling::nearest;

impl Study {
    /// Reads a study file and builds every setting in it once.
    ///
    /// # Errors
    ///
    /// [`StudyError`] with the first place that is wrong and how to mend it.
    pub fn load(path: &Path) -> Result<Self, StudyError> {
        if let Some((what, hint)) = FileKind::Study.misplaced(path) {
            return Err(StudyError::plain(what, hint));
        }
        let text = std::fs::read_to_string(path).map_err(|error| {
            StudyError::plain(
                format!("{} cannot be read: {error}", path.display()),
                "name a study file: TOML with a scene, choices and a reference",
            )
        })?;
        let source = Source { name: path.display().to_string(), text };
        let file = file::parse(&source)?;
        let scene = path.parent().unwrap_or(Path::new("")).join(file.scene.get_ref());
        let reader = Reader { source: &source, file: &file, scene };
        reader.numbers()?;
        let settings = reader.settings()?;
        let reference = reader.reference()?;
        reader.same_end(&settings, &reference)?;
        let name =
            path.file_stem().map_or_else(|| "study".to_owned(), |name| name.to_string_lossy().into_owned());
        Ok(Self {
            name,
            title: file.title.clone(),
            quantity: reader.quantity(),
            wanted: file.wanted.as_ref().map(|wanted| *wanted.get_ref()),
            settings,
            reference,
            text: source.text.clone(),
        })
    }
}

/// An override and where the study has it.
type Override<'a> = &'a Spanned<String>;

struct Reader<'a> {
    source: &'a Source,
    file: &'a File,
    scene: PathBuf,
}

impl<'a> Reader<'a> {
    /// What can be said without a scene.
    fn numbers(&self) -> Result<(), StudyError> {
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

    fn quantity(&self) -> Quantity {
        let file::Quantity { name, column, take, from, to, error } = &self.file.quantity;
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
    fn settings(&self) -> Result<Vec<Setting>, StudyError> {
        let choices = self.file.choice.get_ref();
        if choices.is_empty() {
            let hint = "add a curve: [[choice]] with a `name` and `refinements`";
            return Err(self.source.error("the study has no choice", self.file.choice.span(), "empty", hint));
        }
        let names = choices.iter().map(|choice| &choice.get_ref().name);
        self.differ(names, "two choices have this name")?;
        let mut settings = Vec::new();
        for choice in choices {
            let refinements = self.refinements(choice)?;
            self.differ(
                refinements.iter().map(|refinement| &refinement.get_ref().name),
                "two refinements of a choice have this name",
            )?;
            for refinement in refinements {
                let Refinement { name, set } = refinement.get_ref();
                let overrides: Vec<Override> =
                    self.file.set.iter().chain(&choice.get_ref().set).chain(set).collect();
                settings.push(Setting {
                    choice: choice.get_ref().name.get_ref().clone(),
                    refinement: name.get_ref().clone(),
                    resolved: self.resolve(&overrides, name.span())?,
                    place: name.span(),
                });
            }
        }
        Ok(settings)
    }

    fn refinements(&self, choice: &'a Spanned<Choice>) -> Result<&'a [Spanned<Refinement>], StudyError> {
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

    fn differ<'n>(
        &self,
        names: impl Iterator<Item = &'n Spanned<String>>,
        what: &str,
    ) -> Result<(), StudyError> {
        let mut seen: Vec<&str> = Vec::new();
        for name in names {
            if seen.contains(&name.get_ref().as_str()) {
                return Err(self.source.error(
                    what,
                    name.span(),
                    "the second time",
                    "give each its own name",
                ));
            }
            seen.push(name.get_ref());
        }
        Ok(())
    }

    fn reference(&self) -> Result<Standard, StudyError> {
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
                    self.resolve(&overrides, set.span())
                };
                Ok(Standard::Run {
                    run: Box::new(run(set)?),
                    check: reference.check.as_ref().map(run).transpose()?.map(Box::new),
                })
            }
            (None, Some(value)) => self.value(value),
        }
    }

    fn value(&self, value: &Spanned<f64>) -> Result<Standard, StudyError> {
        let file::Quantity { take, error, .. } = &self.file.quantity;
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
    fn resolve(&self, overrides: &[Override], place: Range<usize>) -> Result<Resolved, StudyError> {
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
            self.source.error(error.to_string(), place, "this setting cannot be built", hint)
        })?;
        Ok(resolved)
    }

    fn column(&self, resolved: &Resolved) -> Result<(), StudyError> {
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
    fn window(&self, resolved: &Resolved, place: Range<usize>) -> Result<(), StudyError> {
        let (quantity, time) = (self.quantity(), &resolved.scene.time);
        if (1..=time.steps.get()).any(|step| quantity.counts(step as f64 * time.step.get())) {
            return Ok(());
        }
        let [from, to] = &quantity.window;
        Err(self.source.error(
            format!("no step ends between t = {from} s and t = {to} s"),
            place,
            format!("ends at t = {} s", end(resolved)),
            "change the window `from`, `to` under [quantity], or time.steps",
        ))
    }

    /// All runs end at the same time, where the quantity depends on it.
    fn same_end(&self, settings: &[Setting], reference: &Standard) -> Result<(), StudyError> {
        if self.file.quantity.to.is_some() {
            return Ok(());
        }
        let expected = match reference {
            Standard::Run { run, .. } => end(run),
            Standard::Value { .. } => settings.first().map_or(0.0, |first| end(&first.resolved)),
        };
        let other =
            settings.iter().find(|setting| (end(&setting.resolved) - expected).abs() > 1e-6 * expected);
        match other {
            None => Ok(()),
            Some(setting) => Err(self.source.error(
                format!("the runs end at different times: {expected} s and {} s", end(&setting.resolved)),
                setting.place.clone(),
                format!("{} steps of {} s", setting.resolved.scene.time.steps, setting.resolved.scene.time.step),
                "set time.steps together with time.step, or say with `to` under [quantity] up to when values count",
            )),
        }
    }
}

/// The end of a run \[s\].
fn end(resolved: &Resolved) -> f64 {
    resolved.scene.time.steps.get() as f64 * resolved.scene.time.step.get()
}
