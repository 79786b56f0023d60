//! From elements to the residual on all dofs and the tangent over the free ones.

use partita_mesh::Cells;
use partita_numerics::newton::ResidualNorm;
use partita_numerics::{Connectivity, DofMap, Pattern, Scatter};

use crate::boundary::{Frames, Natural, NaturalFacet};
use crate::kernel::facet::Facet;
use crate::kernel::{Element, Fields, Flow, TERMS, Terms, element};
use crate::residual::{Sizes, norm};

/// Where the residual is evaluated.
pub(crate) struct Iterate<'a, const D: usize> {
    pub(crate) flow: &'a Flow,
    pub(crate) cells: &'a Cells,
    /// Nodes of the moved mesh.
    pub(crate) points: &'a [[f64; D]],
    /// u and p, `node * (D + 1) + c`.
    pub(crate) values: &'a [f64],
    /// w, `c_1 u^n + c_2 u^{n-1}` and b, `node * D + c`.
    pub(crate) mesh_velocity: &'a [f64],
    pub(crate) history: &'a [f64],
    pub(crate) body_force: &'a [f64],
    pub(crate) natural: &'a [NaturalFacet<D>],
    pub(crate) frames: &'a Frames<D>,
}

/// Patterns, maps and work vectors; they live as long as the solver.
pub(crate) struct Assembly {
    pub(crate) dofs: DofMap,
    pub(crate) pattern: Pattern,
    scatter: Scatter,
    /// Contributions to each row by term; after [`assemble`](Self::assemble), rows of turned nodes are turned.
    terms: Vec<[f64; TERMS]>,
    /// R on all dofs, along the axes.
    pub(crate) residual: Vec<f64>,
    /// -R over the free equations, in the frames of the nodes.
    pub(crate) right_hand_side: Vec<f64>,
    /// dR over the pattern, in the frames of the nodes.
    pub(crate) tangent: Vec<f64>,
    /// Whether continuity, not momentum, decided the norm of the last assembly.
    pub(crate) continuity_is_worse: bool,
    /// One element matrix.
    local: Vec<f64>,
}

impl Assembly {
    pub(crate) fn new(cells: &Cells, prescribed: &[bool]) -> Self {
        let nodes = cells.kind.node_count();
        // A simplex with N nodes carries N - 1 velocities and a pressure at each of them.
        let connectivity = Connectivity::from_nodes(nodes, &cells.nodes, nodes);
        let dofs = DofMap::new(prescribed);
        let pattern = Pattern::new(&dofs, &[&connectivity]);
        let scatter = Scatter::new(&pattern, &dofs, &connectivity);
        Self {
            terms: vec![[0.0; TERMS]; prescribed.len()],
            residual: vec![0.0; prescribed.len()],
            right_hand_side: vec![0.0; dofs.free_count()],
            tangent: vec![0.0; pattern.nonzeros()],
            continuity_is_worse: false,
            local: vec![0.0; connectivity.dofs_per_element().pow(2)],
            dofs,
            pattern,
            scatter,
        }
    }

    /// Residual, and tangent where wanted, at an iterate.
    pub(crate) fn assemble<const D: usize>(
        &mut self,
        iterate: &Iterate<D>,
        with_tangent: bool,
    ) -> ResidualNorm {
        self.terms.fill([0.0; TERMS]);
        if with_tangent {
            self.tangent.fill(0.0);
        }
        // N = D + 1 cannot be written as a type.
        let sizes = match D {
            2 => self.elements::<D, 3>(iterate, with_tangent),
            3 => self.elements::<D, 4>(iterate, with_tangent),
            _ => unreachable!("fluids have 2 or 3 dimensions"),
        };
        for (residual, terms) in self.residual.iter_mut().zip(&self.terms) {
            *residual = terms.iter().sum();
        }
        self.turn_terms(iterate.frames);
        let measured = norm::<D>(&self.dofs, &self.terms, &sizes, &mut self.right_hand_side);
        self.continuity_is_worse = measured.continuity_is_worse;
        measured.norm
    }

    fn elements<const D: usize, const N: usize>(
        &mut self,
        iterate: &Iterate<D>,
        with_tangent: bool,
    ) -> Sizes {
        let (cells, _) = iterate.cells.nodes.as_chunks::<N>();
        let mut sizes = Sizes::default();
        for (cell, nodes) in cells.iter().enumerate() {
            let tangent = with_tangent.then_some(&mut self.local[..]);
            let (_, terms) = element(&iterate.gather(nodes), iterate.flow, tangent);
            sizes.add(&terms);
            self.add_terms(nodes, &terms);
            if with_tangent {
                self.add_tangent(cell, nodes, iterate.frames);
            }
        }
        for facet in iterate.natural {
            self.facet(facet, &cells[facet.cell], iterate, with_tangent);
        }
        sizes
    }

    fn facet<const D: usize, const N: usize>(
        &mut self,
        natural: &NaturalFacet<D>,
        nodes: &[usize; N],
        iterate: &Iterate<D>,
        with_tangent: bool,
    ) {
        let element = Element::new(&iterate.gather(nodes), iterate.flow);
        let mut terms = Terms::ZERO;
        self.local.fill(0.0);
        let tangent = with_tangent.then_some(&mut self.local[..]);
        let mut facet = Facet { element: &element, opposite: natural.opposite, terms: &mut terms, tangent };
        match &natural.natural {
            Natural::Traction { values, .. } => facet.traction(values),
            Natural::Outflow { do_nothing, backflow } => {
                if *do_nothing {
                    facet.do_nothing();
                }
                if *backflow {
                    facet.backflow();
                }
            }
        }
        self.add_terms(nodes, &terms);
        if with_tangent {
            self.add_tangent(natural.cell, nodes, iterate.frames);
        }
    }

    #[inline]
    fn add_terms<const D: usize, const N: usize>(&mut self, nodes: &[usize; N], terms: &Terms<D, N>) {
        for a in 0..N {
            let rows = &mut self.terms[nodes[a] * (D + 1)..][..=D];
            for (row, contribution) in
                rows.iter_mut().zip(terms.momentum[a].iter().chain([&terms.continuity[a]]))
            {
                for (sum, term) in row.iter_mut().zip(contribution) {
                    *sum += term;
                }
            }
        }
    }

    #[inline]
    fn add_tangent<const D: usize, const N: usize>(
        &mut self,
        cell: usize,
        nodes: &[usize; N],
        frames: &Frames<D>,
    ) {
        if !frames.turned_nodes().is_empty() {
            for (a, &node) in nodes.iter().enumerate() {
                if let Some(frame) = frames.at(node) {
                    turn_matrix::<D, N>(&mut self.local, a, frame);
                }
            }
        }
        self.scatter.add_matrix(cell, &self.local, &mut self.tangent);
    }

    fn turn_terms<const D: usize>(&mut self, frames: &Frames<D>) {
        for &node in frames.turned_nodes() {
            let frame = frames.at(node).expect("a turned node has a frame");
            let rows = &mut self.terms[node * (D + 1)..node * (D + 1) + D];
            for term in 0..TERMS {
                let along_axes: [f64; D] = std::array::from_fn(|i| rows[i][term]);
                for i in 0..D {
                    rows[i][term] = (0..D).map(|j| frame[i][j] * along_axes[j]).sum();
                }
            }
        }
    }
}

impl<const D: usize> Iterate<'_, D> {
    /// The nodal values of one element.
    #[inline]
    fn gather<const N: usize>(&self, nodes: &[usize; N]) -> Fields<D, N> {
        let vector = |from: &[f64], node: usize| -> [f64; D] {
            from[node * D..][..D].try_into().expect("D components")
        };
        let velocity: [[f64; D]; N] =
            nodes.map(|node| self.values[node * (D + 1)..][..D].try_into().expect("D components"));
        let mut convective = velocity;
        for (c, &node) in convective.iter_mut().zip(nodes) {
            let w = vector(self.mesh_velocity, node);
            for i in 0..D {
                c[i] -= w[i];
            }
        }
        Fields {
            points: nodes.map(|node| self.points[node]),
            velocity,
            pressure: nodes.map(|node| self.values[node * (D + 1) + D]),
            convective,
            history: nodes.map(|node| vector(self.history, node)),
            body_force: nodes.map(|node| vector(self.body_force, node)),
        }
    }
}

/// Turns rows and columns of local node `a` into its frame: Q K Q^T.
fn turn_matrix<const D: usize, const N: usize>(matrix: &mut [f64], a: usize, frame: &[[f64; D]; D]) {
    let size = N * (D + 1);
    let start = a * (D + 1);
    for other in 0..size {
        let column: [f64; D] = std::array::from_fn(|i| matrix[(start + i) * size + other]);
        for i in 0..D {
            matrix[(start + i) * size + other] = (0..D).map(|j| frame[i][j] * column[j]).sum();
        }
    }
    for other in 0..size {
        let row: [f64; D] = std::array::from_fn(|j| matrix[other * size + start + j]);
        for i in 0..D {
            matrix[other * size + start + i] = (0..D).map(|j| frame[i][j] * row[j]).sum();
        }
    }
}
