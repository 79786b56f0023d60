//! Which displacements of the mesh are given: the whole boundary, but for the directions in which it slides.

use super::MotionError;
use crate::mesh::Mesh;

/// Smallest component of a unit normal along an axis that counts as aligned with it.
const ALIGNED: f64 = 1.0 - 1e-9;

/// Flags `node * D + c` of the displacements that the boundary prescribes.
///
/// Nodes on the boundary are held in all directions, nodes on the groups in `slide` only in the direction of
/// the normal. A node at the corner of several groups obeys all of them, so one between a sliding wall and
/// a moving interface follows the interface.
///
/// ```
/// use partita_mesh::generate::{Diagonal, RectangleMesh, rectangle};
/// use partita_mesh::motion::prescribed_dofs;
///
/// let mesh = rectangle(&RectangleMesh {
///     origin: [0.0, 0.0],
///     size: [1.0, 1.0],
///     divisions: [1, 2],
///     pattern: Diagonal::Right,
/// })?;
/// let prescribed = prescribed_dofs(&mesh, &["left"])?;
/// // Node 2 is the middle of the left side: held in x, free to slide in y.
/// assert_eq!(prescribed[4..6], [true, false]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// [`MotionError::UnknownGroup`] for a name that is no group, [`MotionError::SlideNotAligned`] for a group
/// with a facet that is not normal to an axis.
pub fn prescribed_dofs<const D: usize>(mesh: &Mesh<D>, slide: &[&str]) -> Result<Vec<bool>, MotionError> {
    let mut prescribed = vec![false; D * mesh.points().len()];
    for &name in slide {
        let group = mesh.group(name).ok_or_else(|| unknown_group(mesh, name))?;
        for facet in &group.facets {
            let normal = facet.normal(mesh.points());
            let Some(axis) = normal.iter().position(|n| n.abs() >= ALIGNED) else {
                let place = facet.centroid(mesh.points()).into();
                return Err(MotionError::SlideNotAligned { name: name.into(), place });
            };
            for node in facet.nodes {
                prescribed[node * D + axis] = true;
            }
        }
    }
    let held = mesh.groups().iter().filter(|group| !slide.contains(&group.name.as_str()));
    let held = held.flat_map(|group| group.facets.iter().copied());
    for facet in held.chain(mesh.ungrouped_boundary()) {
        for node in facet.nodes {
            prescribed[node * D..(node + 1) * D].fill(true);
        }
    }
    Ok(prescribed)
}

fn unknown_group<const D: usize>(mesh: &Mesh<D>, name: &str) -> MotionError {
    let names: Vec<&str> = mesh.groups().iter().map(|group| group.name.as_str()).collect();
    MotionError::UnknownGroup { name: name.into(), known: names.join(", ") }
}
