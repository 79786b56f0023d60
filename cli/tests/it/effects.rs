//! What runs costs, and what does not run costs nothing: counts of assemblies, factorizations and solves.

use std::path::Path;

use partita::build;
use partita::output::Totals;
use partita::scene::{self, Resolved};
use partita_coupling::record::StepRecord;

fn tank(overrides: &[&str]) -> Resolved {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../scenes/elastic-bottom");
    let overrides: Vec<String> = overrides.iter().map(|&given| given.to_owned()).collect();
    scene::load(&folder, &overrides).expect("the scene is sound")
}

/// The first steps of a scene.
fn steps(scene: &Resolved, count: usize) -> Vec<StepRecord> {
    let mut run = build::run(scene).expect("the scene builds");
    (0..count).map(|_| run.step(scene.scene.time.step.get(), &mut ()).expect("the step converges")).collect()
}

fn totals(steps: &[StepRecord]) -> Totals {
    let mut totals = Totals::default();
    for step in steps {
        totals.add(step);
    }
    totals
}

#[test]
fn the_work_of_each_field_is_counted() {
    let steps = steps(&tank(&[]), 3);
    let Totals { fluid, structure, coupling_iterations, .. } = totals(&steps);
    assert_eq!((fluid.calls, structure.calls), (coupling_iterations, coupling_iterations));
    for field in [fluid, structure] {
        assert_eq!((field.factorizations, field.solves), (field.newton, field.newton));
        assert_eq!(
            field.assemblies,
            field.newton + field.calls,
            "a residual at entry and one after each solve"
        );
        assert!((field.factorizations..=field.assemblies).contains(&field.details.tangents));
        assert_eq!(field.details.fallbacks, 0);
    }
    assert_eq!((fluid.details.mesh_factorizations, fluid.details.mesh_solves), (0, fluid.calls));
    assert_eq!((structure.details.mesh_factorizations, structure.details.mesh_solves), (0, 0));
}

#[test]
fn an_incremental_mesh_motion_is_factored_once_a_step() {
    let steps = steps(&tank(&["fluid.mesh_motion.mode=incremental"]), 2);
    assert!(steps.iter().all(|step| step.fields[0].details.mesh_factorizations == 1));
    assert!(steps.iter().all(|step| step.fields[0].details.mesh_solves == step.iterations));
}

/// Displacements of the interface after the last step.
fn after(scene: &Resolved, count: usize) -> (Vec<StepRecord>, Vec<f64>) {
    let mut run = build::run(scene).expect("the scene builds");
    let mut step = || run.step(scene.scene.time.step.get(), &mut ()).expect("the step converges");
    let steps = (0..count).map(|_| step()).collect();
    (steps, run.interface().x_tilde.clone())
}

/// |a - b| / |b|
fn distance(a: &[f64], b: &[f64]) -> f64 {
    let norm = |entries: &mut dyn Iterator<Item = f64>| entries.map(|x| x * x).sum::<f64>().sqrt();
    norm(&mut a.iter().zip(b).map(|(a, b)| a - b)) / norm(&mut b.iter().copied())
}

#[test]
fn reused_factors_are_fewer_and_lead_to_the_same_answer() {
    let tight = "coupling.convergence={changes=1e-8}";
    let (plain, expected) = after(&tank(&[tight]), 4);
    let reuse = ["fluid.newton.reuse_factor=0.5", "structure.newton.reuse_factor=0.5", tight];
    let (reused, found) = after(&tank(&reuse), 4);
    assert!(distance(&found, &expected) < 1e-7, "{:e}", distance(&found, &expected));
    let (plain, reused) = (totals(&plain), totals(&reused));
    for (plain, reused) in [(plain.fluid, reused.fluid), (plain.structure, reused.structure)] {
        assert!(4 * reused.factorizations < plain.factorizations, "{reused:?} for {plain:?}");
        assert_eq!(reused.solves, reused.newton);
        assert_eq!(reused.details.tangents, reused.factorizations);
        assert!(reused.newton > plain.newton, "linear convergence takes more of them");
    }
}
