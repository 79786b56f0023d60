//! Counts, sizes and boundaries of generated meshes.

use approx::assert_relative_eq;
use partita_mesh::generate::{CuboidMesh, Diagonal, RectangleMesh, cuboid, rectangle};
use partita_mesh::mesh::facet_nodes;
use partita_mesh::{Mesh, MeshError, quality};
use partita_testing::with_hint;
use proptest::prelude::*;

use crate::boxes::{PATTERNS, unit_cube, unit_square};

#[test]
fn crossed_ten_by_ten_has_400_triangles_and_221_nodes() {
    let mesh = unit_square(10, Diagonal::Crossed);
    assert_eq!((mesh.cells().len(), mesh.points().len()), (400, 221));
}

#[test]
fn each_side_carries_its_nodes_and_its_normal() {
    for pattern in PATTERNS {
        let mesh = unit_square(3, pattern);
        let sides =
            [("left", [-1.0, 0.0]), ("right", [1.0, 0.0]), ("bottom", [0.0, -1.0]), ("top", [0.0, 1.0])];
        check_sides(&mesh, &sides, 3, 4);
    }
}

#[test]
fn each_face_carries_its_nodes_and_its_normal() {
    let sides = [
        ("left", [-1.0, 0.0, 0.0]),
        ("right", [1.0, 0.0, 0.0]),
        ("bottom", [0.0, -1.0, 0.0]),
        ("top", [0.0, 1.0, 0.0]),
        ("front", [0.0, 0.0, -1.0]),
        ("back", [0.0, 0.0, 1.0]),
    ];
    check_sides(&unit_cube(3), &sides, 18, 16);
}

fn check_sides<const D: usize>(mesh: &Mesh<D>, sides: &[(&str, [f64; D])], facets: usize, nodes: usize) {
    assert_eq!(mesh.groups().len(), sides.len());
    for (name, normal) in sides {
        let group = mesh.group(name).expect("every side is a group");
        assert_eq!(group.facets.len(), facets, "facets of {name}");
        assert_eq!(mesh.group_nodes(name).map(|nodes| nodes.len()), Some(nodes), "nodes of {name}");
        for facet in &group.facets {
            assert_relative_eq!(facet.normal(mesh.points())[..], normal[..], epsilon = 1e-14);
        }
    }
    assert_eq!(mesh.group("nowhere"), None);
    assert_eq!(mesh.group_nodes("nowhere"), None);
}

#[test]
fn right_and_left_cuts_join_their_corners() {
    // The corners of one square: 0 lower left, 1 lower right, 2 upper left, 3 upper right.
    let shared = |pattern| {
        let mesh = unit_square(1, pattern);
        let in_both = |&node: &usize| mesh.cells().iter().all(|cell| cell.contains(&node));
        (0..4).filter(in_both).collect::<Vec<_>>()
    };
    assert_eq!(shared(Diagonal::Right), [0, 3]);
    assert_eq!(shared(Diagonal::Left), [1, 2]);
}

#[test]
fn alternating_squares_meet_at_their_diagonals() {
    // Union jack: at the centre of 2 x 2 squares all diagonals meet, and no mid-side has one.
    let mesh = unit_square(2, Diagonal::Alternating);
    let uses = |node| mesh.cells().nodes.iter().filter(|&&n| n == node).count();
    assert_eq!(uses(4), 8);
    assert_eq!([1, 3, 5, 7].map(uses), [2; 4]);
}

#[test]
fn boxes_without_extent_are_refused() {
    let flat =
        RectangleMesh { origin: [0.0; 2], size: [1.0, 0.0], divisions: [2, 2], pattern: Diagonal::Left };
    let error = rectangle(&flat).expect_err("no height");
    insta::assert_snapshot!(with_hint(&error), @r"
    a box of size [1.0, 0.0] m in [2, 2] divisions from [0.0, 0.0] m cannot be meshed
    hint: give finite coordinates, positive sizes and at least one division a direction
    ");
    let undivided = CuboidMesh { origin: [0.0; 3], size: [1.0; 3], divisions: [2, 0, 2] };
    assert!(matches!(cuboid(&undivided), Err(MeshError::InvalidBox { .. })));
    let endless = CuboidMesh { origin: [0.0; 3], size: [1.0, f64::INFINITY, 1.0], divisions: [1; 3] };
    assert!(matches!(cuboid(&endless), Err(MeshError::InvalidBox { .. })));
}

proptest! {
    #[test]
    fn rectangles_are_covered_once(
        origin in prop::array::uniform2(-5.0..5.0), size in prop::array::uniform2(0.1..3.0),
        divisions in prop::array::uniform2(1_usize..6), pattern in prop::sample::select(&PATTERNS),
    ) {
        let mesh = rectangle(&RectangleMesh { origin, size, divisions, pattern }).expect("a proper box");
        let [nx, ny] = divisions;
        let squares = nx * ny;
        let (cells, centres) = if pattern == Diagonal::Crossed { (4, squares) } else { (2, 0) };
        prop_assert_eq!(mesh.cells().len(), cells * squares);
        prop_assert_eq!(mesh.points().len(), (nx + 1) * (ny + 1) + centres);
        prop_assert_eq!(mesh.topology().boundary().len(), 2 * (nx + ny));
        check_box(&mesh, &origin, &size);
    }

    #[test]
    fn cuboids_are_covered_once(
        origin in prop::array::uniform3(-5.0..5.0), size in prop::array::uniform3(0.1..3.0),
        divisions in prop::array::uniform3(1_usize..5),
    ) {
        let mesh = cuboid(&CuboidMesh { origin, size, divisions }).expect("a proper box");
        let [nx, ny, nz] = divisions;
        prop_assert_eq!(mesh.cells().len(), 6 * nx * ny * nz);
        prop_assert_eq!(mesh.points().len(), (nx + 1) * (ny + 1) * (nz + 1));
        prop_assert_eq!(mesh.topology().boundary().len(), 4 * (nx * ny + ny * nz + nz * nx));
        check_box(&mesh, &origin, &size);
    }
}

fn check_box<const D: usize>(mesh: &Mesh<D>, origin: &[f64; D], size: &[f64; D]) {
    let volume: f64 = size.iter().product();
    let total: f64 = quality::measures(mesh.points(), mesh.cells()).iter().sum();
    assert_relative_eq!(total, volume, max_relative = 1e-12);
    check_groups(mesh);
    check_divergence_theorem(mesh, volume);
    check_neighbours(mesh);
    for node in facet_nodes(mesh.topology().boundary()) {
        let on_side = |c: usize| {
            let x = mesh.points()[node][c];
            (x - origin[c]).abs() < 1e-12 || (x - origin[c] - size[c]).abs() < 1e-12
        };
        assert!((0..D).any(on_side), "boundary node {node} lies inside");
    }
}

/// Every boundary facet is in exactly one group.
fn check_groups<const D: usize>(mesh: &Mesh<D>) {
    let mut grouped: Vec<_> = mesh.groups().iter().flat_map(|group| &group.facets).collect();
    let mut boundary: Vec<_> = mesh.topology().boundary().iter().collect();
    grouped.sort_unstable_by_key(|facet| (facet.nodes, facet.cell));
    boundary.sort_unstable_by_key(|facet| (facet.nodes, facet.cell));
    assert_eq!(grouped, boundary);
    assert!(mesh.ungrouped_boundary().is_empty());
}

/// `sum A = 0` and `sum x . A = D V`: the surface is closed and all normals point outwards.
fn check_divergence_theorem<const D: usize>(mesh: &Mesh<D>, volume: f64) {
    let (mut closure, mut flux, mut area) = ([0.0; D], 0.0, 0.0);
    for facet in mesh.topology().boundary() {
        let (vector, centre) = (facet.area_vector(mesh.points()), facet.centroid(mesh.points()));
        area += facet.area(mesh.points());
        for c in 0..D {
            closure[c] += vector[c];
            flux += centre[c] * vector[c];
        }
    }
    for component in closure {
        assert!(component.abs() < 1e-12 * area, "the surface is not closed: {closure:?}");
    }
    assert_relative_eq!(flux, D as f64 * volume, max_relative = 1e-10);
}

/// Neighbours know each other and share `D` nodes.
fn check_neighbours<const D: usize>(mesh: &Mesh<D>) {
    for cell in 0..mesh.cells().len() {
        for (local, neighbour) in mesh.topology().neighbours(cell).iter().enumerate() {
            let Some(neighbour) = *neighbour else { continue };
            assert!(mesh.topology().neighbours(neighbour).contains(&Some(cell)));
            let (nodes, others) = (mesh.cells().cell(cell), mesh.cells().cell(neighbour));
            assert!(!others.contains(&nodes[local]), "the opposite node is shared");
            assert_eq!(nodes.iter().filter(|&node| others.contains(node)).count(), D);
        }
    }
}
