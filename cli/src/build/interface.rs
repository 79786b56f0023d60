//! Where fluid and structure meet: the operator H between their interface points.

use partita_coupling::{MatrixTransfer, Transfer};
use partita_fluid::FluidSolver;
use partita_structure::StructureSolver;
use sprs::TriMat;

use super::BuildError;

/// The transfer `d_f = H x`, `F = H^T f`, with the rows `R_a(xi_i)` of the fluid's interface nodes.
///
/// Columns of nodes that do not move at all are left out: their displacement is zero, and what the fluid puts on them goes
/// into the support. A fluid node that lies on such nodes alone has an empty row. A node that moves in one direction has its
/// column; the component that is held stays zero, and its force goes into the support.
///
/// # Errors
/// When a fluid node lies farther from the wetted sides than `tolerance` times the interface's extent.
pub(crate) fn transfer(
    fluid: &FluidSolver<2>,
    structure: &StructureSolver<2>,
    tolerance: f64,
) -> Result<Box<dyn Transfer>, BuildError> {
    let points: Vec<[f64; 2]> =
        fluid.interface_nodes().iter().map(|&node| fluid.mesh().points()[node]).collect();
    let rows = structure.interface_rows(&points, tolerance * extent(&points))?;
    let mut weights = TriMat::new((points.len(), structure.interface_points().len()));
    for (row, entries) in rows.iter().enumerate() {
        for (node, &weight) in entries.nodes.iter().zip(&entries.weights) {
            if let Ok(column) = structure.interface_points().binary_search(node) {
                weights.add_triplet(row, column, weight);
            }
        }
    }
    Ok(Box::new(MatrixTransfer::new(weights.to_csr(), 2)))
}

/// Diagonal of the bounding box \[m\].
fn extent(points: &[[f64; 2]]) -> f64 {
    let side = |c: usize| {
        let (low, high) = points.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), point| {
            (low.min(point[c]), high.max(point[c]))
        });
        high - low
    };
    side(0).hypot(side(1))
}
