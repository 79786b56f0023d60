//! What to read off a fluid: energy, flow rates, the balance of volume.

use partita_mesh::{Facet, simplex};
use partita_numerics::small::dot;

use crate::boundary::ClosedWalls;
use crate::solver::FluidSolver;
use crate::trial::volume;

impl<const D: usize> FluidSolver<D> {
    /// Kinetic energy of the latest iterate on the present mesh `[J/m in 2D, J in 3D]`:
    ///
    /// ```text
    /// rho/2 (u, u)
    /// ```
    ///
    /// integrated exactly, as in [`kernel`](crate::kernel).
    #[must_use]
    pub fn kinetic_energy(&self) -> f64 {
        let velocity =
            |node: usize| -> [f64; D] { std::array::from_fn(|i| self.trial.values[node * (D + 1) + i]) };
        let mut sum = 0.0;
        for nodes in self.mesh.cells() {
            let measure = simplex::measure(&simplex::vertices(&self.trial.points, nodes));
            let (mut total, mut squares) = ([0.0; D], 0.0);
            for &node in nodes {
                let u = velocity(node);
                squares += dot(&u, &u);
                for i in 0..D {
                    total[i] += u[i];
                }
            }
            sum += measure / ((D + 1) * (D + 2)) as f64 * (squares + dot(&total, &total));
        }
        0.5 * self.model.density * sum
    }

    /// Fluid that leaves through the boundary group of that name, of the latest iterate on the present mesh
    /// `[m^2/s in 2D, m^3/s in 3D]`; nothing for a name that is no group:
    ///
    /// ```text
    /// sum over its facets of (u - w, n)
    /// ```
    ///
    /// Through a boundary that moves with the fluid nothing flows.
    #[must_use]
    pub fn flow_rate(&self, group: &str) -> Option<f64> {
        let facets = &self.mesh.group(group)?.facets;
        let through = |facet: &Facet<D>| {
            self.flux(facet, &self.trial.values, D + 1) - self.flux(facet, &self.trial.mesh_velocity, D)
        };
        Some(facets.iter().map(through).sum())
    }

    /// Fluid that the conditions let out at `time` through the boundary group of that name, on the mesh before it moves
    /// `[m^2/s in 2D, m^3/s in 3D]`; `None` for a name that is no group, or where a condition leaves the velocity free:
    ///
    /// ```text
    /// sum over its facets of (u_h, n)
    /// ```
    ///
    /// with the prescribed velocities `u_h` at the nodes, linear between them. A node that a neighbouring group holds has
    /// the value of that group: next to a no-slip wall a uniform inflow loses the flow of half an edge.
    #[must_use]
    pub fn prescribed_flow_rate(&self, group: &str, time: f64) -> Option<f64> {
        let points = self.mesh.points();
        let mut sum = 0.0;
        for facet in &self.mesh.group(group)?.facets {
            let area_vector = facet.area_vector(points);
            for &node in &facet.nodes {
                let velocity = self.boundaries.held_at_rest(&self.model, node, &points[node], time)?;
                sum += dot(&area_vector, &velocity) / D as f64;
            }
        }
        Some(sum)
    }

    /// What the step in progress, or after [`commit`](partita_numerics::Field::commit) the accepted one, loses of the balance of volume
    /// `[m^2/s in 2D, m^3/s in 3D]`:
    ///
    /// ```text
    /// D_t V - sum over the boundary of (w, n)
    /// ```
    ///
    /// with the same BDF for the volume V of the mesh as for its nodes. The fluid obeys the flux; the shape
    /// changes by `D_t V`. O(dt) for BDF1. Zero before the first step, in steady flow, and up to round-off in a closed
    /// domain, whose moving walls push the fluid by what they sweep.
    #[must_use]
    pub fn volume_defect(&self) -> f64 {
        if self.trial.step.is_none() {
            return self.last_volume_defect;
        }
        let Some(bdf) = self.trial.bdf else { return 0.0 };
        let rate = bdf.derivative(
            volume(&self.mesh, &self.trial.displacement),
            volume(&self.mesh, &self.committed.displacement),
            volume(&self.mesh, &self.committed.previous_displacement),
        );
        let velocity = &self.trial.mesh_velocity;
        let boundary = self.mesh.topology().boundary();
        let corrected = self.boundaries.closed_walls.as_ref().map_or(0.0, ClosedWalls::corrected_flux);
        rate - boundary.iter().map(|facet| self.flux(facet, velocity, D)).sum::<f64>() - corrected
    }

    /// Work that the fluid does on its interface in the step in progress, or after [`commit`](partita_numerics::Field::commit) did in the
    /// accepted one `[J/m in 2D, J in 3D]`:
    ///
    /// ```text
    /// sum over the interface nodes of f_{n+1} . (d_{n+1} - d_n)
    /// ```
    ///
    /// with the forces f of [`output`](partita_numerics::Field::output). What the structure receives differs by the load
    /// that its time scheme takes within the step.
    #[must_use]
    pub fn interface_work(&self) -> f64 {
        let (now, before) = match self.trial.step {
            Some(_) => (&self.trial.displacement, &self.committed.displacement),
            None => (&self.committed.displacement, &self.committed.previous_displacement),
        };
        let work = |&node: &usize| -> f64 {
            let force = self.interface_force_at(node);
            (0..D).map(|c| force[c] * (now[node * D + c] - before[node * D + c])).sum()
        };
        self.interface_nodes().iter().map(work).sum()
    }

    /// Outward flux through a facet of a nodal velocity with `stride` entries a node.
    fn flux(&self, facet: &Facet<D>, velocity: &[f64], stride: usize) -> f64 {
        flux(facet, &self.trial.points, velocity, stride)
    }
}

/// Outward flux through a facet at these points of a nodal velocity with `stride` entries a node.
pub(crate) fn flux<const D: usize>(
    facet: &Facet<D>,
    points: &[[f64; D]],
    velocity: &[f64],
    stride: usize,
) -> f64 {
    let area_vector = facet.area_vector(points);
    let through = |node: usize| (0..D).map(|i| area_vector[i] * velocity[node * stride + i]).sum::<f64>();
    facet.nodes.iter().map(|&node| through(node)).sum::<f64>() / D as f64
}
