//! Tetrahedra in a cuboid.

use super::{check_box, grid_points};
use crate::cell::{CellKind, Cells};
use crate::error::MeshError;
use crate::mesh::{Mesh, NamedFacets};
use crate::topology::boundary_facets;

/// A cuboid and its divisions.
#[derive(Debug, Clone, PartialEq)]
pub struct CuboidMesh {
    /// Corner with the smallest coordinates `[m]`.
    pub origin: [f64; 3],
    /// Edge lengths `[m]`.
    pub size: [f64; 3],
    /// Cuboids in x, y and z; each becomes six tetrahedra.
    pub divisions: [usize; 3],
}

/// The axes in the six orders in which a walk from the lowest to the highest corner may take them, and
/// whether the tetrahedron along that walk is right-handed (an even permutation).
const WALKS: [([usize; 3], bool); 6] = [
    ([0, 1, 2], true),
    ([1, 2, 0], true),
    ([2, 0, 1], true),
    ([0, 2, 1], false),
    ([1, 0, 2], false),
    ([2, 1, 0], false),
];

/// Group of a face by the axis it is normal to: smallest coordinate, largest coordinate.
const SIDES: [[&str; 2]; 3] = [["left", "right"], ["bottom", "top"], ["front", "back"]];

/// Meshes a cuboid; boundary groups `left`, `right` (x), `bottom`, `top` (y), `front`, `back` (z).
///
/// Each small cuboid is cut into the six tetrahedra round its main diagonal (Kuhn's triangulation), the
/// same way everywhere, so that neighbours fit. Nodes are numbered with x fastest, then y, then z.
///
/// # Errors
/// [`MeshError::InvalidBox`] for a size that is not positive or no divisions.
pub fn cuboid(cuboid: &CuboidMesh) -> Result<Mesh<3>, MeshError> {
    let CuboidMesh { origin, size, divisions } = cuboid;
    check_box(origin, size, divisions)?;
    let cells = tetrahedra(*divisions);
    let groups = sides(*divisions, &cells)?;
    Mesh::new(grid_points(origin, size, divisions), cells, groups)
}

/// Distance in node numbers to the next node along each axis.
fn strides([nx, ny, _]: [usize; 3]) -> [usize; 3] {
    [1, nx + 1, (nx + 1) * (ny + 1)]
}

fn tetrahedra(divisions: [usize; 3]) -> Cells {
    let strides = strides(divisions);
    let [nx, ny, nz] = divisions;
    let mut nodes = Vec::with_capacity(24 * nx * ny * nz);
    for k in 0..nz {
        for j in 0..ny {
            for i in 0..nx {
                let lowest = i * strides[0] + j * strides[1] + k * strides[2];
                for (walk, right_handed) in WALKS {
                    let a = lowest + strides[walk[0]];
                    let b = a + strides[walk[1]];
                    let highest = b + strides[walk[2]];
                    let [a, b] = if right_handed { [a, b] } else { [b, a] };
                    nodes.extend([lowest, a, b, highest]);
                }
            }
        }
    }
    Cells::new(CellKind::Tetrahedron4, nodes)
}

/// Sorts the boundary facets by the coordinate index all their nodes share.
fn sides(divisions: [usize; 3], cells: &Cells) -> Result<Vec<NamedFacets<3>>, MeshError> {
    let strides = strides(divisions);
    let index = |node: usize, axis: usize| node / strides[axis] % (divisions[axis] + 1);
    let boundary = boundary_facets::<3>(cells)?;
    let mut groups = Vec::with_capacity(6);
    for axis in 0..3 {
        for (name, end) in SIDES[axis].into_iter().zip([0, divisions[axis]]) {
            let on_side = |nodes: &[usize; 3]| nodes.iter().all(|&node| index(node, axis) == end);
            let facets = boundary.iter().map(|facet| facet.nodes).filter(on_side).collect();
            groups.push((name.into(), facets));
        }
    }
    Ok(groups)
}
