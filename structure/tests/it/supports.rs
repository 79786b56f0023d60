//! Supports that hold one component, and patches that are closed.
use partita_numerics::Field;

use std::f64::consts::TAU;

use approx::assert_relative_eq;
use partita_iga::{Side, build};
use partita_numerics::newton::{self, Limit, Verdict};
use partita_structure::{
    BodyForce, Boundary, Held, Patch, Space, StructureError, StructureModel, StructureSolver,
};

use crate::common::{bare, dynamic, linear, quasi_static, solver, svk, traction_of_uniform_stress};

const YOUNG: f64 = 1e5;

fn held(side: Side, components: [bool; 2]) -> Held<2> {
    Held { parts: side.into(), components }
}

/// The load of a uniform pressure on a side, at the interface points.
fn pressure(solver: &StructureSolver<2>, side: Side, pressure: f64) -> Vec<f64> {
    let Space::Patch(patch) = solver.space() else { unreachable!() };
    let force = traction_of_uniform_stress(patch.spline(), &[side], [[-pressure, 0.0], [0.0, -pressure]]);
    let mut of_nodes = vec![[0.0; 2]; patch.points().len()];
    for (&node, force) in patch.seams().nodes().iter().zip(force.as_chunks::<2>().0) {
        (0..2).for_each(|c| of_nodes[node][c] += force[c]);
    }
    solver.interface_points().iter().flat_map(|&node| of_nodes[node]).collect()
}

fn converge(solver: &mut StructureSolver<2>) {
    let settings = *solver.newton_settings();
    newton::solve(solver, &settings, Limit::ToConvergence, |_, _| Verdict::Continue).unwrap();
}

/// A bar of 2 m between walls at both ends of x and on a floor, pressed from above: uniaxial strain, with the exact
/// displacement `-q y (1 + nu)(1 - 2 nu)/(E (1 - nu))`.
#[test]
fn a_bar_between_rollers_is_in_uniaxial_strain() {
    let (q, nu) = (40.0, 0.3);
    let patch = build::rectangle([0.0; 2], [2.0, 0.5], [2, 2], [3, 2]).unwrap();
    let model = StructureModel {
        held: vec![
            held(Side::LEFT, [true, false]),
            held(Side::RIGHT, [true, false]),
            held(Side::BOTTOM, [false, true]),
        ],
        wetted: Side::TOP.into(),
        ..bare(linear(YOUNG, nu))
    };
    let mut bar = solver(patch, model, quasi_static());
    // All points of the wetted side are there, those on the walls, too.
    assert_eq!(bar.interface_points().len(), 5);
    bar.begin_step(1.0, 1.0).expect("a step");
    let load = pressure(&bar, Side::TOP, q);
    bar.impose(&load).expect("a step");
    converge(&mut bar);
    let modulus = YOUNG * (1.0 - nu) / ((1.0 + nu) * (1.0 - 2.0 * nu));
    for at in [[0.0, 1.0], [0.3, 0.5], [1.0, 1.0], [1.0, 0.25]] {
        let [x, y] = bar.displacement_at(&at);
        assert!(x.abs() < 1e-18, "{x}");
        assert_relative_eq!(y, -q * 0.5 * at[1] / modulus, max_relative = 1e-10);
    }
    let mut output = vec![0.0; load.len()];
    bar.output(&mut output);
    assert_eq!(output[0].abs().max(output[8].abs()), 0.0, "what is held stays exactly zero");
    // The walls push with nu/(1 - nu) of the pressure, the floor with all of it.
    let [push, _] = bar.reaction(Side::LEFT).unwrap();
    assert_relative_eq!(push, q * nu / (1.0 - nu) * 0.5, max_relative = 1e-9);
    assert_relative_eq!(bar.reaction(Side::BOTTOM).unwrap()[1], q * 2.0, max_relative = 1e-9);
}

#[test]
fn a_side_held_in_every_component_is_clamped() {
    let patch = || build::rectangle([0.0; 2], [1.0, 0.1], [2, 2], [6, 1]).unwrap();
    let load = BodyForce::Constant([3.0, -5.0]);
    let clamped =
        StructureModel { clamped: Side::LEFT.into(), body_force: load.clone(), ..bare(svk(YOUNG, 0.3)) };
    let both = StructureModel {
        held: vec![held(Side::LEFT, [true, false]), held(Side::LEFT, [false, true])],
        body_force: load,
        wetted: Side::TOP.into(),
        ..bare(svk(YOUNG, 0.3))
    };
    let mut beams = [clamped, both].map(|model| solver(patch(), model, dynamic(0.5)));
    // The corner between the held and the wetted side does not move: it is no interface point.
    assert_eq!(beams[1].interface_points().len(), 7);
    for beam in &mut beams {
        beam.step_alone(0.01, 0.01).unwrap();
    }
    assert_eq!(beams[0].state().displacement, beams[1].state().displacement);
}

fn ring(sweep: f64) -> Space<2> {
    build::annular_sector([0.0; 2], [0.9, 1.1], 0.4, sweep, [2, 2], [24, 1]).unwrap().into()
}

#[test]
fn a_ring_is_one_piece_and_holds_together_at_its_seam() {
    let Space::Patch(patch) = ring(-TAU) else { unreachable!() };
    let full = patch.spline().control_points().len();
    assert_eq!(patch.points().len(), full - 3);
    // Pressed from outside by p: the exact solution of a thick ring in plane strain is radial and the same all round.
    let model = StructureModel { wetted: Side::TOP.into(), ..bare(linear(YOUNG, 0.3)) };
    let mut ring = StructureSolver::new(Space::Patch(patch), model, dynamic(0.0)).unwrap();
    let p = 50.0;
    for step in 1..=40 {
        ring.begin_step(f64::from(step), 1.0).expect("a step");
        let load = pressure(&ring, Side::TOP, p);
        ring.impose(&load).expect("a step");
        converge(&mut ring);
        ring.commit();
    }
    let (a, b, nu) = (0.9_f64, 1.1_f64, 0.3);
    let exact =
        |r: f64| -p * b * b / (b * b - a * a) * ((1.0 - 2.0 * nu) * r + a * a / r) * (1.0 + nu) / YOUNG;
    for xi in [0.0, 0.1, 0.5, 0.77, 1.0] {
        let [x, y] = ring.space().evaluate(&[xi, 1.0], &places(&ring)).unwrap();
        let [u, v] = ring.displacement_at(&[xi, 1.0]);
        let radial = (u * x + v * y) / x.hypot(y);
        assert_relative_eq!(radial, exact(b), max_relative = 2e-3);
    }
    let [start, end] = [0.0, 1.0].map(|xi| ring.displacement_at(&[xi, 0.3]));
    assert_eq!(start, end);
}

fn places(ring: &StructureSolver<2>) -> Vec<[f64; 2]> {
    ring.space().points().to_vec()
}

#[test]
fn joined_sides_are_no_part_of_the_boundary() {
    let model = || StructureModel { clamped: Side::LEFT.into(), ..bare(linear(YOUNG, 0.3)) };
    let error = StructureSolver::new(ring(TAU), model(), dynamic(0.5)).err().expect("a refusal");
    assert_eq!(error, StructureError::JoinedSide { side: Side::LEFT, partner: Side::RIGHT });
    assert!(StructureSolver::new(ring(TAU * (1.0 - 1e-4)), model(), dynamic(0.5)).is_ok());
}

/// A disk: its centre is a side, its seam a radius. A uniform force and the mass of the whole give a free fall.
#[test]
fn a_disk_falls_in_one_piece() {
    let arc = build::arc([0.0; 2], 1.0, 0.0, TAU).unwrap();
    let centre = arc.with_control_points(vec![[0.0; 2]; arc.control_points().len()]).unwrap();
    let patch = build::ruled(&arc, &centre).unwrap().elevate_degree(1, 1).subdivide(0, 2).unwrap();
    let patch = Patch::from(patch.subdivide(1, 2).unwrap());
    let nodes = patch.points().len();
    assert_eq!(patch.side_nodes(Side::TOP).unwrap().iter().filter(|&&node| node + 1 < nodes).count(), 0);
    let model = StructureModel {
        body_force: BodyForce::Constant([0.0, -2.0]),
        wetted: Boundary::NONE,
        ..bare(svk(1e3, 0.3))
    };
    let mut disk = StructureSolver::new(Space::Patch(patch), model, dynamic(1.0)).unwrap();
    disk.start_from_equilibrium(0.0).unwrap();
    for step in 1..=10 {
        disk.step_alone(0.1 * f64::from(step), 0.1).unwrap();
    }
    for at in [[0.0, 0.0], [1.0, 0.0], [0.3, 0.7], [0.9, 1.0], [0.1, 1.0]] {
        let [x, y] = disk.displacement_at(&at);
        assert!(x.abs() < 1e-9, "{x}");
        assert_relative_eq!(y, -1.0, max_relative = 1e-9);
    }
}
