//! The beam in channel flow, end to end: an unstructured mesh, three wetted sides.

use std::fs;
use std::path::Path;

use insta::assert_snapshot;
use partita::build;
use partita::output::Clock;
use partita::scene::{self, Resolved};
use partita::session::{Options, Session};
use partita_coupling::Record;

fn beam(overrides: &[&str]) -> Resolved {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../scenes/beam-in-channel");
    let overrides: Vec<String> = overrides.iter().map(|&given| given.to_owned()).collect();
    scene::load(&folder, &overrides).expect("the shipped scene is sound")
}

#[test]
fn first_steps_of_the_beam_cost_what_they_did() {
    let mut table = vec!["N^f N^s  coupling  fluid  structure".to_owned()];
    for limits in ["1", "2", "unlimited"] {
        let beam = beam(&[
            &format!("coupling.newton.fixed.fluid={limits}"),
            &format!("coupling.newton.fixed.structure={limits}"),
        ]);
        let mut run = build::march(&beam).expect("the scene builds");
        let mut records: Vec<Record> = Vec::new();
        for _ in 0..3 {
            run.step(beam.scene.time.step.get(), &mut records).expect("the step converges");
        }
        let iterations = records.iter().filter_map(|record| match record {
            Record::Iteration(iteration) => Some(iteration.fields.each_ref().map(|field| field.newton)),
            Record::Step(_) | Record::Retry(_) => None,
        });
        let [coupling, fluid, structure] = iterations
            .fold([0; 3], |sum, [fluid, structure]| [sum[0] + 1, sum[1] + fluid, sum[2] + structure]);
        table.push(format!("{limits} {limits}: {coupling} {fluid} {structure}"));
    }
    assert_snapshot!(table.join("\n"), @r"
    N^f N^s  coupling  fluid  structure
    1 1: 67 67 56
    2 2: 48 96 77
    unlimited unlimited: 44 153 79
    ");
}

/// A small relaxation makes small changes, however far from balance the step is.
#[test]
fn the_residual_is_judged_beside_the_changes_where_the_scene_asks_for_it() {
    let [changes, both] = ["changes", "changes_and_residual"].map(|criterion| {
        let beam = beam(&[
            "coupling.acceleration.constant.relaxation=0.1",
            &format!("coupling.convergence.{criterion}=1e-2"),
        ]);
        let mut run = build::march(&beam).expect("the scene builds");
        run.step(beam.scene.time.step.get(), &mut ()).expect("the step converges")
    });
    assert!(changes.largest_change < 1e-2 && both.largest_change < 1e-2);
    assert!(both.iterations > changes.iterations, "{} and {}", both.iterations, changes.iterations);
    // The change is a tenth of the residual.
    assert!(both.residual < 0.3 * changes.residual, "{:e} and {:e}", both.residual, changes.residual);
}

/// Nodes of the mesh at both ends of the tip carry the load to one control point each.
#[test]
fn the_mesh_meets_the_beam_on_three_sides() {
    let run = build::march(&beam(&[])).expect("the scene builds");
    let (fluid, structure) =
        (run.first().field().expect("a fluid"), run.second().field().expect("a structure"));
    assert_eq!(fluid.mesh().cells().len(), 769);
    assert_eq!(fluid.interface_nodes().len(), 26);
    // 62 control points up each side, 3 across the tip, corners once, the two at the foot clamped.
    assert_eq!(structure.interface_points().len(), 2 * 61 + 1);
}

#[test]
fn a_run_keeps_its_mesh_and_can_be_taken_up_without_the_scene() {
    let folder = tempfile::tempdir().expect("a folder");
    let (kept, dir) = (folder.path().join("scene"), folder.path().join("run"));
    fs::create_dir(&kept).expect("a folder");
    let shipped = Path::new(env!("CARGO_MANIFEST_DIR")).join("../scenes/beam-in-channel");
    for name in ["scene.toml", "channel.msh"] {
        fs::copy(shipped.join(name), kept.join(name)).expect("a copy");
    }
    let overrides = ["output.checkpoint_every=1", "output.fields_every=0"].map(str::to_owned);
    let scene = scene::load(&kept, &overrides).expect("the copy is sound");
    let options = Options { steps: Some(1), ..Options::default() };
    let session = Session::start(&scene, &dir, options, Clock::start()).expect("the run starts");
    session.finish().expect("the step converges");
    fs::remove_dir_all(&kept).expect("the scene can go");

    let again = scene::load(&dir, &[]).expect("the folder of the run holds all it needs");
    let options = Options { steps: Some(2), ..options };
    let session = Session::resume(&again, &dir, options, Clock::start()).expect("it can be resumed");
    assert_eq!(session.finish().expect("the step converges").steps, 2);

    // A mesh that was changed in between is refused.
    let mesh = dir.join("input/fluid.msh");
    let text = fs::read_to_string(&mesh).expect("the copy of the mesh");
    let moved = text.replacen(" 0\n$EndNodes", "1 0\n$EndNodes", 1);
    assert_ne!(moved, text);
    fs::write(&mesh, moved).expect("another mesh");
    let changed = scene::load(&dir, &[]).expect("still sound");
    let refused =
        Session::resume(&changed, &dir, options, Clock::start()).err().expect("another mesh").to_string();
    assert!(refused.contains("fluid.msh"), "{refused}");
}
