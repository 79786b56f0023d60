//! The texts that a scene is read from: its file, and the overrides of the command line.

use std::ops::Range;

use super::overrides::Override;

/// One text: the scene file, or one override.
///
/// The text stands behind as many blanks as the texts before it are long. So a place in it is a place in all of
/// them together, and tells which text it belongs to.
pub(super) struct Source {
    pub(super) name: String,
    padded: String,
    start: usize,
    names: usize,
}

impl Source {
    pub(super) fn text(&self) -> &str {
        &self.padded[self.start..]
    }

    /// The text behind its blanks: what a parser reads, so that its places are places in all texts.
    pub(super) fn padded(&self) -> &str {
        &self.padded
    }

    /// Names in the key of an override; zero for the scene file.
    pub(super) fn names(&self) -> usize {
        self.names
    }

    /// Whether it is an override and not the scene file.
    pub(super) fn is_override(&self) -> bool {
        self.names > 0
    }

    /// A place in all texts as a place in this one.
    pub(super) fn local(&self, place: &Range<usize>) -> Range<usize> {
        let end = self.text().len();
        let start = place.start.saturating_sub(self.start).min(end);
        start..place.end.saturating_sub(self.start).clamp(start, end)
    }
}

/// The scene file first, then the overrides in the order they were given.
pub(super) struct Sources(Vec<Source>);

impl Sources {
    pub(super) fn new(name: &str, text: &str, overrides: &[Override]) -> Self {
        let mut all = vec![Source { name: name.to_owned(), padded: text.to_owned(), start: 0, names: 0 }];
        let mut end = text.len() + 1;
        for Override { text, path } in overrides {
            let padded = format!("{:end$}{text}", "");
            all.push(Source { name: "--set".to_owned(), padded, start: end, names: path.len() });
            end += text.len() + 1;
        }
        Self(all)
    }

    /// The text that holds this place.
    pub(super) fn holding(&self, place: usize) -> &Source {
        self.0.iter().rev().find(|source| source.start <= place).expect("the scene file starts at zero")
    }

    /// What stands at a place.
    pub(super) fn text_at(&self, place: &Range<usize>) -> &str {
        let source = self.holding(place.start);
        source.text().get(source.local(place)).unwrap_or_default()
    }

    /// The scene file, and the overrides.
    pub(super) fn file_and_overrides(&self) -> (&Source, &[Source]) {
        self.0.split_first().expect("the scene file is always there")
    }
}
