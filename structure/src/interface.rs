//! How points outside of a structure hang on its interface: the rows of the transfer operator.

use partita_mesh::solid;

use crate::boundary::Boundary;
use crate::error::StructureError;
use crate::solver::StructureSolver;
use crate::space::Space;

/// One row of `H`: the displacement of a point is `sum_a weights_a d_a` over the nodes, and its force goes to them with the
/// same weights.
#[derive(Debug, Clone, PartialEq)]
pub struct InterfaceRow {
    /// Nodes of the structure with a weight other than zero, clamped ones among them.
    pub nodes: Vec<usize>,
    /// Their shape functions at the point's projection; the sum is one.
    pub weights: Vec<f64>,
    /// Distance between the point and its projection `[m]`.
    pub distance: f64,
}

impl<const D: usize> StructureSolver<D> {
    /// Ties points `[m]` to the wetted parts of the undeformed structure, each to the closest place there.
    ///
    /// The operator between interface points takes the columns of the nodes that
    /// [`interface_points`](Self::interface_points) lists; the others do not move at all. See
    /// [`partita_iga::transfer`] for patches and [`partita_mesh::solid::transfer`] for meshes.
    ///
    /// # Errors
    /// When nothing is wetted, a point is not finite, or one is farther away than `tolerance` `[m]`; the error names it.
    pub fn interface_rows(
        &self,
        points: &[[f64; D]],
        tolerance: f64,
    ) -> Result<Vec<InterfaceRow>, StructureError> {
        match (&self.space, &self.model.wetted) {
            (Space::Patch(patch), Boundary::Sides(sides)) => {
                let rows = partita_iga::transfer::rows(patch.spline(), sides, points, tolerance)?;
                let row = |row: partita_iga::transfer::Row| {
                    let (nodes, weights) = patch.merged(&row.control_points, row.weights);
                    InterfaceRow { nodes, weights, distance: row.distance }
                };
                Ok(rows.into_iter().map(row).collect())
            }
            (Space::Lagrange(mesh), Boundary::Groups(groups)) => {
                let rows = solid::transfer::rows(mesh, groups, points, tolerance)?;
                let row = |row: solid::transfer::Row| InterfaceRow {
                    nodes: row.nodes,
                    weights: row.weights,
                    distance: row.distance,
                };
                Ok(rows.into_iter().map(row).collect())
            }
            // The solver was built, so that a list of the other kind is empty.
            (Space::Patch(_), Boundary::Groups(_)) => {
                Err(partita_iga::transfer::TransferError::NoSides.into())
            }
            (Space::Lagrange(_), Boundary::Sides(_)) => Err(solid::transfer::TransferError::NoGroups.into()),
        }
    }
}
