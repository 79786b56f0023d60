//! The wetted parts of a structure, seen from the nodes of the fluid's interface.

use std::collections::BTreeMap;

use partita_iga::{Side, Spline};
use partita_mesh::{SolidMesh, solid};
use partita_structure::{Boundary, Patch, Space};

/// What is known of the wetted parts, sides of a patch or groups of a mesh.
pub(super) struct Wetted {
    /// For each node the nearest part and the distance from it \[m\].
    pub(super) gaps: Vec<(String, f64)>,
    /// Ends of the parts \[m\].
    pub(super) ends: Vec<(String, [f64; 2])>,
    /// Points that span the parts \[m\].
    pub(super) places: Vec<[f64; 2]>,
}

impl Wetted {
    /// `None` where a part is not known, which is told elsewhere.
    pub(super) fn new(space: &Space<2>, parts: &Boundary, nodes: &[[f64; 2]]) -> Option<Self> {
        match (space, parts) {
            (Space::Patch(patch), Boundary::Sides(sides)) => Self::of_patch(patch, sides, nodes),
            (Space::Lagrange(mesh), Boundary::Groups(groups)) => Self::of_mesh(mesh, groups, nodes),
            _ => None,
        }
    }

    fn of_patch(patch: &Patch<2>, sides: &[Side], nodes: &[[f64; 2]]) -> Option<Self> {
        let (patch, seams) = (patch.spline(), patch.seams());
        if sides.iter().any(|side| seams.partner(*side).is_some()) {
            return None;
        }
        let rows = partita_iga::transfer::rows(patch, sides, nodes, f64::INFINITY).ok()?;
        let curves: Vec<_> = sides.iter().map(|&side| (side.to_string(), patch.side(side).0)).collect();
        let open = sides
            .iter()
            .zip(&curves)
            .filter(|(side, (_, curve))| !(seams.is_loop(**side) && is_smooth(curve)));
        let ends = open
            .map(|(_, curve)| curve)
            .flat_map(|(name, curve)| curve.knots()[0].domain().map(|xi| (name.clone(), curve.point(&[xi]))));
        Some(Self {
            gaps: rows.into_iter().map(|row| (row.side.to_string(), row.distance)).collect(),
            ends: ends.collect(),
            places: curves.iter().flat_map(|(_, curve)| curve.bounding_box()).collect(),
        })
    }

    /// A chain of edges ends in a node that belongs to one edge alone.
    fn of_mesh(mesh: &SolidMesh<2>, groups: &[String], nodes: &[[f64; 2]]) -> Option<Self> {
        let rows = solid::transfer::rows(mesh, groups, nodes, f64::INFINITY).ok()?;
        let mut edges_at: BTreeMap<usize, (usize, &str)> = BTreeMap::new();
        for group in groups.iter().filter_map(|name| mesh.group(name)) {
            for node in group.edges.iter().flat_map(|edge| [edge[0], edge[1]]) {
                edges_at.entry(node).or_insert((0, group.name.as_str())).0 += 1;
            }
        }
        let place = |node: usize| mesh.points()[node];
        let ends = edges_at.iter().filter(|(_, (edges, _))| *edges == 1);
        Some(Self {
            gaps: rows.into_iter().map(|row| (row.group, row.distance)).collect(),
            ends: ends.map(|(&node, (_, name))| ((*name).to_owned(), place(node))).collect(),
            places: edges_at.keys().map(|&node| place(node)).collect(),
        })
    }
}

/// The sine of an angle below which two directions are one.
const SMOOTH: f64 = 1e-3;

/// Whether a closed curve has no corner where its ends meet: the fluid needs no node there.
fn is_smooth(curve: &Spline<2>) -> bool {
    let [a, b] = curve.knots()[0].domain().map(|xi| curve.tangent(&[xi], 0));
    let lengths = a[0].hypot(a[1]) * b[0].hypot(b[1]);
    a[0] * b[0] + a[1] * b[1] > 0.0 && (a[0] * b[1] - a[1] * b[0]).abs() <= SMOOTH * lengths
}
