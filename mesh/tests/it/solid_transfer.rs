//! Force, moment and work pass from points to the boundary of a solid mesh and back unchanged.

use partita_mesh::SolidMesh;
use partita_mesh::solid::reference::line_shape;
use partita_mesh::solid::transfer::{Row, TransferError, add_to_nodes, rows, to_points};
use partita_testing::with_hint;
use proptest::prelude::*;

use crate::solid::{KINDS, bent_square, plates};

/// Points at the given parameters of each edge of some groups.
fn on_edges(mesh: &SolidMesh<2>, groups: &[&str], parameters: &[f64]) -> Vec<[f64; 2]> {
    let mut points = Vec::new();
    for name in groups {
        let edges = &mesh.group(name).expect("a group").edges;
        for edge in edges {
            for &s in parameters {
                let mut point = [0.0; 2];
                for (&node, [value, _]) in edge.iter().zip(line_shape(edges.kind, s)) {
                    (0..2).for_each(|i| point[i] += value * mesh.points()[node][i]);
                }
                points.push(point);
            }
        }
    }
    points
}

fn total(vectors: &[[f64; 2]]) -> [f64; 2] {
    vectors.iter().fold([0.0; 2], |sum, v| [sum[0] + v[0], sum[1] + v[1]])
}

fn moment(places: &[[f64; 2]], forces: &[[f64; 2]]) -> f64 {
    places.iter().zip(forces).map(|([x, y], [u, v])| x * v - y * u).sum()
}

fn work(a: &[[f64; 2]], b: &[[f64; 2]]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a[0] * b[0] + a[1] * b[1]).sum()
}

fn noise(count: usize, seed: f64) -> Vec<[f64; 2]> {
    (0..count).map(|i| [1.0, 2.0].map(|c| (12.9898 * (i as f64 + c) + 78.233 * (seed + c)).sin())).collect()
}

#[test]
fn transfer_conserves_force_moment_and_virtual_work() {
    let meshes = plates().into_iter().chain(KINDS.map(|kind| bent_square(kind, 3)));
    for (number, mesh) in meshes.enumerate() {
        let groups: Vec<&str> = mesh.groups().iter().map(|group| group.name.as_str()).collect();
        let points = on_edges(&mesh, &groups, &[-0.9, -0.31, 0.0, 0.6]);
        let rows = rows(&mesh, &groups, &points, 1e-12).expect("the points lie on the boundary");
        let forces = noise(points.len(), number as f64);
        let mut at_nodes = vec![[0.0; 2]; mesh.points().len()];
        add_to_nodes(&rows, &forces, &mut at_nodes);
        let (given, taken) = (total(&forces), total(&at_nodes));
        let scale = points.len() as f64;
        assert!((0..2).all(|i| (given[i] - taken[i]).abs() < 1e-13 * scale), "{given:?} {taken:?}");
        let moments = [moment(&points, &forces), moment(mesh.points(), &at_nodes)];
        assert!((moments[0] - moments[1]).abs() < 1e-13 * scale, "{moments:?}");

        let displacement = noise(mesh.points().len(), 0.5);
        let mut at_points = vec![[0.0; 2]; points.len()];
        to_points(&rows, &displacement, &mut at_points);
        let works = [work(&forces, &at_points), work(&at_nodes, &displacement)];
        assert!((works[0] - works[1]).abs() < 1e-13 * scale, "{works:?}");
    }
}

#[test]
fn a_node_hangs_on_itself_alone_and_a_point_between_nodes_on_its_edge() {
    for mesh in KINDS.map(|kind| bent_square(kind, 2)) {
        let nodes = mesh.group_nodes("top").expect("a side");
        let places: Vec<[f64; 2]> = nodes.iter().map(|&node| mesh.points()[node]).collect();
        for (row, node) in rows(&mesh, &["top"], &places, 1e-12).expect("nodes").iter().zip(nodes) {
            assert_eq!(row.weights, [(node, 1.0)]);
            assert!(row.distance < 1e-15);
        }
        let between = on_edges(&mesh, &["right"], &[0.37]);
        let edges = &mesh.group("right").expect("a side").edges;
        for (row, edge) in rows(&mesh, &["top", "right"], &between, 1e-12).expect("points").iter().zip(edges)
        {
            assert_eq!(row.group, "right");
            assert!(row.weights.iter().map(|(node, _)| node).eq(edge), "{row:?}");
            for ((_, weight), [value, _]) in row.weights.iter().zip(line_shape(edges.kind, 0.37)) {
                assert!((weight - value).abs() < 1e-12);
            }
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(40))]

    /// No sample of the boundary is closer than the projection.
    #[test]
    fn the_projection_is_the_closest_point(x in -1.0..2.0, y in -1.0..2.0, kind in 0_usize..5) {
        let mesh = bent_square(KINDS[kind], 2);
        let point = [x, y];
        let groups = ["left", "right", "bottom", "top"];
        let [row]: [Row; 1] = rows(&mesh, &groups, &[point], 10.0).unwrap().try_into().unwrap();
        let parameters: Vec<f64> = (0..=400).map(|k| f64::from(k) / 200.0 - 1.0).collect();
        let distance = |[u, v]: [f64; 2]| (u - x).hypot(v - y);
        let sampled = on_edges(&mesh, &groups, &parameters).into_iter().map(distance).fold(f64::INFINITY, f64::min);
        prop_assert!(row.distance <= sampled + 1e-14 && row.distance > sampled - 1e-3);
        let mut foot = [[0.0; 2]];
        to_points(std::slice::from_ref(&row), mesh.points(), &mut foot);
        prop_assert!((distance(foot[0]) - row.distance).abs() < 1e-14);
    }
}

#[test]
fn points_and_groups_that_do_not_fit_are_refused_by_name() {
    let mesh = bent_square(KINDS[1], 2);
    let error = rows(&mesh, &["top"], &[[0.5, 0.5], [f64::NAN, 0.0]], 1.0).expect_err("no number");
    assert!(matches!(error, TransferError::NotFinite { index: 1, .. }), "{error}");
    let error = rows::<2>(&mesh, &[] as &[&str], &[[0.5, 0.5]], 1.0).expect_err("no group");
    assert_eq!(error, TransferError::NoGroups);
    let error = rows(&mesh, &["lid"], &[[0.5, 0.5]], 1.0).expect_err("no such group");
    insta::assert_snapshot!(with_hint(&error), @r"
    the mesh has no boundary group `lid`
    hint: it has `left`, `right`, `bottom`, `top`
    ");
    let error = rows(&mesh, &["left", "bottom"], &[[0.0, 0.0], [-0.25, 0.5]], 1e-6).expect_err("too far");
    insta::assert_snapshot!(with_hint(&error), @r"
    point 1 at (-0.25, 0.5) m lies 2.5e-1 m away from the nearest boundary group, `left`, which is more than the tolerance of 1e-6 m
    hint: check that points and mesh show the same shape, in the same place and unit; if they do, raise the tolerance above that distance
    ");
}
