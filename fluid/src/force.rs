//! Forces on boundaries.

use crate::solver::FluidSolver;

impl<const D: usize> FluidSolver<D> {
    /// The residual of the last assembly on **all** dofs, along the axes: `[N/m]` and `[m^2/s]` in 2D, `[N]` and
    /// `[m^3/s]` in 3D. In prescribed momentum rows it is the force on the fluid that holds the value.
    #[must_use]
    pub fn residual(&self) -> &[f64] {
        &self.assembly.residual
    }

    /// Nodal forces of the fluid **on** the structure at the [`interface_nodes`](Self::interface_nodes), `point * D + c`
    /// `[N/m in 2D, N in 3D]`: the residual of the last assembly with the sign turned, and at the ends of the interface, whose
    /// nodes other boundaries hold as well, the part of it that acts on the interface:
    ///
    /// ```text
    /// f_i = sum over the facets f of the interface at node i of (a_if + W_if (-R_i - sum_g a_ig))
    /// a_if = int_f N_i (p n - mu (grad u + grad u^T) n)
    /// ```
    ///
    /// where g runs over all facets at the node that hold its velocity, and the weights W, which sum to one, are the measures of
    /// the facets. A slip wall holds, and gets, no more than its normal component. The parts on all boundaries together are
    /// the residual again, and a linear pressure and a linear velocity give the exact traction of the interface.
    ///
    /// They belong to the iterate of that assembly, which a finished Newton loop leaves at the last iterate.
    ///
    /// # Panics
    ///
    /// If `force` does not have D entries an interface node.
    pub fn interface_force(&self, force: &mut [f64]) {
        let nodes = self.interface_nodes();
        assert_eq!(force.len(), nodes.len() * D, "interface forces have {D} entries a node");
        for (node, force) in nodes.iter().zip(force.chunks_exact_mut(D)) {
            force.copy_from_slice(&self.interface_force_at(*node));
        }
    }

    /// Force of the fluid on the boundary group of that name, from the last assembly `[N/m in 2D, N in 3D]`: the
    /// sum of the nodal forces, taken apart as in [`interface_force`](Self::interface_force) at nodes that it shares with neighbouring groups. None
    /// for a name that is no group; zero where the group holds no velocity.
    #[must_use]
    pub fn force_on(&self, group: &str) -> Option<[f64; D]> {
        self.force_on_all(&[group])
    }

    /// The same for several groups together: the sum of the forces on each of them, a group that is named twice counted once.
    #[must_use]
    pub fn force_on_all(&self, groups: &[impl AsRef<str>]) -> Option<[f64; D]> {
        let mut asked = vec![false; self.mesh.groups().len()];
        let mut nodes = Vec::new();
        for group in groups {
            let name = group.as_ref();
            let index = self.mesh.groups().iter().position(|group| group.name == name)?;
            asked[index] = true;
            if self.shared.holds(index) {
                nodes.extend(self.mesh.groups()[index].facets.iter().flat_map(|facet| facet.nodes));
            }
        }
        nodes.sort_unstable();
        nodes.dedup();
        let mut sum = [0.0; D];
        for node in nodes {
            let force = self.force_at(node, |group| asked[group]);
            for i in 0..D {
                sum[i] += force[i];
            }
        }
        Some(sum)
    }

    /// The force at a node of the interface on the interface alone.
    pub(crate) fn interface_force_at(&self, node: usize) -> [f64; D] {
        self.force_at(node, |group| self.shared.is_interface(group))
    }

    fn force_at(&self, node: usize, asked: impl Fn(usize) -> bool) -> [f64; D] {
        let whole = || std::array::from_fn(|c| -self.assembly.residual[node * (D + 1) + c]);
        self.shared.part_at(node, asked).unwrap_or_else(whole)
    }
}
