//! Saving, giving up and repeating steps, to the bit.
use partita_numerics::Field;
use partita_numerics::field::StateMismatch;

use partita_iga::Side;
use partita_structure::{
    BodyForce, Rayleigh, StructureError, StructureSettings, StructureSolver, StructureState,
};

use crate::common::{bare, beam, dynamic, quasi_static, solver, svk};

fn shaken(settings: StructureSettings) -> StructureSolver<2> {
    let mut model = bare(svk(1e5, 0.3));
    model.clamped = [Side::LEFT].into();
    model.wetted = [Side::TOP].into();
    model.body_force = BodyForce::in_time(|t| [3.0 * (20.0 * t).cos(), -40.0 * (7.0 * t).sin()]);
    let rayleigh = Some(Rayleigh { mass: 0.1, stiffness: 1e-4 });
    solver(beam(1.0, 0.1, 2, 8), model, StructureSettings { rayleigh, ..settings })
}

/// Steps of changing size with an interface load that changes too.
fn step(solver: &mut StructureSolver<2>, number: usize) {
    use partita_numerics::newton::{self, Limit, Verdict};
    let dt = [0.02, 0.01, 0.03][number % 3];
    solver.begin_step(solver.state().time + dt, dt).expect("a step");
    let load = vec![0.02 * (number as f64).sin(); solver.interface_points().len() * 2];
    solver.impose(&load).expect("a step");
    let settings = *solver.newton_settings();
    newton::solve(solver, &settings, Limit::ToConvergence, |_, _| Verdict::Continue).unwrap();
    solver.commit();
}

/// All numbers of a state as bits.
fn bits(state: &StructureState) -> Vec<u64> {
    let fields = [
        &state.displacement,
        &state.velocity,
        &state.acceleration,
        &state.external_force,
        &state.interface_force,
    ];
    let numbers = fields.into_iter().flatten().chain([&state.time]);
    numbers.map(|x| x.to_bits()).collect()
}

#[test]
fn a_restored_run_continues_with_the_same_bits() {
    for settings in [dynamic(0.5), quasi_static()] {
        let mut whole = shaken(settings);
        (0..5).for_each(|number| step(&mut whole, number));
        let saved = serde_json::to_string(whole.state()).unwrap();
        (5..10).for_each(|number| step(&mut whole, number));

        let mut resumed = shaken(settings);
        resumed.restore(&serde_json::from_str(&saved).unwrap()).unwrap();
        (5..10).for_each(|number| step(&mut resumed, number));
        assert_eq!(bits(whole.state()), bits(resumed.state()));
        assert!(whole.values().iter().any(|d| d.abs() > 1e-3));
    }
}

#[test]
fn a_step_given_up_and_done_again_has_the_same_bits() {
    let mut solver = shaken(dynamic(0.5));
    (0..3).for_each(|number| step(&mut solver, number));
    let before = solver.state().clone();

    step(&mut solver, 3);
    let once = bits(solver.state());

    // The same step after another one of half the size was tried and given up.
    solver.restore(&before).unwrap();
    solver.begin_step(before.time + 0.005, 0.005).expect("a step");
    solver.impose(&vec![1.0; solver.interface_points().len() * 2]).expect("a step");
    let newton = *solver.newton_settings();
    partita_numerics::newton::solve(
        &mut solver,
        &newton,
        partita_numerics::newton::Limit::AtMost(2),
        |_, _| partita_numerics::newton::Verdict::Continue,
    )
    .unwrap();
    solver.rewind();
    assert_eq!(bits(solver.trial()), bits(&before));
    step(&mut solver, 3);
    assert_eq!(bits(solver.state()), once);
}

#[test]
fn a_step_begun_again_starts_from_the_committed_state() {
    let mut solver = shaken(dynamic(0.5));
    (0..2).for_each(|number| step(&mut solver, number));
    let begun = |solver: &mut StructureSolver<2>| {
        solver.begin_step(0.1, 0.07).expect("a step");
        bits(solver.trial())
    };
    let once = begun(&mut solver);
    let elsewhere = vec![0.01; solver.values().len()];
    solver.guess(&elsewhere);
    solver.impose(&vec![1.0; solver.interface_points().len() * 2]).expect("a step");
    assert_ne!(bits(solver.trial()), once);
    assert_eq!(begun(&mut solver), once);
    assert_eq!(solver.values(), solver.state().displacement);
}

#[test]
fn a_run_repeats_itself_to_the_bit() {
    let run = || {
        let mut solver = shaken(dynamic(0.8));
        (0..6).for_each(|number| step(&mut solver, number));
        bits(solver.state())
    };
    assert_eq!(run(), run());
}

#[test]
fn commit_makes_the_trial_state_the_committed_one() {
    let mut solver = shaken(dynamic(0.5));
    solver.begin_step(0.02, 0.02).expect("a step");
    assert_eq!(solver.state().time, 0.0);
    solver.commit();
    assert_eq!(solver.state(), solver.trial());
    assert_eq!(solver.state().time, 0.02);
}

#[test]
fn a_state_of_another_structure_is_refused() {
    let mut solver = shaken(dynamic(0.5));
    let mut state = solver.state().clone();
    state.velocity.pop();
    let error = solver.restore(&state).unwrap_err();
    assert!(
        matches!(
            error,
            StructureError::StateOfAnotherStructure(StateMismatch { what: "values of the velocity", .. })
        ),
        "{error}"
    );
}
