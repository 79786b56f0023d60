//! The work at the interface of a real run, as the fluid gives it and as the structure gets it.
use partita_numerics::Field;

use partita::build::{self, FieldMarch};
use partita_coupling::Record;
use partita_structure::StructureSolver;

use crate::linear_tank::tank;

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

fn difference(a: &[f64], b: &[f64]) -> Vec<f64> {
    a.iter().zip(b).map(|(a, b)| a - b).collect()
}

fn structure(run: &FieldMarch) -> &StructureSolver<2> {
    run.second().field().expect("the tank has a bottom")
}

fn energy(run: &FieldMarch) -> f64 {
    structure(run).kinetic_energy() + structure(run).strain_energy()
}

/// The tank with a bottom that keeps energy (radius 1, Hooke's law), coupled as tightly as round-off allows.
fn tight(overrides: &[&str]) -> (FieldMarch, f64) {
    let mut given = vec![
        "fluid.mesh.rectangle.divisions=[8,8]",
        "fluid.body_force=[0.0,-9.81]",
        "fluid.newton.tolerance={relative=1e-11}",
        "structure.newton.tolerance={relative=1e-11}",
        "coupling.acceleration={iqn_ils={}}",
        "coupling.convergence={interface_residual={relative=1e-11}}",
        "coupling.max_iterations=60",
        "coupling.on_limit=fail",
    ];
    given.extend(overrides);
    let resolved = tank(&given);
    (build::march(&resolved).expect("the scene builds"), resolved.scene.time.step.get())
}

/// The fluid moves its boundary with F_{n+1}, the structure balances F at n+1-alpha_f. What the fluid gives beyond what
/// the structure's energy gains is therefore
///
/// ```text
/// f.(H dx) - (E_{n+1} - E_n) = alpha_f (F_{n+1} - F_n).dd
/// ```
///
/// The left side is measured: nodal forces and mesh displacement of the fluid, energies of the structure.
#[test]
fn work_lost_at_the_interface_is_that_of_the_averaged_load() {
    let alpha_f = 0.5;
    let (mut run, dt) = tight(&[]);
    let mut lost = 0.0_f64;
    for _ in 0..6 {
        let (before, moved, start) =
            (structure(&run).state().clone(), run.interface().displacement.clone(), energy(&run));
        run.step(dt, &mut ()).expect("the step converges");
        let (after, interface) = (structure(&run).state(), run.interface());
        let given = dot(&interface.load, &difference(&interface.displacement, &moved));
        let gained = energy(&run) - start;
        let load = difference(&after.interface_force, &before.interface_force);
        let motion = difference(&interface.x_tilde, &at_interface(&run, &before.displacement));
        let expected = alpha_f * dot(&load, &motion);
        assert!(
            (given - gained - expected).abs() < 1e-8 * given.abs(),
            "given {given:e}, gained {gained:e}, lost {:e}, expected {expected:e}",
            given - gained
        );
        assert!((run.interface_work() - given).abs() < 1e-8 * given.abs());
        lost = lost.max(expected.abs() / given.abs());
    }
    assert!(lost > 1e-2, "the defect is far above what is asked of it: {lost:e}");
}

/// Entries of all control points at those of the interface.
fn at_interface(run: &FieldMarch, all: &[f64]) -> Vec<f64> {
    structure(run).interface_points().iter().flat_map(|point| [all[2 * point], all[2 * point + 1]]).collect()
}

/// What one field sends is what the other one works with, to the bit.
#[test]
fn both_fields_hold_the_data_of_the_interface() {
    let (mut run, dt) = tight(&[]);
    for _ in 0..3 {
        run.step(dt, &mut ()).expect("the step converges");
        let interface = run.interface();
        let fluid = run.first().field().expect("the tank has a fluid");
        let nodes = fluid.interface_nodes().iter();
        let moved: Vec<f64> =
            nodes.flat_map(|n| [fluid.displacement()[2 * n], fluid.displacement()[2 * n + 1]]).collect();
        let mut forces = vec![0.0; moved.len()];
        fluid.output(&mut forces);
        assert!(!moved.is_empty() && moved.iter().any(|d| *d != 0.0) && forces.iter().any(|f| *f != 0.0));
        assert_eq!(moved, interface.displacement);
        assert_eq!(forces, interface.load);
        assert_eq!(structure(&run).state().interface_force, interface.transferred_load);
        assert_eq!(at_interface(&run, structure(&run).values()), interface.x_tilde);
    }
}

#[test]
fn virtual_work_survives_every_transfer() {
    let (mut run, dt) = tight(&[]);
    let mut records: Vec<Record> = Vec::new();
    for _ in 0..4 {
        run.step(dt, &mut records).expect("the step converges");
    }
    let defects: Vec<f64> = records
        .iter()
        .filter_map(|record| match record {
            Record::Iteration(iteration) => Some(iteration.work_defect),
            Record::Step(_) | Record::Retry(_) => None,
        })
        .collect();
    assert!(defects.len() > 12, "{} iterations", defects.len());
    assert!(defects.iter().all(|defect| *defect < 1e-14), "{defects:?}");
}

/// The fluid's boundary lies on the structure's surface: each node where the spline is at its place. Work, energy and
/// total force cannot tell control points that changed places in H, for its transpose sends the loads after them.
#[test]
fn fluid_boundary_lies_on_the_surface_of_the_structure() {
    // As many edges as spline elements, so that every control point moves some node; a load without symmetry.
    let (mut run, dt) = tight(&[
        "fluid.mesh.rectangle.divisions=[20,8]",
        "fluid.body_force=[4.0,-9.81]",
        "coupling.transfer=interpolation",
    ]);
    for _ in 0..2 {
        run.step(dt, &mut ()).expect("the step converges");
    }
    let fluid = run.first().field().expect("the tank has a fluid");
    let sag = structure(&run).displacement_at(&[0.5, 1.0])[1].abs();
    assert!(sag > 0.0, "the bottom gives way");
    assert_eq!((fluid.interface_nodes().len(), run.interface().displacement.len()), (21, 42));
    for (&node, moved) in fluid.interface_nodes().iter().zip(run.interface().displacement.chunks_exact(2)) {
        let place = fluid.mesh().points()[node][0]; // the tank is one metre wide
        let surface = structure(&run).displacement_at(&[place, 1.0]);
        for c in 0..2 {
            assert!((moved[c] - surface[c]).abs() < 1e-8 * sag, "x = {place}: {moved:?} and {surface:?}");
        }
    }
}
