//! Slip walls: the frames into which the unknowns of their nodes are turned.
//!
//! Rows of a rotation Q that hold the normal velocity (n.u = n.w) keep the place of the axis nearest to that
//! normal; the others complete the frame. On a wall normal to an axis Q is the identity to the bit.

use std::collections::BTreeMap;

use partita_mesh::{Facet, Mesh};
use partita_numerics::small::{dot, identity};

use crate::model::{BoundaryCondition, FluidModel, SLIP_CORNER};

/// A node on slip walls.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct SlipNode<const D: usize> {
    pub(crate) node: usize,
    /// The facets that give each of its normals: one list for each smooth piece of wall.
    pieces: Vec<Vec<Facet<D>>>,
    /// The rows of the frame: those of the pieces first, then the tangents.
    rows: [usize; D],
}

/// The nodes whose velocity slip walls hold: those that `owner` says belong to a slip condition.
pub(super) fn nodes<const D: usize>(
    mesh: &Mesh<D>,
    model: &FluidModel<D>,
    owner: impl Fn(usize) -> Option<usize>,
) -> Vec<SlipNode<D>> {
    let mut facets: BTreeMap<usize, Vec<Facet<D>>> = BTreeMap::new();
    let is_slip = |condition: &BoundaryCondition<D>| matches!(condition, BoundaryCondition::Slip);
    for (group, _) in model.boundary.iter().filter(|(_, condition)| is_slip(condition)) {
        for facet in &mesh.group(group).expect("a checked group").facets {
            for node in facet.nodes {
                facets.entry(node).or_default().push(*facet);
            }
        }
    }
    let belongs = |node: &usize| owner(*node).is_some_and(|owner| is_slip(&model.boundary[owner].1));
    facets
        .into_iter()
        .filter(|(node, _)| belongs(node))
        .map(|(node, facets)| SlipNode::new(node, facets, mesh.points()))
        .collect()
}

impl<const D: usize> SlipNode<D> {
    fn new(node: usize, facets: Vec<Facet<D>>, points: &[[f64; D]]) -> Self {
        let pieces = smooth_pieces(facets, points);
        let normals: Vec<[f64; D]> = pieces.iter().map(|piece| normal(piece, points)).collect();
        let (kept, rows) = independent_rows(&normals);
        let pieces = kept.into_iter().map(|k| pieces[k].clone()).collect();
        Self { node, pieces, rows }
    }

    /// The rows of the frame that are prescribed.
    pub(crate) fn held_rows(&self) -> &[usize] {
        &self.rows[..self.pieces.len()]
    }

    /// Whether all directions are held.
    fn is_corner(&self) -> bool {
        self.pieces.len() == D
    }

    /// The frame on a mesh with these points: orthonormal rows, by Gram and Schmidt from the normals and the
    /// axes. At a corner any frame will do.
    fn frame(&self, points: &[[f64; D]]) -> [[f64; D]; D] {
        let mut frame = identity();
        if self.is_corner() {
            return frame;
        }
        for (&row, piece) in self.rows.iter().zip(&self.pieces) {
            frame[row] = normal(piece, points);
        }
        for (k, &row) in self.rows.iter().enumerate() {
            let mut direction = frame[row];
            for &earlier in &self.rows[..k] {
                add_scaled(-dot(&direction, &frame[earlier]), &frame[earlier], &mut direction);
            }
            frame[row] = unit(if direction[row] < 0.0 { direction.map(|x| -x) } else { direction });
        }
        frame
    }

    /// Sets n.u = n.w and leaves the other directions of `velocity` alone.
    pub(super) fn impose(&self, frame: &[[f64; D]; D], wall: &[f64; D], velocity: &mut [f64]) {
        let mut change = [0.0; D];
        for &row in self.held_rows() {
            let normal_change: f64 = (0..D).map(|i| frame[row][i] * (wall[i] - velocity[i])).sum();
            add_scaled(normal_change, &frame[row], &mut change);
        }
        for i in 0..D {
            velocity[i] += change[i];
        }
    }
}

/// The frames of all slip nodes on the present mesh.
#[derive(Debug, Clone)]
pub(crate) struct Frames<const D: usize> {
    rotations: Vec<[[f64; D]; D]>,
    /// For each node the frame that turns it; nothing where the frame is that of the axes.
    turning: Vec<Option<usize>>,
    turned_nodes: Vec<usize>,
}

impl<const D: usize> Frames<D> {
    /// Frames of the axes.
    pub(crate) fn new(slip: &[SlipNode<D>], nodes: usize) -> Self {
        Self {
            rotations: vec![identity(); slip.len()],
            turning: vec![None; nodes],
            turned_nodes: Vec::with_capacity(slip.len()),
        }
    }

    /// Turns the frames to the walls of a mesh with these points.
    pub(crate) fn update(&mut self, slip: &[SlipNode<D>], points: &[[f64; D]]) {
        self.turned_nodes.clear();
        for (k, (rotation, slip)) in self.rotations.iter_mut().zip(slip).enumerate() {
            *rotation = slip.frame(points);
            let turns = *rotation != identity();
            self.turning[slip.node] = turns.then_some(k);
            if turns {
                self.turned_nodes.push(slip.node);
            }
        }
    }

    /// The frame of the slip node with this index.
    pub(super) fn rotation(&self, slip: usize) -> &[[f64; D]; D] {
        &self.rotations[slip]
    }

    /// The frame of a node, where it is not that of the axes.
    pub(crate) fn at(&self, node: usize) -> Option<&[[f64; D]; D]> {
        Some(&self.rotations[self.turning[node]?])
    }

    /// The nodes with a frame that is not that of the axes.
    pub(crate) fn turned_nodes(&self) -> &[usize] {
        &self.turned_nodes
    }
}

/// Sorts the facets at a node into pieces without a corner.
fn smooth_pieces<const D: usize>(facets: Vec<Facet<D>>, points: &[[f64; D]]) -> Vec<Vec<Facet<D>>> {
    let mut pieces: Vec<Vec<Facet<D>>> = Vec::new();
    for facet in facets {
        let facet_normal = facet.normal(points);
        let fits =
            |piece: &&mut Vec<Facet<D>>| dot(&piece[0].normal(points), &facet_normal) > SLIP_CORNER.cos();
        match pieces.iter_mut().find(fits) {
            Some(piece) => piece.push(facet),
            None => pieces.push(vec![facet]),
        }
    }
    pieces
}

/// `sum over facets of (N_a, n)`, normalized: with it the discrete flux through the piece vanishes.
///
/// Source: M. Engelman, R. Sani, P. Gresho, *The implementation of normal and/or tangential boundary
/// conditions in finite element codes for incompressible fluid flow*, IJNMF 2 (1982).
fn normal<const D: usize>(piece: &[Facet<D>], points: &[[f64; D]]) -> [f64; D] {
    let mut normal = [0.0; D];
    for facet in piece {
        add_scaled(1.0, &facet.area_vector(points), &mut normal);
    }
    unit(normal)
}

/// What is left of a unit normal that others already span.
const DEPENDENT: f64 = 1e-3;

/// Which normals are independent, and the rows of a frame: for each of these the axis it is to replace, then
/// the axes that stay. Gaussian elimination with column pivoting.
fn independent_rows<const D: usize>(normals: &[[f64; D]]) -> (Vec<usize>, [usize; D]) {
    let mut kept: Vec<(usize, [f64; D], usize)> = Vec::new();
    for (k, normal) in normals.iter().enumerate() {
        let mut left = *normal;
        for (_, earlier, pivot) in &kept {
            add_scaled(-left[*pivot] / earlier[*pivot], earlier, &mut left);
        }
        let pivot = largest(&left);
        if left[pivot].abs() > DEPENDENT {
            kept.push((k, left, pivot));
        }
    }
    let held: Vec<usize> = kept.iter().map(|(_, _, pivot)| *pivot).collect();
    let mut order = held.iter().copied().chain((0..D).filter(|row| !held.contains(row)));
    let rows = std::array::from_fn(|_| order.next().expect("D rows in all"));
    (kept.into_iter().map(|(k, ..)| k).collect(), rows)
}

fn largest<const D: usize>(x: &[f64; D]) -> usize {
    (0..D).fold(0, |best, i| if x[i].abs() > x[best].abs() { i } else { best })
}

fn add_scaled<const D: usize>(a: f64, x: &[f64; D], y: &mut [f64; D]) {
    for i in 0..D {
        y[i] += a * x[i];
    }
}

fn unit<const D: usize>(x: [f64; D]) -> [f64; D] {
    let length = dot(&x, &x).sqrt();
    x.map(|x| x / length)
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    const CORNER: [[f64; 2]; 3] = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0]];
    const BOTTOM: Facet<2> = Facet { nodes: [0, 1], cell: 0 };
    const RIGHT: Facet<2> = Facet { nodes: [1, 2], cell: 0 };

    #[test]
    fn frame_of_a_wall_along_an_axis_is_the_identity_to_the_bit() {
        let slip = SlipNode::new(0, vec![BOTTOM], &CORNER);
        assert_eq!(slip.held_rows(), [1]);
        assert_eq!(slip.frame(&CORNER), identity());
    }

    #[test]
    fn corner_of_two_walls_is_held_in_all_directions() {
        let slip = SlipNode::new(1, vec![BOTTOM, RIGHT], &CORNER);
        assert_eq!(slip.held_rows(), [1, 0]);
        let mut velocity = [3.0, 4.0];
        slip.impose(&slip.frame(&CORNER), &[1.0, 2.0], &mut velocity);
        assert_relative_eq!(velocity[..], [1.0, 2.0][..]);
    }

    #[test]
    fn gentle_bend_has_one_normal_and_a_free_tangent() {
        let points = [[0.0, 0.0], [1.0, 0.1], [2.0, 0.4]];
        let slip = SlipNode::new(1, vec![BOTTOM, RIGHT], &points);
        assert_eq!(slip.held_rows(), [1]);
        let frame = slip.frame(&points);
        // The consistent normal belongs to the chord from (0, 0) to (2, 0.4).
        let length = 2.0_f64.hypot(0.4);
        assert_relative_eq!(frame[1][..], [-0.4 / length, 2.0 / length][..], max_relative = 1e-14);
        assert_relative_eq!(dot(&frame[0], &frame[1]), 0.0, epsilon = 1e-15);
        let mut velocity = [0.7, -0.3];
        slip.impose(&frame, &[0.5, 0.25], &mut velocity);
        assert_relative_eq!(dot(&frame[1], &velocity), dot(&frame[1], &[0.5, 0.25]), max_relative = 1e-14);
        assert_relative_eq!(dot(&frame[0], &velocity), dot(&frame[0], &[0.7, -0.3]), max_relative = 1e-14);
    }

    #[test]
    fn edge_of_two_walls_in_space_leaves_one_tangent() {
        // Two walls that meet along an oblique edge through the origin.
        let points = [[0.0; 3], [1.0, 1.0, 0.2], [1.0, -1.0, 0.0], [0.0, 0.3, 1.0]];
        let walls = [[0, 1, 2], [0, 3, 1]].map(|nodes| Facet { nodes, cell: 0 });
        let slip = SlipNode::new(0, walls.to_vec(), &points);
        assert_eq!(slip.held_rows().len(), 2);
        let frame = slip.frame(&points);
        let free = (0..3).find(|row| !slip.held_rows().contains(row)).expect("one tangent");
        let edge = unit(points[1]);
        assert_relative_eq!(dot(&frame[free], &edge).abs(), 1.0, max_relative = 1e-14);
        for row in 0..3 {
            for other in 0..3 {
                let expected = f64::from(u8::from(row == other));
                assert_relative_eq!(dot(&frame[row], &frame[other]), expected, epsilon = 1e-14);
            }
        }
    }

    #[test]
    fn opposite_normals_count_once() {
        let (kept, rows) = independent_rows(&[[0.0, 1.0], [0.0, -1.0]]);
        assert_eq!((kept, rows), (vec![0], [1, 0]));
    }
}
