//! What a motion did to the cells.

use super::system::inverted;
use super::{MotionError, moved_vertices};
use crate::cell::Cells;
use crate::quality::shape_quality;
use crate::simplex;

/// Size and shape of the cells of a displaced mesh.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MotionQuality {
    /// Smallest area or volume of a cell `[m^D]`, positive.
    pub smallest_measure: f64,
    /// Smallest ratio of a cell's measure to the one it has in the reference mesh.
    pub smallest_ratio: f64,
    /// The cell of the smallest ratio.
    pub cell: usize,
    /// Smallest shape quality in (0, 1], see [`shape_quality`].
    pub smallest_quality: f64,
}

pub(super) fn check<const D: usize>(
    points: &[[f64; D]],
    cells: &Cells,
    reference_measures: &[f64],
    displacement: &[f64],
) -> Result<MotionQuality, MotionError> {
    let mut found = MotionQuality {
        smallest_measure: f64::INFINITY,
        smallest_ratio: f64::INFINITY,
        cell: 0,
        smallest_quality: f64::INFINITY,
    };
    let mut smallest_cell = 0;
    for (cell, nodes) in cells.iter().enumerate() {
        let vertices = moved_vertices(points, nodes, displacement);
        let measure = simplex::measure(&vertices);
        if measure.is_nan() {
            return Err(inverted(cell, &vertices));
        }
        if measure < found.smallest_measure {
            (found.smallest_measure, smallest_cell) = (measure, cell);
        }
        let ratio = measure / reference_measures[cell];
        if ratio < found.smallest_ratio {
            (found.smallest_ratio, found.cell) = (ratio, cell);
        }
        found.smallest_quality = found.smallest_quality.min(shape_quality(&vertices));
    }
    if found.smallest_measure > 0.0 {
        return Ok(found);
    }
    Err(inverted(smallest_cell, &moved_vertices(points, cells.cell(smallest_cell), displacement)))
}
