//! A broken mesh of a solid is refused with the entity, its place and a remedy.

use partita_mesh::gmsh::{ElementBlock, ElementKind, GmshFile};
use partita_mesh::solid::NamedEdges;
use partita_mesh::{CellKind, Cells, MeshError, SolidMesh};
use partita_testing::with_hint;

use crate::gmsh::{PLATE_4_TEXT, PRISM_4_TEXT, SECOND_ORDER, parse};
use crate::solid::QUADRILATERALS_4;

/// Two squares of 8 nodes side by side.
fn squares() -> (Vec<[f64; 2]>, Vec<usize>) {
    let points = vec![
        [0.0, 0.0],
        [0.5, 0.0],
        [1.0, 0.0],
        [1.5, 0.0],
        [2.0, 0.0],
        [0.0, 0.5],
        [1.0, 0.5],
        [2.0, 0.5],
        [0.0, 1.0],
        [0.5, 1.0],
        [1.0, 1.0],
        [1.5, 1.0],
        [2.0, 1.0],
    ];
    (points, vec![0, 2, 10, 8, 1, 6, 9, 5, 2, 4, 12, 10, 3, 7, 11, 6])
}

fn edges(name: &str, nodes: &[usize]) -> NamedEdges {
    (name.to_owned(), Cells::new(CellKind::Line3, nodes.to_vec()))
}

fn message(points: Vec<[f64; 2]>, nodes: Vec<usize>, groups: Vec<NamedEdges>) -> String {
    let cells = Cells::new(CellKind::Quadrilateral8, nodes);
    with_hint(&SolidMesh::new(points, cells, groups).expect_err("a broken mesh"))
}

fn message_of_groups(groups: Vec<NamedEdges>) -> String {
    let (points, nodes) = squares();
    message(points, nodes, groups)
}

#[test]
fn whole_squares_are_fine_and_edges_take_their_direction_from_the_cells() {
    let (points, nodes) = squares();
    let cells = Cells::new(CellKind::Quadrilateral8, nodes);
    let mesh = SolidMesh::new(points, cells, vec![edges("top", &[8, 10, 9, 10, 12, 11])]).expect("a mesh");
    assert_eq!(mesh.groups()[0].edges.nodes, [10, 8, 9, 12, 10, 11]);
    assert_eq!(mesh.boundary_nodes(), (0..13).filter(|&node| node != 6).collect::<Vec<_>>());
}

#[test]
fn a_node_of_an_edge_that_is_far_from_its_middle_folds_the_cell() {
    let (mut points, nodes) = squares();
    points[1] = [0.95, 0.0];
    insta::assert_snapshot!(message(points, nodes, vec![]), @r"
    cell 0 is folded near (1.04701, 0.112702) m: the determinant of its map is -5.928e-2 m^2
    hint: corners run counter-clockwise, and the points on its edges stay near the middle; remesh there, or straighten the mesh
    ");
}

#[test]
fn cells_that_are_turned_over_are_folded() {
    let (points, _) = squares();
    let cells = Cells::new(CellKind::Triangle3, vec![0, 5, 1]);
    let message = SolidMesh::new(points[..6].to_vec(), cells, vec![]).expect_err("a node without a cell");
    insta::assert_snapshot!(with_hint(&message), @r"
    node 2 at (1, 0) m belongs to no cell
    hint: remove it from the mesh
    ");
    let cells = Cells::new(CellKind::Triangle3, vec![0, 2, 1]);
    let message =
        SolidMesh::new(vec![[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]], cells, vec![]).expect_err("clockwise");
    insta::assert_snapshot!(with_hint(&message), @r"
    cell 0 is folded near (0.166667, 0.166667) m: the determinant of its map is -1.000e0 m^2
    hint: corners run counter-clockwise, and the points on its edges stay near the middle; remesh there, or straighten the mesh
    ");
}

#[test]
fn cells_beyond_all_numbers() {
    // In one case the determinant is inf - inf, in the other inf.
    for corner in [[1e199, 1e200], [0.0, 1e200]] {
        let cells = Cells::new(CellKind::Triangle3, vec![0, 1, 2]);
        let error = SolidMesh::new(vec![[0.0, 0.0], [1e200, 1e200], corner], cells, vec![]);
        assert!(matches!(error, Err(MeshError::TooLarge { cell: 0, .. })), "{error:?}");
    }
}

#[test]
fn no_cells_and_cells_of_other_kinds() {
    let empty = SolidMesh::<2>::new(vec![], Cells::new(CellKind::Triangle6, vec![]), vec![]);
    assert!(empty.expect_err("no cells").to_string().starts_with("the mesh has no cells"));
    let line = SolidMesh::new(vec![[0.0; 2], [1.0; 2]], Cells::new(CellKind::Line2, vec![0, 1]), vec![]);
    insta::assert_snapshot!(with_hint(&line.expect_err("a line")), @r"
    cells of kind Line2 do not make a solid in 2 dimensions
    hint: plane solids consist of triangles or quadrilaterals of degree 1 or 2; solids in space need a patch
    ");
    let corners = vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let solid = SolidMesh::new(corners, Cells::new(CellKind::Tetrahedron4, vec![0, 1, 2, 3]), vec![]);
    assert!(solid.expect_err("in space").to_string().contains("in 3 dimensions"));
}

#[test]
fn groups_hold_edges_of_the_boundary_once() {
    insta::assert_snapshot!(message_of_groups(vec![edges("cut", &[2, 10, 6])]), @r"
    group `cut`: facet 0 with nodes [2, 10, 6] at (1, 0.5) m is not on the boundary
    hint: a group holds only facets that belong to exactly one cell
    ");
    // The right ends, but the node of another edge between them.
    insta::assert_snapshot!(message_of_groups(vec![edges("top", &[8, 10, 11])]), @r"
    group `top`: facet 0 with nodes [8, 10, 11] at (0.5, 1) m is not on the boundary
    hint: a group holds only facets that belong to exactly one cell
    ");
    let twice = vec![edges("top", &[8, 10, 9]), edges("lid", &[10, 8, 9])];
    insta::assert_snapshot!(message_of_groups(twice), @r"
    facet with nodes [10, 8, 9] at (0.5, 1) m is in group `top` and in group `lid`
    hint: each boundary facet belongs to one group at most, once
    ");
    insta::assert_snapshot!(message_of_groups(vec![edges("top", &[8, 10, 13])]), @r"
    edge 0 of group `top` names node 13, but there are only 13 nodes (counted from 0)
    hint: are the nodes counted from 1?
    ");
    let same = vec![edges("top", &[8, 10, 9]), edges("top", &[10, 12, 11])];
    assert!(message_of_groups(same).starts_with("two boundary groups are called `top`"));
    assert!(message_of_groups(vec![edges("top", &[])]).starts_with("boundary group `top` has no facets"));
}

#[test]
#[should_panic(expected = "edges of group `top` do not fit the cells")]
fn edges_of_another_degree_are_a_bug() {
    message_of_groups(vec![("top".to_owned(), Cells::new(CellKind::Line2, vec![8, 10]))]);
}

#[test]
fn three_cells_at_one_edge() {
    let points = vec![[0.0, 0.0], [1.0, 0.0], [0.5, 1.0], [0.5, -1.0], [0.5, 2.0]];
    let cells = Cells::new(CellKind::Triangle3, vec![0, 1, 2, 1, 0, 3, 0, 1, 4]);
    let message = SolidMesh::new(points, cells, vec![]).expect_err("overlapping cells").to_string();
    assert!(
        message.starts_with("facet with nodes [0, 1] belongs to cells [0, 1, 2], at most two"),
        "{message}"
    );
}

fn refusal(file: GmshFile) -> String {
    with_hint(&file.into_solid_mesh().expect_err("no solid"))
}

#[test]
fn files_that_make_no_solid() {
    insta::assert_snapshot!(refusal(parse(PRISM_4_TEXT)), @r"
    the file has 4-node tetrahedrons (17), so it is no mesh in 2 dimensions
    hint: save the mesh of the surface only
    ");

    let mut mixed = parse(PLATE_4_TEXT);
    let nodes = mixed.blocks.last().expect("triangles").nodes[..4].to_vec();
    mixed.blocks.push(ElementBlock { kind: ElementKind::Quadrilateral4, groups: vec![11], nodes });
    insta::assert_snapshot!(refusal(mixed), @r"
    the file mixes 3-node triangles (50) and 4-node quadrilaterals (1), a solid takes cells of one kind
    hint: drop `Recombine Surface`, or let it leave no triangles: Mesh.RecombinationAlgorithm = 3
    ");

    let mut other_order = parse(SECOND_ORDER);
    other_order.blocks.push(ElementBlock { kind: ElementKind::Line2, groups: vec![3], nodes: vec![0, 1] });
    insta::assert_snapshot!(refusal(other_order), @r"
    the 2-node lines of the file (1) are no edges of its 6-node triangles, which have 3-node lines
    hint: give all elements the same order: Mesh.ElementOrder before meshing, or `SetOrder` after it
    ");

    let mut lines = parse(PLATE_4_TEXT);
    lines.blocks.retain(|block| block.kind == ElementKind::Line2);
    insta::assert_snapshot!(refusal(lines), @r"
    the file has no triangles or quadrilaterals, which a plane solid consists of
    hint: mesh the domain (`gmsh -2` or `gmsh -3`) and put it into a physical group: gmsh saves only groups once there is one
    ");

    let mut lifted = parse(QUADRILATERALS_4);
    lifted.points[2][2] = 0.1;
    assert!(refusal(lifted).contains("is not in the plane z = 0"));
    let mut bare = parse(QUADRILATERALS_4);
    bare.names.clear();
    bare.blocks.iter_mut().for_each(|block| block.groups.clear());
    assert!(refusal(bare).contains("no 2-node line belongs to a physical group"));
}
