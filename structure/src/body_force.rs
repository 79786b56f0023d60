//! The force on the volume of a structure, as data.

use std::fmt;
use std::sync::Arc;

/// A function of the place `[m]` in the reference configuration and of the time `[s]`.
pub type VectorField<const D: usize> = Arc<dyn Fn(&[f64; D], f64) -> [f64; D] + Send + Sync>;

/// A force per reference volume b `[N/m^3]`.
#[derive(Clone)]
pub enum BodyForce<const D: usize> {
    /// The same everywhere and at all times.
    Constant([f64; D]),
    /// The same everywhere, a function of the time `[s]`.
    Time(Arc<dyn Fn(f64) -> [f64; D] + Send + Sync>),
    /// A function of place and time.
    Field(VectorField<D>),
}

impl<const D: usize> BodyForce<D> {
    /// No body force.
    pub const NONE: Self = Self::Constant([0.0; D]);

    /// A body force that varies in time.
    ///
    /// ```
    /// use partita_structure::BodyForce;
    ///
    /// let ramp = BodyForce::in_time(|t| [0.0, -9.81e3 * t.min(1.0)]);
    /// assert!(matches!(ramp, BodyForce::Time(force) if force(0.5) == [0.0, -4.905e3]));
    /// ```
    pub fn in_time(force: impl Fn(f64) -> [f64; D] + Send + Sync + 'static) -> Self {
        Self::Time(Arc::new(force))
    }

    /// A body force that varies in space and time.
    pub fn in_space(force: impl Fn(&[f64; D], f64) -> [f64; D] + Send + Sync + 'static) -> Self {
        Self::Field(Arc::new(force))
    }
}

impl<const D: usize> fmt::Debug for BodyForce<D> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Constant(force) => f.debug_tuple("Constant").field(force).finish(),
            Self::Time(_) => f.write_str("Time(..)"),
            Self::Field(_) => f.write_str("Field(..)"),
        }
    }
}
