//! A boundary that moves: velocities, forces, balance of volume.
use partita_numerics::Field;

use partita_fluid::{BodyForce, BoundaryCondition, FluidModel, FluidSettings, FluidSolver, TimeScheme};
use partita_mesh::motion::{MotionMode, MotionSettings};
use partita_numerics::newton::Limit;

use crate::common::*;

const DENSITY: f64 = 1000.0;
const GRAVITY: f64 = 9.81;

/// A tank with slip walls whose bottom is a piston.
fn piston(time: TimeScheme, bottom: BoundaryCondition<2>, mode: MotionMode) -> FluidSolver<2> {
    let model = FluidModel {
        density: DENSITY,
        viscosity: 0.3,
        body_force: BodyForce::Constant([0.0, -GRAVITY]),
        ..model(boundary(&[
            ("left", BoundaryCondition::Slip),
            ("right", BoundaryCondition::Slip),
            ("bottom", bottom),
            ("top", BoundaryCondition::StressFree { backflow: false }),
        ]))
    };
    let settings = FluidSettings {
        mesh_slide: ["left", "right"].map(String::from).to_vec(),
        motion: MotionSettings { mode, ..MotionSettings::default() },
        ..settings(time)
    };
    FluidSolver::new(unit_square(5), model, settings).expect("a fluid")
}

fn height(t: f64) -> f64 {
    0.05 * (1.0 - (3.0 * t).cos())
}

fn raise(fluid: &mut FluidSolver<2>, by: f64) {
    let rise: Vec<f64> = fluid.interface_nodes().iter().flat_map(|_| [0.0, by]).collect();
    fluid.impose(&rise).expect("a motion");
}

/// Uniform motion and a pressure that is linear: rho (`D_t` v + g) times the depth, to round-off.
#[test]
fn piston_moves_the_fluid_as_one_body() {
    for time in [BDF1, BDF2] {
        for mode in [MotionMode::Reference, MotionMode::Incremental] {
            let mut fluid = piston(time, BoundaryCondition::Interface, mode);
            let (mut h, mut v) = ([0.0; 2], [0.0; 2]);
            for k in 1..6 {
                let (t, dt) = (0.1 * f64::from(k), 0.1);
                let weights = if time == BDF2 && k > 1 { [1.5, -2.0, 0.5] } else { [1.0, -1.0, 0.0] };
                let rate = |now: f64, old: [f64; 2]| {
                    (weights[0] * now + weights[1] * old[0] + weights[2] * old[1]) / dt
                };
                fluid.begin_step(t, dt).expect("a step");
                raise(&mut fluid, height(t));
                fluid.advance(Limit::ToConvergence).expect("convergence");
                let velocity = rate(height(t), h);
                let weight = DENSITY * (GRAVITY + rate(velocity, v));
                assert!(velocity_error(&fluid, |_| [0.0, velocity]) < 1e-10);
                assert!(pressure_error(&fluid, |x| weight * (1.0 - x[1])) < 1e-7);
                let force = fluid.force_on("bottom").expect("a group")[1];
                assert!((force + weight * (1.0 - height(t))).abs() < 1e-7, "{force}");
                assert!(fluid.volume_defect().abs() < 1e-13, "{:e}", fluid.volume_defect());
                fluid.commit();
                (h, v) = ([height(t), h[0]], [velocity, v[0]]);
            }
        }
    }
}

#[test]
fn wall_with_a_motion_of_its_own_equals_an_interface_moved_alike() {
    let wall = BoundaryCondition::WallMotion(field(|_, t| [0.0, height(t)]));
    let mut wall = piston(BDF2, wall, MotionMode::Reference);
    let mut interface = piston(BDF2, BoundaryCondition::Interface, MotionMode::Reference);
    assert!(wall.interface_nodes().is_empty() && !interface.interface_nodes().is_empty());
    for k in 1..4 {
        let t = 0.1 * f64::from(k);
        step(&mut wall, t, 0.1);
        interface.begin_step(t, 0.1).expect("a step");
        raise(&mut interface, height(t));
        interface.advance(Limit::ToConvergence).expect("convergence");
        interface.commit();
        assert_eq!(wall.values(), interface.values());
        assert_eq!(wall.displacement(), interface.displacement());
    }
}

#[test]
fn new_interface_data_of_a_round_replaces_the_old() {
    let mut direct = piston(BDF1, BoundaryCondition::Interface, MotionMode::Reference);
    direct.begin_step(0.1, 0.1).expect("a step");
    raise(&mut direct, 0.02);
    direct.advance(Limit::ToConvergence).expect("convergence");
    let mut rounds = piston(BDF1, BoundaryCondition::Interface, MotionMode::Reference);
    rounds.begin_step(0.1, 0.1).expect("a step");
    for height in [0.05, -0.01, 0.02] {
        raise(&mut rounds, height);
        rounds.advance(Limit::ToConvergence).expect("convergence");
    }
    for (one, other) in direct.values().iter().zip(rounds.values()) {
        assert!((one - other).abs() < 1e-9 * (1.0 + one.abs()), "{one} and {other}");
    }
    assert_eq!(direct.displacement(), rounds.displacement());
}

/// The fluid takes in the flux of w, the shape changes by `D_t` of the area: equal up to O(dt^order) where the
/// boundary moves both ways.
#[test]
fn volume_defect_falls_with_the_order_of_the_scheme() {
    let defect = |time: TimeScheme, steps: u32| -> f64 {
        let mut fluid = piston(time, BoundaryCondition::Interface, MotionMode::Reference);
        let dt = 0.4 / f64::from(steps);
        let mut last = 0.0;
        for k in 1..=steps {
            let t = dt * f64::from(k);
            fluid.begin_step(t, dt).expect("a step");
            let moved = |node: &usize| {
                let x = fluid.mesh().points()[*node][0];
                let bubble = t * t * (1.0 + t) * x * (1.0 - x);
                [2.0 * bubble * x, 3.0 * bubble * (1.0 - x)]
            };
            let displacement: Vec<f64> = fluid.interface_nodes().iter().flat_map(moved).collect();
            fluid.impose(&displacement).expect("a motion");
            last = fluid.volume_defect();
            fluid.commit();
        }
        last.abs()
    };
    let first = defect(BDF1, 20) / defect(BDF1, 40);
    let second = defect(BDF2, 20) / defect(BDF2, 40);
    assert!((1.8..2.2).contains(&first), "{first}");
    assert!((3.5..4.6).contains(&second), "{second}");
}

/// Pressure amplitude that the acceleration cos(n pi x) of the bottom of a unit tank raises there, from the
/// first step out of rest, without viscosity: measured in the interface forces.
fn added_mass(n: u32, divisions: usize) -> f64 {
    let model = FluidModel {
        density: DENSITY,
        viscosity: 0.0,
        ..model(boundary(&[
            ("left", BoundaryCondition::Slip),
            ("right", BoundaryCondition::Slip),
            ("bottom", BoundaryCondition::Interface),
            ("top", BoundaryCondition::StressFree { backflow: false }),
        ]))
    };
    let slide = ["left", "right"].map(String::from).to_vec();
    let settings = FluidSettings { mesh_slide: slide, ..settings(BDF1) };
    let mut fluid = FluidSolver::new(unit_square(divisions), model, settings).expect("a fluid");
    let (dt, amplitude) = (0.01, 1e-6);
    let mode = |x: f64| (f64::from(n) * std::f64::consts::PI * x).cos();
    let places: Vec<f64> =
        fluid.interface_nodes().iter().map(|node| fluid.mesh().points()[*node][0]).collect();
    let rise: Vec<f64> = places.iter().flat_map(|x| [0.0, amplitude * mode(*x)]).collect();
    fluid.begin_step(dt, dt).expect("a step");
    fluid.impose(&rise).expect("a motion");
    fluid.advance(Limit::ToConvergence).expect("convergence");
    let mut force = vec![0.0; rise.len()];
    fluid.output(&mut force);
    let work: f64 = places.iter().zip(force.chunks_exact(2)).map(|(x, f)| -f[1] * mode(*x)).sum();
    let norm = if n == 0 { 1.0 } else { 0.5 }; // integral of cos^2
    work / (norm * amplitude / (dt * dt))
}

#[test]
fn bottom_feels_the_added_mass_of_the_tank() {
    assert!((added_mass(0, 5) / DENSITY - 1.0).abs() < 1e-5, "the whole tank: {}", added_mass(0, 5));
    for n in [1, 2] {
        let wave = f64::from(n) * std::f64::consts::PI;
        let exact = DENSITY / wave * wave.tanh();
        let error = |divisions| (added_mass(n, divisions) / exact - 1.0).abs();
        // Of order one: the interface holds the tangential velocity too, in a layer of one element.
        let (coarse, fine) = (error(20), error(40));
        println!("mode {n}: off by {coarse:.1e} at 20, {fine:.1e} at 40 divisions");
        assert!(coarse < 0.03 && fine < 0.75 * coarse, "mode {n}: {coarse} at 20, {fine} at 40 divisions");
    }
}
