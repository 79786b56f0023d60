//! The linear system of mesh motion: matrix, factor, and what the prescribed dofs contribute.

use partita_numerics::scatter::add_vector;
use partita_numerics::{Connectivity, DofMap, Factor, Method, Pattern, Scatter};

use super::{MotionError, MotionLaw, kernel, moved_vertices};
use crate::cell::Cells;
use crate::simplex;

/// `K_ff` factored, and `K_fp` as the matrices of the cells that have free and prescribed dofs.
#[derive(Debug)]
pub(super) struct System<const D: usize> {
    law: MotionLaw,
    mean_measure: f64,
    connectivity: Connectivity,
    dofs: DofMap,
    scatter: Scatter,
    factor: Factor,
    /// `K_ff` on its pattern.
    values: Vec<f64>,
    /// Cells through which prescribed dofs act on free ones, ascending.
    coupling_cells: Vec<usize>,
    /// Their element matrices, one after the other.
    coupling_matrices: Vec<f64>,
    /// Work: one element matrix, one element vector twice, a full vector, a vector of the free dofs.
    element_matrix: Vec<f64>,
    local: Vec<f64>,
    local_load: Vec<f64>,
    load: Vec<f64>,
    unknowns: Vec<f64>,
}

impl<const D: usize> System<D> {
    pub(super) fn new(
        cells: &Cells,
        law: MotionLaw,
        mean_measure: f64,
        prescribed: &[bool],
    ) -> Result<Self, MotionError> {
        let connectivity = Connectivity::from_nodes(D + 1, &cells.nodes, D);
        let dofs = DofMap::new(prescribed);
        let pattern = Pattern::new(&dofs, &[&connectivity]);
        let scatter = Scatter::new(&pattern, &dofs, &connectivity);
        let factor = Factor::new(Method::Llt, &pattern)?;
        let couples = |&cell: &usize| {
            let element = connectivity.element(cell);
            element.iter().any(|&dof| dofs.is_free(dof)) && element.iter().any(|&dof| !dofs.is_free(dof))
        };
        let coupling_cells: Vec<usize> = (0..cells.len()).filter(couples).collect();
        let n = connectivity.dofs_per_element();
        Ok(Self {
            law,
            mean_measure,
            values: vec![0.0; pattern.nonzeros()],
            coupling_matrices: vec![0.0; coupling_cells.len() * n * n],
            coupling_cells,
            element_matrix: vec![0.0; n * n],
            local: vec![0.0; n],
            local_load: vec![0.0; n],
            load: vec![0.0; dofs.total()],
            unknowns: vec![0.0; dofs.free_count()],
            connectivity,
            dofs,
            scatter,
            factor,
        })
    }

    /// Assembles and factors the matrix of the mesh displaced by `displacement`.
    pub(super) fn factor_at(
        &mut self,
        points: &[[f64; D]],
        cells: &Cells,
        displacement: &[f64],
    ) -> Result<(), MotionError> {
        self.values.fill(0.0);
        let mut coupling = self
            .coupling_cells
            .iter()
            .zip(self.coupling_matrices.chunks_exact_mut(self.element_matrix.len()))
            .peekable();
        for (cell, nodes) in cells.iter().enumerate() {
            let vertices = moved_vertices(points, nodes, displacement);
            let Some((gradients, measure)) =
                simplex::gradients(&vertices).filter(|(_, measure)| *measure > 0.0)
            else {
                return Err(inverted(cell, &vertices));
            };
            let scale = (self.mean_measure / measure).powf(self.law.stiffening());
            kernel::stiffness(self.law, &gradients, measure, scale, &mut self.element_matrix);
            self.scatter.add_matrix(cell, &self.element_matrix, &mut self.values);
            if let Some((_, kept)) = coupling.next_if(|(couples, _)| **couples == cell) {
                kept.copy_from_slice(&self.element_matrix);
            }
        }
        Ok(self.factor.refactor(&self.values)?)
    }

    /// Free entries of `displacement` from its prescribed ones, both counted from `origin` (or from zero).
    pub(super) fn displace(&mut self, origin: Option<&[f64]>, displacement: &mut [f64]) {
        self.assemble_load(origin, displacement);
        self.dofs.gather(&self.load, &mut self.unknowns);
        self.factor.solve(&mut self.unknowns);
        for &dof in self.dofs.free() {
            displacement[dof] = origin.map_or(0.0, |origin| origin[dof]);
        }
        self.dofs.add_scaled(1.0, &self.unknowns, displacement);
    }

    /// `load = -K_fp (d_p - origin_p)`.
    fn assemble_load(&mut self, origin: Option<&[f64]>, displacement: &[f64]) {
        let n = self.local.len();
        self.load.fill(0.0);
        for (&cell, matrix) in self.coupling_cells.iter().zip(self.coupling_matrices.chunks_exact(n * n)) {
            for (entry, &dof) in self.local.iter_mut().zip(self.connectivity.element(cell)) {
                let change = displacement[dof] - origin.map_or(0.0, |origin| origin[dof]);
                *entry = if self.dofs.is_free(dof) { 0.0 } else { change };
            }
            for (load, row) in self.local_load.iter_mut().zip(matrix.chunks_exact(n)) {
                *load = -row.iter().zip(&self.local).map(|(k, d)| k * d).sum::<f64>();
            }
            add_vector(&self.connectivity, cell, &self.local_load, &mut self.load);
        }
    }

    /// Refuses a prescribed displacement that is not finite.
    pub(super) fn check_finite(&self, points: &[[f64; D]], displacement: &[f64]) -> Result<(), MotionError> {
        let broken = |&dof: &usize| !self.dofs.is_free(dof) && !displacement[dof].is_finite();
        match (0..displacement.len()).find(broken) {
            Some(dof) => Err(MotionError::NotFinite { node: dof / D, place: points[dof / D].into() }),
            None => Ok(()),
        }
    }
}

/// The error for a cell that is not positive.
pub(super) fn inverted<const D: usize>(
    cell: usize,
    vertices: &[[f64; D]; simplex::MAX_VERTICES],
) -> MotionError {
    let vertices = &vertices[..=D];
    MotionError::Inverted {
        cell,
        centroid: simplex::centroid(vertices).into(),
        measure: simplex::measure(vertices),
    }
}
