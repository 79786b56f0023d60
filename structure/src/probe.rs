//! What to read off a structure: displacements at places, energies, reactions.

use crate::boundary::Boundary;
use crate::error::StructureError;
use crate::solver::StructureSolver;

impl<const D: usize> StructureSolver<D> {
    /// Displacement `d = sum_a N_a d_a` `[m]` of the trial state: at the parameters of a patch, or at a point `[m]` of the
    /// undeformed mesh.
    ///
    /// # Panics
    /// When `at` lies outside the patch or mesh or has the wrong length; [`Space::evaluate`](crate::Space::evaluate)
    /// tells the first for a mesh.
    #[must_use]
    pub fn displacement_at(&self, at: &[f64]) -> [f64; D] {
        self.field_at(at, &self.trial.displacement)
    }

    /// Velocity `[m/s]`, as [`displacement_at`](Self::displacement_at).
    ///
    /// # Panics
    /// As [`displacement_at`](Self::displacement_at).
    #[must_use]
    pub fn velocity_at(&self, at: &[f64]) -> [f64; D] {
        self.field_at(at, &self.trial.velocity)
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

    /// Force `[N, in 2D N/m]` that the supports of some parts of the boundary exert on the structure, at
    /// `n+1-alpha_f`.
    ///
    /// It is the sum of the residual, as last assembled, over the nodes of the parts; on parts that are free this is
    /// zero up to the Newton tolerance.
    ///
    /// # Errors
    /// When there is no such part.
    pub fn reaction(&self, parts: impl Into<Boundary>) -> Result<[f64; D], StructureError> {
        let residual = self.work.residual.as_chunks::<D>().0;
        let mut sum = [0.0; D];
        for node in self.space.nodes_of(&parts.into())? {
            for i in 0..D {
                sum[i] += residual[node][i];
            }
        }
        Ok(sum)
    }

    fn field_at(&self, at: &[f64], field: &[f64]) -> [f64; D] {
        let value = self.space.evaluate(at, field.as_chunks::<D>().0);
        value.unwrap_or_else(|| panic!("the point {at:?} lies outside the mesh"))
    }
}
