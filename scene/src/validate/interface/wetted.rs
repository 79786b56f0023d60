//! The wetted parts of a structure, seen from the nodes of the fluid's interface.

use partita_iga::Side;
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
        let (gaps, places) = match (space, parts) {
            (Space::Patch(patch), Boundary::Sides(sides)) => of_patch(patch, sides, nodes)?,
            (Space::Lagrange(mesh), Boundary::Groups(groups)) => of_mesh(mesh, groups, nodes)?,
            _ => return None,
        };
        Some(Self { gaps, ends: space.boundary_ends(parts), places })
    }
}

/// The nearest part of each node with its distance, and points that span the parts.
type Extent = (Vec<(String, f64)>, Vec<[f64; 2]>);

fn of_patch(patch: &Patch<2>, sides: &[Side], nodes: &[[f64; 2]]) -> Option<Extent> {
    let (patch, seams) = (patch.spline(), patch.seams());
    if sides.iter().any(|side| seams.partner(*side).is_some()) {
        return None;
    }
    let rows = partita_iga::transfer::rows(patch, sides, nodes, f64::INFINITY).ok()?;
    let gaps = rows.into_iter().map(|row| (row.side.to_string(), row.distance)).collect();
    Some((gaps, sides.iter().flat_map(|&side| patch.side(side).0.bounding_box()).collect()))
}

fn of_mesh(mesh: &SolidMesh<2>, groups: &[String], nodes: &[[f64; 2]]) -> Option<Extent> {
    let rows = solid::transfer::rows(mesh, groups, nodes, f64::INFINITY).ok()?;
    let gaps = rows.into_iter().map(|row| (row.group, row.distance)).collect();
    let edges = groups.iter().filter_map(|name| mesh.group(name)).flat_map(|group| group.edges.iter());
    Some((gaps, edges.flat_map(|edge| [edge[0], edge[1]]).map(|node| mesh.points()[node]).collect()))
}
