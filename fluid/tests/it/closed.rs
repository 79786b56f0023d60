//! Domains without outflow whose boundary moves, or through which fluid is driven.
use partita_numerics::Field;

use std::f64::consts::{PI, TAU};

use partita_fluid::{BoundaryCondition, FluidError, FluidSettings, FluidSolver, PressurePin, TimeScheme};
use partita_mesh::{CellKind, Cells, Mesh};
use partita_numerics::newton::Limit;
use partita_testing::with_hint;

use crate::common::*;

const AROUND: usize = 24;
const OUTWARDS: usize = 5;

/// Between a body whose outline is `radius(angle)`, group `body`, and a square of side 2, group `shell`.
fn ring(radius: impl Fn(f64) -> f64) -> Mesh<2> {
    let mut points = Vec::new();
    for layer in 0..=OUTWARDS {
        let part = layer as f64 / OUTWARDS as f64;
        for k in 0..AROUND {
            let angle = TAU * k as f64 / AROUND as f64;
            let to_square = 1.0 / angle.cos().abs().max(angle.sin().abs());
            let r = (1.0 - part) * radius(angle) + part * to_square;
            points.push([r * angle.cos(), r * angle.sin()]);
        }
    }
    let node = |layer: usize, k: usize| layer * AROUND + k % AROUND;
    let (mut cells, mut body, mut shell) = (Vec::new(), Vec::new(), Vec::new());
    for k in 0..AROUND {
        for layer in 0..OUTWARDS {
            let [a, b, c, d] =
                [node(layer, k), node(layer + 1, k), node(layer + 1, k + 1), node(layer, k + 1)];
            cells.extend([a, b, c, a, c, d]);
        }
        body.push([node(0, k), node(0, k + 1)]);
        shell.push([node(OUTWARDS, k), node(OUTWARDS, k + 1)]);
    }
    let groups = vec![("body".into(), body), ("shell".into(), shell)];
    Mesh::new(points, Cells::new(CellKind::Triangle3, cells), groups).expect("a ring")
}

fn round() -> Mesh<2> {
    ring(|_| 0.4)
}

/// An ellipse with a bump: nothing about it is symmetric.
fn lopsided() -> Mesh<2> {
    ring(|angle| 0.35 + 0.1 * (2.0 * angle).cos() + 0.05 * (angle - 0.3).sin())
}

fn pinned(time: TimeScheme) -> FluidSettings {
    FluidSettings { pressure_pin: Some(PressurePin { node: 0, pressure: 0.0 }), ..settings(time) }
}

fn moving(displacement: impl Fn(&[f64; 2], f64) -> [f64; 2] + Send + Sync + 'static) -> BoundaryCondition<2> {
    BoundaryCondition::WallMotion(field(displacement))
}

fn turned(x: &[f64; 2], about: [f64; 2], angle: f64) -> [f64; 2] {
    let [a, b] = [x[0] - about[0], x[1] - about[1]];
    let (sine, cosine) = angle.sin_cos();
    [cosine * a - sine * b - a, sine * a + cosine * b - b]
}

fn fluid(mesh: Mesh<2>, conditions: &[(&str, BoundaryCondition<2>)], time: TimeScheme) -> FluidSolver<2> {
    FluidSolver::new(mesh, model(boundary(conditions)), pinned(time)).expect("a fluid")
}

/// Steps of changing size; after each, the equation that the pin replaces holds like the others.
fn runs(mut fluid: FluidSolver<2>, of: &str) {
    let mut t = 0.0;
    for dt in [0.05, 0.05, 0.1, 0.025, 0.05] {
        t += dt;
        fluid.begin_step(t, dt).unwrap_or_else(|error| panic!("{of}: {error}"));
        exhaust(&mut fluid);
        let largest = fluid.residual().iter().skip(2).step_by(3).fold(0.0, |most: f64, r| most.max(r.abs()));
        assert!(largest < 1e-12, "{of}, t = {t} s: continuity misses {largest:e} m2/s");
        assert!(fluid.volume_defect().abs() < 1e-12, "{of}: {:e}", fluid.volume_defect());
        fluid.commit();
    }
    let fastest = fluid.values().iter().step_by(3).fold(0.0, |most: f64, u| most.max(u.abs()));
    assert!(fastest > 0.05, "{of}: the fluid moves, {fastest}");
}

#[test]
fn a_body_that_shifts_or_turns_in_a_shell_keeps_the_volume_at_every_step() {
    for time in [BDF1, BDF2] {
        for (shape, mesh) in [("round", round()), ("lopsided", lopsided())] {
            let shift = moving(|_, t| [0.1 * (5.0 * t).sin(), 0.4 * t * t]);
            let turn = moving(|x, t| turned(x, [0.0, 0.0], 2.0 * t));
            let swing = moving(|x, t| turned(x, [0.3, -0.1], 0.5 * (4.0 * t).sin()));
            let both = moving(|x, t| {
                let turned = turned(x, [0.1, 0.0], t);
                [turned[0] + 0.1 * t, turned[1] - 0.1 * t]
            });
            for (name, motion) in [("shift", shift), ("turn", turn), ("swing", swing), ("both", both)] {
                let conditions = [("body", motion), ("shell", BoundaryCondition::NoSlip)];
                runs(fluid(mesh.clone(), &conditions, time), &format!("{shape} {name} {time:?}"));
            }
        }
    }
}

/// The surface of a wheel that turns: tangential, although the chords of its nodes' ways are not.
#[test]
fn a_turning_wheel_pushes_no_fluid_off_its_rim() {
    let turn = moving(|x, t| turned(x, [0.0, 0.0], 3.0 * t));
    let mut fluid = fluid(round(), &[("body", turn), ("shell", BoundaryCondition::NoSlip)], BDF1);
    fluid.begin_step(0.1, 0.1).expect("a step");
    for node in 0..AROUND {
        let [x, y] = fluid.points()[node];
        let [u, v] = [fluid.values()[3 * node], fluid.values()[3 * node + 1]];
        assert!((u * x + v * y).abs() < 1e-14, "{u}, {v} at {x}, {y}");
        let [a, b] = [fluid.mesh_velocity()[2 * node], fluid.mesh_velocity()[2 * node + 1]];
        assert!((a * x + b * y).abs() > 0.05, "the difference quotient has a radial part");
    }
}

/// A whole tank that is shaken: the fluid moves as one body, under a pressure that is linear.
#[test]
fn a_tank_that_shifts_carries_its_fluid_along() {
    for time in [BDF1, BDF2] {
        let mesh = unit_square(4);
        let shake = moving(|_, t| [0.2 * (1.0 - (3.0 * t).cos()), 0.1 * t * t]);
        let mut fluid =
            FluidSolver::new(mesh.clone(), model(everywhere(&mesh, &shake)), pinned(time)).expect("a fluid");
        let mut velocity = [[0.0; 2]; 2];
        for k in 1..5 {
            fluid.begin_step(0.1 * f64::from(k), 0.1).expect("a step");
            fluid.advance(Limit::ToConvergence).expect("convergence");
            let w = [fluid.mesh_velocity()[0], fluid.mesh_velocity()[1]];
            assert!(velocity_error(&fluid, |_| w) < 1e-11);
            let weights = if time == BDF2 && k > 1 { [1.5, -2.0, 0.5] } else { [1.0, -1.0, 0.0] };
            let rate = |c: usize| {
                (weights[0] * w[c] + weights[1] * velocity[0][c] + weights[2] * velocity[1][c]) / 0.1
            };
            let (force, origin) = ([0, 1].map(|c| -1.2 * rate(c)), fluid.points()[0]);
            let linear = |x: &[f64; 2]| force[0] * (x[0] - origin[0]) + force[1] * (x[1] - origin[1]);
            assert!(pressure_error(&fluid, linear) < 1e-9);
            fluid.commit();
            velocity = [w, velocity[0]];
        }
    }
}

fn pistons(left: f64, right: f64) -> Vec<(&'static str, BoundaryCondition<2>)> {
    let sides = [("left", left), ("right", right)]
        .map(|(group, speed)| (group, moving(move |_, t| [speed * t, 0.0])));
    let walls = ["bottom", "top"].map(|group| (group, BoundaryCondition::Slip));
    sides.into_iter().chain(walls).collect()
}

fn sliding(time: TimeScheme) -> FluidSettings {
    FluidSettings { mesh_slide: ["bottom", "top"].map(String::from).to_vec(), ..pinned(time) }
}

#[test]
fn walls_that_squeeze_a_closed_fluid_are_refused_with_time_and_flux() {
    let with = |conditions: &[(&str, BoundaryCondition<2>)]| {
        FluidSolver::new(unit_square(4), model(boundary(conditions)), sliding(BDF1)).expect("a fluid")
    };
    let mut together = with(&pistons(0.3, 0.3));
    for k in 1..4 {
        step(&mut together, 0.1 * f64::from(k), 0.1);
        assert!(velocity_error(&together, |_| [0.3, 0.0]) < 1e-11);
    }
    let mut squeeze = with(&pistons(0.3, 0.299));
    insta::assert_snapshot!(with_hint(&squeeze.begin_step(0.1, 0.1).expect_err("a refusal")), @r"
    t = 0.1 s, fluid: moving walls and prescribed velocities carry a net -1.000e-3 m^2/s out of a closed domain (5.990e-1 m^2/s pass its boundary)
    hint: make one boundary an outflow or a traction, or let the walls enclose the same volume at all times
    ");
    let grow = moving(|x, t| [0.1 * t * x[0], 0.1 * t * x[1]]);
    let mut growing = fluid(round(), &[("body", grow), ("shell", BoundaryCondition::NoSlip)], BDF2);
    assert!(matches!(growing.begin_step(0.1, 0.1), Err(FluidError::NetFlux { moves: true, .. })));
    // Of equal area only as a smooth curve: its polygon is not.
    let squash = moving(|x, t| [x[0] * (0.5 * t).exp() - x[0], x[1] * (-0.45 * t).exp() - x[1]]);
    let mut squashed = fluid(round(), &[("body", squash), ("shell", BoundaryCondition::NoSlip)], BDF2);
    assert!(matches!(squashed.begin_step(0.1, 0.1), Err(FluidError::NetFlux { .. })));
    // Of equal area as a polygon, too.
    let shear = moving(|x, t| [0.5 * t * x[1], 0.0]);
    runs(fluid(round(), &[("body", shear), ("shell", BoundaryCondition::NoSlip)], BDF2), "shear");
}

#[test]
fn a_piston_may_drive_fluid_through_an_opening_of_given_velocity() {
    let drive = |speed: f64| {
        let mut conditions = pistons(0.2, 0.0);
        conditions[1].1 = BoundaryCondition::Velocity(field(move |_, _| [speed, 0.0]));
        FluidSolver::new(unit_square(4), model(boundary(&conditions)), sliding(BDF2)).expect("a fluid")
    };
    let mut balanced = drive(0.2);
    for k in 1..4 {
        step(&mut balanced, 0.1 * f64::from(k), 0.1);
    }
    assert!(velocity_error(&balanced, |_| [0.2, 0.0]) < 1e-11);
    assert!(matches!(drive(0.21).begin_step(0.1, 0.1), Err(FluidError::NetFlux { moves: true, .. })));
}

#[test]
fn what_flows_in_must_flow_out() {
    let through = |out: f64| {
        let conditions = boundary(&[
            ("left", BoundaryCondition::Velocity(field(|x: &[f64; 2], t| [t * x[1] * (1.0 - x[1]), 0.0]))),
            (
                "right",
                BoundaryCondition::Velocity(field(move |x: &[f64; 2], t| {
                    [out * t * x[1] * (1.0 - x[1]), 0.0]
                })),
            ),
            ("bottom", BoundaryCondition::NoSlip),
            ("top", BoundaryCondition::NoSlip),
        ]);
        FluidSolver::new(unit_square(4), model(conditions), pinned(BDF1)).expect("a fluid")
    };
    let mut balanced = through(1.0);
    step(&mut balanced, 0.1, 0.1);
    assert!(balanced.check_prescribed(0.1, 0.1).is_ok());
    for out in [0.0, 0.999, 1.001, -1.0] {
        let mut unbalanced = through(out);
        let foreseen = unbalanced.check_prescribed(0.1, 0.1).expect_err("a refusal");
        assert_eq!(unbalanced.begin_step(0.1, 0.1), Err(foreseen));
    }
}

/// A spinning wall does not move its mesh: the velocity of a turning cylinder is given on a circle at rest.
#[test]
fn a_rim_of_given_velocity_spins_in_a_shell() {
    let spin = BoundaryCondition::Velocity(field(|x: &[f64; 2], _| [-x[1], x[0]]));
    runs(fluid(round(), &[("body", spin.clone()), ("shell", BoundaryCondition::NoSlip)], BDF1), "spin");
    runs(fluid(lopsided(), &[("body", spin), ("shell", BoundaryCondition::NoSlip)], BDF2), "lopsided spin");
}

/// Far from the origin and in late steps, a difference of coordinates is round-off: no flux.
#[test]
fn a_wall_that_comes_to_rest_is_at_rest() {
    let far = {
        let mesh = round();
        let points = mesh.points().iter().map(|x| [x[0] + 1000.0, x[1] - 300.0]).collect();
        mesh.with_points(points).expect("a mesh")
    };
    let stop = moving(|x, t| turned(x, [1000.0, -300.0], 0.3 * (60.0 * t).tanh()));
    let mut fluid = fluid(far, &[("body", stop), ("shell", BoundaryCondition::NoSlip)], BDF2);
    for k in 1..20 {
        step(&mut fluid, 0.05 * f64::from(k), 0.05);
    }
    let moves = fluid.mesh_velocity().iter().fold(0.0, |most: f64, w| most.max(w.abs()));
    assert!(moves < 1e-9, "{moves}");
}

#[test]
fn check_foresees_what_a_later_step_refuses() {
    let late = |t: f64| 0.1 * (t - 0.35).max(0.0);
    let grow = moving(move |x, t| [late(t) * x[0], late(t) * x[1]]);
    let mut fluid = fluid(round(), &[("body", grow), ("shell", BoundaryCondition::NoSlip)], BDF2);
    for k in 1..4 {
        assert!(fluid.check_prescribed(0.1 * f64::from(k), 0.1).is_ok());
        step(&mut fluid, 0.1 * f64::from(k), 0.1);
    }
    let foreseen = fluid.check_prescribed(0.4, 0.1).expect_err("a refusal");
    assert_eq!(fluid.begin_step(0.4, 0.1), Err(foreseen));
}

fn box_in_space(motion: impl Fn(&[f64; 3], f64) -> [f64; 3] + Send + Sync + 'static) -> FluidSolver<3> {
    let mesh = unit_cube(2);
    let walls = BoundaryCondition::WallMotion(field(motion));
    let model = model(everywhere(&mesh, &walls));
    FluidSolver::new(mesh, model, pinned(BDF2)).expect("a fluid")
}

#[test]
fn a_turning_box_in_space_keeps_its_volume() {
    let mut fluid = box_in_space(|x, t| {
        let (sine, cosine) = (0.8 * t).sin_cos();
        let axis = [1.0 / 3.0, 2.0 / 3.0, 2.0 / 3.0];
        let along: f64 = (0..3).map(|i| axis[i] * x[i]).sum();
        std::array::from_fn(|i| {
            let (j, k) = ((i + 1) % 3, (i + 2) % 3);
            let across = axis[j] * x[k] - axis[k] * x[j];
            (cosine - 1.0) * (x[i] - along * axis[i]) + sine * across
        })
    });
    for k in 1..4 {
        step(&mut fluid, PI / 20.0 * f64::from(k), PI / 20.0);
        assert!(fluid.volume_defect().abs() < 1e-13, "{:e}", fluid.volume_defect());
    }
}

/// Along the straight ways of its corners its volume is a cubic polynomial: their area vectors need more than two points.
#[test]
fn a_box_in_space_that_is_stretched_and_squeezed_keeps_its_volume() {
    let mut fluid = box_in_space(|x, t| {
        let (a, b) = (1.0 + 0.5 * t, 1.0 + 0.8 * t);
        [(a - 1.0) * x[0], (b - 1.0) * x[1], (1.0 / (a * b) - 1.0) * x[2]]
    });
    for k in 1..4 {
        step(&mut fluid, 0.1 * f64::from(k), 0.1);
        assert!(fluid.volume_defect().abs() < 1e-13, "{:e}", fluid.volume_defect());
    }
}
