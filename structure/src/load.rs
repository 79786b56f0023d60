//! Loads: the body force, and forces at the control points of the interface.

use std::fmt;
use std::sync::Arc;

use crate::assembly::Assembly;

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

/// External nodal forces, the body force of one time kept apart from the interface force, which changes within a step.
#[derive(Debug, Clone)]
pub(crate) struct Loads<const D: usize> {
    body_force: BodyForce<D>,
    /// `(N_a, 1)` of every control point `[m^D]`.
    volumes: Vec<f64>,
    /// `(N_a, b)` at the time last asked for, on all dofs.
    body: Vec<f64>,
    interface_points: Vec<usize>,
}

impl<const D: usize> Loads<D> {
    pub(crate) fn new(
        body_force: BodyForce<D>,
        assembly: &Assembly<D>,
        interface_points: Vec<usize>,
    ) -> Self {
        let volumes = assembly.volumes();
        let body = vec![0.0; volumes.len() * D];
        Self { body_force, volumes, body, interface_points }
    }

    /// Control points that carry the interface force.
    pub(crate) fn interface_points(&self) -> &[usize] {
        &self.interface_points
    }

    /// Evaluates the body force at `time`.
    pub(crate) fn set_time(&mut self, time: f64, assembly: &Assembly<D>) {
        match &self.body_force {
            BodyForce::Constant(force) => self.spread(*force),
            BodyForce::Time(force) => self.spread(force(time)),
            BodyForce::Field(force) => assembly.body_force(|x| force(x, time), &mut self.body),
        }
    }

    /// A uniform b loads each control point with its share of the volume.
    fn spread(&mut self, b: [f64; D]) {
        for (force, volume) in self.body.as_chunks_mut::<D>().0.iter_mut().zip(&self.volumes) {
            *force = b.map(|b| b * volume);
        }
    }

    /// All external forces on all dofs, with `interface_force` in the order of the interface points.
    pub(crate) fn external_force(&self, interface_force: &[f64], external: &mut [f64]) {
        external.copy_from_slice(&self.body);
        let external = external.as_chunks_mut::<D>().0;
        for (&point, force) in self.interface_points.iter().zip(interface_force.as_chunks::<D>().0) {
            for i in 0..D {
                external[point][i] += force[i];
            }
        }
    }
}
