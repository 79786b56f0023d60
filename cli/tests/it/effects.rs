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
