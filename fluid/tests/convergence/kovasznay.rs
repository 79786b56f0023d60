//! The flow behind a grid, an exact solution of the full equations without any force.
use partita_numerics::Field;

use std::f64::consts::PI;
use std::sync::Arc;

use partita_fluid::{
    BodyForce, FluidModel, FluidSettings, FluidSolver, InitialState, PressurePin, TimeScheme, VectorField,
};
use partita_numerics::newton::Limit;

use crate::common::*;

const REYNOLDS: f64 = 40.0;

/// ```text
/// u = 1 - e^(lambda x) cos 2 pi y,   v = lambda/(2 pi) e^(lambda x) sin 2 pi y,   p = (1 - e^(2 lambda x))/2
/// lambda = Re/2 - (Re^2/4 + 4 pi^2)^(1/2)
/// ```
///
/// Source: L. Kovasznay, *Laminar flow behind a two-dimensional grid*, Proc. Camb. Phil. Soc. 44 (1948).
fn exact(x: &[f64; 2]) -> Exact {
    let lambda = REYNOLDS / 2.0 - (REYNOLDS * REYNOLDS / 4.0 + 4.0 * PI * PI).sqrt();
    let wave = 2.0 * PI;
    let (decay, (sin, cos)) = ((lambda * x[0]).exp(), (wave * x[1]).sin_cos());
    let across = lambda / wave * decay * sin;
    Exact {
        velocity: [1.0 - decay * cos, across],
        gradient: [[-lambda * decay * cos, wave * decay * sin], [lambda * across, lambda * decay * cos]],
        pressure: 0.5 * (1.0 - decay * decay),
    }
}

fn run(divisions: usize) -> Errors {
    let mesh = mesh([-0.5, -0.5], [1.5, 1.0], [3 * divisions / 2, divisions]);
    let velocity: VectorField<2> = Arc::new(|x, _| exact(x).velocity);
    let model = FluidModel {
        density: 1.0,
        viscosity: 1.0 / REYNOLDS,
        body_force: BodyForce::Constant([0.0; 2]),
        boundary: prescribed(&mesh, &velocity),
        initial: InitialState::Rest,
    };
    let pin = PressurePin { node: 0, pressure: exact(&mesh.points()[0]).pressure };
    let settings =
        FluidSettings { time: TimeScheme::Steady, pressure_pin: Some(pin), ..FluidSettings::default() };
    let mut fluid = FluidSolver::new(mesh, model, settings).expect("a fluid");
    fluid.begin_step(1.0, 1.0).expect("a step");
    fluid.advance(Limit::ToConvergence).expect("convergence");
    errors(&fluid, exact)
}

#[test]
fn kovasznay_flow_converges() {
    let divisions = [12, 24, 48];
    let h = divisions.map(|n| 1.0 / n as f64);
    let errors = divisions.map(run);
    let expected = |order, error| Expected { order, error };
    assert_converges("velocity", &h, &errors.map(|e| e.velocity), &expected(2.0, 2.1e-3), 0.1);
    assert_converges("gradient", &h, &errors.map(|e| e.gradient), &expected(1.0, 0.253), 0.1);
    assert_converges("pressure", &h, &errors.map(|e| e.pressure), &expected(1.5, 2.0e-3), 0.1);
}
