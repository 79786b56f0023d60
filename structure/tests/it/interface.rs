//! The interface: which points it has, what goes in, what comes out.
use partita_numerics::Field;

use partita_iga::{Side, build};
use partita_numerics::newton::{self, Limit, Problem, Verdict};
use partita_structure::StructureSolver;

use crate::common::{RADII, bare, dynamic, noise, quasi_static, solver, svk};

/// 4 x 3 control points, numbered along x first.
fn with_sides(clamped: &[Side], wetted: &[Side]) -> StructureSolver<2> {
    let patch = build::rectangle([0.0, 0.0], [1.0, 0.5], [2, 2], [2, 1]).unwrap();
    let mut model = bare(svk(10.0, 0.3));
    model.clamped = clamped.to_vec().into();
    model.wetted = wetted.to_vec().into();
    solver(patch, model, quasi_static())
}

fn converge<const D: usize>(solver: &mut StructureSolver<D>) {
    let settings = *solver.newton_settings();
    newton::solve(solver, &settings, Limit::ToConvergence, |_, _| Verdict::Continue).unwrap();
}

#[test]
fn points_are_ascending_corners_come_once_and_clamped_ones_not_at_all() {
    let top = with_sides(&[Side::LEFT], &[Side::TOP]);
    assert_eq!(top.interface_points(), [9, 10, 11]);
    let corner = with_sides(&[Side::LEFT], &[Side::TOP, Side::RIGHT]);
    assert_eq!(corner.interface_points(), [3, 7, 9, 10, 11]);
    let three = with_sides(&[Side::BOTTOM], &[Side::TOP, Side::RIGHT, Side::LEFT]);
    assert_eq!(three.interface_points(), [4, 7, 8, 9, 10, 11]);
    let both_ends = with_sides(&[Side::LEFT, Side::RIGHT], &[Side::BOTTOM]);
    assert_eq!(both_ends.interface_points(), [1, 2]);
    assert!(with_sides(&[Side::LEFT], &[]).interface_points().is_empty());
}

#[test]
fn the_interface_of_a_volume_lies_on_its_faces() {
    let patch = build::cuboid([0.0; 3], [1.0, 1.0, 1.0], [1, 1, 1], [1, 1, 1]).unwrap();
    let mut model = bare(svk(10.0, 0.3));
    model.clamped = [Side::FRONT].into();
    model.wetted = [Side::LEFT, Side::TOP].into();
    assert_eq!(solver(patch, model, quasi_static()).interface_points(), [4, 6, 7]);
}

#[test]
fn one_force_reaches_its_own_point_and_component() {
    let mut solver = with_sides(&[Side::LEFT], &[Side::TOP, Side::RIGHT]);
    let points = solver.interface_points().to_vec();
    assert!(points.len() > 3, "{points:?}");
    for (place, &point) in points.iter().enumerate() {
        for component in 0..2 {
            let mut load = vec![0.0; points.len() * 2];
            load[place * 2 + component] = 3.0;
            solver.begin_step(1.0, 1.0).expect("a step");
            solver.impose(&load).expect("a step");
            let force = &solver.trial().external_force;
            for (dof, &f) in force.iter().enumerate() {
                assert_eq!(f, if dof == point * 2 + component { 3.0 } else { 0.0 });
            }
        }
    }
}

#[test]
fn output_holds_the_displacements_of_the_points_in_order() {
    let mut solver = with_sides(&[Side::LEFT], &[Side::TOP, Side::RIGHT]);
    solver.begin_step(1.0, 1.0).expect("a step");
    let points = solver.interface_points().to_vec();
    let load: Vec<f64> = noise(points.len() * 2, 1.0).iter().map(|x| 0.1 * x).collect();
    solver.impose(&load).expect("a step");
    converge(&mut solver);
    let mut output = vec![0.0; load.len()];
    solver.output(&mut output);
    for (place, &point) in points.iter().enumerate() {
        assert_eq!(output[place * 2..][..2], solver.values()[point * 2..][..2]);
        assert_ne!(output[place * 2], 0.0);
    }
    // The same points, seen on the patch: a corner of the patch is a control point.
    assert_eq!(output[(points.len() - 1) * 2..], solver.displacement_at(&[1.0, 1.0]));
}

#[test]
fn forces_at_the_interface_are_held_by_the_support() {
    let mut solver = with_sides(&[Side::LEFT], &[Side::TOP]);
    solver.begin_step(1.0, 1.0).expect("a step");
    let load: Vec<f64> = noise(6, 2.0).iter().map(|x| 0.05 * x).collect();
    solver.impose(&load).expect("a step");
    converge(&mut solver);
    let reaction = solver.reaction(Side::LEFT).unwrap();
    for i in 0..2 {
        let total: f64 = load.iter().skip(i).step_by(2).sum();
        assert!((reaction[i] + total).abs() < 1e-9, "{} and {total}", reaction[i]);
    }
}

#[test]
fn an_interface_load_is_averaged_over_the_step_like_every_other() {
    for radius in RADII {
        let alpha_f = radius / (radius + 1.0);
        let patch = build::rectangle([0.0, 0.0], [1.0, 0.5], [2, 2], [2, 1]).unwrap();
        let mut model = bare(svk(10.0, 0.3));
        model.clamped = [Side::LEFT].into();
        model.wetted = [Side::RIGHT].into();
        let mut solver = solver(patch, model, dynamic(radius));
        let right = solver.interface_points().to_vec();

        // From rest nothing but the load is in the residual of the first assembly.
        let averaged = |solver: &mut StructureSolver<2>, load: f64| {
            solver.impose(&vec![load; right.len() * 2]).expect("a step");
            solver.assemble(false).unwrap();
            -solver.residual()[right[0] * 2]
        };
        solver.begin_step(0.1, 0.1).expect("a step");
        assert!((averaged(&mut solver, 2.0) - (1.0 - alpha_f) * 2.0).abs() < 1e-15);
        // The second step averages with the load that the first one ended with.
        let mut state = solver.trial().clone();
        state.displacement.fill(0.0);
        state.velocity.fill(0.0);
        state.acceleration.fill(0.0);
        solver.restore(&state).unwrap();
        solver.begin_step(0.2, 0.1).expect("a step");
        assert!((averaged(&mut solver, 6.0) - ((1.0 - alpha_f) * 6.0 + alpha_f * 2.0)).abs() < 1e-15);
    }
}

#[test]
fn a_step_begins_under_the_committed_interface_force() {
    let mut solver = with_sides(&[Side::LEFT], &[Side::TOP]);
    solver.begin_step(1.0, 1.0).expect("a step");
    let load = [0.01, 0.02, 0.03, 0.04, 0.05, 0.06];
    solver.impose(&load).expect("a step");
    converge(&mut solver);
    solver.commit();
    solver.begin_step(2.0, 1.0).expect("a step");
    assert_eq!(solver.trial().interface_force, load);
    assert!(solver.assemble(false).unwrap().relative < 1e-9, "still in equilibrium");
}

#[test]
#[should_panic(expected = "the interface force has the wrong length")]
fn a_force_of_the_wrong_length_is_refused() {
    with_sides(&[Side::LEFT], &[Side::TOP]).impose(&[0.0; 5]).expect("a step");
}
