//! Coefficients of time-integration schemes, without any state.

mod bdf;
mod generalized_alpha;
mod newmark;

pub use bdf::{Bdf, BdfOrder};
pub use generalized_alpha::{GeneralizedAlpha, SpectralRadiusError};
pub use newmark::NewmarkError;
