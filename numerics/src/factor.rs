//! Sparse direct solvers behind one type.

mod cholesky;
mod error;
mod lu;
mod multifrontal;
mod node_block;
mod trial;

pub use error::FactorError;

use cholesky::Cholesky;
use lu::Lu;
use node_block::NodeBlockLu;
use trial::Trial;

use crate::Pattern;

/// Which factorization a matrix gets.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Method {
    /// P A Q = L U with partial pivoting, for any matrix.
    Lu,
    /// L U over the nodes of the mesh, on a structure that is decided once, for matrices whose pivots can be found among
    /// the dofs that are eliminated together: stabilized flow, elasticity. Much faster than [`Lu`](Self::Lu); takes
    /// refuge in it where a factor turns out bad.
    NodeBlockLu,
    /// A = L L^T, for symmetric positive definite matrices.
    Llt,
    /// A = L D L^T without pivoting, for symmetric matrices whose leading minors do not vanish.
    Ldlt,
}

/// A factorization of matrices of one pattern: analysed once, refactored and solved in place many times.
///
/// Values are always those of the **full** pattern, for the symmetric methods too (one triangle of them is
/// read). Results are the same bit for bit in every run on one machine: no randomness, the same sums in the same order
/// for any [number of threads](Self::with_threads), and a refactorization equals a fresh factorization of the same values.
///
/// Nothing allocates after [`Factor::new`], with two exceptions: the numeric phase of faer's supernodal LU
/// ([`Method::Lu`], or a [fallback](Self::fallbacks) to it) allocates its fronts in every
/// [`refactor`](Self::refactor), and with more than one thread the start of each thread does. (The matrix kernels also keep
/// one packing buffer a thread, from their first use on.)
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
    pattern: Pattern,
    /// Whether the last refactorization succeeded.
    is_ready: bool,
    trial_error: f64,
    trial: Trial,
    backend: Backend,
}

enum Backend {
    /// No equations, nothing to do.
    Empty,
    Lu(Box<Lu>),
    NodeBlockLu(Box<NodeBlockLu>),
    Cholesky(Box<Cholesky>),
}

impl Factor {
    /// Orders and analyses the pattern, and allocates what the numeric phases need.
    ///
    /// # Errors
    ///
    /// If memory does not suffice.
    pub fn new(method: Method, pattern: &Pattern) -> Result<Self, FactorError> {
        Self::with_threads(method, pattern, 1)
    }

    /// Like [`new`](Self::new), to be factored and solved by this many threads, the calling one among them.
    ///
    /// The number changes no bit of any result, nor which error comes first. Each thread eliminates subtrees of the
    /// elimination tree that are chosen here once and for all; one thread does the rest at the top, a tenth to a fifth of the
    /// work for two threads, and what the trial takes apart from its solve.
    ///
    /// Only [`Method::NodeBlockLu`] has more than one thread, and only above 10 000 equations, where it begins to pay:
    /// threads are started anew in each call, which takes some hundredths of a millisecond. Zero counts as one, and more than 16
    /// as 16.
    ///
    /// # Errors
    ///
    /// If memory does not suffice.
    pub fn with_threads(method: Method, pattern: &Pattern, threads: usize) -> Result<Self, FactorError> {
        let backend = match method {
            _ if pattern.size() == 0 => Backend::Empty,
            Method::Lu => Backend::Lu(Box::new(Lu::new(pattern)?)),
            Method::NodeBlockLu => Backend::NodeBlockLu(Box::new(NodeBlockLu::new(pattern, threads)?)),
            Method::Llt => Backend::Cholesky(Box::new(Cholesky::new(cholesky::Kind::Llt, pattern)?)),
            Method::Ldlt => Backend::Cholesky(Box::new(Cholesky::new(cholesky::Kind::Ldlt, pattern)?)),
        };
        Ok(Self {
            method,
            pattern: pattern.clone(),
            is_ready: false,
            trial_error: f64::NAN,
            trial: Trial::new(pattern.size()),
            backend,
        })
    }

    /// The number of equations.
    #[must_use]
    pub fn size(&self) -> usize {
        self.pattern.size()
    }

    /// The method it was built for.
    #[must_use]
    pub fn method(&self) -> Method {
        self.method
    }

    /// Factors the matrix with these `values` over the full pattern.
    ///
    /// Each factor proves itself on a system with a known solution before it is used, so that a singular
    /// matrix becomes an error and never a large wrong answer. This costs a product and a solve: a twentieth of
    /// the call for LU, up to a quarter for the symmetric methods.
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
        assert_eq!(values.len(), self.pattern.nonzeros(), "values have the wrong length");
        self.is_ready = false;
        self.trial.inspect(&self.pattern, values)?;
        match &self.backend {
            Backend::NodeBlockLu(_) => self.refactor_or_fall_back(values)?,
            Backend::Empty | Backend::Lu(_) | Backend::Cholesky(_) => self.refactor_and_try_out(values)?,
        }
        trial::judge(self.trial_error)?;
        self.is_ready = true;
        Ok(())
    }

    /// Keeps the fast factor only if it is as good as round-off allows.
    fn refactor_or_fall_back(&mut self, values: &[f64]) -> Result<(), FactorError> {
        let fast = self.refactor_and_try_out(values);
        if fast.is_ok() && (self.trial_error < trial::SOUND || self.is_stable(values)) {
            return Ok(());
        }
        let Backend::NodeBlockLu(lu) = &mut self.backend else { return fast };
        self.trial_error = self.trial.error(&self.pattern, values, |rhs| {
            lu.fall_back(&self.pattern, values)?;
            lu.solve(rhs);
            Ok(())
        })?;
        Ok(())
    }

    fn refactor_and_try_out(&mut self, values: &[f64]) -> Result<(), FactorError> {
        let backend = &mut self.backend;
        let factor_and_solve = |rhs: &mut [f64]| backend.refactor_and_solve(values, rhs);
        self.trial_error = self.trial.error(&self.pattern, values, factor_and_solve)?;
        Ok(())
    }

    fn is_stable(&mut self, values: &[f64]) -> bool {
        let backend = &mut self.backend;
        self.trial.is_stable(&self.pattern, values, |rhs| backend.solve(rhs))
    }

    /// How often a factor of [`Method::NodeBlockLu`] turned out bad, or did not come about, so that [`Method::Lu`] had
    /// to do the work. Each time costs several factorizations; a caller may want to record it.
    #[must_use]
    pub fn fallbacks(&self) -> usize {
        match &self.backend {
            Backend::NodeBlockLu(lu) => lu.fallbacks(),
            Backend::Empty | Backend::Lu(_) | Backend::Cholesky(_) => 0,
        }
    }

    /// Bytes that the numbers of the factor take, padding included; nothing for [`Method::Lu`], where faer does not tell.
    #[must_use]
    pub fn factor_bytes(&self) -> Option<usize> {
        match &self.backend {
            Backend::Empty => Some(0),
            Backend::Lu(_) => None,
            Backend::NodeBlockLu(lu) => Some(lu.factor_bytes()),
            Backend::Cholesky(cholesky) => Some(cholesky.factor_bytes()),
        }
    }

    /// The largest error with which the last factor reproduced a known solution, relative to the scale of
    /// each unknown's column: round-off times a condition number.
    #[must_use]
    pub fn trial_error(&self) -> f64 {
        self.trial_error
    }

    /// Replaces `rhs` by the solution of A x = rhs with the matrix of the last refactorization.
    ///
    /// # Panics
    ///
    /// If the last [`refactor`](Self::refactor) failed or there was none, or `rhs` has the wrong length.
    pub fn solve(&mut self, rhs: &mut [f64]) {
        assert_eq!(rhs.len(), self.size(), "right-hand side has the wrong length");
        assert!(self.is_ready, "solve needs a successful refactor before it");
        self.backend.solve(rhs);
    }
}

impl Backend {
    fn refactor_and_solve(&mut self, values: &[f64], rhs: &mut [f64]) -> Result<(), FactorError> {
        match self {
            Self::Empty => {}
            Self::Lu(lu) => lu.refactor(values)?,
            // In one go: it solves with each part of the factor while that is in the cache.
            Self::NodeBlockLu(lu) => return lu.refactor_and_solve(values, rhs),
            Self::Cholesky(cholesky) => cholesky.refactor(values)?,
        }
        self.solve(rhs);
        Ok(())
    }

    fn solve(&mut self, rhs: &mut [f64]) {
        match self {
            Self::Empty => {}
            Self::Lu(lu) => lu.solve(rhs),
            Self::NodeBlockLu(lu) => lu.solve(rhs),
            Self::Cholesky(cholesky) => cholesky.solve(rhs),
        }
    }
}

impl std::fmt::Debug for Factor {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Factor")
            .field("method", &self.method)
            .field("size", &self.size())
            .field("nonzeros", &self.pattern.nonzeros())
            .field("is_ready", &self.is_ready)
            .finish_non_exhaustive()
    }
}
