//! Interpolation weights of points outside a structure on its interface: the rows of the transfer operator.

use std::collections::BTreeMap;

use partita_iga::transfer::Weights;
use partita_mesh::solid;

use crate::boundary::Boundary;
use crate::error::StructureError;
use crate::solver::StructureSolver;
use crate::space::Space;

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
    /// Returns the row of `H` of each point: the nodes with a weight other than zero, clamped ones among them, and their
    /// weights. The displacement of the point is `sum_a weight_a d_a`, its force goes to the nodes with the same weights, and
    /// the weights sum to one.
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
    ) -> Result<Vec<Weights>, StructureError> {
        let rows = rows(&self.space, &self.model.wetted, points, tolerance)?;
        Ok(rows.into_iter().map(|row| row.weights).collect())
    }

    /// Ties the points of segments to the wetted parts, each to the closest place there, however far away it is: the rows of
    /// the points of each segment.
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
    ) -> Result<Vec<Vec<Weights>>, StructureError> {
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
            let rows = rows(&self.space, &parts, &points, f64::INFINITY)?;
            let mut rows = rows.into_iter().map(|row| row.weights);
            for segment in members {
                of_segments[segment] = rows.by_ref().take(segments[segment].points.len()).collect();
            }
        }
        Ok(of_segments)
    }
}

/// The row of a point, and its distance from its projection `[m]`.
struct Tied {
    weights: Weights,
    distance: f64,
}

/// The rows of points on some parts of the boundary of a space.
fn rows<const D: usize>(
    space: &Space<D>,
    parts: &Boundary,
    points: &[[f64; D]],
    tolerance: f64,
) -> Result<Vec<Tied>, StructureError> {
    match (space, parts) {
        (Space::Patch(patch), Boundary::Sides(sides)) => {
            let rows = partita_iga::transfer::rows(patch.spline(), sides, points, tolerance)?;
            let tied = rows
                .into_iter()
                .map(|row| Tied { weights: patch.merged(row.weights), distance: row.distance });
            Ok(tied.collect())
        }
        (Space::Lagrange(mesh), Boundary::Groups(groups)) => {
            let rows = solid::transfer::rows(mesh, groups, points, tolerance)?;
            Ok(rows.into_iter().map(|row| Tied { weights: row.weights, distance: row.distance }).collect())
        }
        // The solver was built, so that a list of the other kind is empty.
        (Space::Patch(_), Boundary::Groups(_)) => Err(partita_iga::transfer::TransferError::NoSides.into()),
        (Space::Lagrange(_), Boundary::Sides(_)) => Err(solid::transfer::TransferError::NoGroups.into()),
    }
}
