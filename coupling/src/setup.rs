//! What is found wrong before the first step: parts that do not fit, settings out of range, foreign states.

use std::fmt;

use miette::Diagnostic;
use thiserror::Error;

/// The parts of a coupled problem do not fit together.
#[derive(Debug, Error, Diagnostic, PartialEq)]
pub enum SetupError {
    /// The two participants and the transfers list different numbers of blocks.
    #[error(
        "{first} has {first_input} input and {first_output} output blocks, {second} has {second_input} and {second_output}, and there are {transfers} transfers"
    )]
    #[diagnostic(help("one block and one transfer an interface"))]
    BlockCount {
        /// Name of the first participant.
        first: String,
        /// Name of the second participant.
        second: String,
        /// Input blocks of the first.
        first_input: usize,
        /// Output blocks of the first.
        first_output: usize,
        /// Input blocks of the second.
        second_input: usize,
        /// Output blocks of the second.
        second_output: usize,
        /// Transfers given.
        transfers: usize,
    },
    /// Both participants have one name, by which records could not tell them apart.
    #[error("both participants are called `{name}`")]
    #[diagnostic(help("records list the fields by name: give one of them another"))]
    SameName {
        /// The name.
        name: String,
    },
    /// Two blocks that meet do not agree.
    #[error("interface {interface}: {problem}")]
    BlockMismatch {
        /// Name of the interface.
        interface: String,
        /// What disagrees.
        problem: String,
    },
    /// A setting is out of its range.
    #[error("{setting} = {value} is not allowed")]
    #[diagnostic(help("{hint}"))]
    Setting {
        /// Name of the setting.
        setting: &'static str,
        /// Its value.
        value: String,
        /// What is allowed.
        hint: &'static str,
    },
    /// A transfer matrix has an entry that does not fit.
    #[error("transfer row {row}: {problem}")]
    TransferRow {
        /// Row, that is point of the first participant.
        row: usize,
        /// What is wrong.
        problem: String,
    },
    /// A saved state belongs to other choices or to another interface.
    #[error("the saved state of `{what}` does not fit: {problem}")]
    #[diagnostic(help("resume with the choices the state was saved with"))]
    State {
        /// Whose state it is.
        what: String,
        /// What disagrees.
        problem: String,
    },
}

impl SetupError {
    pub(crate) fn setting(setting: &'static str, value: impl fmt::Display, hint: &'static str) -> Self {
        Self::Setting { setting, value: value.to_string(), hint }
    }

    /// A saved state of `what` that does not fit, and why.
    #[must_use]
    pub fn state(what: &str, problem: impl Into<String>) -> Self {
        Self::State { what: what.to_owned(), problem: problem.into() }
    }
}
