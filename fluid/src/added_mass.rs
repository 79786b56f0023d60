//! The added mass of an inviscid fluid.

use partita_mesh::simplex;
use partita_numerics::small::dot;
use partita_numerics::{Connectivity, DofMap, Factor, Method, Pattern, Scatter};

use crate::error::FluidError;
use crate::solver::FluidSolver;

impl<const D: usize> FluidSolver<D> {
    /// The mass `[kg/m in 2D, kg in 3D]` that an inviscid fluid at rest adds to a motion `phi` of the interface, which has D
    /// entries for each of the [`interface_nodes`](Self::interface_nodes):
    ///
    /// ```text
    /// -div grad p = 0,   dp/dn = -rho phi.n on the interface,   p = 0 on open boundaries,   dp/dn = 0 elsewhere
    /// m = sum over the interface of (p, phi.n)
    /// ```
    ///
    /// Accelerating the interface by `a phi` takes the force `m a` along `phi`. Linear elements on the reference mesh.
    ///
    /// Source: P. Causin, J. F. Gerbeau, F. Nobile, *Added-mass effect in the design of partitioned algorithms for
    /// fluid-structure problems*, Comput. Methods Appl. Mech. Engrg. 194 (2005), section 3.
    ///
    /// # Errors
    ///
    /// If no boundary is open, so that the fluid cannot give way.
    ///
    /// # Panics
    ///
    /// If `phi` does not have D entries an interface node.
    pub fn added_mass(&self, phi: &[f64]) -> Result<f64, FluidError> {
        let flux = self.flux_of_motion(phi);
        let cells = self.mesh.cells();
        let connectivity = Connectivity::from_nodes(D + 1, &cells.nodes, 1);
        let dofs = DofMap::new(&self.open_nodes());
        let pattern = Pattern::new(&dofs, &[&connectivity]);
        let scatter = Scatter::new(&pattern, &dofs, &connectivity);
        let mut values = vec![0.0; pattern.nonzeros()];
        for (cell, nodes) in cells.iter().enumerate() {
            let vertices = simplex::vertices(self.mesh.points(), nodes);
            let (gradients, measure) =
                simplex::gradients(&vertices).expect("the cells of a mesh have a volume");
            let gradients = &gradients[..=D];
            let products = gradients.iter().flat_map(|a| gradients.iter().map(move |b| measure * dot(a, b)));
            let matrix: Vec<f64> = products.collect();
            scatter.add_matrix(cell, &matrix, &mut values);
        }
        let mut factor = Factor::new(Method::Llt, &pattern)?;
        factor.refactor(&values)?;
        let mut pressure = vec![0.0; dofs.free_count()];
        dofs.gather(&flux, &mut pressure);
        let load = pressure.clone();
        factor.solve(&mut pressure);
        let work: f64 = load.iter().zip(&pressure).map(|(flux, p)| flux * p).sum();
        Ok(self.model.density * work)
    }

    /// `(N_a, phi.n)` over the interface at every node, exact for linear `phi` on each facet.
    fn flux_of_motion(&self, phi: &[f64]) -> Vec<f64> {
        let interface = self.interface_nodes();
        assert_eq!(phi.len(), interface.len() * D, "a motion of the interface has {D} entries a node");
        let at = |node: usize| -> [f64; D] {
            let k = interface.binary_search(&node).expect("a facet of the interface has its nodes there");
            std::array::from_fn(|c| phi[k * D + c])
        };
        let mut flux = vec![0.0; self.mesh.points().len()];
        for facet in self.interface_facets() {
            let area = facet.area_vector(self.mesh.points());
            let normal: [f64; D] = facet.nodes.map(|node| dot(&at(node), &area));
            let sum: f64 = normal.iter().sum();
            for (&node, own) in facet.nodes.iter().zip(normal) {
                flux[node] += (sum + own) / (D * (D + 1)) as f64;
            }
        }
        flux
    }

    /// Nodes where the pressure of an outflow is known.
    fn open_nodes(&self) -> Vec<bool> {
        let mut open = vec![false; self.mesh.points().len()];
        for (group, _) in self.model.boundary.iter().filter(|(_, condition)| condition.is_natural()) {
            for node in self.mesh.group_nodes(group).expect("a checked group") {
                open[node] = true;
            }
        }
        open
    }
}
