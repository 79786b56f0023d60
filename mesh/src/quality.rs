//! How large and how well shaped the cells are.

use crate::cell::Cells;
use crate::simplex;

/// Signed areas or volumes of all cells, `det A / D!`, `[m^D]`.
///
/// # Panics
/// If the cells are not simplices with `D + 1` nodes.
#[must_use]
pub fn measures<const D: usize>(points: &[[f64; D]], cells: &Cells) -> Vec<f64> {
    cells.iter().map(|nodes| simplex::measure(&simplex::vertices(points, nodes))).collect()
}

/// Isotropic shape quality: 1 for the regular simplex, towards 0 for a flat one, negative if inverted.
///
/// The mean ratio `q = (|V| / V_reg)^(2/D) / mean(l^2)` with the measure `V`, the edge lengths `l`, and the
/// measure `V_reg` of the regular simplex of edge 1; it does not depend on size, place or numbering
/// (Liu and Joe, *Relationship between tetrahedron shape measures*, BIT 34, 1994).
///
/// ```
/// use partita_mesh::quality::shape_quality;
/// let equilateral = [[0.0, 0.0], [1.0, 0.0], [0.5, 0.75_f64.sqrt()]];
/// assert!((shape_quality(&equilateral) - 1.0).abs() < 1e-14);
/// ```
#[must_use]
pub fn shape_quality<const D: usize>(vertices: &[[f64; D]]) -> f64 {
    let edge_count = (D * (D + 1) / 2) as f64;
    let mean_squared_edge = simplex::squared_edges(vertices) / edge_count;
    let ratio = simplex::measure(vertices) / regular_measure(D);
    ratio.signum() * ratio.abs().powf(2.0 / D as f64) / mean_squared_edge
}

/// Measure of the regular simplex of edge 1: `sqrt((D + 1) / 2^D) / D!`.
fn regular_measure(dimension: usize) -> f64 {
    match dimension {
        1 => 1.0,
        2 => 0.75_f64.sqrt() / 2.0,
        _ => 0.5_f64.sqrt() / 6.0,
    }
}

/// Sizes and shapes of all cells in a few numbers.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Summary {
    /// Area or volume of the mesh `[m^D]`.
    pub total_measure: f64,
    /// Smallest signed measure of a cell `[m^D]`.
    pub smallest_measure: f64,
    /// The cell of the smallest measure.
    pub smallest_cell: usize,
    /// Smallest shape quality.
    pub worst_quality: f64,
    /// The cell of the smallest quality.
    pub worst_cell: usize,
    /// Mean shape quality.
    pub mean_quality: f64,
}

/// Summary over all cells.
///
/// # Panics
/// If there are no cells, or they are not simplices with `D + 1` nodes.
#[must_use]
pub fn summary<const D: usize>(points: &[[f64; D]], cells: &Cells) -> Summary {
    assert!(!cells.is_empty(), "a summary needs at least one cell");
    let mut summary = Summary {
        total_measure: 0.0,
        smallest_measure: f64::INFINITY,
        smallest_cell: 0,
        worst_quality: f64::INFINITY,
        worst_cell: 0,
        mean_quality: 0.0,
    };
    for (cell, nodes) in cells.iter().enumerate() {
        let vertices = simplex::vertices(points, nodes);
        let (measure, quality) = (simplex::measure(&vertices), shape_quality(&vertices));
        summary.total_measure += measure;
        summary.mean_quality += quality / cells.len() as f64;
        if measure < summary.smallest_measure {
            (summary.smallest_measure, summary.smallest_cell) = (measure, cell);
        }
        if quality < summary.worst_quality {
            (summary.worst_quality, summary.worst_cell) = (quality, cell);
        }
    }
    summary
}
