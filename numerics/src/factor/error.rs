//! How a factorization fails.

/// A matrix that could not be factored, or not well enough to solve with.
#[derive(Debug, Clone, PartialEq, thiserror::Error, miette::Diagnostic)]
pub enum FactorError {
    /// The analysis or the fill-in does not fit into memory.
    #[error("factorization of {equations} equations: out of memory")]
    #[diagnostic(help("a coarser mesh needs less"))]
    OutOfMemory {
        /// The size of the matrix.
        equations: usize,
    },
    /// A value is infinite or not a number.
    #[error("matrix entry ({row}, {column}) is not finite")]
    #[diagnostic(help("the iterate or the material data it was assembled from is broken"))]
    NotFinite {
        /// The equation of the row.
        row: usize,
        /// The equation of the column.
        column: usize,
    },
    /// A pivot of L L^T is not positive.
    #[error("matrix is not positive definite at equation {equation}")]
    #[diagnostic(help(
        "a body without supports, or a tangent past buckling; LDL^T or LU takes indefinite matrices"
    ))]
    NotPositiveDefinite {
        /// The equation of the pivot.
        equation: usize,
    },
    /// A column is empty or a pivot is zero.
    #[error("matrix is singular{}", equation.map_or_else(String::new, |equation| format!(" at equation {equation}")))]
    #[diagnostic(help("a missing support, a pressure fixed nowhere, or a dof without an element"))]
    Singular {
        /// The equation of the column or pivot, where the method shows it.
        equation: Option<usize>,
    },
    /// The factor does not reproduce a known solution.
    #[error(
        "matrix is singular to working precision: a known solution comes back with a relative error of {error:.1e}"
    )]
    #[diagnostic(help(
        "a missing support, a pressure fixed nowhere, or an unsymmetric matrix given to a symmetric method"
    ))]
    Inaccurate {
        /// The largest error of an unknown, relative to the scale of its column.
        error: f64,
    },
}
