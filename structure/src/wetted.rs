//! Elements and ends of a structure's boundary, for the other side of an interface.

use std::collections::BTreeMap;

use partita_iga::{Side, Spline};
use partita_mesh::SolidMesh;

use crate::boundary::Boundary;
use crate::patch::Patch;
use crate::space::Space;

impl Space<2> {
    /// Start and end `[m]` of every element along some parts of the boundary: knot spans of sides, edges of groups. Parts that
    /// the space lacks have none.
    #[must_use]
    pub fn boundary_elements(&self, parts: &Boundary) -> Vec<[[f64; 2]; 2]> {
        match (self, parts) {
            (Self::Patch(patch), Boundary::Sides(sides)) => {
                curves(patch, sides).iter().flat_map(|(_, curve)| spans(curve)).collect()
            }
            (Self::Lagrange(mesh), Boundary::Groups(groups)) => {
                let groups = groups.iter().filter_map(|name| mesh.group(name));
                let edges = groups.flat_map(|group| group.edges.iter());
                edges.map(|edge| [mesh.points()[edge[0]], mesh.points()[edge[1]]]).collect()
            }
            _ => Vec::new(),
        }
    }

    /// Highest degree of the shape functions along some parts of the boundary; 1 without any.
    #[must_use]
    pub fn boundary_degree(&self, parts: &Boundary) -> usize {
        match (self, parts) {
            (Self::Patch(patch), Boundary::Sides(sides)) => {
                let degrees = curves(patch, sides).into_iter().map(|(_, curve)| curve.knots()[0].degree());
                degrees.max().unwrap_or(1)
            }
            (Self::Lagrange(mesh), Boundary::Groups(groups)) => {
                let groups = groups.iter().filter_map(|name| mesh.group(name));
                groups.map(|group| group.edges.kind.node_count() - 1).max().unwrap_or(1)
            }
            _ => 1,
        }
    }

    /// Where some parts of the boundary end, and the name of the part `[m]`: the ends of sides that are no smooth ring, and
    /// the nodes that belong to one edge of the groups alone.
    #[must_use]
    pub fn boundary_ends(&self, parts: &Boundary) -> Vec<(String, [f64; 2])> {
        match (self, parts) {
            (Self::Patch(patch), Boundary::Sides(sides)) => {
                let open = curves(patch, sides)
                    .into_iter()
                    .filter(|(side, curve)| !(patch.seams().is_loop(*side) && is_smooth(curve)));
                let ends = |(side, curve): (Side, Spline<2>)| {
                    curve.knots()[0].domain().map(|xi| (side.to_string(), curve.point(&[xi])))
                };
                open.flat_map(ends).collect()
            }
            (Self::Lagrange(mesh), Boundary::Groups(groups)) => ends_of_groups(mesh, groups),
            _ => Vec::new(),
        }
    }
}

/// The sides that the patch has.
fn curves(patch: &Patch<2>, sides: &[Side]) -> Vec<(Side, Spline<2>)> {
    let spline = patch.spline();
    sides
        .iter()
        .filter(|side| spline.has_side(**side))
        .map(|&side| (side, spline.side(side).0))
        .filter(|(_, curve)| curve.parameters() == 1)
        .collect()
}

fn spans(curve: &Spline<2>) -> Vec<[[f64; 2]; 2]> {
    let knots = &curve.knots()[0];
    (0..knots.element_count()).map(|k| knots.element(k).map(|xi| curve.point(&[xi]))).collect()
}

/// A chain of edges ends in a node that belongs to one edge alone.
fn ends_of_groups(mesh: &SolidMesh<2>, groups: &[String]) -> Vec<(String, [f64; 2])> {
    let mut edges_at: BTreeMap<usize, (usize, &str)> = BTreeMap::new();
    for group in groups.iter().filter_map(|name| mesh.group(name)) {
        for node in group.edges.iter().flat_map(|edge| [edge[0], edge[1]]) {
            edges_at.entry(node).or_insert((0, group.name.as_str())).0 += 1;
        }
    }
    let ends = edges_at.into_iter().filter(|(_, (edges, _))| *edges == 1);
    ends.map(|(node, (_, name))| (name.to_owned(), mesh.points()[node])).collect()
}

/// The sine of an angle below which two directions are one.
const SMOOTH: f64 = 1e-3;

/// Whether a closed curve has no corner where its ends meet.
fn is_smooth(curve: &Spline<2>) -> bool {
    let [a, b] = curve.knots()[0].domain().map(|xi| curve.tangent(&[xi], 0));
    let lengths = a[0].hypot(a[1]) * b[0].hypot(b[1]);
    a[0] * b[0] + a[1] * b[1] > 0.0 && (a[0] * b[1] - a[1] * b[0]).abs() <= SMOOTH * lengths
}
