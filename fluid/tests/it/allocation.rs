//! What a Newton iteration and the forces after it may allocate: nothing.
use partita_numerics::Field;

use allocation_counter::measure;
use partita_fluid::{BoundaryCondition, FluidModel, FluidSolver, InitialState};
use partita_numerics::newton::{self, Limit, Problem, Verdict};

use crate::common::*;

/// A tank in the first step of a run, with its bottom in motion.
fn tank(divisions: usize) -> FluidSolver<2> {
    let start = field(|x: &[f64; 2], _| [x[1] * (1.0 - x[1]), x[0]]);
    let model = FluidModel {
        initial: InitialState::Velocity(start),
        ..model(boundary(&[
            ("left", BoundaryCondition::NoSlip),
            ("right", BoundaryCondition::NoSlip),
            ("bottom", BoundaryCondition::Interface),
            ("top", BoundaryCondition::DoNothing { backflow: true }),
        ]))
    };
    let mut fluid = FluidSolver::new(unit_square(divisions), model, settings(BDF2)).expect("a fluid");
    fluid.begin_step(0.01, 0.01).expect("a step");
    fluid
}

#[test]
fn a_newton_iteration_allocates_nothing() {
    // The mesh of the published tank, and one whose fronts are large enough for the kernels of faer.
    for divisions in [10, 60] {
        let mut fluid = tank(divisions);
        let mut load = vec![0.0; 2 * fluid.interface_nodes().len()];
        let mut iteration = || {
            fluid.assemble(true).expect("an assembly");
            fluid.solve_and_update().expect("a solution");
            fluid.output(&mut load);
        };
        // The first factorization sizes the packing buffer of this thread's matrix kernels.
        iteration();
        let counted = measure(iteration);
        assert_eq!(counted.count_total, 0, "{divisions} divisions: {counted:?}");
    }
}

#[test]
fn a_newton_loop_allocates_nothing() {
    let mut fluid = tank(10);
    let settings = *fluid.newton_settings();
    let mut iterations = |limit| {
        newton::solve(&mut fluid, &settings, limit, |_, _| Verdict::Continue).expect("a flow").iterations
    };
    iterations(Limit::AtMost(1));
    let counted = measure(|| assert!(iterations(Limit::ToConvergence) > 1));
    assert_eq!(counted.count_total, 0, "{counted:?}");
}
