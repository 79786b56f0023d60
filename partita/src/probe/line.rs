//! A straight line through a mesh of triangles.

use partita_mesh::Mesh;

/// Where the line enters and leaves triangles, and its ends: there a piecewise linear field takes its extremes along
/// the line.
#[derive(Debug, PartialEq)]
pub(super) struct Samples(Vec<Sample>);

/// A point of a triangle: its nodes and their weights.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Sample {
    nodes: [usize; 3],
    weights: [f64; 3],
}

/// Part of a length within which a point counts as its end.
const END: f64 = 1e-9;

impl Samples {
    /// The points where the line between two ends, both in the mesh, crosses edges of the mesh, and the ends.
    pub(super) fn new(mesh: &Mesh<2>, from: [f64; 2], to: [f64; 2]) -> Self {
        let mut samples: Vec<Sample> = [from, to].iter().filter_map(|end| within(mesh, *end)).collect();
        let direction = difference(to, from);
        let along = |p: [f64; 2]| dot(direction, difference(p, from)) / dot(direction, direction);
        for nodes in edges(mesh) {
            let [a, b] = nodes.map(|node| mesh.points()[node]);
            let [at_a, at_b] = [a, b].map(|p| cross(direction, difference(p, from)));
            // Not a number for an edge along the line: its neighbours end in the same nodes.
            let weight = at_a / (at_a - at_b);
            let place = (1.0 - weight) * along(a) + weight * along(b);
            if [weight, place].iter().all(|part| (-END..=1.0 + END).contains(part)) {
                let weight = weight.clamp(0.0, 1.0);
                samples.push(Sample {
                    nodes: [nodes[0], nodes[1], nodes[1]],
                    weights: [1.0 - weight, weight, 0.0],
                });
            }
        }
        Self(samples)
    }

    /// Smallest and largest u, then v, of nodal values `node * 3 + (u, v, p)`.
    pub(super) fn extremes(&self, values: &[f64]) -> [[f64; 2]; 2] {
        [0, 1].map(|c| {
            let at = |Sample { nodes, weights }: &Sample| -> f64 {
                (0..3).map(|a| weights[a] * values[3 * nodes[a] + c]).sum()
            };
            self.0.iter().map(at).fold([f64::NAN; 2], |[low, high], value| [low.min(value), high.max(value)])
        })
    }
}

/// Both nodes of every edge, once.
fn edges(mesh: &Mesh<2>) -> Vec<[usize; 2]> {
    let of_cell = |c: &[usize]| [[c[0], c[1]], [c[1], c[2]], [c[2], c[0]]];
    let mut edges: Vec<[usize; 2]> =
        mesh.cells().iter().flat_map(of_cell).map(|[a, b]| [a.min(b), a.max(b)]).collect();
    edges.sort_unstable();
    edges.dedup();
    edges
}

/// The point in the first triangle that holds it.
fn within(mesh: &Mesh<2>, point: [f64; 2]) -> Option<Sample> {
    mesh.cells().iter().find_map(|cell| {
        let nodes = [cell[0], cell[1], cell[2]];
        let [a, b, c] = nodes.map(|node| mesh.points()[node]);
        let part = |p, q| cross(difference(p, point), difference(q, point));
        let parts = [part(b, c), part(c, a), part(a, b)];
        let whole: f64 = parts.iter().sum();
        let weights = parts.map(|part| part / whole);
        weights.iter().all(|&weight| weight >= -END).then_some(Sample { nodes, weights })
    })
}

fn difference(a: [f64; 2], b: [f64; 2]) -> [f64; 2] {
    [a[0] - b[0], a[1] - b[1]]
}

fn dot(a: [f64; 2], b: [f64; 2]) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

fn cross(a: [f64; 2], b: [f64; 2]) -> f64 {
    a[0] * b[1] - a[1] * b[0]
}

#[cfg(test)]
mod tests {
    use partita_mesh::generate::{Diagonal, RectangleMesh, rectangle};

    use super::*;

    fn square(divisions: usize) -> Mesh<2> {
        rectangle(&RectangleMesh {
            origin: [0.0; 2],
            size: [1.0; 2],
            divisions: [divisions; 2],
            pattern: Diagonal::Crossed,
        })
        .expect("a square")
    }

    fn extremes(mesh: &Mesh<2>, from: [f64; 2], to: [f64; 2]) -> [[f64; 2]; 2] {
        let values: Vec<f64> =
            mesh.points().iter().flat_map(|[x, y]| [3.0 * x - y, (x - 0.5).abs(), 0.0]).collect();
        Samples::new(mesh, from, to).extremes(&values)
    }

    /// The kink of |x - 1/2| lies on edges of the mesh, wherever the line crosses them.
    #[test]
    fn extremes_of_a_piecewise_linear_field_are_exact() {
        let close = |found: [[f64; 2]; 2], expected: [[f64; 2]; 2]| {
            for (found, expected) in found.as_flattened().iter().zip(expected.as_flattened()) {
                assert!((found - expected).abs() < 1e-14, "{found} {expected}");
            }
        };
        let mesh = square(4);
        close(extremes(&mesh, [0.0, 0.3], [1.0, 0.3]), [[-0.3, 2.7], [0.0, 0.5]]);
        close(extremes(&mesh, [1.0, 0.9], [0.0, 0.1]), [[-0.1, 2.1], [0.0, 0.5]]);
        // Along edges of the mesh, and only a part of the way.
        close(extremes(&mesh, [0.5, 0.0], [0.5, 1.0]), [[0.5, 1.5], [0.0, 0.0]]);
        close(extremes(&mesh, [0.25, 0.5], [0.5, 0.5]), [[0.25, 1.0], [0.0, 0.25]]);
    }

    #[test]
    fn a_line_within_a_triangle_has_its_ends() {
        let [u, _] = extremes(&square(1), [0.4, 0.1], [0.6, 0.1]);
        assert!((u[0] - 1.1).abs() < 1e-14 && (u[1] - 1.7).abs() < 1e-14, "{u:?}");
    }
}
