//! Why fields and their coupling cannot be built.

use miette::Diagnostic;
use partita_coupling::SetupError;
use partita_fluid::FluidError;
use partita_structure::{MaterialError, StructureError};
use thiserror::Error;

/// A scene that reads well but cannot be built.
#[derive(Debug, Error, Diagnostic)]
pub enum BuildError {
    /// The fluid.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Fluid(#[from] FluidError),
    /// The structure's material.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Material(#[from] MaterialError),
    /// The structure.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Structure(#[from] StructureError),
    /// The coupling.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Coupling(#[from] SetupError),
    /// A field that is to be coupled has no interface.
    #[error("{field}: it has no interface")]
    #[diagnostic(help("{remedy}"))]
    NoInterface {
        /// The field.
        field: &'static str,
        /// How it gets one.
        remedy: &'static str,
    },
    /// There is no obvious way from the points of one participant to those of the other.
    #[error("the interface of {first} has {first_values} values, that of {second} {second_values}")]
    #[diagnostic(help("give the operator between them to `Run::couple_by`"))]
    Unmatched {
        /// Name of the first participant.
        first: String,
        /// Values at its interface.
        first_values: usize,
        /// Name of the second participant.
        second: String,
        /// Values at its interface.
        second_values: usize,
    },
}
