//! What can be wrong with a spline's file, and where.

use std::ops::Range;

use super::format::{FORMAT, KEYS, VERSION};
use crate::knots::KnotError;
use crate::spline::{MAX_PARAMETERS, SplineError};

/// A fault in the text of a spline's file, and its place.
#[derive(Clone, Debug, PartialEq, thiserror::Error, miette::Diagnostic)]
#[error("line {line}, {fault}")]
#[diagnostic(forward(fault))]
pub struct FileError {
    line: usize,
    span: Range<usize>,
    #[source]
    fault: Fault,
}

impl FileError {
    pub(super) fn new(text: &str, span: Range<usize>, fault: Fault) -> Self {
        let line = 1 + text.bytes().take(span.start).filter(|byte| *byte == b'\n').count();
        Self { line, span, fault }
    }

    /// Line of the fault, counted from 1.
    #[must_use]
    pub fn line(&self) -> usize {
        self.line
    }

    /// Bytes of the text that are at fault. Empty, at the end of the text, where something is missing.
    #[must_use]
    pub fn span(&self) -> Range<usize> {
        self.span.clone()
    }

    /// What is wrong there.
    #[must_use]
    pub fn fault(&self) -> &Fault {
        &self.fault
    }
}

/// What is wrong with the text of a spline's file.
#[derive(Clone, Debug, PartialEq, thiserror::Error, miette::Diagnostic)]
pub enum Fault {
    /// The text is not TOML.
    #[error("not TOML: {message}")]
    #[diagnostic(help("a spline file consists of `key = value`, values are numbers or [lists]"))]
    Toml {
        /// What the parser says.
        message: String,
    },
    /// Another kind of file.
    #[error("`format` is \"{found}\"")]
    #[diagnostic(help("the format of a spline file is \"{FORMAT}\""))]
    Format {
        /// The format named.
        found: String,
    },
    /// A version of the format that is not known.
    #[error("`version` is {found}")]
    #[diagnostic(help("this program reads version {VERSION}"))]
    Version {
        /// The version named.
        found: usize,
    },
    /// A key that does not belong there.
    #[error("`{key}` is not a key of a spline file")]
    #[diagnostic(help("{}", match nearest {
        Some(near) => format!("did you mean `{near}`?"),
        None => format!("keys are {}", KEYS.join(", ")),
    }))]
    UnknownKey {
        /// The key found.
        key: String,
        /// The valid key it resembles most, if it resembles one.
        nearest: Option<&'static str>,
    },
    /// A key that must stand in every file.
    #[error("the file ends without `{key}`")]
    #[diagnostic(help("add `{key} = {example}`"))]
    MissingKey {
        /// The key.
        key: &'static str,
        /// What could stand there.
        example: &'static str,
    },
    /// A value of another type.
    #[error("{path}: {found} stands where {wanted} should")]
    #[diagnostic(help("give {wanted}"))]
    Kind {
        /// Key and index, like `knots[0][3]`.
        path: String,
        /// What should be there.
        wanted: &'static str,
        /// What is there.
        found: String,
    },
    /// The file holds a spline in another dimension.
    #[error("a spline in {found} dimensions, where one in {wanted} is needed")]
    #[diagnostic(help("take a file with `dimension = {wanted}` and {wanted} coordinates a control point"))]
    Dimension {
        /// Dimension of the file.
        found: usize,
        /// Dimension asked for.
        wanted: usize,
    },
    /// More than [`MAX_PARAMETERS`] degrees.
    #[error("degrees: {found} parameters are too many")]
    #[diagnostic(help("a spline has up to {MAX_PARAMETERS}"))]
    TooManyParameters {
        /// Number of degrees.
        found: usize,
    },
    /// Not one knot vector for each degree.
    #[error("knots: {found} knot vectors for {needed} degrees")]
    #[diagnostic(help("give one list of knots for each degree"))]
    KnotVectors {
        /// Number of knot vectors.
        found: usize,
        /// Number of degrees.
        needed: usize,
    },
    /// A knot vector that is none.
    #[error("{}[{parameter}]: {error}", match error {
        KnotError::DegreeZero => "degrees",
        _ => "knots",
    })]
    #[diagnostic(forward(error))]
    Knots {
        /// Which parameter it belongs to, from 0.
        parameter: usize,
        /// What is wrong with it.
        error: KnotError,
    },
    /// A control point with too few or too many coordinates.
    #[error("control_points[{index}]: {found} coordinates")]
    #[diagnostic(help("with `dimension = {needed}` a point has {needed}"))]
    Components {
        /// Index of the control point.
        index: usize,
        /// Number of its coordinates.
        found: usize,
        /// The dimension.
        needed: usize,
    },
    /// Control points or weights that do not fit.
    #[error("{key}: {error}")]
    #[diagnostic(forward(error))]
    Spline {
        /// `control_points` or `weights`.
        key: &'static str,
        /// What is wrong with them.
        error: SplineError,
    },
}
