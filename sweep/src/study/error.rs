//! What is wrong with a study file, as the user sees it, and why a study failed.

use std::fmt;
use std::ops::Range;
use std::path::PathBuf;

use miette::{Diagnostic, LabeledSpan, NamedSource, SourceCode};
use thiserror::Error;

use partita::build::BuildError;
use partita_scene::SceneError;

/// Why a study cannot be conducted. Nothing has been run or written when it is returned.
#[derive(Debug, Error)]
#[error("{what}")]
pub struct StudyError {
    what: String,
    hint: String,
    excerpt: Option<Box<Excerpt>>,
}

/// The text of the study, a place in it, and what is wrong there.
#[derive(Debug)]
struct Excerpt {
    source: NamedSource<String>,
    place: Range<usize>,
    label: String,
}

impl StudyError {
    /// A problem that stands in no text.
    pub(super) fn plain(what: impl Into<String>, hint: impl Into<String>) -> Self {
        Self { what: what.into(), hint: hint.into(), excerpt: None }
    }

    /// How to mend it.
    #[must_use]
    pub fn hint(&self) -> &str {
        &self.hint
    }
}

impl Diagnostic for StudyError {
    fn help<'a>(&'a self) -> Option<Box<dyn fmt::Display + 'a>> {
        (!self.hint.is_empty()).then(|| Box::new(&self.hint) as Box<dyn fmt::Display>)
    }

    fn source_code(&self) -> Option<&dyn SourceCode> {
        self.excerpt.as_ref().map(|excerpt| &excerpt.source as &dyn SourceCode)
    }

    fn labels(&self) -> Option<Box<dyn Iterator<Item = LabeledSpan> + '_>> {
        let Excerpt { place, label, .. } = self.excerpt.as_deref()?;
        let label = (!label.is_empty()).then(|| label.clone());
        Some(Box::new(std::iter::once(LabeledSpan::new(label, place.start, place.len()))))
    }
}

/// A study file's name and text, to point into.
#[derive(Debug, Clone)]
pub(super) struct Source {
    pub(super) name: String,
    pub(super) text: String,
}

impl Source {
    /// A problem at a place of the text.
    pub(super) fn error(
        &self,
        what: impl Into<String>,
        place: Range<usize>,
        label: impl Into<String>,
        hint: impl Into<String>,
    ) -> StudyError {
        let source = NamedSource::new(&self.name, self.text.clone());
        let excerpt = Excerpt { source, place, label: label.into() };
        StudyError { what: what.into(), hint: hint.into(), excerpt: Some(Box::new(excerpt)) }
    }
}

/// Why a study that was begun could not be ended.
#[derive(Debug, Error)]
pub enum StudyFailure {
    /// The folder holds something.
    #[error("{dir} is not empty\nhint: choose another folder with --out; --force replaces an earlier study, never other files", dir = dir.display())]
    Occupied {
        /// The folder.
        dir: PathBuf,
    },
    /// The system refuses to write.
    #[error("cannot write {path}: {source}\nhint: name a folder that can be written, on a disk with space, with --out", path = path.display())]
    Write {
        /// The file or folder.
        path: PathBuf,
        /// What the system says.
        source: std::io::Error,
    },
    /// A run that every error is measured against could not be made.
    #[error(
        "{run}: {cause}\nhint: every error is measured against this run: choose settings for it, under [reference], with which the scene runs"
    )]
    Reference {
        /// Which run.
        run: String,
        /// What happened.
        cause: String,
    },
}

/// Why a setting has no error.
#[derive(Debug, Error)]
pub(super) enum MeasureError {
    /// It cannot be built.
    #[error(transparent)]
    Build(#[from] BuildError),
    /// A step could not be solved.
    #[error(transparent)]
    Step(#[from] partita_coupling::StepError),
    /// What was probed is no number.
    #[error("what the probe shows is not finite")]
    NotFinite,
    /// It shares no time with the reference.
    #[error("it has no time in common with the reference run")]
    NoCommonTime,
}

/// The first thing that is wrong with a scene, and how to mend it; how many more there are.
pub(super) fn first_problem(error: &SceneError) -> (String, String) {
    let problems = error.problems();
    let (what, hint) =
        problems.first().map_or_else(Default::default, |first| (first.to_string(), first.hint().to_owned()));
    // The line for the command line, where the overrides are `--set`s.
    let hint = hint.lines().filter(|line| !line.contains("`--set`s")).collect::<Vec<_>>().join("\n");
    match problems.len() {
        0 | 1 => (what, hint),
        more => (format!("{what} (and {} more)", more - 1), hint),
    }
}
