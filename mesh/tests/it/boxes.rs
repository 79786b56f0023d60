//! Meshes and displacements that several tests share.

use partita_mesh::Mesh;
use partita_mesh::generate::{CuboidMesh, Diagonal, RectangleMesh, cuboid, rectangle};
use partita_mesh::mesh::facet_nodes;
use partita_testing::Noise;

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
    let mut random = Noise::new(1);
    let mut points = mesh.points().to_vec();
    for (node, point) in points.iter_mut().enumerate() {
        if boundary.binary_search(&node).is_err() {
            *point = point.map(|x| x + amplitude * random.number());
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
