//! Runs that fail, as a user meets them: what the message says, what is left in the folder, the exit code.

use std::fs;
use std::path::Path;

use insta::assert_snapshot;
use serde_json::Value;

use crate::program::{Outcome, entries, folder_with, partita, tank};

/// What a failed run has left: the iterations of the failed step, the summary, and the file of fields before it.
struct Left {
    iterations: usize,
    summary: Value,
    fields: Vec<String>,
}

fn left_in(out: &Path, failed_step: usize) -> Left {
    let records = fs::read_to_string(out.join("run.jsonl")).expect("records");
    let record = |line: &str| -> Value { serde_json::from_str(line).expect("whole lines of JSON") };
    let of_failed = |line: &&str| record(line)["iteration"]["step"] == failed_step;
    Left {
        iterations: records.lines().filter(of_failed).count(),
        summary: record(&fs::read_to_string(out.join("summary.json")).expect("a summary")),
        fields: entries(&out.join("fields")),
    }
}

/// What was written after the warnings about the scene.
fn without_warnings(stderr: &str) -> String {
    stderr.split_inclusive('\n').filter(|line| !line.starts_with("warning: ")).collect()
}

/// A message without the breaks and bars of the terminal: one line for what and where, one for the hint.
fn plain(stderr: &str) -> String {
    let stderr = without_warnings(stderr);
    let words: Vec<&str> = stderr.split_whitespace().filter(|word| !["×", "│"].contains(word)).collect();
    words.join(" ").replace(" help: ", "\nhelp: ")
}

/// Runs the scene in `case.toml` to its failure: exit code 3, a summary that says why, a checkpoint that can be resumed
/// and fails in the same way.
fn fails(folder: &Path, more: &[&str], step: usize) -> (Outcome, Left) {
    let failed = partita(folder, &[&["run", "case.toml", "--out", "out"][..], more].concat());
    assert_eq!(failed.code, 3, "{}{}", failed.stdout, failed.stderr);
    assert_eq!(failed.stdout, "");
    let out = folder.join("out");
    let left = left_in(&out, step);
    assert_eq!((&left.summary["ending"], &left.summary["steps"]), (&"failed".into(), &(step - 1).into()));
    let cause = left.summary["cause"].as_str().expect("a cause");
    assert!(cause.starts_with(&format!("step {step} (t = ")) && !cause.contains("hint"), "{cause}");

    let resumed = partita(folder, &["resume", "out"]);
    assert_eq!(
        (resumed.code, resumed.stderr),
        (3, without_warnings(&failed.stderr)),
        "the checkpoint before the step is whole"
    );
    let again = left_in(&out, step);
    assert_eq!((again.iterations, &again.fields), (left.iterations, &left.fields));
    (failed, left)
}

/// A channel whose upper wall comes down by 1 m/s, faster than its mesh can bear.
const FALLING_WALL: &str = r#"title = "Falling wall"
time = { step = 0.1, steps = 5 }

[fluid]
density = 1.0
viscosity = 1.0
mesh.rectangle = { size = [2.0, 1.0], divisions = [4, 4], diagonals = "alternating" }
boundary = { left = "no_slip", right = "do_nothing", top = { wall_motion = ["0", "-t"] }, bottom = "no_slip" }

[output]
fields_every = 0
"#;

#[test]
fn a_wall_that_folds_the_mesh_ends_the_run_at_the_cell() {
    let (_guard, folder) = folder_with(FALLING_WALL);
    let (outcome, left) = fails(&folder, &[], 3);
    assert_snapshot!(plain(&outcome.stderr), @r"
    step 3 (t = 0.3 s), fluid: mesh motion: cell 24 at (0.175709, 0.663281) m is inverted, measure -1.318e-2 m^2
    help: smaller time steps, incremental mesh motion, or another stiffening
    ");
    assert_eq!(left.fields, ["fluid-000002.vtu"]);
    assert_eq!(left.iterations, 0, "the step was not opened");
}

/// A beam under a load that grows until it cannot be carried.
const OVERLOADED: &str = r#"title = "Overloaded beam"
time = { step = 0.1, steps = 5 }

[structure]
density = 1000.0
body_force = ["0", "-1e4*t"]
clamped = ["left"]
time_scheme = "quasi_static"
geometry.rectangle = { size = [1.0, 0.1], elements = [8, 1] }
material.saint_venant_kirchhoff = { young_modulus = 1e6, poisson_ratio = 0.3, plane = "strain" }
newton = { max_iterations = 5 }
"#;

#[test]
fn a_newton_loop_at_its_bound_names_field_residuals_and_place() {
    let (_guard, folder) = folder_with(OVERLOADED);
    let (outcome, left) = fails(&folder, &[], 2);
    assert_snapshot!(plain(&outcome.stderr), @r"
    step 2 (t = 0.2 s), structure: residual 5.158e-5 (relative 1.351e-6) after 5 Newton iterations, from 1.909e1 (relative 5.000e-1); the bound is 1e-10 (relative); it is largest for force in y at control point 27, undeformed at (0.8125, 0.1) m
    help: a residual that still falls needs a larger `structure.newton.max_iterations`, one that does not a smaller time step
    ");
    assert_eq!(left.fields, ["structure-000000.vtu", "structure-000001.vtu"]);
}

#[test]
fn a_newton_loop_that_diverges_ends_the_run() {
    let load = r#"structure.body_force=["0", "-1e9*t"]"#;
    let (_guard, folder) = folder_with(OVERLOADED);
    let (outcome, left) = fails(&folder, &["--set", load], 1);
    let message = plain(&outcome.stderr);
    let expected = "step 1 (t = 0.1 s), structure: Newton iteration 1: the residual grew from 1.909e6 \
                    (relative 1.000e0) to ";
    assert!(message.starts_with(expected), "{message}");
    assert!(
        message.contains("; it is largest for force in x at control point 7, undeformed at (0.8125, 0) m"),
        "{message}"
    );
    assert_eq!(left.fields, ["structure-000000.vtu"]);
}

#[test]
fn a_block_pressed_through_its_support_is_refused_though_newton_converged() {
    let (_guard, folder) = folder_with(OVERLOADED);
    let more = [
        r#"structure.body_force=["-1e7*t", "0"]"#,
        "structure.newton.max_iterations=50",
        "structure.geometry.rectangle.size=[1.0, 1.0]",
        "structure.geometry.rectangle.elements=[2, 1]",
    ];
    let (outcome, _) = fails(&folder, &more.map(|setting| ["--set", setting]).concat(), 1);
    let message = plain(&outcome.stderr);
    assert!(message.starts_with("step 1 (t = 0.1 s), structure: element "), "{message}");
    assert!(message.contains(" m is turned inside out: det F = -"), "{message}");
}

#[test]
fn a_coupling_loop_at_its_bound_ends_the_run_with_its_iterations() {
    let (_guard, folder) = folder_with(&fs::read_to_string(tank() + "/scene.toml").expect("the tank"));
    let more = ["--set", "coupling.max_iterations=6", "--set", "output.fields_every=0"];
    let (outcome, left) = fails(&folder, &more, 1);
    assert_snapshot!(plain(&outcome.stderr), @r"
    step 1 (t = 0.01 s), coupling iteration 6, the step is not converged after 6 coupling iterations: |r| = 9.785e-7 m (1.848e-4 of the interface displacement), largest change 6.347e-4, both fields below their own bounds
    help: raise the iteration bound, use a quasi-Newton method, or check that the tolerances can be met
    ");
    assert_eq!((left.iterations, left.fields.len()), (6, 2));
}

/// The tank without acceleration, constantly relaxed.
fn relaxed(omega: f64) -> [String; 3] {
    let relaxation = format!("coupling.acceleration={{constant={{relaxation={omega:?}}}}}");
    [relaxation, "output.fields_every=0".to_owned(), "coupling.on_limit=accept".to_owned()]
}

#[test]
fn a_relaxation_too_large_for_the_added_mass_is_called_that() {
    for (omega, most) in [(1.0, 10), (0.48, 40)] {
        let (_guard, folder) = folder_with(&fs::read_to_string(tank() + "/scene.toml").expect("the tank"));
        let settings = relaxed(omega);
        let more: Vec<&str> = settings.iter().flat_map(|setting| ["--set", setting]).collect();
        let (outcome, left) = fails(&folder, &more, 1);
        let message = plain(&outcome.stderr);
        assert!(message.starts_with("step 1 (t = 0.01 s), coupling iteration "), "{message}");
        assert!(
            message
                .contains("; the coupling iteration diverges: |r| grew from 2.474e-2 m in iteration 1 to "),
            "{message}"
        );
        assert!(message.contains("help: take a smaller relaxation factor"), "{message}");
        assert!(left.iterations < most, "omega = {omega}: {} iterations", left.iterations);
        assert_eq!(left.fields, ["fluid-000000.vtu", "structure-000000.vtu"]);
    }
}

#[test]
fn a_divergence_that_only_creeps_is_not_accepted_as_a_step() {
    let (_guard, folder) = folder_with(&fs::read_to_string(tank() + "/scene.toml").expect("the tank"));
    let settings = relaxed(0.438);
    let more: Vec<&str> = settings.iter().flat_map(|setting| ["--set", setting]).collect();
    let (outcome, left) = fails(&folder, &more, 1);
    let expected = "step 1 (t = 0.01 s), coupling iteration 100, interface: the coupling iteration diverges: |r| grew from \
                    2.474e-2 m in iteration 1 to ";
    let message = plain(&outcome.stderr);
    assert!(
        message.starts_with(expected) && message.contains(" m in iteration 100\nhelp: take a smaller"),
        "{message}"
    );
    assert_eq!(left.iterations, 100);
}

#[test]
fn a_folder_that_cannot_be_written_is_said_before_the_first_step() {
    let (_guard, folder) = folder_with(FALLING_WALL);
    let run = |out: &str| {
        let outcome = partita(&folder, &["run", "case.toml", "--out", out]);
        assert_eq!((outcome.code, entries(&folder)), (2, vec!["case.toml".to_owned()]), "{}", outcome.stderr);
        outcome.stderr
    };
    assert_snapshot!(plain(&run("case.toml")), @r"
    cannot write case.toml: File exists (os error 17)
    help: name a folder that can be written, on a disk with space, with --out
    ");
    assert_snapshot!(plain(&run("case.toml/below")), @r"
    cannot write case.toml/below: Not a directory (os error 20)
    help: name a folder that can be written, on a disk with space, with --out
    ");
    // Not even root makes folders there.
    let refused = run("/proc/partita/run");
    assert!(refused.contains("cannot write /proc/partita/run: ") && refused.contains("--out"), "{refused}");
}

#[cfg(unix)]
#[test]
fn a_run_larger_than_the_disk_is_said_before_the_first_step() {
    let (_guard, folder) = folder_with(FALLING_WALL);
    let endless = [
        "time.steps=4000000000",
        "output.fields_every=1",
        "fluid.mesh.rectangle.divisions=[40, 40]",
        "fluid.boundary.top={wall_motion=[\"0\", \"0\"]}",
    ]
    .map(|setting| ["--set", setting])
    .concat();
    let outcome = partita(&folder, &[&["run", "case.toml", "--out", "runs/long"][..], &endless].concat());
    assert_eq!(outcome.code, 2, "{}", outcome.stderr);
    assert_eq!(entries(&folder), ["case.toml"]);
    let message = plain(&outcome.stderr);
    let (before, after) = message.split_once(" where ").expect("both numbers");
    let (free, after) = after.split_once(" are free ").expect("both numbers");
    assert!(free.ends_with('B'), "{free}");
    assert_snapshot!(format!("{before} where [some] are free {after}"), @r"
    the run will write about 726 TB to runs/long, where [some] are free (fields 716 TB, records and tables 10.4 TB, checkpoints 406 kB)
    help: write fields less often (output.fields_every), make space, or choose another folder with --out
    ");
    // The same scene for a few steps is welcome.
    let short = [&["run", "case.toml", "--out", "runs/long", "--steps", "2"][..], &endless].concat();
    assert_eq!(partita(&folder, &short).code, 0);
    assert_eq!(partita(&folder, &["resume", "runs/long"]).code, 2, "nor can the rest be written");
}

/// A disk that fills up, in the shape of a largest size of files; without the signal that would end the program.
#[cfg(unix)]
fn partita_with_small_files(folder: &Path, blocks: usize, arguments: &str) -> Outcome {
    let program = env!("CARGO_BIN_EXE_partita");
    let line = format!("trap '' XFSZ; ulimit -f {blocks}; exec '{program}' {arguments}");
    Outcome::of(std::process::Command::new("sh").args(["-c", &line]).current_dir(folder))
}

#[cfg(unix)]
#[test]
fn a_disk_that_fills_up_costs_no_more_than_the_steps_since_the_checkpoint() {
    let (_guard, folder) = folder_with(FALLING_WALL);
    let gentle = "--set fluid.boundary.top=no_slip --set time.steps=200 --set output.checkpoint_every=5";
    let outcome = partita_with_small_files(&folder, 48, &format!("run case.toml --out out {gentle}"));
    assert_eq!(outcome.code, 3, "{}", outcome.stderr);
    // Which step it is depends on the digits of the times in the records, and on the unit of `ulimit`.
    let message = plain(&outcome.stderr);
    assert!(
        message.starts_with("step ") && message.contains(" s), output: cannot write out/run.jsonl: "),
        "{message}"
    );
    assert!(message.contains("`partita resume out` then goes on after step "), "{message}");
    let summary = fs::read_to_string(folder.join("out/summary.json")).expect("a summary is small");
    assert!(summary.contains("\"ending\": \"failed\"") && summary.contains("cannot write out/"), "{summary}");
    // There is space again.
    let resumed = partita(&folder, &["resume", "out"]);
    assert_eq!(resumed.code, 0, "{}", resumed.stderr);
    let records = fs::read_to_string(folder.join("out/run.jsonl")).expect("records");
    assert_eq!(records.lines().count(), 2 * 200, "no step twice, none missing, no broken line");
    assert!(records.lines().all(|line| serde_json::from_str::<Value>(line).is_ok()));
}

#[cfg(unix)]
#[test]
fn a_checkpoint_that_does_not_fit_leaves_the_one_before() {
    let still = FALLING_WALL.replace("[4, 4]", "[20, 20]").replace(r#"["0", "-t"]"#, r#"["0", "0"]"#);
    let (_guard, folder) = folder_with(&still);
    let one_step = ["--steps", "1", "--set", "output.checkpoint_every=1"];
    let started = partita(&folder, &[&["run", "case.toml", "--out", "out"][..], &one_step].concat());
    assert_eq!(started.code, 0, "{}", started.stderr);
    let before = fs::read(folder.join("out/checkpoint.bin")).expect("a checkpoint");
    let blocks = before.len() / 1024 / 2;
    let outcome = partita_with_small_files(&folder, blocks, "resume out");
    assert_eq!(outcome.code, 3, "{}", outcome.stderr);
    assert!(
        outcome.stderr.contains("checkpoint.tmp.bin") && outcome.stderr.contains("goes on after step 1"),
        "{}",
        outcome.stderr
    );
    assert_eq!(fs::read(folder.join("out/checkpoint.bin")).expect("still there"), before);
    assert!(!folder.join("out/checkpoint.tmp.bin").exists());
    assert_eq!(partita(&folder, &["resume", "out", "--steps", "3"]).code, 0);
}
