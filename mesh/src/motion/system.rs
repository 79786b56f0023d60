//! The linear system of mesh motion, `K_ff d_f = -K_fp d_p`.

use partita_numerics::{Connectivity, DofMap, Factor, Method, Pattern, Scatter};

use super::coupling::Coupling;
use super::{MotionError, MotionLaw, kernel, moved_vertices};
use crate::cell::Cells;
use crate::simplex;

/// Matrix and factor of one configuration of the mesh, and the work vectors of a solution.
#[derive(Debug)]
pub(super) struct System<const D: usize> {
    law: MotionLaw,
    mean_measure: f64,
    connectivity: Connectivity,
    dofs: DofMap,
    scatter: Scatter,
    /// `K_ff` on its pattern.
    values: Vec<f64>,
    /// `None` when every dof is prescribed: there is nothing to solve.
    factor: Option<Factor>,
    /// `K_fp`.
    coupling: Coupling,
    element_matrix: Vec<f64>,
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
        let has_unknowns = dofs.free_count() > 0;
        let n = connectivity.dofs_per_element();
        Ok(Self {
            law,
            mean_measure,
            scatter: Scatter::new(&pattern, &dofs, &connectivity),
            values: vec![0.0; pattern.nonzeros()],
            factor: has_unknowns.then(|| Factor::new(Method::Llt, &pattern)).transpose()?,
            coupling: Coupling::new(&connectivity, &dofs),
            element_matrix: vec![0.0; n * n],
            load: vec![0.0; dofs.total()],
            unknowns: vec![0.0; dofs.free_count()],
            connectivity,
            dofs,
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
        for (cell, nodes) in cells.iter().enumerate() {
            let vertices = moved_vertices(points, nodes, displacement);
            let geometry = simplex::gradients(&vertices).filter(|(_, measure)| *measure > 0.0);
            let (gradients, measure) = geometry.ok_or_else(|| inverted(cell, &vertices))?;
            let scale = (self.mean_measure / measure).powf(self.law.stiffening());
            kernel::stiffness(self.law, &gradients, measure, scale, &mut self.element_matrix);
            self.scatter.add_matrix(cell, &self.element_matrix, &mut self.values);
            self.coupling.keep(cell, &self.element_matrix);
        }
        match &mut self.factor {
            Some(factor) => Ok(factor.refactor(&self.values)?),
            None => Ok(()),
        }
    }

    /// Free entries of `displacement` from its prescribed ones, both counted from `origin` (or from zero).
    pub(super) fn displace(&mut self, origin: Option<&[f64]>, displacement: &mut [f64]) {
        let start = |dof: usize| origin.map_or(0.0, |origin| origin[dof]);
        let change = |dof: usize| displacement[dof] - start(dof);
        self.coupling.load(&self.connectivity, &self.dofs, change, &mut self.load);
        self.dofs.gather(&self.load, &mut self.unknowns);
        if let Some(factor) = &mut self.factor {
            factor.solve(&mut self.unknowns);
        }
        for &dof in self.dofs.free() {
            displacement[dof] = start(dof);
        }
        self.dofs.add_scaled(1.0, &self.unknowns, displacement);
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
