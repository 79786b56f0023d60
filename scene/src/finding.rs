//! What is wrong with a scene, before it is known which text it stands in.

use std::ops::Range;

use miette::Diagnostic;

use super::sources::Sources;

/// One thing that is wrong, where, and how to mend it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Finding {
    pub(super) what: String,
    pub(super) marks: Vec<(Range<usize>, String)>,
    pub(super) hint: String,
}

impl Finding {
    pub(super) fn new(what: impl Into<String>) -> Self {
        Self { what: what.into(), marks: Vec::new(), hint: String::new() }
    }

    /// The error of a library, with its remedy.
    pub(super) fn of(error: &impl Diagnostic) -> Self {
        let hint = error.help().map(|help| help.to_string());
        Self::new(error.to_string()).hint(hint.unwrap_or_default())
    }

    /// Says before everything else where this was found.
    pub(super) fn led_by(mut self, place: &str) -> Self {
        self.what.insert_str(0, place);
        self
    }

    /// Points at a place. The first mark decides which text is shown.
    pub(super) fn mark(mut self, place: Range<usize>, label: impl Into<String>) -> Self {
        self.marks.push((place, label.into()));
        self
    }

    /// Points at a place, if it is known.
    pub(super) fn mark_if(self, place: Option<Range<usize>>, label: impl Into<String>) -> Self {
        match place {
            Some(place) => self.mark(place, label),
            None => self,
        }
    }

    /// Points at a place, if it is known and nothing is pointed at yet.
    pub(super) fn mark_unless(self, place: Option<Range<usize>>, label: impl Into<String>) -> Self {
        if self.marks.is_empty() { self.mark_if(place, label) } else { self }
    }

    pub(super) fn hint(mut self, hint: impl Into<String>) -> Self {
        self.hint = hint.into();
        self
    }

    /// Says that the file without the overrides is sound.
    pub(super) fn blame_overrides(&mut self) {
        self.hint.push_str("\nwithout the overrides the scene is sound: look at the `--set`s");
    }

    /// A text that is no TOML.
    pub(super) fn syntax(error: &toml::de::Error, sources: &Sources) -> Self {
        let place = error.span().unwrap_or(0..0);
        let text = sources.text_at(&place);
        let message = error.message();
        if message == "duplicate key" {
            return Self::new(format!("`{text}` is set twice"))
                .mark(place, "the second time")
                .hint("keep one of the two");
        }
        let unquoted =
            message.starts_with("string values must be quoted") || message.starts_with("invalid float");
        if unquoted && text.starts_with(char::is_alphabetic) {
            return Self::new(format!("`{text}` is no value"))
                .mark(place, "text stands in quotes")
                .hint(format!("write \"{text}\""));
        }
        if unquoted && text.is_empty() {
            return Self::new("a value is missing").mark(place, "missing here").hint("write `key = value`");
        }
        Self::new("this is not TOML")
            .mark(place, message)
            .hint("a scene is written in TOML: lines `key = value` under headings `[table]`")
    }
}
