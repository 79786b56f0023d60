//! A run as programs hold it.

use std::fs;

use partita::coupling::{Acceleration, CouplingSettings, QuasiNewton};
use partita::fluid::{BoundaryCondition, FluidModel, FluidSettings, FluidSolver};
use partita::mesh::generate::{RectangleMesh, rectangle};
use partita::structure::{StructureModel, StructureSettings, StructureSolver};
use partita::{Run, RunError, TransferMethod};

#[path = "../../examples/tank/mod.rs"]
mod tank;

fn coupled() -> Run {
    let structure = tank::structure(tank::rubber()).expect("a bottom");
    Run::couple(tank::fluid().expect("water"), structure).expect("they fit").with_steps(6, 0.01)
}

fn tip(run: &Run) -> f64 {
    run.structure().map_or(0.0, |structure| structure.displacement_at(&[0.5, 1.0])[1])
}

fn finish(run: &mut Run) -> f64 {
    while run.step().expect("the step converges") {}
    tip(run)
}

/// The files of a run's folder, the times left out.
fn files(dir: &std::path::Path) -> Vec<(String, String)> {
    let read = |name: &str| fs::read_to_string(dir.join(name)).expect("a table");
    ["steps.csv", "probes.csv", "run.json", "fluid.pvd", "structure.pvd"]
        .map(|name| (name.to_owned(), read(name)))
        .to_vec()
}

#[test]
fn a_folder_of_a_resumed_run_holds_the_same_files() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let [whole, parts] = ["whole", "parts"].map(|name| folder.path().join(name));
    let run = |dir| {
        let run = coupled().with_probe("tip", tip).with_output(dir);
        run.with_fields_every(2).with_checkpoint_every(3)
    };
    finish(&mut run(&whole));
    let mut first = run(&parts);
    for _ in 0..4 {
        first.step().expect("the step converges");
    }
    drop(first);
    let mut second = run(&parts);
    second.resume(&parts).expect("there is a checkpoint");
    assert_eq!(second.done(), 3, "the checkpoint is that of step 3");
    finish(&mut second);
    assert_eq!(files(&parts), files(&whole));
    let summary = fs::read_to_string(parts.join("summary.json")).expect("a summary");
    assert!(summary.contains("\"ending\": \"completed\"") && summary.contains("\"steps\": 6"), "{summary}");
    assert!(
        fs::read_to_string(parts.join("probes.csv")).expect("probes").starts_with("step,time,tip_value\n")
    );
}

#[test]
fn fields_of_any_name_have_their_columns_and_sums() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let dir = folder.path().join("run");
    let mut run = crate::examples::piston().expect("it can be built").with_output(&dir);
    while run.step().expect("the step converges") {}
    let steps = fs::read_to_string(dir.join("steps.csv")).expect("steps");
    let header = steps.lines().next().expect("a header");
    assert!(header.contains("fluid_calls") && header.contains("piston_calls"), "{header}");
    assert!(!header.contains("structure"), "{header}");
    let summary: serde_json::Value =
        serde_json::from_str(&fs::read_to_string(dir.join("summary.json")).expect("a summary"))
            .expect("JSON");
    let calls = summary["coupling_iterations"].as_u64().expect("a count");
    assert_eq!(summary["others"][0]["name"], "piston");
    assert_eq!(summary["others"][0]["work"]["calls"].as_u64(), Some(calls));
    let mut table = Vec::new();
    partita::output::tables::write(&dir, partita::output::tables::Rows::Iterations, &mut table)
        .expect("a table");
    let table = String::from_utf8(table).expect("text");
    assert!(table.starts_with("step,iteration,") && table.contains("piston_change"), "{table}");
    assert_eq!(table.lines().count() as u64, calls + 1);
}

#[test]
fn settings_and_transfer_can_be_chosen() {
    let constant = Acceleration::Constant { omega: 0.05 };
    let relaxed = CouplingSettings { acceleration: constant, ..CouplingSettings::default() };
    let mut slow = coupled().with_coupling(relaxed).expect("sound settings").with_steps(1, 0.01);
    let mut fast = coupled().with_steps(1, 0.01);
    let mut interpolated =
        coupled().with_transfer(TransferMethod::Interpolation).expect("it fits").with_steps(1, 0.01);
    let [slow_tip, fast_tip, other_tip] = [&mut slow, &mut fast, &mut interpolated].map(finish);
    assert!((slow_tip / fast_tip - 1.0).abs() < 1e-2, "{slow_tip} {fast_tip}");
    assert_ne!(other_tip.to_bits(), fast_tip.to_bits(), "another operator leads to other bits");
    let iterations = |run: &Run| run.march().history().iterations.len();
    assert!(iterations(&slow) > iterations(&fast));
    let wrong = Acceleration::IqnIls(QuasiNewton { omega_0: -1.0, ..QuasiNewton::default() });
    let wrong = CouplingSettings { acceleration: wrong, ..CouplingSettings::default() };
    assert!(coupled().with_coupling(wrong).is_err());
}

/// A fluid whose bottom does not move, under a lid that does.
fn cavity(bottom: BoundaryCondition<2>) -> FluidSolver<2> {
    use BoundaryCondition::{NoSlip, StressFree, Velocity};
    let mesh = rectangle(&RectangleMesh { divisions: [4, 4], ..Default::default() }).expect("a mesh");
    let wind = Velocity(std::sync::Arc::new(|_, t| [t.min(1.0), 0.0]));
    let boundary =
        [("left", wind), ("right", StressFree { backflow: false }), ("top", NoSlip), ("bottom", bottom)];
    FluidSolver::new(mesh, FluidModel::new(1.0, 0.1, boundary), FluidSettings::default()).expect("a fluid")
}

#[test]
fn one_field_alone_and_one_way_are_named() {
    let mut fluid = Run::fluid_alone(cavity(BoundaryCondition::NoSlip)).expect("it runs").with_steps(2, 0.1);
    while fluid.step().expect("it converges") {}
    assert!(fluid.fluid().expect("a fluid").kinetic_energy() > 0.0 && fluid.structure().is_none());

    let bottom = tank::structure(tank::rubber()).expect("a bottom");
    let mut structure = Run::structure_alone(bottom).expect("it runs").with_steps(2, 0.1);
    assert!(finish(&mut structure).abs() < f64::MIN_POSITIVE, "nothing loads it");

    let bottom = tank::structure(tank::rubber()).expect("a bottom");
    let fluid = cavity(BoundaryCondition::RigidInterface);
    let mut one_way = Run::one_way(fluid, bottom).expect("they fit").with_steps(2, 0.1);
    assert!(finish(&mut one_way).abs() > 0.0, "the pressure loads it");
    assert!(one_way.march().interface().x.is_empty(), "nothing comes back");
}

#[test]
fn errors_name_the_place_and_a_remedy() {
    let text = |error: RunError| partita_testing::with_hint(&error);
    let bottom = || tank::structure(tank::rubber()).expect("a bottom");
    let error = text(Run::couple(cavity(BoundaryCondition::NoSlip), bottom()).err().expect("no interface"));
    assert!(
        error.starts_with("fluid: it has no interface\nhint: ") && error.contains("Interface"),
        "{error}"
    );

    let patch = partita::iga::build::rectangle([0.0, -0.1], [1.0, 0.1], [2, 2], [8, 1]).expect("a patch");
    let dry = StructureModel::new(1.0, tank::rubber());
    let dry = StructureSolver::new(patch.into(), dry, StructureSettings::default()).expect("a structure");
    let error = text(Run::couple(tank::fluid().expect("water"), dry).err().expect("no interface"));
    assert!(
        error.starts_with("structure: it has no interface\nhint: ") && error.contains("wetted"),
        "{error}"
    );

    let mut run = Run::couple(tank::fluid().expect("water"), bottom()).expect("they fit");
    assert!(text(run.step().expect_err("no step")).contains("with_steps"));
    assert!(text(run.write_fields().expect_err("no folder")).contains("with_output"));

    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path().join("state");
    coupled().save(&path).expect("it can be saved");
    let error =
        text(crate::examples::piston().expect("it can be built").resume(&path).expect_err("another run"));
    assert!(error.contains("piston") && error.contains("structure") && error.contains("\nhint: "), "{error}");
    let mut more = coupled().with_probe("tip", tip);
    let error = text(more.resume(&path).expect_err("a probe more"));
    assert!(error.contains("probe `tip`"), "{error}");
    assert!(coupled().resume(&path).is_ok());
}
