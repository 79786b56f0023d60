//! Where a point lies in a solid mesh.

use partita_numerics::small;

use super::{CellMap, SolidMesh, reference};

/// How far outside its reference cell a point may lie and still be taken for one on the cell's edge.
const OUTSIDE: f64 = 1e-9;

/// A step of Newton's method after which the next one is round-off.
const CONVERGED: f64 = 1e-11;

/// More iterations than Newton's method needs inside any cell that is not folded.
const MAX_ITERATIONS: usize = 30;

/// A place in a mesh: the cell and the point of its reference cell.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Location {
    /// The cell.
    pub cell: usize,
    /// Coordinates in the reference cell.
    pub xi: [f64; 2],
}

impl<const D: usize> SolidMesh<D> {
    /// The first cell that holds `point` `[m]`, edges included, and where; `None` outside of the mesh.
    ///
    /// A node is found where it is to the last bit, so that a field there is its value at the node.
    #[must_use]
    pub fn locate(&self, point: &[f64; D]) -> Option<Location> {
        let is_here = |x: &[f64; D]| (0..D).all(|i| x[i] - point[i] == 0.0);
        let node = self.points().iter().position(is_here);
        let at_node = node.and_then(|node| {
            let cell = self.cells().iter().position(|nodes| nodes.contains(&node))?;
            let local = self.cells().cell(cell).iter().position(|&other| other == node)?;
            Some(Location { cell, xi: reference::nodes(self.cells().kind)[local] })
        });
        at_node.or_else(|| {
            (0..self.cells().len()).find_map(|cell| {
                let xi = self.invert(cell, point)?;
                self.is_inside(xi).then_some(Location { cell, xi })
            })
        })
    }

    /// A nodal field, one `[f64; N]` a node, at a place: `sum_a N_a(xi) q_a`.
    ///
    /// # Panics
    /// If there is no such cell or the field is too short.
    #[must_use]
    pub fn evaluate<const N: usize>(&self, at: Location, field: &[[f64; N]]) -> [f64; N] {
        let shape = reference::shape(self.cells().kind, at.xi);
        let mut value = [0.0; N];
        for (&node, n) in self.cells().cell(at.cell).iter().zip(shape.values) {
            (0..N).for_each(|c| value[c] += n * field[node][c]);
        }
        value
    }

    /// The point of the reference cell that is mapped to `point`, by Newton's method; `None` where the cell is too far
    /// away for that.
    fn invert(&self, cell: usize, point: &[f64; D]) -> Option<[f64; 2]> {
        let nodes = self.cells().cell(cell);
        for i in 0..D {
            let along = || nodes.iter().map(|&node| self.points()[node][i]);
            let (low, high) =
                (along().fold(f64::INFINITY, f64::min), along().fold(f64::NEG_INFINITY, f64::max));
            // A curved edge leaves the box round its nodes by less than a quarter of it.
            let margin = 0.25 * (high - low);
            if !(low - margin..=high + margin).contains(&point[i]) {
                return None;
            }
        }
        let centre = if reference::corner_count(self.cells().kind) == 3 { 1.0 / 3.0 } else { 0.0 };
        let mut xi = [centre; 2];
        for _ in 0..MAX_ITERATIONS {
            let CellMap { place, jacobian, .. } = self.map(cell, xi);
            let gap: [f64; D] = std::array::from_fn(|i| point[i] - place[i]);
            let (inverse, _) = small::inverse(&jacobian)?;
            let step = small::apply(&inverse, &gap);
            (0..2).for_each(|i| xi[i] += step[i]);
            if step.iter().all(|step| step.abs() < CONVERGED) {
                return Some(xi);
            }
        }
        None
    }

    fn is_inside(&self, [x, y]: [f64; 2]) -> bool {
        if reference::corner_count(self.cells().kind) == 3 {
            x >= -OUTSIDE && y >= -OUTSIDE && x + y <= 1.0 + OUTSIDE
        } else {
            x.abs() <= 1.0 + OUTSIDE && y.abs() <= 1.0 + OUTSIDE
        }
    }
}
