//! Forces, fluxes and the balance of volume.

use partita_mesh::Facet;

use crate::error::FluidError;
use crate::solver::FluidSolver;
use crate::trial::volume;

/// Net flux of a closed domain relative to what passes its boundary that still counts as balanced.
const BALANCED: f64 = 1e-8;

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
        let mut sum = [0.0; D];
        for node in self.mesh.group_nodes(group)? {
            let force = self.force_at(node);
            for i in 0..D {
                sum[i] += force[i];
            }
        }
        Some(sum)
    }

    fn force_at(&self, node: usize) -> [f64; D] {
        std::array::from_fn(|c| -self.assembly.residual[node * (D + 1) + c])
    }

    /// What the step in progress loses of the balance of volume `[m^2/s in 2D, m^3/s in 3D]`:
    ///
    /// ```text
    /// D_t V - sum over the boundary of (w, n)
    /// ```
    ///
    /// with the same BDF for the volume V of the mesh as for its nodes. The fluid obeys the flux; the shape
    /// changes by `D_t V`. O(dt) for BDF1. Zero outside a step and in steady flow.
    #[must_use]
    pub fn volume_defect(&self) -> f64 {
        let (Some(_), Some(bdf)) = (self.trial.step, self.trial.bdf) else { return 0.0 };
        let rate = bdf.derivative(
            volume(&self.mesh, &self.trial.displacement),
            volume(&self.mesh, &self.committed.displacement),
            volume(&self.mesh, &self.committed.previous_displacement),
        );
        let velocity = &self.trial.mesh_velocity;
        let boundary = self.mesh.topology().boundary();
        rate - boundary.iter().map(|facet| self.flux(facet, velocity, D)).sum::<f64>()
    }

    /// The prescribed velocities of a closed domain must keep its volume.
    pub(crate) fn check_net_flux(&self, time: f64) -> Result<(), FluidError> {
        let (mut net, mut gross) = (0.0, 0.0);
        for facet in self.mesh.topology().boundary() {
            let flux = self.flux(facet, &self.trial.values, D + 1);
            net += flux;
            gross += flux.abs();
        }
        if f64::abs(net) > BALANCED * gross {
            return Err(FluidError::NetFlux { time, net, gross, dimension: D });
        }
        Ok(())
    }

    /// Outward flux through a facet of a nodal velocity with `stride` entries a node.
    fn flux(&self, facet: &Facet<D>, velocity: &[f64], stride: usize) -> f64 {
        let area_vector = facet.area_vector(&self.trial.points);
        let through = |node: usize| (0..D).map(|i| area_vector[i] * velocity[node * stride + i]).sum::<f64>();
        facet.nodes.iter().map(|&node| through(node)).sum::<f64>() / D as f64
    }
}
