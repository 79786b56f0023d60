//! The tank with an elastic bottom, end to end: the real solvers, the coupling, the folder of a run.

use std::fs;
use std::path::{Path, PathBuf};

use insta::assert_snapshot;
use partita::build::{self, FieldMarch};
use partita::output::{Clock, Ending};
use partita::scene::{self, Resolved};
use partita::session::{Options, RunError, Session};
use partita_coupling::conformance::{ParticipantCheck, check_participant};
use partita_coupling::{IterationRecord, Participant, Record, Step};
use partita_testing::timeless;
use serde_json::Value;

fn tank(overrides: &[&str]) -> Resolved {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../scenes/elastic-bottom");
    let overrides: Vec<String> = overrides.iter().map(|&given| given.to_owned()).collect();
    scene::load(&folder, &overrides).expect("the shipped scene is sound")
}

fn limits(fluid: &str, structure: &str) -> [String; 2] {
    [format!("coupling.newton.fixed.fluid={fluid}"), format!("coupling.newton.fixed.structure={structure}")]
}

/// Steps a run and returns its records.
fn records(run: &mut FieldMarch, tank: &Resolved, steps: usize) -> Vec<Record> {
    let mut records = Vec::new();
    for _ in 0..steps {
        run.step(tank.scene.time.step.get(), &mut records).expect("the step converges");
    }
    records
}

fn iterations(records: &[Record]) -> Vec<&IterationRecord> {
    let iterations = records.iter().filter_map(|record| match record {
        Record::Iteration(iteration) => Some(iteration),
        Record::Step(_) | Record::Retry(_) => None,
    });
    let all: Vec<_> = iterations.collect();
    assert!(!all.is_empty(), "a run has coupling iterations");
    all
}

/// The fluid's bound lies within a decade of round-off, so that the last digits of a linear solution show. With the
/// entries of each fluid increment multiplied by 1 +- 5e-16 at random, 24 times, the coupling takes 62 to 73, 39 to 40, 46
/// to 49 and 41 to 42 iterations after faer's LU, and 62 to 64, 39 to 41, 46 to 49 and 41 to 42 after the node-block LU.
#[test]
fn first_steps_of_the_tank_cost_what_they_did() {
    let mut table = vec!["N^f N^s  coupling  fluid  structure".to_owned()];
    for (fluid, structure) in [("1", "1"), ("unlimited", "unlimited"), ("2", "3"), ("unlimited", "1")] {
        let [of_fluid, of_structure] = limits(fluid, structure);
        let tank = tank(&[&of_fluid, &of_structure]);
        let records = records(&mut build::march(&tank).expect("the scene builds"), &tank, 5);
        let newton =
            |field: usize| iterations(&records).iter().map(|k| k.fields[field].newton).sum::<usize>();
        let coupling = iterations(&records).len();
        table.push(format!("{fluid} {structure}: {coupling} {} {}", newton(0), newton(1)));
    }
    assert_snapshot!(table.join("\n"), @r"
    N^f N^s  coupling  fluid  structure
    1 1: 63 63 58
    unlimited unlimited: 37 154 86
    2 3: 45 90 82
    unlimited 1: 43 180 43
    ");
}

#[test]
fn no_call_exceeds_its_newton_limit_and_a_converged_structure_costs_nothing() {
    let [fluid, structure] = limits("1", "1");
    let tank = tank(&[&fluid, &structure]);
    let records = records(&mut build::march(&tank).expect("the scene builds"), &tank, 5);
    let mut free_calls = 0;
    for iteration in iterations(&records) {
        let [fluid, structure] = &iteration.fields;
        assert_eq!(fluid.newton, 1, "a lagged fluid call costs one iteration at least");
        assert!(structure.newton <= 1);
        assert_eq!(structure.newton == 0, structure.entry_converged);
        free_calls += usize::from(structure.newton == 0);
    }
    assert!(free_calls > 0, "some structure call enters converged");
}

#[test]
fn virtual_work_is_kept_between_the_meshes() {
    let tank = tank(&[]);
    let mut run = build::march(&tank).expect("the scene builds");
    for iteration in iterations(&records(&mut run, &tank, 3)) {
        assert!(iteration.work_defect < 1e-13, "work defect {:e}", iteration.work_defect);
    }
}

#[test]
fn gravity_rests_on_the_bottom_at_the_first_instant_of_a_stiff_tank() {
    // A bottom that hardly gives way carries the weight of the fluid, rho g L H = 9810 N/m, but for what hangs on the
    // walls by viscosity; with slip walls nothing does. (At 1e15 Pa the 0.012 N/m that accelerate the fluid show.)
    let tank = tank(&[
        "structure.material.saint_venant_kirchhoff.young_modulus=1e18",
        "fluid.boundary.left=slip",
        "fluid.boundary.right=slip",
        "fluid.newton.tolerance={relative=1e-10}",
        "structure.newton.tolerance={relative=1e-8}",
    ]);
    let mut run = build::march(&tank).expect("the scene builds");
    records(&mut run, &tank, 1);
    let fluid = run.first().field().expect("the tank has a fluid");
    let [x, y] = fluid.force_on("bottom").expect("the tank has a bottom");
    assert!((y + 9810.0).abs() < 1e-4 && x.abs() < 1e-4, "force ({x}, {y}) N/m");
}

#[test]
fn both_solvers_keep_the_contract_of_a_participant() {
    let tank = tank(&[
        "fluid.newton={tolerance={relative=1e-11}}",
        "structure.newton={tolerance={relative=1e-11}}",
        "fluid.tangent=full",
    ]);
    let mut run = build::march(&tank).expect("the scene builds");
    let step = Step { index: 1, time: 0.01, dt: 0.01 };
    let (fluid, structure) = run.participants_mut();
    let sag = |depth: f64| -> Vec<f64> {
        let points = fluid.input()[0].points;
        let shape = |i: usize| (std::f64::consts::PI * i as f64 / (points - 1) as f64).sin();
        (0..points).flat_map(|i| [0.0, -depth * shape(i)]).collect()
    };
    let inputs = [sag(1e-3), sag(-2e-3)];
    let load = |force: f64| vec![force; structure.input()[0].len()];
    let loads = [load(-10.0), load(30.0)];
    check_participant(fluid, &ParticipantCheck { step, inputs, tolerance: 1e-7 })
        .expect("the fluid keeps the contract");
    check_participant(structure, &ParticipantCheck { step, inputs: loads, tolerance: 1e-7 })
        .expect("the structure keeps the contract");
}

#[test]
fn reaching_the_iteration_bound_fails_the_run_and_keeps_its_history() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let dir = folder.path().join("run");
    let tank = tank(&["coupling.max_iterations=3", "output.fields_every=0"]);
    let error = start(&tank, &dir, None).finish().expect_err("three iterations are too few");
    assert!(matches!(error, RunError::Step(_)));
    let message = error.to_string();
    assert!(message.starts_with("step 1 (t = 0.01 s), coupling iteration 3, "), "{message}");
    let lines = fs::read_to_string(dir.join("run.jsonl")).expect("the history is there");
    assert_eq!(lines.lines().count(), 3);
    let summary = json(&dir.join("summary.json"));
    assert_eq!((&summary["converged"], &summary["steps"]), (&Value::Bool(false), &Value::from(0)));
}

#[test]
fn a_resumed_run_equals_the_uninterrupted_one() {
    resumed_equals_uninterrupted(&[]);
}

#[test]
fn factors_that_outlive_a_checkpoint_do_not_change_a_resumed_run() {
    let steps = resumed_equals_uninterrupted(&[
        "fluid.newton.reuse_factor=0.3",
        "structure.newton.reuse_factor=0.3",
        "coupling.newton={fixed={}}",
    ]);
    // Else the test would show nothing: steps that use the factor of an earlier one.
    for field in ["fluid_factorizations", "structure_factorizations"] {
        assert!(column(&steps, field)[1..].contains(&"0".to_owned()), "{field}: {:?}", column(&steps, field));
    }
}

#[test]
fn the_factor_of_a_linear_structure_does_not_change_a_resumed_run() {
    let steps = resumed_equals_uninterrupted(&[
        "structure.material={linear_elastic={young_modulus=5e6,poisson_ratio=0.3}}",
        "coupling.newton={fixed={}}",
    ]);
    let factorizations: usize =
        column(&steps, "structure_factorizations").iter().map(|n| n.parse::<usize>().expect("a count")).sum();
    assert_eq!(factorizations, 1);
}

/// The column of a table without times.
fn column(table: &[String], name: &str) -> Vec<String> {
    let mut rows = table.iter().map(|row| row.split(','));
    let index = rows.next().and_then(|mut header| header.position(|column| column == name)).expect(name);
    rows.map(|mut row| row.nth(index).expect("a cell").to_owned()).collect()
}

/// Runs the tank with further settings as a whole and in parts; returns the rows of `steps.csv`.
fn resumed_equals_uninterrupted(further: &[&str]) -> Vec<String> {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let (whole, parts) = (folder.path().join("whole"), folder.path().join("parts"));
    let [fluid, structure] = limits("2", "3");
    let settings = [&fluid, &structure, "time.steps=9", "output.checkpoint_every=4", "output.fields_every=3"];
    let tank = tank(&[&settings, further].concat());
    start(&tank, &whole, None).finish().expect("the whole run converges");
    start(&tank, &parts, Some(6)).finish().expect("the first part converges");
    // A killed run has written beyond its checkpoint: the records of step 6 and a line that broke off. It goes on
    // from step 4.
    fs::rename(parts.join("checkpoint.previous.bin"), parts.join("checkpoint.bin")).expect("a checkpoint");
    let half = fs::read_to_string(parts.join("run.jsonl")).expect("records") + "{\"iteration\":{\"st";
    fs::write(parts.join("run.jsonl"), half).expect("a broken line");
    let clock = Clock::start();
    let options = Options::default();
    let resumed = Session::resume(&tank, &parts, options, clock).expect("it can be resumed");
    assert_eq!(resumed.finish().expect("the rest converges").steps, 9);
    for name in ["run.jsonl", "steps.csv", "probes.csv", "scene.toml", "fluid.pvd"] {
        let timeless = |dir: &Path| timeless::file(&dir.join(name));
        assert_eq!(timeless(&whole), timeless(&parts), "{name}");
    }
    for name in ["fields/fluid-000009.vtu", "fields/structure-000009.vtu"] {
        assert!(fs::read(whole.join(name)).expect(name) == fs::read(parts.join(name)).expect(name), "{name}");
    }
    timeless::file(&whole.join("steps.csv")).lines().map(str::to_owned).collect()
}

#[test]
fn one_field_alone_runs_in_the_same_loop() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path().join("scene.toml");
    let mut tank = tank(&["output.probes={}"]);
    tank.scene.structure = None;
    tank.scene.coupling = None;
    let alone = tank.to_toml().replace("bottom = \"interface\"", "bottom = \"no_slip\"");
    fs::write(&path, alone).expect("a scene file");
    let alone = scene::load(&path, &["output.fields_every=0".to_owned()]).expect("a fluid alone is a scene");
    let summary = start(&alone, &folder.path().join("run"), Some(3)).finish().expect("it runs");
    assert_eq!((summary.steps, summary.coupling_iterations, summary.newton_structure), (3, 3, 0));
    assert_eq!(summary.ending, Ending::Stopped);
}

fn start<'a>(tank: &'a Resolved, dir: &Path, steps: Option<usize>) -> Session<'a> {
    let options = Options { steps, ..Options::default() };
    Session::start(tank, dir, options, Clock::start()).expect("the run starts")
}

fn json(path: &PathBuf) -> Value {
    serde_json::from_str(&fs::read_to_string(path).expect("a file")).expect("JSON")
}
