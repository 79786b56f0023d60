//! Flow without convection: linear equations, whose factor serves as long as mesh and step size stay.
use partita_numerics::Field;

use partita_fluid::{BoundaryCondition, FluidSettings, FluidSolver, TimeScheme};
use partita_numerics::newton::{Limit, Report};

use crate::common::{
    BDF1, BDF2, Noise, boundary, everywhere, field, inner_motion, model, perturbed, settings, unit_square,
};

/// A channel whose inflow grows with time.
fn channel(inflow: f64, settings: FluidSettings) -> FluidSolver<2> {
    let profile = field(move |x: &[f64; 2], t| [inflow * (1.0 + t) * x[1] * (1.0 - x[1]), 0.0]);
    let conditions = boundary(&[
        ("left", BoundaryCondition::Velocity(profile)),
        ("right", BoundaryCondition::DoNothing { backflow: false }),
        ("bottom", BoundaryCondition::NoSlip),
        ("top", BoundaryCondition::NoSlip),
    ]);
    FluidSolver::new(perturbed(&unit_square(6), 0.02, 5), model(conditions), settings).expect("a fluid")
}

fn stokes(time: TimeScheme) -> FluidSettings {
    FluidSettings { convection: false, ..settings(time) }
}

fn steps(fluid: &mut FluidSolver<2>, sizes: &[f64]) -> Vec<Report> {
    let mut time = fluid.state().time;
    let mut step = |dt: f64| {
        time += dt;
        fluid.begin_step(time, dt).expect("a step");
        let report = fluid.advance(Limit::ToConvergence).expect("convergence");
        fluid.commit();
        report
    };
    sizes.iter().map(|dt| step(*dt)).collect()
}

fn factorizations(reports: &[Report]) -> Vec<usize> {
    reports.iter().map(|report| report.factorizations).collect()
}

#[test]
fn one_factor_serves_as_long_as_the_step_size_stays() {
    let reports = steps(&mut channel(1.0, stokes(BDF1)), &[0.1; 4]);
    assert_eq!(factorizations(&reports), [1, 0, 0, 0]);
    for report in &reports {
        assert_eq!((report.solves, report.assemblies, report.tangents), (1, 2, report.factorizations));
        assert!(report.exit.relative < 1e-12, "{report:?}");
    }
    let reports = steps(&mut channel(1.0, stokes(BDF1)), &[0.1, 0.1, 0.05, 0.05, 0.1]);
    assert_eq!(factorizations(&reports), [1, 0, 1, 0, 1]);
    // The first step of BDF2 is one of BDF1.
    let reports = steps(&mut channel(1.0, stokes(BDF2)), &[0.1; 4]);
    assert_eq!(factorizations(&reports), [1, 1, 0, 0]);
    // A steady flow does not know the step size.
    let reports = steps(&mut channel(1.0, stokes(TimeScheme::Steady)), &[0.1, 0.2, 0.3]);
    assert_eq!(factorizations(&reports), [1, 0, 0]);
}

#[test]
fn convection_takes_more() {
    let reports = steps(&mut channel(1.0, settings(BDF1)), &[0.1; 3]);
    assert!(reports.iter().all(|report| report.factorizations == report.solves && report.solves > 1));
}

#[test]
fn twice_the_inflow_is_twice_the_flow() {
    let mut flows = [1.0, 2.0].map(|inflow| channel(inflow, stokes(BDF2)));
    for fluid in &mut flows {
        steps(fluid, &[0.1; 3]);
    }
    let largest = flows[0].values().iter().fold(0.0_f64, |largest, x| largest.max(x.abs()));
    for (one, two) in flows[0].values().iter().zip(flows[1].values()) {
        assert!((two - 2.0 * one).abs() < 1e-12 * largest, "{one} and {two}");
    }
}

#[test]
fn the_tangent_is_the_whole_derivative_on_a_moving_mesh_too() {
    let mesh = unit_square(6);
    let slide = field(|x: &[f64; 2], t| [t * x[1], 0.0]);
    let mut conditions = everywhere(&mesh, &BoundaryCondition::Velocity(slide));
    conditions.retain(|(group, _)| group != "right");
    conditions.push(("right".to_owned(), BoundaryCondition::StressFree { backflow: true }));
    let mut fluid = FluidSolver::new(mesh.clone(), model(conditions), stokes(BDF1)).expect("a fluid");
    let mut numbers = Noise::new(8);
    for n in 1..=3 {
        fluid.begin_step(0.1 * f64::from(n), 0.1).expect("a step");
        fluid.impose_mesh(&inner_motion(&mesh, 0.02, &mut numbers)).expect("no inverted cells");
        let report = fluid.advance(Limit::ToConvergence).expect("convergence");
        fluid.commit();
        // The mesh has moved, so the factor is new; the equations are linear, so once is enough.
        assert_eq!((report.iterations, report.factorizations), (1, 1), "step {n}");
    }
}

#[test]
fn a_step_that_is_given_up_takes_its_factor_along() {
    let mut fluid = channel(1.0, stokes(BDF1));
    fluid.begin_step(0.1, 0.1).expect("a step");
    fluid.advance(Limit::ToConvergence).expect("convergence");
    fluid.rewind();
    assert!(fluid.reusable_tangent().is_none());
    assert_eq!(factorizations(&steps(&mut fluid, &[0.1, 0.1])), [1, 0]);
}

#[test]
fn a_restored_tangent_gives_the_same_bits() {
    let mut whole = channel(1.0, stokes(BDF1));
    steps(&mut whole, &[0.1, 0.1]);
    let mut resumed = channel(1.0, stokes(BDF1));
    resumed.restore(whole.state()).expect("the state fits");
    resumed.restore_tangent(&whole.reusable_tangent().expect("a factor")).expect("the tangent fits");
    assert_eq!(steps(&mut whole, &[0.1; 2]), steps(&mut resumed, &[0.1; 2]));
    assert_eq!(whole.state(), resumed.state());
    let other = perturbed(&unit_square(5), 0.02, 5);
    let wall = everywhere(&other, &BoundaryCondition::StressFree { backflow: false });
    let mut other = FluidSolver::new(other, model(wall), stokes(BDF1)).expect("a fluid");
    let error =
        other.restore_tangent(&whole.reusable_tangent().expect("a factor")).expect_err("another mesh");
    assert!(error.to_string().contains("entries of the kept tangent"), "{error}");
}

#[test]
fn a_rigid_interface_gives_its_forces_and_takes_no_displacement() {
    let mut conditions = boundary(&[
        ("left", BoundaryCondition::Slip),
        ("right", BoundaryCondition::Slip),
        ("top", BoundaryCondition::StressFree { backflow: false }),
        ("bottom", BoundaryCondition::RigidInterface),
    ]);
    let weight = |conditions: &[(String, BoundaryCondition<2>)]| {
        let mut model = model(conditions.to_vec());
        model.body_force = partita_fluid::BodyForce::Constant([0.0, -10.0]);
        let mut fluid = FluidSolver::new(unit_square(4), model, settings(BDF1)).expect("a fluid");
        steps(&mut fluid, &[0.1]);
        fluid
    };
    let rigid = weight(&conditions);
    assert!(rigid.mesh_motion().is_none());
    let mut forces = vec![0.0; 2 * rigid.interface_nodes().len()];
    rigid.output(&mut forces);
    let total: f64 = forces.chunks_exact(2).map(|force| force[1]).sum();
    assert!((total + 12.0).abs() < 1e-9, "{total} N/m");
    // A wall that is no interface holds the same.
    conditions[3].1 = BoundaryCondition::NoSlip;
    assert_eq!(weight(&conditions).state(), rigid.state());
}
