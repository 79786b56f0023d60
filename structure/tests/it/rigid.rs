//! What supports leave free.

use partita_iga::{Side, build};
use partita_mesh::{CellKind, Cells, SolidMesh};
use partita_structure::rigid::{FreePiece, RigidMotion, free_pieces};
use partita_structure::{Boundary, Held, Space};

use RigidMotion::{Rotation, Translation};

const X: [bool; 2] = [true, false];
const Y: [bool; 2] = [false, true];

fn plate() -> Space<2> {
    build::rectangle([0.0; 2], [2.0, 1.0], [2, 2], [4, 2]).unwrap().into()
}

fn motions(space: &Space<2>, clamped: impl Into<Boundary>, held: &[(Side, [bool; 2])]) -> Vec<RigidMotion> {
    let held: Vec<Held<2>> =
        held.iter().map(|&(side, components)| Held { parts: side.into(), components }).collect();
    let dofs = space.held_dofs(&clamped.into(), &held).unwrap();
    let free = free_pieces(space, &dofs);
    free.into_iter().next().map(|piece| piece.motions).unwrap_or_default()
}

#[test]
fn a_patch_keeps_the_motions_that_its_rollers_leave() {
    let plate = plate();
    let all = [Translation([1.0, 0.0]), Translation([0.0, 1.0])];
    let loose = motions(&plate, Boundary::NONE, &[]);
    assert_eq!(loose[..2], all);
    assert!(matches!(loose[2], Rotation([x, y]) if (x - 1.0).abs() < 1e-12 && (y - 0.5).abs() < 1e-12));
    assert_eq!(motions(&plate, Side::LEFT, &[]), []);
    assert_eq!(motions(&plate, Boundary::NONE, &[(Side::RIGHT, X)]), [all[1]]);
    assert_eq!(motions(&plate, Boundary::NONE, &[(Side::LEFT, X), (Side::RIGHT, X)]), [all[1]]);
    assert_eq!(motions(&plate, Boundary::NONE, &[(Side::LEFT, X), (Side::BOTTOM, Y)]), []);
    // A line that is held along itself: it may move across and turn about any of its points.
    let turning = motions(&plate, Boundary::NONE, &[(Side::BOTTOM, X)]);
    assert_eq!(turning[0], all[1]);
    assert!(
        matches!(turning[1], Rotation([x, y]) if (x - 1.0).abs() < 1e-12 && y.abs() < 1e-12),
        "{turning:?}"
    );
}

/// Squares with these lower left corners; those that share a corner share its node unless `apart`.
fn squares(corners: &[[usize; 2]], apart: bool) -> SolidMesh<2> {
    let (mut points, mut nodes) = (Vec::new(), Vec::new());
    for &[i, j] in corners {
        for place in [[i, j], [i + 1, j], [i + 1, j + 1], [i, j + 1]].map(|p| p.map(|k| k as f64)) {
            let known = points.iter().position(|point| *point == place).filter(|_| !apart);
            nodes.push(known.unwrap_or_else(|| {
                points.push(place);
                points.len() - 1
            }));
        }
    }
    let wall = ("wall".to_owned(), Cells::new(CellKind::Line2, vec![0, 3]));
    SolidMesh::new(points, Cells::new(CellKind::Quadrilateral4, nodes), vec![wall]).unwrap()
}

fn free(mesh: SolidMesh<2>, clamped: impl Into<Boundary>) -> Vec<FreePiece> {
    let space = Space::from(mesh);
    let held = space.held_dofs(&clamped.into(), &[]).unwrap();
    free_pieces(&space, &held)
}

#[test]
fn a_piece_without_a_common_node_is_loose() {
    let found = free(squares(&[[0, 0], [1, 0]], true), "wall");
    assert_eq!(found.len(), 1);
    assert_eq!((found[0].cells, found[0].place, found[0].is_loose()), (1, [1.5, 0.5], true));
    assert_eq!(free(squares(&[[0, 0], [1, 0]], false), "wall"), []);
    assert_eq!(free(squares(&[[0, 0], [5, 0]], false), Boundary::NONE).len(), 2);
}

#[test]
fn a_piece_on_one_common_node_turns_about_it() {
    let found = free(squares(&[[0, 0], [1, 1]], false), "wall");
    assert_eq!(found.len(), 1);
    let [Rotation([x, y])] = found[0].motions[..] else { panic!("{found:?}") };
    assert!((x - 1.0).abs() < 1e-12 && (y - 1.0).abs() < 1e-12, "{found:?}");
    assert_eq!(found[0].place, [1.5, 1.5]);
}

#[test]
fn pieces_on_one_common_node_each_can_hold_one_another() {
    // A ring of squares that touch in corners: the wall holds one, the last touches the first again. Four bodies and four
    // hinges are a mechanism: one motion is left, and the square on the wall has no part in it.
    let four_bar = free(squares(&[[0, 1], [1, 0], [2, 1], [1, 2]], false), "wall");
    assert_eq!(four_bar.len(), 3);
    assert!(four_bar.iter().all(|piece| piece.motions.len() == 1), "{four_bar:?}");
    // A square in the hole shares two nodes with each neighbour: all is one body.
    assert_eq!(free(squares(&[[0, 1], [1, 0], [2, 1], [1, 2], [1, 1]], false), "wall"), []);
}

#[test]
fn a_triangle_of_hinges_is_stiff() {
    // Three thin triangles along the sides of a triangle, joined in its corners.
    let corners = [[0.0, 0.0], [4.0, 0.0], [2.0, 3.0]];
    let points = [&corners[..], &[[2.0, -1.0], [4.0, 2.0], [0.0, 2.0]]].concat();
    let cells = Cells::new(CellKind::Triangle3, vec![0, 3, 1, 1, 4, 2, 2, 5, 0]);
    let wall = ("wall".to_owned(), Cells::new(CellKind::Line2, vec![0, 3]));
    let mesh = SolidMesh::new(points, cells, vec![wall]).unwrap();
    assert_eq!(free(mesh.clone(), "wall"), []);
    assert_eq!(free(mesh, Boundary::NONE).len(), 3);
}

#[test]
fn a_mesh_of_many_hinges_is_not_searched_for_ever() {
    let checkers: Vec<[usize; 2]> =
        (0..40).flat_map(|i| (0..40).map(move |j| [i, j])).filter(|[i, j]| (i + j) % 2 == 0).collect();
    assert_eq!(free(squares(&checkers, false), "wall"), []);
    let all = free(squares(&checkers, false), Boundary::NONE);
    assert_eq!((all.len(), all[0].cells, all[0].is_loose()), (1, 800, true));
}
