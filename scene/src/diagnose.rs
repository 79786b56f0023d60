//! What is wrong with a scene, as the user sees it: the line, a caret under the place, and a hint.

use std::fmt;
use std::ops::Range;

use miette::{Diagnostic, LabeledSpan, NamedSource, SourceCode};
use thiserror::Error;

use super::finding::Finding;
use super::sources::Sources;

/// Why a scene cannot be run. Nothing has been written when it is returned.
#[derive(Debug, Error)]
#[error("{}", self.head())]
pub struct SceneError {
    problems: Vec<Problem>,
}

/// One thing that is wrong with a scene.
#[derive(Debug, Error)]
#[error("{what}")]
pub struct Problem {
    what: String,
    hint: String,
    excerpt: Option<Excerpt>,
}

/// The text a problem stands in, and the places in it.
#[derive(Debug)]
struct Excerpt {
    source: NamedSource<String>,
    marks: Vec<(Range<usize>, String)>,
}

impl SceneError {
    /// A problem that stands in no text.
    #[must_use]
    pub fn plain(what: impl Into<String>, hint: impl Into<String>) -> Self {
        Self { problems: vec![Problem { what: what.into(), hint: hint.into(), excerpt: None }] }
    }

    /// A problem with places in a text that is no scene; `marks` are places and what is said of them.
    #[must_use]
    pub fn in_text(name: &str, text: &str, what: &str, hint: &str, marks: &[(Range<usize>, &str)]) -> Self {
        let marks = marks.iter().map(|(place, label)| (place.clone(), (*label).to_owned())).collect();
        let excerpt = Some(Excerpt { source: NamedSource::new(name, text.to_owned()), marks });
        Self { problems: vec![Problem { what: what.to_owned(), hint: hint.to_owned(), excerpt }] }
    }

    /// What the first problem is, and how to mend it.
    #[must_use]
    pub fn first(&self) -> (String, String) {
        self.problems.first().map_or_else(Default::default, |p| (p.what.clone(), p.hint.clone()))
    }

    /// A problem with one argument of the command line.
    pub(super) fn argument(given: &str, what: &str, hint: &str) -> Self {
        let source = NamedSource::new("--set", given.to_owned());
        let excerpt = Some(Excerpt { source, marks: vec![(0..given.len(), String::new())] });
        Self { problems: vec![Problem { what: what.to_owned(), hint: hint.to_owned(), excerpt }] }
    }

    /// The findings, at least one, as problems.
    pub(super) fn new(findings: Vec<Finding>, sources: &Sources) -> Self {
        assert!(!findings.is_empty(), "an error needs a finding");
        Self { problems: findings.into_iter().map(|finding| Problem::new(finding, sources)).collect() }
    }

    /// Everything that is wrong.
    #[must_use]
    pub fn problems(&self) -> &[Problem] {
        &self.problems
    }

    /// The problem, if it is the only one.
    fn alone(&self) -> Option<&Problem> {
        self.problems.first().filter(|_| self.problems.len() == 1)
    }

    fn head(&self) -> String {
        self.alone().map_or_else(
            || format!("{} things are wrong in the scene", self.problems.len()),
            |problem| problem.what.clone(),
        )
    }
}

impl Problem {
    fn new(Finding { what, hint, marks }: Finding, sources: &Sources) -> Self {
        let excerpt = marks.first().map(|(place, _)| {
            let text = sources.holding(place.start);
            let here =
                |place: &Range<usize>| sources.holding(place.start).text().as_ptr() == text.text().as_ptr();
            Excerpt {
                source: NamedSource::new(&text.name, text.text().to_owned()),
                marks: marks
                    .iter()
                    .filter(|(place, _)| here(place))
                    .map(|(place, label)| (text.local(place), label.clone()))
                    .collect(),
            }
        });
        Self { what, hint, excerpt }
    }

    /// How to mend it.
    #[must_use]
    pub fn hint(&self) -> &str {
        &self.hint
    }
}

impl Diagnostic for Problem {
    fn help<'a>(&'a self) -> Option<Box<dyn fmt::Display + 'a>> {
        (!self.hint.is_empty()).then(|| Box::new(&self.hint) as Box<dyn fmt::Display>)
    }

    fn source_code(&self) -> Option<&dyn SourceCode> {
        self.excerpt.as_ref().map(|excerpt| &excerpt.source as &dyn SourceCode)
    }

    fn labels(&self) -> Option<Box<dyn Iterator<Item = LabeledSpan> + '_>> {
        let excerpt = self.excerpt.as_ref()?;
        Some(Box::new(excerpt.marks.iter().map(|(place, label)| {
            LabeledSpan::new((!label.is_empty()).then(|| label.clone()), place.start, place.len())
        })))
    }
}

impl Diagnostic for SceneError {
    fn help<'a>(&'a self) -> Option<Box<dyn fmt::Display + 'a>> {
        self.alone()?.help()
    }

    fn source_code(&self) -> Option<&dyn SourceCode> {
        self.alone()?.source_code()
    }

    fn labels(&self) -> Option<Box<dyn Iterator<Item = LabeledSpan> + '_>> {
        self.alone()?.labels()
    }

    fn related<'a>(&'a self) -> Option<Box<dyn Iterator<Item = &'a dyn Diagnostic> + 'a>> {
        let several = self.alone().is_none().then_some(&self.problems)?;
        Some(Box::new(several.iter().map(|problem| problem as &dyn Diagnostic)))
    }
}
