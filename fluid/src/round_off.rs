//! What round-off alone leaves of a residual.

use partita_mesh::simplex;
use partita_numerics::norms::relative;

use crate::residual::Sizes;
use crate::solver::FluidSolver;

/// Relative error of one rounding, with room for the sums of some of them. A direct solve leaves 0.1 to 0.6 of
/// `f64::EPSILON`.
const ROUNDING: f64 = 2.0 * f64::EPSILON;

/// Relative error of a displacement that a solver of a structure returns: its stiffness matrix makes more of every rounding.
const DISPLACEMENT: f64 = 1e-12;

impl<const D: usize> FluidSolver<D> {
    /// The residual of the last assembly in units of its round-off, of momentum or of continuity, whichever is more: that of
    /// the sum of its terms, each with every factor at its largest value.
    pub(crate) fn residual_in_round_off(&self) -> f64 {
        self.residual_in_units_of(&Sizes::default())
    }

    /// The same with the uncertainty of the displacements that were imposed: the velocity of a wall is a difference of
    /// displacements over dt, and has that of [`DISPLACEMENT`] |d|/dt.
    pub(crate) fn residual_in_uncertainty(&self) -> f64 {
        self.residual_in_units_of(&self.motion_sizes())
    }

    fn residual_in_units_of(&self, motion: &Sizes) -> f64 {
        let (residual, terms) = (self.assembly.squares, self.assembly.sizes);
        let block = |residual: f64, terms: f64, motion: f64| {
            relative(residual.sqrt(), (ROUNDING * terms.sqrt()).hypot(DISPLACEMENT * motion.sqrt()))
        };
        let momentum = block(residual.momentum, terms.momentum, motion.momentum);
        momentum.max(block(residual.continuity, terms.continuity, motion.continuity))
    }

    /// Squared sizes of the terms that a velocity of |d|/dt would make, with d the displacement of the mesh.
    fn motion_sizes(&self) -> Sizes {
        let mut sizes = Sizes::default();
        let Some(bdf) = self.trial.bdf.filter(|_| !self.mesh_is_fixed) else { return sizes };
        let flow = &self.trial.flow;
        let largest_displacement = |node: &usize| {
            self.trial.displacement[node * D..(node + 1) * D]
                .iter()
                .fold(0.0, |most: f64, d| most.max(d.abs()))
        };
        for nodes in self.mesh.cells() {
            let displacement = nodes.iter().map(largest_displacement).fold(0.0, f64::max);
            if displacement > 0.0 {
                let speed = bdf.c[0].abs() * displacement;
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
