//! Structured meshes of boxes: rectangles of triangles, cuboids of tetrahedra, rectangles for solids.

mod cuboid;
mod rectangle;
mod solid_rectangle;

pub use cuboid::{CuboidMesh, cuboid};
pub use rectangle::{Diagonal, RECTANGLE_SIDES, RectangleMesh, rectangle};
pub use solid_rectangle::{SolidRectangle, solid_rectangle};

use crate::error::MeshError;

fn check_box<const D: usize>(
    origin: &[f64; D],
    size: &[f64; D],
    divisions: &[usize; D],
) -> Result<(), MeshError> {
    let finite = origin.iter().chain(size).all(|x| x.is_finite());
    if finite && size.iter().all(|&s| s > 0.0) && divisions.iter().all(|&n| n > 0) {
        return Ok(());
    }
    Err(MeshError::InvalidBox { origin: origin.to_vec(), size: size.to_vec(), divisions: divisions.to_vec() })
}

/// Points of a regular grid with `divisions + 1` nodes a direction, the first direction fastest.
fn grid_points<const D: usize>(origin: &[f64; D], size: &[f64; D], divisions: &[usize; D]) -> Vec<[f64; D]> {
    let count = divisions.iter().map(|n| n + 1).product();
    let point = |mut node: usize| {
        std::array::from_fn(|i| {
            let index = node % (divisions[i] + 1);
            node /= divisions[i] + 1;
            origin[i] + size[i] * (index as f64 / divisions[i] as f64)
        })
    };
    (0..count).map(point).collect()
}
