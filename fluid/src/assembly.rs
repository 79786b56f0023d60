//! From elements to the residual on all dofs and the tangent over the free ones.

#![allow(
    clippy::inline_always,
    reason = "vector code has to be part of the entry point of its instruction set"
)]

use partita_mesh::Cells;
use partita_numerics::lanes::{Kernel, Real, on_lanes};
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
    /// Whether u convects; else the mesh alone moves past the fluid.
    pub(crate) convects: bool,
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
    /// Squared norms of the residual of the last assembly, and the squared sizes of its terms.
    pub(crate) squares: Sizes,
    pub(crate) sizes: Sizes,
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
            squares: Sizes::default(),
            sizes: Sizes::default(),
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
        (self.squares, self.sizes) = (measured.squares, sizes);
        measured.norm
    }

    fn elements<const D: usize, const N: usize>(
        &mut self,
        iterate: &Iterate<D>,
        with_tangent: bool,
    ) -> Sizes {
        let sizes = on_lanes(Batches::<D, N> { assembly: self, iterate, with_tangent });
        let (cells, _) = iterate.cells.nodes.as_chunks::<N>();
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
        let element = Element::new(&iterate.gather(0.0, |_| nodes), iterate.flow);
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
        self.add_terms(nodes, &terms, 0);
        if with_tangent {
            self.turn_and_add_local(natural.cell, nodes, iterate.frames);
        }
    }

    /// Adds the terms of one lane.
    #[inline(always)]
    fn add_terms<const D: usize, const N: usize, R: Real>(
        &mut self,
        nodes: &[usize; N],
        terms: &Terms<D, N, R>,
        lane: usize,
    ) {
        for a in 0..N {
            let rows = &mut self.terms[nodes[a] * (D + 1)..][..=D];
            for (row, contribution) in
                rows.iter_mut().zip(terms.momentum[a].iter().chain([&terms.continuity[a]]))
            {
                for (sum, term) in row.iter_mut().zip(contribution) {
                    *sum += term.lanes()[lane];
                }
            }
        }
    }

    /// Adds the element matrix of one lane.
    #[inline(always)]
    fn add_tangent<const D: usize, const N: usize, R: Real>(
        &mut self,
        (cell, nodes): (usize, &[usize; N]),
        matrix: &[R],
        lane: usize,
        frames: &Frames<D>,
    ) {
        let entries = matrix.iter().map(|entry| entry.lanes()[lane]);
        if frames.turned_nodes().is_empty() {
            self.scatter.add_entries(cell, entries, &mut self.tangent);
        } else {
            for (local, entry) in self.local.iter_mut().zip(entries) {
                *local = entry;
            }
            self.turn_and_add_local(cell, nodes, frames);
        }
    }

    /// Adds the local matrix, in the frames of its nodes.
    fn turn_and_add_local<const D: usize, const N: usize>(
        &mut self,
        cell: usize,
        nodes: &[usize; N],
        frames: &Frames<D>,
    ) {
        for (a, &node) in nodes.iter().enumerate() {
            if let Some(frame) = frames.at(node) {
                turn_matrix::<D, N>(&mut self.local, a, frame);
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

/// Evaluates as many elements at a time as there are lanes and adds them one after the other, so that no sum depends on
/// how many these are.
struct Batches<'a, const D: usize, const N: usize> {
    assembly: &'a mut Assembly,
    iterate: &'a Iterate<'a, D>,
    with_tangent: bool,
}

impl<const D: usize, const N: usize> Kernel for Batches<'_, D, N> {
    type Output = Sizes;

    #[inline(always)]
    fn run<R: Real>(self, zero: R) -> Sizes {
        let Self { assembly, iterate, with_tangent } = self;
        let flow = iterate.flow.on_lanes_of(zero);
        let (cells, _) = iterate.cells.nodes.as_chunks::<N>();
        let mut sizes = Sizes::default();
        // N (D + 1) squared, and N = D + 1.
        let mut matrix = [[[[zero; N]; N]; N]; N];
        let matrix = matrix.as_flattened_mut().as_flattened_mut().as_flattened_mut();
        for (batch, cells) in cells.chunks(R::LANES).enumerate() {
            // In the last batch, lanes without an element repeat the last one.
            let fields = iterate.gather(
                zero,
                #[inline(always)]
                |lane| &cells[lane.min(cells.len() - 1)],
            );
            let (_, terms) = element(&fields, &flow, with_tangent.then_some(&mut *matrix));
            for (lane, nodes) in cells.iter().enumerate() {
                sizes.add(&terms, lane);
                assembly.add_terms(nodes, &terms, lane);
                if with_tangent {
                    let cell = batch * R::LANES + lane;
                    assembly.add_tangent((cell, nodes), matrix, lane, iterate.frames);
                }
            }
        }
        sizes
    }
}

impl<const D: usize> Iterate<'_, D> {
    /// The nodal values of the element with `nodes(lane)`, in each of as many lanes as `zero` has.
    #[inline(always)]
    fn gather<'n, const N: usize, R: Real>(
        &self,
        zero: R,
        nodes: impl Fn(usize) -> &'n [usize; N],
    ) -> Fields<D, N, R> {
        let mut fields = Fields {
            points: [[zero; D]; N],
            velocity: [[zero; D]; N],
            pressure: [zero; N],
            convective: [[zero; D]; N],
            history: [[zero; D]; N],
            body_force: [[zero; D]; N],
        };
        for a in 0..N {
            let of_node = |lane: usize, components: usize, i: usize| nodes(lane)[a] * components + i;
            for i in 0..D {
                fields.points[a][i] = zero.gather(|lane| self.points.as_flattened()[of_node(lane, D, i)]);
                fields.velocity[a][i] = zero.gather(|lane| self.values[of_node(lane, D + 1, i)]);
                let mesh_velocity = zero.gather(|lane| self.mesh_velocity[of_node(lane, D, i)]);
                let carried = if self.convects { fields.velocity[a][i] } else { zero };
                fields.convective[a][i] = carried - mesh_velocity;
                fields.history[a][i] = zero.gather(|lane| self.history[of_node(lane, D, i)]);
                fields.body_force[a][i] = zero.gather(|lane| self.body_force[of_node(lane, D, i)]);
            }
            fields.pressure[a] = zero.gather(|lane| self.values[of_node(lane, D + 1, D)]);
        }
        fields
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

#[cfg(test)]
mod tests;
