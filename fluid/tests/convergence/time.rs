//! Flows linear in space, where every error is one of the time scheme: at rest and on a moving mesh, with even and
//! uneven steps.
use partita_numerics::Field;

use std::sync::Arc;

use partita_fluid::{
    BodyForce, FluidModel, FluidSettings, FluidSolver, InitialState, PressurePin, TimeScheme, VectorField,
};
use partita_mesh::Mesh;
use partita_numerics::newton::Limit;
use partita_numerics::rates::fitted_order;
use partita_numerics::time::BdfOrder;

use crate::common::*;

const DENSITY: f64 = 1.3;

fn size(t: f64) -> f64 {
    1.0 + 0.5 * (2.0 * t).sin()
}

/// A vortex that swells, u = s(t) (-y, x), under p = 3 s(t) (x - y): linear in space, so that all errors are errors in
/// time, also those of a mesh that moves through it. The velocity is not a gradient, so that the pressure cannot take
/// the errors of its rate.
fn swelling(x: &[f64; 2], t: f64) -> Exact {
    let s = size(t);
    Exact {
        velocity: [-s * x[1], s * x[0]],
        gradient: [[0.0, -s], [s, 0.0]],
        pressure: 3.0 * s * (x[0] - x[1]),
    }
}

/// b = du/dt + (u.grad) u + grad p / rho.
fn force(x: &[f64; 2], t: f64) -> [f64; 2] {
    let (s, slope) = (size(t), (2.0 * t).cos());
    let push = 3.0 * s / DENSITY;
    [-slope * x[1] - s * s * x[0] + push, slope * x[0] - s * s * x[1] - push]
}

fn fluid(mesh: Mesh<2>, order: BdfOrder) -> FluidSolver<2> {
    let velocity: VectorField<2> = Arc::new(|x, t| swelling(x, t).velocity);
    let model = FluidModel {
        density: DENSITY,
        // Viscosity rules tau_M: with 4/dt^2 in it, smaller steps would also weaken the stabilization.
        viscosity: 5.0,
        body_force: BodyForce::Field(Arc::new(force)),
        boundary: prescribed(&mesh, &velocity),
        initial: InitialState::Velocity(velocity),
    };
    let settings = FluidSettings {
        time: TimeScheme::Bdf(order),
        pressure_pin: Some(PressurePin::default()),
        ..FluidSettings::default()
    };
    FluidSolver::new(mesh, model, settings).expect("a fluid")
}

/// What the mesh does and how the steps are cut.
#[derive(Debug, Clone, Copy)]
struct Course {
    moves: bool,
    uneven: bool,
}

/// Errors at t = 1 s after so many steps.
fn run(order: BdfOrder, steps: u32, course: Course) -> Errors {
    let mesh = unit_square(4);
    let mut fluid = fluid(mesh.clone(), order);
    let (mut t, dt) = (0.0, 1.0 / f64::from(steps));
    for k in 0..steps {
        let factor = match (course.uneven, k % 2) {
            (false, _) => 1.0,
            (true, 0) => 1.25,
            (true, _) => 0.75,
        };
        t += factor * dt;
        fluid.begin_step(t, factor * dt).expect("a step");
        if course.moves {
            let bubble = |x: &[f64; 2]| 0.8 * (3.0 * t).sin() * x[0] * (1.0 - x[0]) * x[1] * (1.0 - x[1]);
            let motion: Vec<f64> = mesh.points().iter().flat_map(|x| [bubble(x), -0.5 * bubble(x)]).collect();
            fluid.impose_mesh(&motion).expect("no inverted cells");
        }
        fluid.advance(Limit::ToConvergence).expect("convergence");
        fluid.commit();
    }
    errors(&fluid, |x| swelling(x, t))
}

/// Both orders of BDF: velocity and pressure have the order of the scheme, and errors below the bounds
/// `[velocity, pressure]` with 256 steps.
fn study(course: Course, bounds: [[f64; 2]; 2]) {
    let steps = [64_u32, 128, 256];
    let dt = steps.map(|n| 1.0 / f64::from(n));
    let schemes = [(BdfOrder::One, 1.0), (BdfOrder::Two, 2.0)];
    for ((scheme, expected), bounds) in schemes.into_iter().zip(bounds) {
        let errors = steps.map(|n| run(scheme, n, course));
        let norms = [errors.map(|e| e.velocity), errors.map(|e| e.pressure)];
        for ((name, errors), bound) in ["velocity", "pressure"].into_iter().zip(norms).zip(bounds) {
            let what = format!("{scheme:?}, {course:?}, {name}");
            assert_converges(&what, &dt, &errors, &Expected { order: expected, error: bound }, 0.1);
            let order = fitted_order(&dt, &errors);
            assert!(order < expected + 0.1, "{what}: order {order:.2} is not that of the scheme");
        }
    }
}

#[test]
fn time_steps_converge_with_the_order_of_the_scheme() {
    study(Course { moves: false, uneven: false }, [[1.66e-6, 1.19e-3], [3.87e-9, 2.79e-6]]);
    study(Course { moves: false, uneven: true }, [[1.46e-6, 8.93e-4], [3.46e-9, 2.1e-6]]);
}

#[test]
fn time_steps_converge_with_the_order_of_the_scheme_on_a_moving_mesh() {
    study(Course { moves: true, uneven: false }, [[1.66e-6, 1.17e-3], [4.01e-9, 3.48e-6]]);
    study(Course { moves: true, uneven: true }, [[1.46e-6, 8.78e-4], [3.58e-9, 2.65e-6]]);
}
