//! Coefficients of time-integration schemes, without any state.

mod bdf;
mod generalized_alpha;
mod newmark;

pub use bdf::{Bdf, BdfOrder};
pub use generalized_alpha::{GeneralizedAlpha, SpectralRadiusError};
pub use newmark::NewmarkError;

/// A time as it is shown to people: with twelve digits, for the last bits of `start + n dt` are noise to a reader. Files
/// keep every bit.
///
/// ```
/// use partita_numerics::time::shown;
///
/// assert_eq!((51.0 * 0.1).to_string(), "5.1000000000000005");
/// assert_eq!(shown(51.0 * 0.1).to_string(), "5.1");
/// ```
#[must_use]
pub fn shown(time: f64) -> f64 {
    format!("{time:.11e}").parse().unwrap_or(time)
}
