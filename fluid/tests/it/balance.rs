//! Consistent forces balance: what the boundary does to the fluid is what changes its momentum.
use partita_numerics::Field;

use partita_fluid::{BodyForce, BoundaryCondition, FluidModel, FluidSolver, TimeScheme};

use crate::common::*;

const TRACTION: [f64; 2] = [0.7, -0.4];
const BODY_FORCE: [f64; 2] = [0.5, -0.3];

/// Flow over a wall bump through a box, traction on top, stress-free outflow.
fn channel(time: TimeScheme) -> FluidSolver<2> {
    let inflow = field(|x: &[f64; 2], t: f64| [x[1] * (2.0 - x[1]) * (1.0 + t), 0.0]);
    let model = FluidModel {
        body_force: BodyForce::Constant(BODY_FORCE),
        ..model(boundary(&[
            ("left", BoundaryCondition::Velocity(inflow)),
            ("right", BoundaryCondition::StressFree { backflow: false }),
            ("bottom", BoundaryCondition::Interface),
            ("top", BoundaryCondition::Traction(field(|_, _| TRACTION))),
        ]))
    };
    FluidSolver::new(unit_square(6), model, settings(time)).expect("a fluid")
}

/// Displacement of the bottom: a bump that grows and shifts.
fn bump(fluid: &FluidSolver<2>, t: f64) -> Vec<f64> {
    let point = |node: &usize| fluid.mesh().points()[*node];
    let displacement = |x: [f64; 2]| [0.1 * t * x[0] * (1.0 - x[0]), 0.3 * t * x[0] * (1.0 - x[0])];
    fluid.interface_nodes().iter().flat_map(|node| displacement(point(node))).collect()
}

/// Integral of rho (`D_t` u + (u - w).grad u - b) by the midpoints of the edges, exact for these products.
fn rate_of_momentum(fluid: &FluidSolver<2>, acceleration: &[f64]) -> [f64; 2] {
    let mut total = [0.0; 2];
    for nodes in fluid.mesh().cells() {
        let x: Vec<[f64; 2]> = nodes.iter().map(|&n| fluid.points()[n]).collect();
        let u: Vec<[f64; 2]> =
            nodes.iter().map(|&n| [fluid.values()[3 * n], fluid.values()[3 * n + 1]]).collect();
        let w: Vec<[f64; 2]> =
            nodes.iter().map(|&n| [fluid.mesh_velocity()[2 * n], fluid.mesh_velocity()[2 * n + 1]]).collect();
        let twice_area =
            (x[1][0] - x[0][0]) * (x[2][1] - x[0][1]) - (x[2][0] - x[0][0]) * (x[1][1] - x[0][1]);
        // du/dx and du/dy of the linear interpolant
        let slope = |i: usize| {
            let (d1, d2) = (u[1][i] - u[0][i], u[2][i] - u[0][i]);
            let (e1, e2) = ([x[1][0] - x[0][0], x[1][1] - x[0][1]], [x[2][0] - x[0][0], x[2][1] - x[0][1]]);
            [(d1 * e2[1] - d2 * e1[1]) / twice_area, (d2 * e1[0] - d1 * e2[0]) / twice_area]
        };
        for i in 0..2 {
            for (a, b) in [(0, 1), (1, 2), (2, 0)] {
                let middle = |v: &[[f64; 2]], j: usize| 0.5 * (v[a][j] + v[b][j]);
                let rate = 0.5 * (acceleration[2 * nodes[a] + i] + acceleration[2 * nodes[b] + i]);
                let convection: f64 = (0..2).map(|j| (middle(&u, j) - middle(&w, j)) * slope(i)[j]).sum();
                total[i] += twice_area / 6.0 * 1.2 * (rate + convection - BODY_FORCE[i]);
            }
        }
    }
    total
}

/// Forces on the fluid from boundaries that hold its velocity, and the traction.
fn boundary_force(fluid: &FluidSolver<2>) -> [f64; 2] {
    let mut total = TRACTION; // on a top of length one
    for rows in fluid.residual().chunks_exact(3) {
        total[0] += rows[0];
        total[1] += rows[1];
    }
    total
}

fn assert_balanced(force: [f64; 2], rate: [f64; 2]) {
    for i in 0..2 {
        assert!((force[i] - rate[i]).abs() < 1e-11, "direction {i}: force {}, rate {}", force[i], rate[i]);
    }
}

#[test]
fn forces_balance_in_steady_flow() {
    let mut fluid = channel(TimeScheme::Steady);
    fluid.begin_step(1.0, 1.0).expect("a step");
    fluid.impose(&bump(&fluid, 0.5)).expect("a motion");
    exhaust(&mut fluid);
    let at_rest = vec![0.0; fluid.mesh_velocity().len()];
    assert_eq!(fluid.mesh_velocity(), at_rest);
    assert_balanced(boundary_force(&fluid), rate_of_momentum(&fluid, &at_rest));
}

#[test]
fn forces_balance_in_unsteady_flow_on_a_moving_mesh() {
    for time in [BDF1, BDF2] {
        let mut fluid = channel(time);
        let velocity = |fluid: &FluidSolver<2>| -> Vec<f64> {
            fluid.values().chunks_exact(3).flat_map(|node| [node[0], node[1]]).collect()
        };
        let mut history = [velocity(&fluid), velocity(&fluid)];
        for k in 1..5 {
            let t = 0.1 * f64::from(k);
            fluid.begin_step(t, 0.1).expect("a step");
            fluid.impose(&bump(&fluid, t)).expect("a motion");
            exhaust(&mut fluid);
            let now = velocity(&fluid);
            let weights = if time == BDF2 && k > 1 { [1.5, -2.0, 0.5] } else { [1.0, -1.0, 0.0] };
            let acceleration: Vec<f64> = (0..now.len())
                .map(|i| {
                    (weights[0] * now[i] + weights[1] * history[0][i] + weights[2] * history[1][i]) / 0.1
                })
                .collect();
            assert_balanced(boundary_force(&fluid), rate_of_momentum(&fluid, &acceleration));
            fluid.commit();
            history = [now, history[0].clone()];
        }
    }
}

#[test]
fn interface_forces_are_the_residual_of_the_interface_with_the_sign_turned() {
    let mut fluid = channel(BDF1);
    fluid.begin_step(0.1, 0.1).expect("a step");
    fluid.impose(&bump(&fluid, 0.1)).expect("a motion");
    exhaust(&mut fluid);
    let mut force = vec![0.0; fluid.interface_nodes().len() * 2];
    fluid.output(&mut force);
    for (node, force) in fluid.interface_nodes().iter().zip(force.chunks_exact(2)) {
        let whole = [-fluid.residual()[3 * node], -fluid.residual()[3 * node + 1]];
        // At its left end the inflow has a part; the outlet at the other end holds nothing.
        let is_shared = fluid.mesh().points()[*node] == [0.0, 0.0];
        assert_eq!(force == whole, !is_shared, "node {node}: {force:?} and {whole:?}");
    }
    let sum = |c: usize| force.iter().skip(c).step_by(2).sum::<f64>();
    let total = fluid.force_on("bottom").expect("a group");
    assert!((sum(0) - total[0]).abs() < 1e-13 && (sum(1) - total[1]).abs() < 1e-13);
    // A boundary that holds no velocity carries no reaction.
    assert_eq!(fluid.force_on("right"), Some([0.0; 2]));
    assert!(fluid.force_on("nowhere").is_none());
}
