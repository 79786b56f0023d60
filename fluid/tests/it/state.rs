//! Commit, rewind and restore.
use partita_numerics::Field;

use partita_fluid::{
    BodyForce, BoundaryCondition, FluidModel, FluidSettings, FluidSolver, InitialState, TimeScheme,
};
use partita_mesh::motion::{MotionMode, MotionSettings};
use partita_numerics::newton::Limit;
use partita_testing::with_hint;

use crate::common::*;

/// A tank with an uneven inflow, an inclined slip wall and a bottom that moves.
fn tank(time: TimeScheme) -> FluidSolver<2> {
    let straight = unit_square(4);
    let skewed = straight.points().iter().map(|x| [x[0] + 0.2 * x[1] * x[0], x[1]]).collect();
    let model = FluidModel {
        body_force: BodyForce::Constant([0.0, -1.0]),
        initial: InitialState::Velocity(field(|x: &[f64; 2], _| [x[1], 0.1 * x[0]])),
        ..model(boundary(&[
            ("left", BoundaryCondition::Velocity(field(|x: &[f64; 2], t| [x[1] * (1.0 + t), 0.0]))),
            ("right", BoundaryCondition::Slip),
            ("bottom", BoundaryCondition::Interface),
            ("top", BoundaryCondition::StressFree { backflow: true }),
        ]))
    };
    let motion = MotionSettings { mode: MotionMode::Incremental, ..MotionSettings::default() };
    let settings = FluidSettings { motion, ..settings(time) };
    FluidSolver::new(straight.with_points(skewed).expect("a mesh"), model, settings).expect("a fluid")
}

/// Two rounds of one step of any size.
fn try_step(fluid: &mut FluidSolver<2>, time: f64, dt: f64) {
    fluid.begin_step(time, dt).expect("a step");
    for round in 1..3 {
        let amplitude = 0.1 * time * f64::from(round);
        let bump = |node: &usize| {
            let x = fluid.mesh().points()[*node][0];
            [0.0, amplitude * x * (1.0 - x)]
        };
        let displacement: Vec<f64> = fluid.interface_nodes().iter().flat_map(bump).collect();
        fluid.impose(&displacement).expect("a motion");
        fluid.advance(Limit::AtMost(2)).expect("two iterations");
    }
}

fn run(fluid: &mut FluidSolver<2>, steps: std::ops::Range<u32>) {
    for k in steps {
        let dt = if k % 2 == 0 { 0.05 } else { 0.08 };
        try_step(fluid, fluid.state().time + dt, dt);
        fluid.commit();
    }
}

#[test]
fn step_given_up_and_redone_gives_the_same_bits() {
    let (mut plain, mut hesitant) = (tank(BDF2), tank(BDF2));
    run(&mut plain, 0..2);
    run(&mut hesitant, 0..2);
    let before = hesitant.state().clone();
    try_step(&mut hesitant, 0.5, 0.31);
    hesitant.rewind();
    assert_eq!(*hesitant.state(), before);
    assert_eq!(hesitant.values(), before.values);
    assert_eq!(hesitant.displacement(), before.displacement);
    run(&mut plain, 2..4);
    run(&mut hesitant, 2..4);
    assert_eq!(plain.state(), hesitant.state());
}

#[test]
fn restored_state_continues_with_the_same_bits() {
    let mut whole = tank(BDF2);
    run(&mut whole, 0..3);
    let checkpoint = whole.state().clone();
    run(&mut whole, 3..6);
    let mut resumed = tank(BDF2);
    resumed.restore(&checkpoint).expect("a state of this mesh");
    run(&mut resumed, 3..6);
    assert_eq!(whole.state(), resumed.state());
    assert_eq!(whole.residual(), resumed.residual());
    // The bottom shares its ends with the inflow and with an inclined slip wall.
    for group in ["left", "right", "bottom"] {
        assert_eq!(whole.force_on(group), resumed.force_on(group));
    }
    assert_eq!(whole.interface_work(), resumed.interface_work());
}

#[test]
fn commit_makes_the_trial_the_committed_state() {
    let mut fluid = tank(BDF2);
    run(&mut fluid, 0..1);
    let first = fluid.state().clone();
    try_step(&mut fluid, first.time + 0.02, 0.02);
    assert_eq!(*fluid.state(), first, "nothing is committed before commit");
    let (values, displacement) = (fluid.values().to_vec(), fluid.displacement().to_vec());
    fluid.commit();
    let second = fluid.state().clone();
    assert_eq!(second.last_dt, Some(0.02));
    assert_eq!((&second.values, &second.displacement), (&values, &displacement));
    assert_eq!(
        (&second.previous_values, &second.previous_displacement),
        (&first.values, &first.displacement)
    );
    assert_eq!(fluid.values(), values);
}

/// The first step of BDF2 is one of BDF1, whatever its size; the second one is not.
#[test]
fn second_order_starts_with_a_step_of_first_order() {
    let [first, second] = [BDF1, BDF2].map(|time| {
        let mut fluid = tank(time);
        [0..1, 1..2].map(|steps| {
            run(&mut fluid, steps);
            fluid.values().to_vec()
        })
    });
    assert_eq!(first[0], second[0]);
    assert_ne!(first[1], second[1]);
}

#[test]
fn state_of_another_mesh_is_refused() {
    let mut fluid = tank(BDF2);
    let mut state = fluid.state().clone();
    state.values.pop();
    let error = fluid.restore(&state).expect_err("a state that does not fit");
    insta::assert_snapshot!(with_hint(&error), @r"
    fluid: the saved state has 122 values, the field has 123
    hint: states fit only the mesh they were saved from
    ");
}
