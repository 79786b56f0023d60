//! Elements side by side against elements one by one.

use partita_mesh::Mesh;
use partita_mesh::generate::{CuboidMesh, Diagonal, RectangleMesh, cuboid, rectangle};

use partita_testing::Noise;

use super::*;
use crate::settings::Tangent;

fn bits(values: &[f64]) -> Vec<u64> {
    values.iter().map(|value| value.to_bits()).collect()
}

/// Terms, tangent and sizes of the first `count` elements of a mesh, with the widest registers and without.
fn is_the_same_to_the_bit<const D: usize, const N: usize>(mesh: &Mesh<D>, count: usize, tangent: Tangent) {
    let nodes = mesh.points().len();
    let cells = Cells::new(mesh.cells().kind, mesh.cells().nodes[..count * N].to_vec());
    let flow = Flow {
        density: 1.3,
        viscosity: 0.07,
        inverse_constant: 36.0,
        grad_div: 0.9,
        rate: 12.5,
        four_over_dt_squared: 400.0,
        tangent,
    };
    let frames = Frames::new(&[], nodes);
    let (values, vectors) =
        (Noise::new(1).numbers(nodes * (D + 1)), [2, 3, 4].map(|seed| Noise::new(seed).numbers(nodes * D)));
    let iterate = Iterate {
        convects: true,
        flow: &flow,
        cells: &cells,
        points: mesh.points(),
        values: &values,
        mesh_velocity: &vectors[0],
        history: &vectors[1],
        body_force: &vectors[2],
        natural: &[],
        frames: &frames,
    };
    let prescribed: Vec<bool> = (0..nodes * (D + 1)).map(|dof| dof % 7 == 0).collect();
    let [mut side_by_side, mut one_by_one] = [0, 1].map(|_| Assembly::new(&cells, &prescribed));
    let batches = |assembly| Batches::<D, N> { assembly, iterate: &iterate, with_tangent: true };
    let sizes = [on_lanes(batches(&mut side_by_side)), batches(&mut one_by_one).run(0.0)];
    assert_eq!(format!("{:?}", sizes[0]), format!("{:?}", sizes[1]), "sizes of {count} elements");
    assert!(side_by_side.tangent.iter().any(|entry| *entry != 0.0));
    assert_eq!(bits(&side_by_side.tangent), bits(&one_by_one.tangent), "tangent of {count} elements");
    let terms = |assembly: &Assembly| bits(assembly.terms.as_flattened());
    assert_eq!(terms(&side_by_side), terms(&one_by_one), "terms of {count} elements");
}

const TANGENTS: [Tangent; 3] = [Tangent::Full, Tangent::FrozenTau, Tangent::Picard];

#[test]
fn triangles_have_the_same_bits_on_every_number_of_lanes() {
    let (origin, size) = ([0.1, -0.3], [1.1, 0.7]);
    let mesh =
        rectangle(&RectangleMesh { origin, size, divisions: [3, 5], pattern: Diagonal::Crossed }).unwrap();
    for count in [1, 2, 3, 4, 5, 7, 8, 9, 60] {
        for tangent in TANGENTS {
            is_the_same_to_the_bit::<2, 3>(&mesh, count, tangent);
        }
    }
}

#[test]
fn tetrahedra_have_the_same_bits_on_every_number_of_lanes() {
    let (origin, size) = ([0.1, -0.3, 0.2], [1.1, 0.7, 0.9]);
    let mesh = cuboid(&CuboidMesh { origin, size, divisions: [2, 1, 3] }).unwrap();
    for count in [1, 2, 3, 4, 5, 7, 8, 9, 36] {
        for tangent in TANGENTS {
            is_the_same_to_the_bit::<3, 4>(&mesh, count, tangent);
        }
    }
}
