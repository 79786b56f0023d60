//! What to read off a structure: displacements at places, energies, reactions.

use partita_iga::{BasisValues, Derivatives, Side};

use crate::error::StructureError;
use crate::solver::StructureSolver;
use crate::space::Space;

impl<const D: usize> StructureSolver<D> {
    /// Displacement `d(xi) = sum_a R_a(xi) d_a` `[m]` of the trial state at the parameters `xi` of the patch.
    ///
    /// # Panics
    /// When `xi` lies outside the domain or has the wrong length.
    #[must_use]
    pub fn displacement_at(&self, xi: &[f64]) -> [f64; D] {
        self.field_at(xi, &self.trial.displacement)
    }

    /// Velocity v(xi) `[m/s]`, as [`displacement_at`](Self::displacement_at).
    ///
    /// # Panics
    /// When `xi` lies outside the domain or has the wrong length.
    #[must_use]
    pub fn velocity_at(&self, xi: &[f64]) -> [f64; D] {
        self.field_at(xi, &self.trial.velocity)
    }

    /// Strain energy of the trial state `[J, in 2D J/m]`.
    #[must_use]
    pub fn strain_energy(&self) -> f64 {
        self.assembly.strain_energy(&self.trial.displacement)
    }

    /// Kinetic energy of the trial state `[J, in 2D J/m]`.
    #[must_use]
    pub fn kinetic_energy(&self) -> f64 {
        self.assembly.kinetic_energy(&self.trial.velocity)
    }

    /// Force `[N, in 2D N/m]` that the support of a clamped side exerts on the structure, at `n+1-alpha_f`.
    ///
    /// It is the sum of the residual, as last assembled, over the control points of the side; on a side that is free
    /// this is zero up to the Newton tolerance.
    ///
    /// # Errors
    /// When there is no such side.
    pub fn reaction(&self, side: Side) -> Result<[f64; D], StructureError> {
        let residual = self.work.residual.as_chunks::<D>().0;
        let mut sum = [0.0; D];
        for node in self.space.side_nodes(side)? {
            for i in 0..D {
                sum[i] += residual[node][i];
            }
        }
        Ok(sum)
    }

    fn field_at(&self, xi: &[f64], field: &[f64]) -> [f64; D] {
        match &self.space {
            Space::Patch(spline) => {
                let mut basis = BasisValues::new(spline);
                spline.basis(xi, Derivatives::None, &mut basis);
                basis.value_of(field.as_chunks::<D>().0)
            }
        }
    }
}
