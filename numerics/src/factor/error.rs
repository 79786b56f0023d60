//! How a factorization fails.

/// A matrix that could not be factored.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum FactorError {
    /// The analysis or the fill-in does not fit into memory.
    #[error("factorization of {equations} equations: out of memory\nhint: a coarser mesh needs less")]
    OutOfMemory {
        /// The size of the matrix.
        equations: usize,
    },
    /// A value is infinite or not a number.
    #[error(
        "matrix entry {slot} is not finite\n\
         hint: the iterate or the material data it was assembled from is broken"
    )]
    NotFinite {
        /// The position in the values.
        slot: usize,
    },
    /// A pivot of L L^T is not positive.
    #[error(
        "matrix is not positive definite at equation {equation}\n\
         hint: a body without supports, or a tangent past buckling; LDL^T or LU takes indefinite matrices"
    )]
    NotPositiveDefinite {
        /// The equation of the pivot.
        equation: usize,
    },
    /// The matrix is singular to working precision.
    #[error(
        "matrix is singular to working precision{}\n\
         hint: a missing support, a pressure fixed nowhere, or a dof without an element",
        at(*equation)
    )]
    Singular {
        /// The equation of the failed pivot, where the method shows it.
        equation: Option<usize>,
    },
}

fn at(equation: Option<usize>) -> String {
    equation.map_or_else(String::new, |equation| format!(" at equation {equation}"))
}
