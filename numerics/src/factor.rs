//! Sparse direct solvers behind one type.

mod cholesky;
mod error;
mod lu;

pub use error::FactorError;

use cholesky::Cholesky;
use lu::Lu;
use serde::{Deserialize, Serialize};

use crate::Pattern;

/// Which factorization a matrix gets.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Method {
    /// P A Q = L U with partial pivoting, for any matrix.
    Lu,
    /// A = L L^T, for symmetric positive definite matrices.
    Llt,
    /// A = L D L^T without pivoting, for symmetric matrices whose leading minors do not vanish.
    Ldlt,
}

/// A factorization of matrices of one pattern: analysed once, refactored and solved in place many times.
///
/// Values are always those of the **full** pattern, for the symmetric methods too (one triangle of them is
/// read). Results are the same bit for bit in every run: one thread, no randomness, and a refactorization
/// equals a fresh factorization of the same values.
///
/// Nothing allocates after [`Factor::new`], with one exception: the numeric phase of faer's supernodal LU
/// allocates its fronts in every [`refactor`](Self::refactor). [`solve`](Self::solve) never allocates.
///
/// ```
/// use partita_numerics::{Connectivity, DofMap, Factor, Method, Pattern};
///
/// let bars = Connectivity::new(2, vec![0, 1, 1, 2]);
/// let pattern = Pattern::new(&DofMap::new(&[true, false, false]), &[&bars]);
/// let mut factor = Factor::new(Method::Llt, &pattern)?;
/// factor.refactor(&[2.0, -1.0, -1.0, 1.0])?;
/// let mut x = [0.0, 1.0];
/// factor.solve(&mut x);
/// assert!((x[0] - 1.0).abs() < 1e-14 && (x[1] - 2.0).abs() < 1e-14);
/// # Ok::<(), partita_numerics::FactorError>(())
/// ```
pub struct Factor {
    method: Method,
    size: usize,
    nonzeros: usize,
    /// Whether the last refactorization succeeded.
    is_ready: bool,
    backend: Backend,
}

enum Backend {
    Lu(Box<Lu>),
    Cholesky(Box<Cholesky>),
}

impl Factor {
    /// Orders and analyses the pattern, and allocates what the numeric phases need.
    ///
    /// # Errors
    ///
    /// If memory does not suffice.
    pub fn new(method: Method, pattern: &Pattern) -> Result<Self, FactorError> {
        let backend = match method {
            Method::Lu => Backend::Lu(Box::new(Lu::new(pattern)?)),
            Method::Llt => Backend::Cholesky(Box::new(Cholesky::new(cholesky::Kind::Llt, pattern)?)),
            Method::Ldlt => Backend::Cholesky(Box::new(Cholesky::new(cholesky::Kind::Ldlt, pattern)?)),
        };
        Ok(Self { method, size: pattern.size(), nonzeros: pattern.nonzeros(), is_ready: false, backend })
    }

    /// The number of equations.
    #[must_use]
    pub fn size(&self) -> usize {
        self.size
    }

    /// The method it was built for.
    #[must_use]
    pub fn method(&self) -> Method {
        self.method
    }

    /// Factors the matrix with these `values` over the full pattern.
    ///
    /// # Errors
    ///
    /// If a value is not finite, or the matrix is singular to working precision, or not positive definite
    /// for [`Method::Llt`]. There is then nothing to solve with until another call succeeds.
    ///
    /// # Panics
    ///
    /// If `values` does not have one entry an entry of the pattern.
    pub fn refactor(&mut self, values: &[f64]) -> Result<(), FactorError> {
        assert_eq!(values.len(), self.nonzeros, "values have the wrong length");
        self.is_ready = false;
        if let Some(slot) = values.iter().position(|value| !value.is_finite()) {
            return Err(FactorError::NotFinite { slot });
        }
        match &mut self.backend {
            Backend::Lu(lu) => lu.refactor(values)?,
            Backend::Cholesky(cholesky) => cholesky.refactor(values)?,
        }
        self.is_ready = true;
        Ok(())
    }

    /// Replaces `rhs` by the solution of A x = rhs with the matrix of the last refactorization.
    ///
    /// # Panics
    ///
    /// If the last [`refactor`](Self::refactor) failed or there was none, or `rhs` has the wrong length.
    pub fn solve(&mut self, rhs: &mut [f64]) {
        assert_eq!(rhs.len(), self.size, "right-hand side has the wrong length");
        assert!(self.is_ready, "solve needs a successful refactor before it");
        match &mut self.backend {
            Backend::Lu(lu) => lu.solve(rhs),
            Backend::Cholesky(cholesky) => cholesky.solve(rhs),
        }
    }
}

impl std::fmt::Debug for Factor {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Factor")
            .field("method", &self.method)
            .field("size", &self.size)
            .field("nonzeros", &self.nonzeros)
            .field("is_ready", &self.is_ready)
            .finish_non_exhaustive()
    }
}
