//! Loads: the body force, and forces at the control points of the interface.

use crate::assembly::Assembly;
use crate::body_force::BodyForce;

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
