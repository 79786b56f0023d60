//! Meshes and displacements that several tests share.

use partita_mesh::Mesh;
use partita_mesh::generate::{CuboidMesh, Diagonal, RectangleMesh, cuboid, rectangle};
use partita_mesh::mesh::facet_nodes;

pub(crate) const PATTERNS: [Diagonal; 4] =
    [Diagonal::Right, Diagonal::Left, Diagonal::Alternating, Diagonal::Crossed];

pub(crate) fn unit_square(divisions: usize, pattern: Diagonal) -> Mesh<2> {
    let square = RectangleMesh { origin: [0.0; 2], size: [1.0; 2], divisions: [divisions; 2], pattern };
    rectangle(&square).expect("a square can be meshed")
}

pub(crate) fn unit_cube(divisions: usize) -> Mesh<3> {
    let cube = CuboidMesh { origin: [0.0; 3], size: [1.0; 3], divisions: [divisions; 3] };
    cuboid(&cube).expect("a cube can be meshed")
}

/// The mesh with its inner nodes moved at random by up to `amplitude` in each direction.
pub(crate) fn shaken<const D: usize>(mesh: &Mesh<D>, amplitude: f64) -> Mesh<D> {
    let boundary = facet_nodes(mesh.topology().boundary());
    let mut random = Random(1);
    let mut points = mesh.points().to_vec();
    for (node, point) in points.iter_mut().enumerate() {
        if boundary.binary_search(&node).is_err() {
            *point = point.map(|x| x + amplitude * random.next());
        }
    }
    mesh.with_points(points).expect("a small random motion inverts nothing")
}

/// Displacement `node * D + c` of every node by a function of its place.
pub(crate) fn field<const D: usize>(mesh: &Mesh<D>, function: impl Fn(&[f64; D]) -> [f64; D]) -> Vec<f64> {
    mesh.points().iter().flat_map(function).collect()
}

pub(crate) fn largest_difference(a: &[f64], b: &[f64]) -> f64 {
    assert_eq!(a.len(), b.len());
    a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

/// Numbers in [-1, 1), the same ones in every run (Knuth's linear congruential generator).
struct Random(u64);

impl Random {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }
}
