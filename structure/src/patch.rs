//! A spline patch as a space: its control points are the nodes, one node where a seam closes it.

use partita_iga::seam::Seams;
use partita_iga::transfer::Weights;
use partita_iga::{BasisValues, Derivatives, Side, Spline};

use crate::error::StructureError;

/// A patch and the node of each of its control points.
///
/// Each control point has a node of its own, except along the seams of the patch ([`partita_iga::seam`]): where two
/// opposite sides are one line, as in a ring, or a side is a point, as in a disk, control points share nodes, so that
/// displacements are continuous there.
///
/// ```
/// use std::f64::consts::TAU;
/// use partita_iga::build;
/// use partita_structure::Patch;
///
/// let ring = build::annular_sector([0.0; 2], [1.0, 1.2], 0.0, TAU, [2, 2], [12, 1])?;
/// let patch = Patch::from(ring);
/// assert_eq!(patch.points().len() + 3, patch.spline().control_points().len());
/// # Ok::<(), build::BuildError>(())
/// ```
#[derive(Debug, Clone)]
pub struct Patch<const D: usize> {
    spline: Spline<D>,
    seams: Seams,
    /// Places of the nodes.
    points: Vec<[f64; D]>,
}

impl<const D: usize> From<Spline<D>> for Patch<D> {
    fn from(spline: Spline<D>) -> Self {
        let seams = Seams::find(&spline);
        let points = seams.control_points().iter().map(|&a| spline.control_points()[a]).collect();
        Self { spline, seams, points }
    }
}

impl<const D: usize> Patch<D> {
    /// The spline.
    #[must_use]
    pub fn spline(&self) -> &Spline<D> {
        &self.spline
    }

    /// Where it is joined with itself.
    #[must_use]
    pub fn seams(&self) -> &Seams {
        &self.seams
    }

    /// Undeformed places of the nodes `[m]`.
    #[must_use]
    pub fn points(&self) -> &[[f64; D]] {
        &self.points
    }

    /// The nodes of some control points, in their order.
    #[must_use]
    pub fn nodes_of(&self, control_points: &[usize]) -> Vec<usize> {
        control_points.iter().map(|&a| self.seams.nodes()[a]).collect()
    }

    /// The nodes of a side, one for each of its control points.
    ///
    /// # Errors
    /// When there is no such side, or it is joined with the opposite one.
    pub fn side_nodes(&self, side: Side) -> Result<Vec<usize>, StructureError> {
        if !self.spline.has_side(side) {
            return Err(StructureError::NoSuchSide { side });
        }
        match self.seams.partner(side) {
            Some(partner) => Err(StructureError::JoinedSide { side, partner }),
            None => Ok(self.nodes_of(&self.spline.side(side).1)),
        }
    }

    /// A field with one vector a node, at some parameters.
    pub(crate) fn evaluate(&self, xi: &[f64], field: &[[f64; D]]) -> [f64; D] {
        let mut basis = BasisValues::new(&self.spline);
        self.spline.basis(xi, Derivatives::None, &mut basis);
        let mut value = [0.0; D];
        for (weight, &a) in basis.values().iter().zip(basis.active()) {
            let of_node = &field[self.seams.nodes()[a]];
            (0..D).for_each(|c| value[c] += weight * of_node[c]);
        }
        value
    }

    /// The weights of nodes from those of control points, each node once.
    pub(crate) fn merged(&self, mut weights: Weights) -> Weights {
        if self.seams.is_empty() {
            return weights;
        }
        for (a, _) in &mut weights {
            *a = self.seams.nodes()[*a];
        }
        weights.sort_by_key(|(node, _)| *node);
        weights.dedup_by(|later, first| {
            let same = later.0 == first.0;
            if same {
                first.1 += later.1;
            }
            same
        });
        weights
    }
}
