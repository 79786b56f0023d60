//! The force on one side of the vortex, whose corners belong to two sides each.
use partita_numerics::Field;

use std::f64::consts::PI;

use partita_fluid::{FluidSolver, TimeScheme};
use partita_numerics::newton::Limit;
use partita_numerics::rates::fitted_order;

use crate::common::*;
use crate::space::fluid;

/// Errors of the force on the left side, whose traction is (-1 - sin pi y + 2 pi mu cos pi y, 0).
fn errors_of(force: [f64; 2]) -> f64 {
    (force[0] + 1.0 + 2.0 / PI).hypot(force[1])
}

/// What it was before forces at shared nodes were taken apart: the residual of all its nodes.
fn residual_on_left(fluid: &FluidSolver<2>) -> [f64; 2] {
    let nodes = fluid.mesh().group_nodes("left").expect("a side");
    [0, 1].map(|c| -nodes.iter().map(|node| fluid.residual()[3 * node + c]).sum::<f64>())
}

#[test]
fn the_force_on_a_side_is_of_second_order_in_spite_of_its_corners() {
    const WIDTHS: [f64; 4] = [1.0 / 8.0, 1.0 / 16.0, 1.0 / 32.0, 1.0 / 64.0];
    for nu in [10.0, 0.05] {
        let (mut taken_apart, mut whole) = ([0.0; 4], [0.0; 4]);
        for k in 0..4 {
            let mut fluid = fluid(unit_square(8 << k), nu, TimeScheme::Steady);
            fluid.begin_step(1.0, 1.0).expect("a step");
            fluid.advance(Limit::ToConvergence).expect("convergence");
            taken_apart[k] = errors_of(fluid.force_on("left").expect("a side"));
            whole[k] = errors_of(residual_on_left(&fluid));
        }
        let [order, before] = [taken_apart, whole].map(|errors| fitted_order(&WIDTHS, &errors));
        println!("nu = {nu}: {taken_apart:?} of order {order}; residual {whole:?} of order {before}");
        assert!(order > 1.8, "nu = {nu}: {taken_apart:?} of order {order}");
        assert!((0.8..1.2).contains(&before), "nu = {nu}: the corners show in {whole:?}, order {before}");
    }
}
