//! What a field says when it cannot go on.

use std::error::Error;

/// A field could not be advanced.
#[derive(Debug, thiserror::Error, miette::Diagnostic)]
#[error("{field}: {message}")]
pub struct ParticipantError {
    /// The field's name.
    pub field: String,
    /// What happened and where, with units.
    pub message: String,
    /// What to try.
    #[help]
    pub hint: Option<String>,
    /// The field's own error.
    pub source: Option<Box<dyn Error + Send + Sync>>,
}

impl ParticipantError {
    /// An error of `field`; `message` says what happened and where.
    #[must_use]
    pub fn new(field: impl Into<String>, message: impl Into<String>) -> Self {
        Self { field: field.into(), message: message.into(), hint: None, source: None }
    }

    /// Adds what to try.
    #[must_use]
    pub fn with_hint(mut self, hint: impl Into<String>) -> Self {
        self.hint = Some(hint.into());
        self
    }

    /// Adds something else to try, behind what there is.
    #[must_use]
    pub fn and_hint(mut self, hint: &str) -> Self {
        self.hint = Some(match self.hint {
            Some(first) => format!("{first}; {hint}"),
            None => hint.to_owned(),
        });
        self
    }

    /// Keeps the error that caused this one.
    #[must_use]
    pub fn with_source(mut self, source: impl Into<Box<dyn Error + Send + Sync>>) -> Self {
        self.source = Some(source.into());
        self
    }
}
