//! Motions that cannot be: each is refused with a place and a remedy.

use partita_mesh::generate::Diagonal;
use partita_mesh::motion::prescribed_dofs;
use partita_mesh::{CellKind, Cells, Mesh, MeshMotion, MotionError, MotionLaw, MotionMode, MotionSettings};
use partita_testing::with_hint;

use crate::boxes::{unit_cube, unit_square};

fn settings(mode: MotionMode) -> MotionSettings {
    MotionSettings { mode, ..MotionSettings::default() }
}

#[test]
fn inverted_triangle_is_named_with_its_place() {
    let mesh = unit_square(2, Diagonal::Right);
    let prescribed = prescribed_dofs(&mesh, &[]).expect("no sliding");
    let motion = MeshMotion::new(&mesh, settings(MotionMode::Reference), &prescribed).expect("a held mesh");
    let mut displacement = vec![0.0; 18];
    displacement[8..10].copy_from_slice(&[0.6, 0.5]);
    let error = motion.check(&displacement).expect_err("the centre has left the square");
    insta::assert_snapshot!(with_hint(&error), @r"
    mesh motion: cell 6 at (1.03333, 0.833333) m is inverted, measure -2.500e-2 m^2
    hint: smaller time steps, incremental mesh motion, or another stiffening
    ");
}

#[test]
fn inverted_tetrahedron_is_named_with_its_place() {
    let mesh = unit_cube(1);
    let prescribed = prescribed_dofs(&mesh, &[]).expect("no sliding");
    let motion = MeshMotion::new(&mesh, settings(MotionMode::Reference), &prescribed).expect("a held mesh");
    let mut displacement = vec![0.0; 24];
    displacement[9..12].copy_from_slice(&[-1.2, 0.0, 0.0]);
    let error = motion.check(&displacement).expect_err("a corner pushed through");
    insta::assert_snapshot!(with_hint(&error), @r"
    mesh motion: cell 4 at (0.2, 0.75, 0.25) m is inverted, measure -3.333e-2 m^3
    hint: smaller time steps, incremental mesh motion, or another stiffening
    ");
}

#[test]
fn displacement_that_is_not_a_number_is_caught_by_the_check() {
    let mesh = unit_square(2, Diagonal::Right);
    let prescribed = prescribed_dofs(&mesh, &[]).expect("no sliding");
    let motion = MeshMotion::new(&mesh, settings(MotionMode::Reference), &prescribed).expect("a held mesh");
    let mut displacement = vec![0.0; 18];
    displacement[8] = f64::NAN;
    assert!(matches!(motion.check(&displacement), Err(MotionError::Inverted { .. })));
}

#[test]
fn incremental_motion_does_not_start_from_an_inverted_mesh() {
    let mesh = unit_square(2, Diagonal::Right);
    let prescribed = prescribed_dofs(&mesh, &[]).expect("no sliding");
    let mut motion =
        MeshMotion::new(&mesh, settings(MotionMode::Incremental), &prescribed).expect("a held mesh");
    let mut committed = vec![0.0; 18];
    committed[8..10].copy_from_slice(&[0.6, 0.5]);
    assert!(matches!(motion.begin_step(&committed), Err(MotionError::Inverted { .. })));
}

#[test]
fn diverged_boundary_is_named() {
    let mesh = unit_square(2, Diagonal::Right);
    let prescribed = prescribed_dofs(&mesh, &[]).expect("no sliding");
    let mut motion =
        MeshMotion::new(&mesh, settings(MotionMode::Reference), &prescribed).expect("a held mesh");
    let committed = vec![0.0; 18];
    let mut displacement = committed.clone();
    displacement[5] = f64::INFINITY;
    let error = motion.displace(&committed, &mut displacement).expect_err("an infinite displacement");
    insta::assert_snapshot!(with_hint(&error), @r"
    mesh motion: the prescribed displacement of node 2 at (1, 0) m is not finite
    hint: the solver that moves this boundary has diverged
    ");
}

#[test]
fn mesh_that_floats_is_refused() {
    let mesh = unit_square(2, Diagonal::Right);
    let mut prescribed = vec![false; 18];
    prescribed[0] = true;
    let error = MeshMotion::new(&mesh, settings(MotionMode::Reference), &prescribed).expect_err("held in x");
    insta::assert_snapshot!(with_hint(&error), @r"
    mesh motion: no node is held in direction y
    hint: not every boundary can slide in the same direction
    ");
    // Held in one node the elastic mesh still turns about it.
    prescribed[1] = true;
    let error = MeshMotion::new(&mesh, settings(MotionMode::Reference), &prescribed).expect_err("a hinge");
    assert!(matches!(error, MotionError::Factorization { .. }), "{error}");
}

#[test]
fn settings_out_of_range_are_refused() {
    let mesh = unit_square(2, Diagonal::Right);
    let prescribed = prescribed_dofs(&mesh, &[]).expect("no sliding");
    let message = |law| {
        let settings = MotionSettings { law, ..MotionSettings::default() };
        with_hint(&MeshMotion::new(&mesh, settings, &prescribed).expect_err("out of range"))
    };
    insta::assert_snapshot!(message(MotionLaw::Elastic { poisson_ratio: 0.5, stiffening: 1.0 }), @r"
    mesh motion: Poisson's ratio 0.5 of the mesh is not in (-1, 0.5)
    hint: 0.3 is common
    ");
    insta::assert_snapshot!(message(MotionLaw::Harmonic { stiffening: -1.0 }), @r"
    mesh motion: stiffening -1 is not a finite number >= 0
    hint: 1 to 2 is common
    ");
}

#[test]
fn unknown_group_cannot_slide() {
    let error = prescribed_dofs(&unit_square(2, Diagonal::Right), &["floor"]).expect_err("no such group");
    insta::assert_snapshot!(with_hint(&error), @r"
    mesh motion: there is no boundary group `floor` to slide along
    hint: the groups are left, right, bottom, top
    ");
}

#[test]
fn oblique_group_cannot_slide() {
    let points = vec![[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]];
    let cells = Cells::new(CellKind::Triangle3, vec![0, 1, 2]);
    let mesh = Mesh::new(points, cells, vec![("ramp".into(), vec![[1, 2]])]).expect("a triangle");
    let error = prescribed_dofs(&mesh, &["ramp"]).expect_err("an oblique side");
    insta::assert_snapshot!(with_hint(&error), @r"
    mesh motion: nodes cannot slide along group `ramp`, its facet at (0.5, 0.5) m is not normal to an axis
    hint: only straight boundaries along x, y or z can slide
    ");
}

#[test]
fn corner_of_a_sliding_and_a_held_side_is_held() {
    let mesh = unit_square(2, Diagonal::Right);
    let prescribed = prescribed_dofs(&mesh, &["left", "top"]).expect("straight sides");
    let flags = |node: usize| [prescribed[2 * node], prescribed[2 * node + 1]];
    assert_eq!(flags(0), [true, true], "corner with the held bottom");
    assert_eq!(flags(3), [true, false], "middle of the left side");
    assert_eq!(flags(6), [true, true], "corner of two sliding sides");
    assert_eq!(flags(7), [false, true], "middle of the top side");
    assert_eq!(flags(4), [false, false], "inside");
}

#[test]
fn boundary_without_a_group_is_held() {
    let points = vec![[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0], [0.4, 0.5]];
    let cells = Cells::new(CellKind::Triangle3, vec![0, 1, 4, 1, 2, 4, 2, 3, 4, 3, 0, 4]);
    let mesh = Mesh::new(points, cells, vec![("bottom".into(), vec![[0, 1]])]).expect("a square");
    let prescribed = prescribed_dofs(&mesh, &["bottom"]).expect("a straight side");
    assert_eq!(prescribed, [vec![true; 8], vec![false; 2]].concat());
}
