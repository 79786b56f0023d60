//! Flows that lie in the discrete spaces and must be found to round-off.
use partita_numerics::Field;

use partita_fluid::{
    BodyForce, BoundaryCondition, FluidModel, FluidSettings, FluidSolver, InitialState, PressurePin,
    TimeScheme,
};
use partita_mesh::Mesh;

use crate::common::*;

/// Linear in space, without divergence.
fn velocity(x: &[f64; 2]) -> [f64; 2] {
    [0.3 + 0.7 * x[0] + 1.1 * x[1], -0.2 + 0.4 * x[0] - 0.7 * x[1]]
}

fn pressure(x: &[f64; 2]) -> f64 {
    2.0 - 3.0 * (x[0] - x[1])
}

/// The flow above, kept steady by a linear body force.
fn linear_flow() -> FluidModel<2> {
    let slope = [[0.7, 1.1], [0.4, -0.7]];
    let given = BoundaryCondition::Velocity(field(|x, _| velocity(x)));
    let mut model = model(everywhere(&unit_square(1), &given));
    // rho (grad u) u + grad p = rho b
    model.body_force = BodyForce::Field(field(move |x, _| {
        let u = velocity(x);
        let p = [-3.0 / 1.2, 3.0 / 1.2];
        std::array::from_fn(|i| slope[i][0] * u[0] + slope[i][1] * u[1] + p[i])
    }));
    model
}

#[test]
fn linear_velocity_and_pressure_are_exact_on_any_mesh() {
    let mesh = perturbed(&unit_square(4), 0.04, 1);
    let model = linear_flow();
    let pin = PressurePin { node: 0, pressure: pressure(&mesh.points()[0]) };
    let settings = FluidSettings { pressure_pin: Some(pin), ..settings(TimeScheme::Steady) };
    let mut fluid = FluidSolver::new(mesh, model, settings).expect("a fluid");
    fluid.begin_step(1.0, 1.0).expect("a step");
    exhaust(&mut fluid);
    assert!(velocity_error(&fluid, velocity) < 1e-11, "{:e}", velocity_error(&fluid, velocity));
    assert!(pressure_error(&fluid, pressure) < 1e-10, "{:e}", pressure_error(&fluid, pressure));
}

/// The same with the stress given on one side and no pressure anywhere.
#[test]
fn linear_flow_is_exact_under_its_own_traction() {
    let mut model = linear_flow();
    let mu = 0.05;
    let traction = BoundaryCondition::Traction(field(move |x, _| {
        let shear = mu * (1.1 + 0.4);
        [2.0 * mu * 0.7 - pressure(x), shear]
    }));
    let right = model.boundary.iter_mut().find(|(group, _)| group == "right").expect("a right side");
    right.1 = traction;
    let mesh = perturbed(&unit_square(4), 0.04, 1);
    let mut fluid = FluidSolver::new(mesh, model, settings(TimeScheme::Steady)).expect("a fluid");
    fluid.begin_step(1.0, 1.0).expect("a step");
    exhaust(&mut fluid);
    assert!(velocity_error(&fluid, velocity) < 1e-11, "{:e}", velocity_error(&fluid, velocity));
    assert!(pressure_error(&fluid, pressure) < 1e-10, "{:e}", pressure_error(&fluid, pressure));
}

#[test]
fn linear_velocity_and_pressure_are_exact_in_space() {
    let exact = |x: &[f64; 3]| [0.3 * x[0] + x[1], 0.2 * x[1] - 0.4 * x[2], 0.6 * x[0] - 0.5 * x[2]];
    let slope = [[0.3, 1.0, 0.0], [0.0, 0.2, -0.4], [0.6, 0.0, -0.5]];
    let mesh = perturbed(&unit_cube(3), 0.03, 2);
    let pressure = |x: &[f64; 3]| 1.0 - x[2];
    let mut model = model(everywhere(&mesh, &BoundaryCondition::Velocity(field(move |x, _| exact(x)))));
    model.body_force = BodyForce::Field(field(move |x, _| {
        let u = exact(x);
        let p = [0.0, 0.0, -1.0 / 1.2];
        std::array::from_fn(|i| (0..3).map(|j| slope[i][j] * u[j]).sum::<f64>() + p[i])
    }));
    let pin = PressurePin { node: 0, pressure: pressure(&mesh.points()[0]) };
    let settings = FluidSettings { pressure_pin: Some(pin), ..settings(TimeScheme::Steady) };
    let mut fluid = FluidSolver::new(mesh, model, settings).expect("a fluid");
    fluid.begin_step(1.0, 1.0).expect("a step");
    exhaust(&mut fluid);
    assert!(velocity_error(&fluid, exact) < 1e-11, "{:e}", velocity_error(&fluid, exact));
    assert!(pressure_error(&fluid, pressure) < 1e-10, "{:e}", pressure_error(&fluid, pressure));
}

/// The shear flow between a wall at rest and one that slides, on a mesh whose inner nodes move at random. Its
/// time derivative on the moving nodes and its convection by the mesh velocity cancel only if both come from
/// the same formula.
fn couette<const D: usize>(mesh: &Mesh<D>, time: TimeScheme, convection: bool) -> f64 {
    let shear = |x: &[f64; D]| {
        let mut u = [0.0; D];
        u[0] = 1.7 * x[1];
        u
    };
    let mut model = model(everywhere(mesh, &BoundaryCondition::Velocity(field(move |x, _| shear(x)))));
    model.initial = InitialState::Velocity(field(move |x, _| shear(x)));
    let settings = FluidSettings { pressure_pin: Some(PressurePin::default()), convection, ..settings(time) };
    let mut fluid = FluidSolver::new(mesh.clone(), model, settings).expect("a fluid");
    let mut numbers = Noise::new(3);
    let (mut t, mut error) = (0.0, 0.0_f64);
    for dt in [0.02, 0.02, 0.013, 0.03, 0.01] {
        t += dt;
        fluid.begin_step(t, dt).expect("a step");
        fluid.impose_mesh(&inner_motion(mesh, 0.02, &mut numbers)).expect("no inverted cells");
        exhaust(&mut fluid);
        error = error.max(velocity_error(&fluid, shear)).max(pressure_error(&fluid, |_| 0.0));
        fluid.commit();
    }
    error
}

#[test]
fn couette_flow_is_exact_under_random_mesh_motion() {
    for time in [BDF1, BDF2] {
        let plane = couette(&unit_square(5), time, true);
        assert!(plane < 1e-12, "{time:?} in the plane: {plane:e}");
        let space = couette(&unit_cube(3), time, true);
        assert!(space < 1e-12, "{time:?} in space: {space:e}");
        // Its own convection vanishes, that past the moving mesh stays.
        let stokes = couette(&unit_square(5), time, false);
        assert!(stokes < 1e-12, "{time:?} without convection: {stokes:e}");
    }
}

/// Water at rest under gravity, on a distorted mesh: linear pressure, no velocity, and the weight on the
/// bottom. Slip on one side wall, no-slip on the other.
fn hydrostatic(time: TimeScheme) {
    let mesh = perturbed(&unit_square(6), 0.03, 4);
    let (density, gravity) = (1000.0, 9.81);
    let mut model = model(boundary(&[
        ("left", BoundaryCondition::Slip),
        ("right", BoundaryCondition::NoSlip),
        ("bottom", BoundaryCondition::NoSlip),
        ("top", BoundaryCondition::StressFree { backflow: true }),
    ]));
    model.density = density;
    model.viscosity = 1.0;
    model.body_force = BodyForce::Constant([0.0, -gravity]);
    let mut fluid = FluidSolver::new(mesh, model, settings(time)).expect("a fluid");
    for k in 1..4 {
        fluid.begin_step(0.1 * f64::from(k), 0.1).expect("a step");
        exhaust(&mut fluid);
        fluid.commit();
    }
    let weight = density * gravity;
    assert!(velocity_error(&fluid, |_| [0.0; 2]) < 1e-12);
    assert!(pressure_error(&fluid, |x| weight * (1.0 - x[1])) < 1e-9 * weight);
    let [across, down] = fluid.force_on("bottom").expect("a group");
    assert!((down + weight).abs() < 1e-10 * weight, "{down}");
    // Its two corners push the side walls apart alike.
    assert!(across.abs() < 1e-10 * weight, "{across}");
    let [left, _] = fluid.force_on("left").expect("a group");
    assert!((left + weight / 2.0).abs() < 1e-10 * weight, "{left}");
}

#[test]
fn hydrostatic_rest_is_exact_on_a_distorted_mesh() {
    hydrostatic(TimeScheme::Steady);
    hydrostatic(BDF1);
    hydrostatic(BDF2);
}

/// A box whose walls all slip moves at constant speed, and the fluid in it with them.
#[test]
fn slip_walls_carry_the_fluid_along() {
    let speed = |_: &[f64; 2]| [0.9, -0.4];
    let mesh = perturbed(&unit_square(4), 0.03, 5);
    let mut model = model(everywhere(&mesh, &BoundaryCondition::Slip));
    model.initial = InitialState::Velocity(field(move |x, _| speed(x)));
    let settings = FluidSettings { pressure_pin: Some(PressurePin::default()), ..settings(BDF2) };
    let mut fluid = FluidSolver::new(mesh.clone(), model, settings).expect("a fluid");
    for t in [0.1, 0.2, 0.3] {
        fluid.begin_step(t, 0.1).expect("a step");
        let moved: Vec<f64> = mesh.points().iter().flat_map(|x| speed(x).map(|v| v * t)).collect();
        fluid.impose_mesh(&moved).expect("a rigid motion");
        exhaust(&mut fluid);
        assert!(velocity_error(&fluid, speed) < 1e-12);
        assert!(pressure_error(&fluid, |_| 0.0) < 1e-11);
        fluid.commit();
    }
}

/// A steady flow is the same whatever the step is said to be.
#[test]
fn steady_flow_does_not_know_the_time_step() {
    let flows = [1.0, 1e-3].map(|dt| {
        let profile = field(|x: &[f64; 2], _| [x[1] * (1.0 - x[1]), 0.0]);
        let model = model(boundary(&[
            ("left", BoundaryCondition::Velocity(profile)),
            ("right", BoundaryCondition::StressFree { backflow: true }),
            ("bottom", BoundaryCondition::NoSlip),
            ("top", BoundaryCondition::NoSlip),
        ]));
        let mut fluid =
            FluidSolver::new(unit_square(4), model, settings(TimeScheme::Steady)).expect("a fluid");
        step(&mut fluid, 1.0, dt);
        fluid.values().to_vec()
    });
    assert_eq!(flows[0], flows[1]);
}
