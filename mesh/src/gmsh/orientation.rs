//! Which way round cells run, and turning those of a mesh that was drawn the other way.

use super::document::GmshFile;
use super::element::ElementKind;
use super::error::ConvertError;
use crate::Place;
use crate::simplex;

impl GmshFile {
    /// Whether all cells of a dimension, 2 or 3, run the wrong way round, so that a mesh made of them is turned: triangles
    /// and quadrilaterals clockwise, seen from +z; tetrahedra with a negative volume. Flat cells are neither.
    #[must_use]
    pub fn is_inverted(&self, dimension: usize) -> bool {
        let blocks = self.blocks.iter().filter(|block| block.kind.dimension() == dimension);
        let mut signs =
            blocks.flat_map(|block| block.elements().map(|nodes| sign(&self.points, block.kind, nodes)));
        let mut any = false;
        signs.all(|sign| {
            any |= sign < 0.0;
            sign <= 0.0
        }) && any
    }
}

/// Turns all cells, `kind.node_count()` nodes each, if they are inverted.
///
/// # Errors
/// [`ConvertError::Orientation`] when some are and others are not.
pub(super) fn unify(points: &[[f64; 3]], kind: ElementKind, cells: &mut [usize]) -> Result<(), ConvertError> {
    let each = kind.node_count();
    let signs = || cells.chunks_exact(each).map(|nodes| sign(points, kind, nodes));
    let inverted = signs().filter(|&sign| sign < 0.0).count();
    let upright = signs().filter(|&sign| sign > 0.0).count();
    if inverted > 0 && upright > 0 {
        let rare = if inverted <= upright { -1.0 } else { 1.0 };
        let first = signs().position(|sign| sign * rare > 0.0).unwrap_or_default();
        let place = centroid(points, kind, &cells[first * each..(first + 1) * each]);
        return Err(ConvertError::Orientation {
            kind,
            fewer: inverted.min(upright),
            cells: cells.len() / each,
            place,
        });
    }
    if inverted > 0 {
        for nodes in cells.chunks_exact_mut(each) {
            let old: [usize; MOST_NODES] = std::array::from_fn(|a| nodes.get(a).copied().unwrap_or_default());
            for (node, &from) in nodes.iter_mut().zip(turned(kind)) {
                *node = old[from];
            }
        }
    }
    Ok(())
}

/// Most nodes of an element.
const MOST_NODES: usize = 10;

/// The local nodes of a cell in the order that turns it: the first corner stays, corners and edges run backwards.
fn turned(kind: ElementKind) -> &'static [usize] {
    match kind {
        ElementKind::Point1 => &[0],
        ElementKind::Line2 => &[1, 0],
        ElementKind::Line3 => &[1, 0, 2],
        ElementKind::Triangle3 => &[0, 2, 1],
        ElementKind::Triangle6 => &[0, 2, 1, 5, 4, 3],
        ElementKind::Quadrilateral4 => &[0, 3, 2, 1],
        ElementKind::Quadrilateral8 => &[0, 3, 2, 1, 7, 6, 5, 4],
        ElementKind::Quadrilateral9 => &[0, 3, 2, 1, 7, 6, 5, 4, 8],
        ElementKind::Tetrahedron4 => &[0, 2, 1, 3],
        // Edges (0 1) (1 2) (2 0) (3 0) (3 2) (3 1).
        ElementKind::Tetrahedron10 => &[0, 2, 1, 3, 6, 5, 4, 7, 9, 8],
    }
}

/// Twice the area that the corners enclose in the plane z = 0, or six times the volume of a tetrahedron; lines and points
/// have no sign.
fn sign(points: &[[f64; 3]], kind: ElementKind, nodes: &[usize]) -> f64 {
    let corners = corner_count(kind);
    match kind.dimension() {
        2 => {
            // Seen from the first corner, so that a mesh far from the origin keeps its digits.
            let [x, y, _] = points[nodes[0]];
            let corner = |a: usize| {
                let [p, q, _] = points[nodes[a % corners]];
                [p - x, q - y]
            };
            (1..corners).map(|a| corner(a)[0] * corner(a + 1)[1] - corner(a + 1)[0] * corner(a)[1]).sum()
        }
        3 => simplex::measure(&[0, 1, 2, 3].map(|a| points[nodes[a]])),
        _ => 0.0,
    }
}

fn centroid(points: &[[f64; 3]], kind: ElementKind, nodes: &[usize]) -> Place {
    let corners = &nodes[..corner_count(kind)];
    let mean = |i: usize| corners.iter().map(|&node| points[node][i]).sum::<f64>() / corners.len() as f64;
    Place((0..kind.dimension()).map(mean).collect())
}

fn corner_count(kind: ElementKind) -> usize {
    match kind {
        ElementKind::Point1 => 1,
        ElementKind::Line2 | ElementKind::Line3 => 2,
        ElementKind::Triangle3 | ElementKind::Triangle6 => 3,
        ElementKind::Quadrilateral4
        | ElementKind::Quadrilateral8
        | ElementKind::Quadrilateral9
        | ElementKind::Tetrahedron4
        | ElementKind::Tetrahedron10 => 4,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The corners, or the ends of the edge, that each node of a kind lies in the middle of.
    fn means(kind: ElementKind) -> Vec<Vec<usize>> {
        let corners = corner_count(kind);
        let mut means: Vec<Vec<usize>> = (0..corners).map(|a| vec![a]).collect();
        match kind {
            ElementKind::Tetrahedron10 => {
                means.extend([[0, 1], [1, 2], [2, 0], [3, 0], [3, 2], [3, 1]].map(Vec::from));
            }
            ElementKind::Line3 => means.push(vec![0, 1]),
            _ => means.extend((0..corners).map(|a| vec![a, (a + 1) % corners])),
        }
        means.truncate(kind.node_count());
        if kind == ElementKind::Quadrilateral9 {
            means.push((0..4).collect());
        }
        means
    }

    #[test]
    fn a_turned_cell_keeps_each_node_between_its_corners() {
        for kind in ElementKind::ALL {
            let (means, order) = (means(kind), turned(kind));
            assert_eq!((means.len(), order.len()), (kind.node_count(), kind.node_count()));
            for (a, &from) in order.iter().enumerate() {
                let mut ends: Vec<usize> = means[a].iter().map(|&corner| order[corner]).collect();
                let mut old = means[from].clone();
                ends.sort_unstable();
                old.sort_unstable();
                assert_eq!(ends, old, "{kind:?}, node {a}");
            }
        }
    }

    #[test]
    fn turning_changes_the_sign_and_turning_twice_nothing() {
        let points = [[5.0, 5.0, 0.0], [7.0, 5.0, 0.0], [7.5, 6.0, 0.0], [5.0, 6.0, 1.0]];
        for kind in [ElementKind::Triangle3, ElementKind::Quadrilateral4, ElementKind::Tetrahedron4] {
            let cell: Vec<usize> = (0..kind.node_count()).collect();
            let back: Vec<usize> = turned(kind).iter().map(|&a| cell[a]).collect();
            let (sign, other) = (sign(&points, kind, &cell), sign(&points, kind, &back));
            assert!(sign > 0.0 && (sign + other).abs() < 1e-14, "{kind:?}: {sign} and {other}");
            let mut twice = back.clone();
            unify(&points, kind, &mut twice).expect("one cell");
            assert_eq!(twice, cell);
        }
    }
}
