//! A known cause of failures.

/// A known cause of failures, to be named beside the error.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Suspect {
    /// What is so, and what to do about it.
    pub advice: String,
    /// Whether it comes before the advice of the error itself.
    pub comes_first: bool,
}
