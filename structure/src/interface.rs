//! Interpolation weights of points outside a structure on its interface: the rows of the transfer operator.

use std::collections::BTreeMap;

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

/// A line between two points on the interface, and points along it `[m]`.
#[derive(Debug, Clone, PartialEq)]
pub struct Segment<const D: usize> {
    /// Where it starts and ends.
    pub ends: [[f64; D]; 2],
    /// Points along it, which may lie off a curved interface.
    pub points: Vec<[f64; D]>,
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
        rows(&self.space, &self.model.wetted, points, tolerance)
    }

    /// Ties the points of segments to the wetted parts, each to the closest place there, however far away it is.
    ///
    /// Only those parts count that both ends of a segment touch (within `tolerance` `[m]`), where there are any: on a thin
    /// curved structure the middle of a chord may be closer to the opposite side.
    ///
    /// # Errors
    /// When nothing is wetted, or a point is not finite.
    pub fn segment_rows(
        &self,
        segments: &[Segment<D>],
        tolerance: f64,
    ) -> Result<Vec<Vec<InterfaceRow>>, StructureError> {
        let wetted = &self.model.wetted;
        let ends: Vec<[f64; D]> = segments.iter().flat_map(|segment| segment.ends).collect();
        let mut parts_of: Vec<Vec<usize>> = vec![Vec::new(); segments.len()];
        for index in 0..wetted.len() {
            let ends = rows(&self.space, &wetted.only(&[index]), &ends, f64::INFINITY)?;
            for (parts, ends) in parts_of.iter_mut().zip(ends.chunks_exact(2)) {
                if ends.iter().all(|end| end.distance <= tolerance) {
                    parts.push(index);
                }
            }
        }
        let mut segments_on: BTreeMap<Vec<usize>, Vec<usize>> = BTreeMap::new();
        for (segment, parts) in parts_of.into_iter().enumerate() {
            segments_on.entry(parts).or_default().push(segment);
        }
        let mut of_segments = vec![Vec::new(); segments.len()];
        for (parts, members) in segments_on {
            let parts = if parts.is_empty() { wetted.clone() } else { wetted.only(&parts) };
            let points: Vec<[f64; D]> =
                members.iter().flat_map(|&segment| &segments[segment].points).copied().collect();
            let mut rows = rows(&self.space, &parts, &points, f64::INFINITY)?.into_iter();
            for segment in members {
                of_segments[segment] = rows.by_ref().take(segments[segment].points.len()).collect();
            }
        }
        Ok(of_segments)
    }
}

/// The rows of points on some parts of the boundary of a space.
fn rows<const D: usize>(
    space: &Space<D>,
    parts: &Boundary,
    points: &[[f64; D]],
    tolerance: f64,
) -> Result<Vec<InterfaceRow>, StructureError> {
    match (space, parts) {
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
        (Space::Patch(_), Boundary::Groups(_)) => Err(partita_iga::transfer::TransferError::NoSides.into()),
        (Space::Lagrange(_), Boundary::Sides(_)) => Err(solid::transfer::TransferError::NoGroups.into()),
    }
}
