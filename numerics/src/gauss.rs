//! Quadrature on lines, triangles and tetrahedra.
//!
//! Points are given in barycentric coordinates and weights sum to one, so that an integral over a cell is
//! its measure times the weighted sum; a line lies on [0, 1]. All weights are positive.

mod line;
mod simplex;

pub use line::line;
pub use simplex::{SimplexPoint, TETRAHEDRON_DEGREE, TRIANGLE_DEGREE, tetrahedron, triangle};
