//! Forces on boundaries.

use crate::solver::FluidSolver;

impl<const D: usize> FluidSolver<D> {
    /// The residual of the last assembly on **all** dofs, along the axes: `[N/m]` and `[m^2/s]` in 2D, `[N]` and
    /// `[m^3/s]` in 3D. In prescribed momentum rows it is the force on the fluid that holds the value.
    #[must_use]
    pub fn residual(&self) -> &[f64] {
        &self.assembly.residual
    }

    /// Consistent nodal forces of the fluid **on** the structure at the
    /// [`interface_nodes`](Self::interface_nodes), `point * D + c`: the residual of the last assembly with the
    /// sign turned `[N/m in 2D, N in 3D]`.
    ///
    /// They belong to the iterate of that assembly, which a finished Newton loop leaves at the last iterate.
    ///
    /// # Panics
    ///
    /// If `force` does not have D entries an interface node.
    pub fn output(&self, force: &mut [f64]) {
        let nodes = self.interface_nodes();
        assert_eq!(force.len(), nodes.len() * D, "interface forces have {D} entries a node");
        for (node, force) in nodes.iter().zip(force.chunks_exact_mut(D)) {
            force.copy_from_slice(&self.force_at(*node));
        }
    }

    /// Force of the fluid on the boundary group of that name, from the last assembly `[N/m in 2D, N in 3D]`: the
    /// sum of the consistent forces at its nodes, those it shares with neighbouring groups included. Nothing
    /// for a name that is no group; zero where the group holds no velocity.
    #[must_use]
    pub fn force_on(&self, group: &str) -> Option<[f64; D]> {
        self.force_on_all(&[group])
    }

    /// The same for several groups together. A node that they share counts once, so this is less than the sum over the
    /// groups where they meet.
    #[must_use]
    pub fn force_on_all(&self, groups: &[impl AsRef<str>]) -> Option<[f64; D]> {
        let mut nodes = Vec::new();
        for group in groups {
            nodes.extend(self.mesh.group_nodes(group.as_ref())?);
        }
        nodes.sort_unstable();
        nodes.dedup();
        let mut sum = [0.0; D];
        for node in nodes {
            let force = self.force_at(node);
            for i in 0..D {
                sum[i] += force[i];
            }
        }
        Some(sum)
    }

    pub(crate) fn force_at(&self, node: usize) -> [f64; D] {
        std::array::from_fn(|c| -self.assembly.residual[node * (D + 1) + c])
    }
}
