//! What round-off alone leaves of a residual.

use partita_numerics::norms::{extent, relative};

use crate::solver::FluidSolver;

/// Relative error of one rounding, with room for the sums of some of them. A direct solve leaves 0.1 to 0.6 of
/// `f64::EPSILON`.
const ROUNDING: f64 = 2.0 * f64::EPSILON;

impl<const D: usize> FluidSolver<D> {
    /// Velocities `[m/s]` whose difference has a smaller norm than this are the same where an interface moves: they differ by
    /// less than the last bit of its coordinates over the time step. Zero where none moves.
    #[must_use]
    pub fn velocity_resolution(&self) -> f64 {
        let rate = self.trial.bdf.map_or(0.0, |bdf| bdf.c[0].abs());
        rate * self.displacement_resolution()
    }

    /// The same of pressures `[Pa]`: what such a change of velocity, within one time step and over the extent of the mesh, makes of
    /// them.
    #[must_use]
    pub fn pressure_resolution(&self) -> f64 {
        let rate = self.trial.bdf.map_or(0.0, |bdf| bdf.c[0].abs());
        self.model.density * extent(self.mesh.points()) * rate * self.velocity_resolution()
    }

    fn displacement_resolution(&self) -> f64 {
        if self.boundaries.moved_interface.is_empty() {
            0.0
        } else {
            f64::EPSILON * extent(self.mesh.points())
        }
    }

    /// The residual of the last assembly in units of its round-off, of momentum or of continuity, whichever is more: that of
    /// the sum of its terms, each with every factor at its largest value.
    pub(crate) fn residual_in_round_off(&self) -> f64 {
        let (residual, terms) = (self.assembly.squares, self.assembly.sizes);
        let block = |residual: f64, terms: f64| relative(residual.sqrt(), ROUNDING * terms.sqrt());
        block(residual.momentum, terms.momentum).max(block(residual.continuity, terms.continuity))
    }
}
