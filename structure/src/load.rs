//! Loads: the body force, and forces at the control points of the interface.

use std::fmt;
use std::sync::Arc;

/// A force per reference volume `[N/m^3]`, uniform in space.
#[derive(Clone)]
pub enum BodyForce<const D: usize> {
    /// The same at all times.
    Constant([f64; D]),
    /// A function of the time `[s]`.
    Time(Arc<dyn Fn(f64) -> [f64; D] + Send + Sync>),
}

impl<const D: usize> BodyForce<D> {
    /// No body force.
    pub const NONE: Self = Self::Constant([0.0; D]);

    /// A body force that varies in time.
    ///
    /// ```
    /// use partita_structure::BodyForce;
    /// let ramp = BodyForce::in_time(|t| [0.0, -9.81e3 * t.min(1.0)]);
    /// assert_eq!(ramp.at(0.5), [0.0, -4.905e3]);
    /// ```
    pub fn in_time(force: impl Fn(f64) -> [f64; D] + Send + Sync + 'static) -> Self {
        Self::Time(Arc::new(force))
    }

    /// Its value `[N/m^3]` at `time` `[s]`.
    #[must_use]
    pub fn at(&self, time: f64) -> [f64; D] {
        match self {
            Self::Constant(force) => *force,
            Self::Time(force) => force(time),
        }
    }
}

impl<const D: usize> fmt::Debug for BodyForce<D> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Constant(force) => f.debug_tuple("Constant").field(force).finish(),
            Self::Time(_) => f.write_str("Time(..)"),
        }
    }
}

/// External nodal forces: `external_a = b (N_a, 1) + interface force`, on all control points.
///
/// `volumes` holds `(N_a, 1)` `[m^D]` a control point, `interface_force` one vector `[N, in 2D N/m]` for each of
/// `interface_points`.
pub(crate) fn external_force<const D: usize>(
    body_force: [f64; D],
    volumes: &[f64],
    interface_points: &[usize],
    interface_force: &[f64],
    external: &mut [f64],
) {
    let external = external.as_chunks_mut::<D>().0;
    for (force, volume) in external.iter_mut().zip(volumes) {
        *force = body_force.map(|b| b * volume);
    }
    for (&point, force) in interface_points.iter().zip(interface_force.as_chunks::<D>().0) {
        for i in 0..D {
            external[point][i] += force[i];
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn body_and_interface_forces_add_up_at_their_points() {
        let mut external = vec![7.0; 6];
        external_force([1.0, -2.0], &[0.5, 0.25, 0.25], &[2], &[10.0, 20.0], &mut external);
        assert_eq!(external, [0.5, -1.0, 0.25, -0.5, 10.25, 19.5]);
    }
}
