//! The residual of an element, kept apart by the terms of the equations.
//!
//! A residual says little without the size of what it is the difference of; with the terms kept apart, the
//! solver can measure each block of the residual against the largest of its own terms.

/// A term of the equations; each contributes to the momentum rows, the continuity rows or both.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[repr(usize)]
pub enum Term {
    /// `rho D_t u`; in continuity its part of the pressure stabilization.
    Rate,
    /// `rho c.grad u`; in continuity its part of the pressure stabilization.
    Convection,
    /// `-rho b`; in continuity its part of the pressure stabilization.
    BodyForce,
    /// `grad p`, in weak form; in continuity its part of the pressure stabilization.
    Pressure,
    /// Viscous stress; momentum only.
    Viscosity,
    /// `tau_M (c.grad q_u, r_M)`; momentum only.
    Streamline,
    /// `tau_C (div q_u, div u)` in momentum, `(q_p, div u)` in continuity.
    Divergence,
    /// Tractions and outflow terms; momentum only.
    Boundary,
}

/// How many terms there are.
pub const TERMS: usize = 8;

/// Contributions of one element to the residual, by node and term. Their sum is the residual.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Terms<const D: usize, const N: usize, R = f64> {
    /// `momentum[a][i][term]` `[N/m in 2D, N in 3D]`.
    pub momentum: [[[R; TERMS]; D]; N],
    /// `continuity[a][term]` `[m^2/s in 2D, m^3/s in 3D]`.
    pub continuity: [[R; TERMS]; N],
    /// Size of the momentum terms before anything cancels: what their round-off is relative to.
    pub momentum_size: R,
    /// The same for continuity.
    pub continuity_size: R,
}

impl<const D: usize, const N: usize> Terms<D, N> {
    /// Nothing yet.
    pub const ZERO: Self = Self {
        momentum: [[[0.0; TERMS]; D]; N],
        continuity: [[0.0; TERMS]; N],
        momentum_size: 0.0,
        continuity_size: 0.0,
    };

    /// The residual of the momentum rows of node `a`.
    #[must_use]
    pub fn momentum_sum(&self, a: usize) -> [f64; D] {
        self.momentum[a].map(|terms| terms.iter().sum())
    }

    /// The residual of the continuity row of node `a`.
    #[must_use]
    pub fn continuity_sum(&self, a: usize) -> f64 {
        self.continuity[a].iter().sum()
    }
}
