//! `K_fp`: how prescribed displacements act on the free ones.

use partita_numerics::scatter::add_vector;
use partita_numerics::{Connectivity, DofMap};

/// The element matrices of the cells that have both free and prescribed dofs, and work space.
#[derive(Debug)]
pub(super) struct Coupling {
    /// Ascending.
    cells: Vec<usize>,
    /// One after the other, row-major.
    matrices: Vec<f64>,
    local_displacement: Vec<f64>,
    local_load: Vec<f64>,
}

impl Coupling {
    pub(super) fn new(connectivity: &Connectivity, dofs: &DofMap) -> Self {
        let couples = |&cell: &usize| {
            let free = connectivity.element(cell).iter().filter(|&&dof| dofs.is_free(dof)).count();
            free > 0 && free < connectivity.dofs_per_element()
        };
        let cells: Vec<usize> = (0..connectivity.len()).filter(couples).collect();
        let n = connectivity.dofs_per_element();
        Self {
            matrices: vec![0.0; cells.len() * n * n],
            cells,
            local_displacement: vec![0.0; n],
            local_load: vec![0.0; n],
        }
    }

    /// Keeps the matrix of a cell if that cell has free and prescribed dofs.
    pub(super) fn keep(&mut self, cell: usize, matrix: &[f64]) {
        if let Ok(position) = self.cells.binary_search(&cell) {
            self.matrices[position * matrix.len()..][..matrix.len()].copy_from_slice(matrix);
        }
    }

    /// `load = -K_fp d_p`, where `prescribed_displacement(dof)` gives `d_p`. Prescribed rows hold reactions.
    pub(super) fn load(
        &mut self,
        connectivity: &Connectivity,
        dofs: &DofMap,
        prescribed_displacement: impl Fn(usize) -> f64,
        load: &mut [f64],
    ) {
        let n = self.local_load.len();
        load.fill(0.0);
        for (&cell, matrix) in self.cells.iter().zip(self.matrices.chunks_exact(n * n)) {
            for (entry, &dof) in self.local_displacement.iter_mut().zip(connectivity.element(cell)) {
                *entry = if dofs.is_free(dof) { 0.0 } else { prescribed_displacement(dof) };
            }
            for (entry, row) in self.local_load.iter_mut().zip(matrix.chunks_exact(n)) {
                *entry = -row.iter().zip(&self.local_displacement).map(|(k, d)| k * d).sum::<f64>();
            }
            add_vector(connectivity, cell, &self.local_load, load);
        }
    }
}
