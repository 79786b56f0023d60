//! What round-off alone leaves of a residual.

use partita_mesh::simplex;
use partita_numerics::norms::{extent, relative};

use crate::residual::Sizes;
use crate::solver::FluidSolver;

/// Relative error of one rounding, with room for the sums of some of them. A direct solve leaves 0.1 to 0.6 of
/// `f64::EPSILON`.
const ROUNDING: f64 = 2.0 * f64::EPSILON;

/// Relative error of a displacement that a solver of a structure returns: its stiffness matrix makes more of every rounding.
const DISPLACEMENT: f64 = 1e-12;

impl<const D: usize> FluidSolver<D> {
    /// Velocities `[m/s]` whose difference has a smaller norm than this are the same where an interface moves: they differ by
    /// less than the last bit of its coordinates over the time step. Zero where none moves.
    #[must_use]
    pub fn velocity_resolution(&self) -> f64 {
        let rate = self.trial.bdf.map_or(0.0, |bdf| bdf.c[0].abs());
        rate * self.displacement_resolution()
    }

    /// Forces `[N, in 2D N/m]` on a boundary whose difference has a smaller norm than this are the same: the round-off of the
    /// terms of the last assembly, of which they are the sums.
    #[must_use]
    pub fn load_resolution(&self) -> f64 {
        ROUNDING * self.assembly.sizes.momentum.sqrt()
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
        self.residual_in_units_of(&Sizes::default())
    }

    /// The same with the uncertainty of the displacements that were imposed: the velocity of a wall is a difference of
    /// displacements over dt, and these are known to [`DISPLACEMENT`] |d|, or to the last bit of the coordinates.
    pub(crate) fn residual_in_uncertainty(&self) -> f64 {
        self.residual_in_units_of(&self.motion_sizes())
    }

    fn residual_in_units_of(&self, motion: &Sizes) -> f64 {
        let (residual, terms) = (self.assembly.squares, self.assembly.sizes);
        let block = |residual: f64, terms: f64, motion: f64| {
            relative(residual.sqrt(), (ROUNDING * terms.sqrt()).hypot(motion.sqrt()))
        };
        let momentum = block(residual.momentum, terms.momentum, motion.momentum);
        momentum.max(block(residual.continuity, terms.continuity, motion.continuity))
    }

    /// Squared sizes of the terms that the uncertainty of the mesh's velocity makes.
    fn motion_sizes(&self) -> Sizes {
        let mut sizes = Sizes::default();
        let Some(bdf) = self.trial.bdf.filter(|_| self.motion.is_some()) else { return sizes };
        let (flow, resolution) = (&self.trial.flow, self.displacement_resolution());
        let largest_displacement = |node: &usize| {
            self.trial.displacement[node * D..(node + 1) * D]
                .iter()
                .fold(0.0, |most: f64, d| most.max(d.abs()))
        };
        for nodes in self.mesh.cells() {
            let displacement = nodes.iter().map(largest_displacement).fold(0.0, f64::max);
            let uncertainty = (DISPLACEMENT * displacement).max(resolution);
            if uncertainty > 0.0 {
                let speed = bdf.c[0].abs() * uncertainty;
                let measure = simplex::measure(&simplex::vertices(&self.trial.points, nodes));
                let per_length = measure.powf(-1.0 / D as f64);
                let force = speed * (flow.density * flow.rate + flow.viscosity * per_length * per_length);
                sizes.momentum += (measure * force).powi(2);
                sizes.continuity += (measure * per_length * speed).powi(2);
            }
        }
        sizes
    }
}
