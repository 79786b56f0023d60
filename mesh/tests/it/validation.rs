//! A broken mesh is refused with the entity, its place and a remedy.

use partita_mesh::mesh::NamedFacets;
use partita_mesh::{CellKind, Cells, Mesh, MeshError};
use partita_testing::with_hint;

/// The unit square in two triangles.
fn square() -> (Vec<[f64; 2]>, Vec<usize>) {
    (vec![[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]], vec![0, 1, 2, 0, 2, 3])
}

fn build(
    points: Vec<[f64; 2]>,
    nodes: Vec<usize>,
    groups: Vec<NamedFacets<2>>,
) -> Result<Mesh<2>, MeshError> {
    Mesh::new(points, Cells::new(CellKind::Triangle3, nodes), groups)
}

fn message(points: Vec<[f64; 2]>, nodes: Vec<usize>, groups: Vec<NamedFacets<2>>) -> String {
    with_hint(&build(points, nodes, groups).expect_err("a broken mesh"))
}

fn message_of_groups(groups: Vec<NamedFacets<2>>) -> String {
    let (points, nodes) = square();
    message(points, nodes, groups)
}

#[test]
fn facets_get_their_owner_and_orientation_from_the_cells() {
    let (points, nodes) = square();
    let mesh = build(points, nodes, vec![("top".into(), vec![[2, 3]]), ("left".into(), vec![[0, 3]])]);
    let mesh = mesh.expect("a proper mesh");
    let top = mesh.group("top").expect("a group").facets[0];
    assert_eq!((top.nodes, top.cell), ([2, 3], 1));
    let left = mesh.group("left").expect("a group").facets[0];
    assert_eq!((left.nodes, left.cell), ([3, 0], 1));
    let rest: Vec<_> = mesh.ungrouped_boundary().iter().map(|facet| facet.nodes).collect();
    assert_eq!(rest, [[1, 2], [0, 1]]);
}

#[test]
fn no_cells() {
    insta::assert_snapshot!(message(vec![], vec![], vec![]), @r"
    the mesh has no cells
    hint: check that the mesh file holds triangles (2D) or tetrahedra (3D)
    ");
}

#[test]
fn quadrilaterals_carry_no_physics() {
    let (points, _) = square();
    let cells = Cells::new(CellKind::Quadrilateral4, vec![0, 1, 2, 3]);
    let error = Mesh::new(points, cells, vec![]).expect_err("no simplices");
    insta::assert_snapshot!(with_hint(&error), @r"
    cells of kind Quadrilateral4 do not make a mesh in 2 dimensions
    hint: only Triangle3 can be solved on there
    ");
}

#[test]
fn coordinate_that_is_not_a_number() {
    let (mut points, nodes) = square();
    points[2][1] = f64::NAN;
    insta::assert_snapshot!(message(points, nodes, vec![]), @r"
    node 2 has a coordinate that is not finite: [1.0, NaN]
    hint: repair the mesh file
    ");
}

#[test]
fn cell_with_a_node_beyond_the_last() {
    let (points, _) = square();
    insta::assert_snapshot!(message(points, vec![0, 1, 2, 0, 2, 4], vec![]), @r"
    cell 1 names node 4, but there are only 4 nodes (counted from 0)
    hint: are the nodes counted from 1?
    ");
}

#[test]
fn inverted_cell() {
    let (points, _) = square();
    insta::assert_snapshot!(message(points, vec![0, 1, 2, 0, 3, 2], vec![]), @r"
    cell 1 at (0.333333, 0.666667) m has measure -5.000e-1 m^2: it is inverted
    hint: swap two of its nodes (triangles run counter-clockwise)
    ");
}

#[test]
fn flat_cell() {
    let (mut points, nodes) = square();
    points[3] = [0.1, 0.1];
    // Round-off leaves the area of three points in a line at 1e-17 or so, of either sign.
    points[2] = [0.3, 0.3];
    insta::assert_snapshot!(message(points, nodes, vec![]), @r"
    cell 1 at (0.133333, 0.133333) m has measure 0.000e0 m^2: it is flat
    hint: merge coinciding nodes or remesh there
    ");
}

#[test]
fn cell_beyond_all_numbers() {
    let far = |corner| build(vec![[0.0, 0.0], [1e200, 1e200], corner], vec![0, 1, 2], vec![]);
    // In one case inf - inf, in the other inf.
    for corner in [[1e199, 1e200], [0.0, 1e200]] {
        let error = far(corner).expect_err("an area that overflows");
        assert!(matches!(error, MeshError::TooLarge { cell: 0, .. }), "{error}");
    }
    insta::assert_snapshot!(with_hint(&far([1e199, 1e200]).expect_err("no number")), @r"
    cell 0 at (3.66667e199, 6.66667e199) m is too large for its measure to be a finite number
    hint: check the coordinates and their unit
    ");
}

#[test]
fn cell_that_names_a_node_twice_is_flat() {
    let (points, _) = square();
    let error = build(points, vec![0, 1, 2, 0, 3, 3], vec![]).expect_err("a node twice");
    assert!(matches!(error, MeshError::NotPositive { cell: 1, .. }), "{error}");
}

#[test]
fn node_without_a_cell() {
    let (mut points, nodes) = square();
    points.push([2.0, 2.0]);
    insta::assert_snapshot!(message(points, nodes, vec![]), @r"
    node 4 at (2, 2) m belongs to no cell
    hint: remove it from the mesh
    ");
}

#[test]
fn cell_given_twice() {
    let (points, mut nodes) = square();
    nodes.extend([0, 1, 2]);
    insta::assert_snapshot!(message(points, nodes, vec![]), @r"
    facet with nodes [0, 2] belongs to cells [0, 1, 2], at most two may share it
    hint: look for overlapping cells or cells given twice
    ");
}

#[test]
fn facet_inside_the_domain() {
    insta::assert_snapshot!(message_of_groups(vec![("cut".into(), vec![[0, 1], [0, 2]])]), @r"
    group `cut`: facet 1 with nodes [0, 2] at (0.5, 0.5) m is not on the boundary
    hint: a group holds only facets that belong to exactly one cell
    ");
}

#[test]
fn facet_in_two_groups() {
    let groups = vec![("wall".into(), vec![[0, 1], [1, 2]]), ("inflow".into(), vec![[2, 1]])];
    insta::assert_snapshot!(message_of_groups(groups), @r"
    facet with nodes [2, 1] at (1, 0.5) m is in group `wall` and in group `inflow`
    hint: each boundary facet belongs to one group at most, once
    ");
}

#[test]
fn facet_twice_in_one_group() {
    insta::assert_snapshot!(message_of_groups(vec![("wall".into(), vec![[0, 1], [1, 0]])]), @r"
    facet with nodes [1, 0] at (0.5, 0) m is in group `wall` and in group `wall`
    hint: each boundary facet belongs to one group at most, once
    ");
}

#[test]
fn facet_with_a_node_beyond_the_last() {
    insta::assert_snapshot!(message_of_groups(vec![("wall".into(), vec![[0, 4]])]), @r"
    facet 0 of group `wall` names node 4, but there are only 4 nodes (counted from 0)
    hint: are the nodes counted from 1?
    ");
}

#[test]
fn group_given_twice() {
    let groups = vec![("wall".into(), vec![[0, 1]]), ("wall".into(), vec![[1, 2]])];
    insta::assert_snapshot!(message_of_groups(groups), @r"
    two boundary groups are called `wall`
    hint: merge them or rename one
    ");
}

#[test]
fn group_without_facets() {
    insta::assert_snapshot!(message_of_groups(vec![("wall".into(), vec![])]), @r"
    boundary group `wall` has no facets
    hint: remove it, or check how the boundary was marked
    ");
}

#[test]
fn moved_points_are_checked_again() {
    let (points, nodes) = square();
    let mesh = build(points.clone(), nodes, vec![]).expect("a proper mesh");
    let mut moved = points;
    moved[2] = [0.8, 0.9];
    assert_eq!(mesh.with_points(moved.clone()).expect("still positive").points(), moved);
    moved[2] = [-0.8, -0.9];
    assert!(matches!(mesh.with_points(moved.clone()), Err(MeshError::NotPositive { cell: 0, .. })));
    moved[2] = [f64::INFINITY, 0.0];
    assert!(matches!(mesh.with_points(moved), Err(MeshError::NotFinite { node: 2, .. })));
}
