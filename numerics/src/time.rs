//! Coefficients of time-integration schemes, without any state.

mod bdf;
mod generalized_alpha;

pub use bdf::{Bdf, BdfOrder};
pub use generalized_alpha::{GeneralizedAlpha, SpectralRadiusError};
