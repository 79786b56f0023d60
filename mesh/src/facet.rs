//! Facets: the boundary's edges (2D) and triangles (3D), oriented so that the normal points outwards.

use crate::simplex;

/// A boundary facet: `D` nodes, ordered so that the normal points out of the cell that owns it.
///
/// In 2D the domain lies to the left of the edge `nodes[0] -> nodes[1]`; in 3D the triangle runs
/// counter-clockwise seen from outside. Its geometry is computed from the points passed in, so that one
/// facet serves the reference mesh and the moved one.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct Facet<const D: usize> {
    /// The facet's nodes.
    pub nodes: [usize; D],
    /// The cell it belongs to.
    pub cell: usize,
}

impl<const D: usize> Facet<D> {
    /// Outward normal times length (2D, `[m]`) or area (3D, `[m^2]`).
    ///
    /// 2D: `(y_1 - y_0, x_0 - x_1)`; 3D: `(x_1 - x_0) x (x_2 - x_0) / 2`. The area vectors of a closed
    /// surface sum to zero.
    ///
    /// # Panics
    /// In other dimensions than 2 and 3.
    #[must_use]
    pub fn area_vector(&self, points: &[[f64; D]]) -> [f64; D] {
        let vertices = self.nodes.map(|node| points[node]);
        let mut vector = [0.0; D];
        match D {
            2 => {
                let [a, b] = [vertices[0], vertices[1]];
                vector[0] = b[1] - a[1];
                vector[1] = a[0] - b[0];
            }
            3 => {
                let u = simplex::difference(&vertices[1], &vertices[0]);
                let v = simplex::difference(&vertices[2], &vertices[0]);
                for i in 0..3 {
                    let (j, k) = ((i + 1) % 3, (i + 2) % 3);
                    vector[i] = 0.5 * (u[j] * v[k] - u[k] * v[j]);
                }
            }
            _ => panic!("facets have area vectors in 2 and 3 dimensions"),
        }
        vector
    }

    /// Length (2D, `[m]`) or area (3D, `[m^2]`).
    #[must_use]
    pub fn area(&self, points: &[[f64; D]]) -> f64 {
        norm(&self.area_vector(points))
    }

    /// Unit normal that points out of the owning cell.
    #[must_use]
    pub fn normal(&self, points: &[[f64; D]]) -> [f64; D] {
        let vector = self.area_vector(points);
        let area = norm(&vector);
        vector.map(|v| v / area)
    }

    /// Mean of the facet's nodes `[m]`.
    #[must_use]
    pub fn centroid(&self, points: &[[f64; D]]) -> [f64; D] {
        simplex::centroid(&self.nodes.map(|node| points[node]))
    }
}

fn norm<const D: usize>(vector: &[f64; D]) -> f64 {
    vector.iter().map(|v| v * v).sum::<f64>().sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    #[test]
    fn edge_has_its_length_and_the_domain_on_its_left() {
        let points = [[0.0, 0.0], [3.0, 4.0]];
        let edge = Facet { nodes: [0, 1], cell: 0 };
        assert_relative_eq!(edge.area(&points), 5.0);
        assert_relative_eq!(edge.normal(&points)[..], [0.8, -0.6][..]);
        assert_relative_eq!(edge.centroid(&points)[..], [1.5, 2.0][..]);
    }

    #[test]
    fn triangle_in_space_has_its_area_and_a_right_handed_normal() {
        let points = [[0.0, 0.0, 1.0], [2.0, 0.0, 1.0], [0.0, 3.0, 1.0]];
        let face = Facet { nodes: [0, 1, 2], cell: 0 };
        assert_relative_eq!(face.area(&points), 3.0);
        assert_relative_eq!(face.normal(&points)[..], [0.0, 0.0, 1.0][..]);
    }
}
