//! What the tests of several crates share.

use miette::Diagnostic;

/// An error as a user reads it: what happened, and below it a line `hint: ...` where there is a remedy.
#[must_use]
pub fn with_hint(error: &dyn Diagnostic) -> String {
    error.help().map_or_else(|| error.to_string(), |help| format!("{error}\nhint: {help}"))
}
