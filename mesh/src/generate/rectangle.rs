//! Triangles in a rectangle.

use super::{check_box, grid_points};
use crate::cell::{CellKind, Cells};
use crate::error::MeshError;
use crate::mesh::{Mesh, NamedFacets};

/// How each square of the grid is cut into triangles.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Diagonal {
    /// Two triangles, the cut runs from the lower left to the upper right corner.
    Right,
    /// Two triangles, the cut runs from the lower right to the upper left corner.
    Left,
    /// Two triangles, right and left in turn (union jack).
    Alternating,
    /// Four triangles round a node at the square's centre: no direction is preferred.
    #[default]
    Crossed,
}

/// A rectangle and its divisions.
#[derive(Debug, Clone, PartialEq)]
pub struct RectangleMesh {
    /// Lower left corner `[m]`.
    pub origin: [f64; 2],
    /// Width and height `[m]`.
    pub size: [f64; 2],
    /// Squares in x and y.
    pub divisions: [usize; 2],
    /// How each square is cut.
    pub pattern: Diagonal,
}

impl Default for RectangleMesh {
    /// The unit square, ten squares along each side.
    fn default() -> Self {
        Self { origin: [0.0; 2], size: [1.0; 2], divisions: [10; 2], pattern: Diagonal::default() }
    }
}

/// Meshes a rectangle; boundary groups `left`, `right`, `bottom`, `top`.
///
/// Grid nodes come first, x fastest; the centre nodes of [`Diagonal::Crossed`] follow, square by square.
///
/// # Errors
/// [`MeshError::InvalidBox`] for a size that is not positive or no divisions.
pub fn rectangle(rectangle: &RectangleMesh) -> Result<Mesh<2>, MeshError> {
    let RectangleMesh { origin, size, divisions, pattern } = rectangle;
    check_box(origin, size, divisions)?;
    let mut points = grid_points(origin, size, divisions);
    if *pattern == Diagonal::Crossed {
        push_centres(&mut points, *divisions);
    }
    Mesh::new(points, triangles(*divisions, *pattern), sides(*divisions))
}

/// Corners of square `(i, j)`, counter-clockwise from the lower left.
fn corners([nx, _]: [usize; 2], i: usize, j: usize) -> [usize; 4] {
    let lower = j * (nx + 1) + i;
    let upper = lower + nx + 1;
    [lower, lower + 1, upper + 1, upper]
}

fn squares([nx, ny]: [usize; 2]) -> impl Iterator<Item = (usize, usize)> {
    (0..ny).flat_map(move |j| (0..nx).map(move |i| (i, j)))
}

fn push_centres(points: &mut Vec<[f64; 2]>, divisions: [usize; 2]) {
    for (i, j) in squares(divisions) {
        let [lower_left, _, upper_right, _] = corners(divisions, i, j).map(|node| points[node]);
        points.push(std::array::from_fn(|k| 0.5 * (lower_left[k] + upper_right[k])));
    }
}

fn triangles(divisions: [usize; 2], pattern: Diagonal) -> Cells {
    let [nx, ny] = divisions;
    let mut nodes = Vec::new();
    for (i, j) in squares(divisions) {
        let [a, b, c, d] = corners(divisions, i, j);
        let right = match pattern {
            Diagonal::Right => true,
            Diagonal::Left => false,
            Diagonal::Alternating => (i + j) % 2 == 0,
            Diagonal::Crossed => {
                let m = (nx + 1) * (ny + 1) + j * nx + i;
                nodes.extend([a, b, m, b, c, m, c, d, m, d, a, m]);
                continue;
            }
        };
        nodes.extend(if right { [a, b, c, a, c, d] } else { [a, b, d, b, c, d] });
    }
    Cells::new(CellKind::Triangle3, nodes)
}

/// The boundary groups of a rectangle, in their order.
pub const RECTANGLE_SIDES: [&str; 4] = ["left", "right", "bottom", "top"];

fn sides([nx, ny]: [usize; 2]) -> Vec<NamedFacets<2>> {
    let node = |i: usize, j: usize| j * (nx + 1) + i;
    let facets = [
        (0..ny).map(|j| [node(0, j + 1), node(0, j)]).collect(),
        (0..ny).map(|j| [node(nx, j), node(nx, j + 1)]).collect(),
        (0..nx).map(|i| [node(i, 0), node(i + 1, 0)]).collect(),
        (0..nx).map(|i| [node(i + 1, ny), node(i, ny)]).collect(),
    ];
    RECTANGLE_SIDES.map(str::to_owned).into_iter().zip(facets).collect()
}
