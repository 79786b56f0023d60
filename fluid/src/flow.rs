//! What all elements of a step share: properties of the fluid, rates of the time scheme, and the derivative that is taken.
#![allow(
    clippy::inline_always,
    reason = "vector code has to be part of the entry point of its instruction set"
)]

use partita_numerics::lanes::Real;

/// Which derivative of the residual Newton's method uses.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Tangent {
    /// The derivative of the residual, d tau/du included: quadratic convergence.
    #[default]
    Full,
    /// The derivative with `tau_M` and `tau_C` held: linear convergence, fast where tau changes little.
    FrozenTau,
    /// The derivative with the convective velocity u - w held, and with it tau: linear convergence from
    /// far away.
    Picard,
}

/// What all elements of a step share.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Flow<R = f64> {
    /// rho `[kg/m^3]`.
    pub density: R,
    /// mu `[Pa s]`.
    pub viscosity: R,
    /// `C_I` of `tau_M`.
    pub inverse_constant: R,
    /// Factor of `tau_C`.
    pub grad_div: R,
    /// `c_0` of the time derivative `D_t u = c_0 u + history` `[1/s]`; zero for a steady flow.
    pub rate: R,
    /// `4/dt^2` of `tau_M` `[1/s^2]`; zero for a steady flow.
    pub four_over_dt_squared: R,
    /// Which derivative the tangent is.
    pub tangent: Tangent,
}

impl Flow {
    /// The same in as many lanes as `zero` has.
    #[inline(always)]
    #[must_use]
    pub fn on_lanes_of<R: Real>(&self, zero: R) -> Flow<R> {
        Flow {
            density: zero.like(self.density),
            viscosity: zero.like(self.viscosity),
            inverse_constant: zero.like(self.inverse_constant),
            grad_div: zero.like(self.grad_div),
            rate: zero.like(self.rate),
            four_over_dt_squared: zero.like(self.four_over_dt_squared),
            tangent: self.tangent,
        }
    }
}

impl<R: Real> Flow<R> {
    /// Zero in every lane.
    #[inline(always)]
    pub(crate) fn zero(&self) -> R {
        self.density.like(0.0)
    }
}
