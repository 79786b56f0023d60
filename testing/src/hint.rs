//! Errors as a user reads them.

use miette::Diagnostic;

/// What happened, and below it a line `hint: ...` where there is a remedy.
#[must_use]
pub fn with_hint(error: &dyn Diagnostic) -> String {
    error.help().map_or_else(|| error.to_string(), |help| format!("{error}\nhint: {help}"))
}
