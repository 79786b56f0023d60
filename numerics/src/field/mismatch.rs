//! A saved state that belongs to another discretization.

/// A count in a saved state that is not that of the solver.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[error("the saved state has {found} {what}, the field has {expected}")]
pub struct StateMismatch {
    /// What was counted.
    pub what: &'static str,
    /// In the state.
    pub found: usize,
    /// In the solver.
    pub expected: usize,
}

impl StateMismatch {
    /// Compares the count in a state with that of the solver.
    ///
    /// # Errors
    /// When they differ.
    pub fn check(what: &'static str, found: usize, expected: usize) -> Result<(), Self> {
        if found == expected { Ok(()) } else { Err(Self { what, found, expected }) }
    }
}
