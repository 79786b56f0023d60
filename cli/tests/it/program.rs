//! The program as a user meets it: arguments, streams, exit codes, the folder it leaves behind.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use insta::assert_snapshot;
use serde_json::Value;

use crate::scene::SOUND;

/// What a call of the program came to.
pub(crate) struct Outcome {
    pub(crate) code: i32,
    pub(crate) stdout: String,
    pub(crate) stderr: String,
}

impl Outcome {
    /// Waits for a program to end.
    pub(crate) fn of(command: &mut Command) -> Self {
        let output = command.output().expect("the program starts");
        let text = |bytes| String::from_utf8(bytes).expect("the program writes UTF-8");
        Self {
            code: output.status.code().expect("the program ends by itself"),
            stdout: text(output.stdout),
            stderr: text(output.stderr),
        }
    }
}

/// Calls the program in a folder, as from a pipe: no colours, no bar.
pub(crate) fn partita(folder: &Path, arguments: &[&str]) -> Outcome {
    Outcome::of(Command::new(env!("CARGO_BIN_EXE_partita")).args(arguments).current_dir(folder))
}

pub(crate) fn tank() -> String {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../scenes/elastic-bottom").display().to_string()
}

/// A new folder with a scene in it.
pub(crate) fn folder_with(scene: &str) -> (tempfile::TempDir, PathBuf) {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let file = folder.path().join("case.toml");
    fs::write(&file, scene).expect("the scene is written");
    let path = folder.path().to_owned();
    (folder, path)
}

pub(crate) fn entries(folder: &Path) -> Vec<String> {
    let mut names: Vec<String> = fs::read_dir(folder)
        .expect("the folder is there")
        .map(|entry| entry.expect("an entry").file_name().to_string_lossy().into_owned())
        .collect();
    names.sort();
    names
}

#[test]
fn check_says_what_a_scene_is() {
    let outcome = partita(Path::new("."), &["check", &tank()]);
    assert_eq!((outcome.code, outcome.stderr.as_str()), (0, ""));
    assert_snapshot!(outcome.stdout, @r"
    Tank with an elastic bottom
      time        50 steps of 0.01 s, to t = 0.5 s
      fluid       400 triangles, 221 nodes, 601 unknowns
                  area 1 m2, x from 0 to 1 m, y from 0 to 1 m
                  shape quality 0.866 on average, 0.866 at worst, at (0.75, 0.583333) m (1 is equilateral)
                  body force [0.0, -9.81] m/s2 (per mass)
                  bdf1, tangent picard
                  left      10 edges  no_slip
                  right     10 edges  no_slip
                  bottom    10 edges  interface
                  top       10 edges  stress_free (backflow_stabilization false)
      structure   60 x 1 elements of degree 2 x 2, 186 control points, 360 unknowns
                  x from 0 to 1 m, y from -0.07 to 0 m
                  saint_venant_kirchhoff (young_modulus 1800000.0, poisson_ratio 0.3, plane strain)
                  body force [0.0, 0.0] N/m3 (per volume)
                  generalized_alpha (spectral_radius 1.0)
                  clamped: left, right; wetted: top
      interface   11 fluid nodes on 60 control points that move, by interpolation
      coupling    iqn_imvls (initial_relaxation 0.1, unseen_relaxation 1.0, history_steps 2, relax_first_iteration false, keep_last_differences true, filter (qr3 0.01))
                  predictor constant
                  until changes 1e-5, at most 100 iterations
                  Newton iterations a call: fixed (fluid unlimited, structure unlimited)
      memory      about 12 MB
    scene is sound
    ");
}

#[test]
fn a_run_is_named_after_its_scene_and_not_overwritten_unasked() {
    let (_guard, folder) = folder_with(SOUND);
    let run = |more: &[&str]| {
        let arguments = ["run", "case.toml", "--steps", "1", "--set", "output.fields_every=0"];
        partita(&folder, &[&arguments[..], more].concat())
    };
    let first = run(&[]);
    assert_eq!(first.code, 0, "{}", first.stderr);
    assert!(first.stdout.contains("coupling iterations"), "{}", first.stdout);
    let dir = folder.join("runs/case");
    let summary = fs::read_to_string(dir.join("summary.json")).expect("a summary");

    let second = run(&[]);
    assert_eq!(second.code, 2);
    assert!(second.stderr.contains("is not empty") && second.stderr.contains("--force"), "{}", second.stderr);
    assert_eq!(fs::read_to_string(dir.join("summary.json")).expect("still there"), summary);

    let broken = run(&["--force", "--set", "structure.geometry.rectangle.origin=[0, -0.06]"]);
    assert_eq!(broken.code, 2, "{}", broken.stderr);
    assert_eq!(fs::read_to_string(dir.join("summary.json")).expect("still there"), summary);

    let third = run(&["--force", "--quiet", "--json"]);
    assert_eq!((third.code, third.stderr.as_str()), (0, ""));
    let summary: Value = serde_json::from_str(&third.stdout).expect("the summary is JSON");
    assert_eq!((&summary["converged"], &summary["steps"]), (&Value::Bool(true), &Value::from(1)));
}

#[test]
fn files_of_others_survive_force() {
    let (_guard, folder) = folder_with(SOUND);
    fs::create_dir_all(folder.join("out")).expect("a folder");
    fs::write(folder.join("out/thesis.tex"), "three years").expect("a thesis");
    let outcome = partita(&folder, &["run", "case.toml", "--out", "out", "--force"]);
    assert_eq!(outcome.code, 2);
    assert_eq!(entries(&folder.join("out")), ["thesis.tex"]);
}

#[test]
fn a_broken_scene_exits_2_and_writes_nothing() {
    for (old, new) in [
        ("density = 1000.0", "densty = 1000.0"),
        ("density = 1000.0", "density = -1000.0"),
        ("bottom = \"interface\"", "base = \"interface\""),
        ("origin = [0.0, -0.05]", "origin = [0.0, -0.06]"),
    ] {
        let (_guard, folder) = folder_with(&SOUND.replacen(old, new, 1));
        for command in ["run", "check"] {
            let outcome = partita(&folder, &[command, "case.toml"]);
            assert_eq!(outcome.code, 2, "{command} {new}: {}", outcome.stderr);
            assert!(outcome.stdout.is_empty() && outcome.stderr.contains("help: "), "{}", outcome.stderr);
            assert_eq!(entries(&folder), ["case.toml"]);
        }
    }
}

#[test]
fn a_run_that_fails_exits_3_and_keeps_what_it_reached() {
    let (_guard, folder) = folder_with(SOUND);
    let outcome =
        partita(&folder, &["run", "case.toml", "--set", "coupling.max_iterations=2", "--out", "out"]);
    assert_eq!(outcome.code, 3);
    assert!(outcome.stderr.contains("step 1 (t = 0.01 s), coupling iteration 2"), "{}", outcome.stderr);
    let summary = fs::read_to_string(folder.join("out/summary.json")).expect("a summary");
    assert!(summary.contains("\"converged\": false"), "{summary}");
}

#[test]
fn a_run_goes_on_where_it_stopped() {
    let (_guard, folder) = folder_with(SOUND);
    let run =
        partita(&folder, &["run", "case.toml", "--out", "out", "--steps", "2", "--set", "time.steps=3"]);
    assert_eq!(run.code, 0, "{}", run.stderr);
    let resumed = partita(&folder, &["resume", "out", "--quiet", "--json"]);
    assert_eq!(resumed.code, 0, "{}", resumed.stderr);
    let summary: Value = serde_json::from_str(&resumed.stdout).expect("the summary is JSON");
    assert_eq!(summary["steps"], Value::from(3));
}

#[test]
fn what_is_no_run_cannot_be_resumed() {
    let (_guard, folder) = folder_with(SOUND);
    let outcome = partita(&folder, &["resume", "nowhere"]);
    assert_eq!(outcome.code, 2);
    assert_snapshot!(outcome.stderr, @r#"
      × nowhere is not the output folder of a run: it holds no scene.toml
      help: give the folder that `partita run` wrote to
    "#);
}

#[test]
fn wrong_arguments_exit_2() {
    let refused: [&[&str]; 5] = [
        &[],
        &["run"],
        &["walk", "case.toml"],
        &["run", "case.toml", "--steps", "0"],
        &["run", "case.toml", "--threads", "0"],
    ];
    for arguments in refused {
        let outcome = partita(Path::new("."), arguments);
        assert_eq!(outcome.code, 2, "{arguments:?}: {}", outcome.stderr);
        assert!(
            outcome.stderr.contains("Usage: partita") || outcome.stderr.contains("--help"),
            "{}",
            outcome.stderr
        );
    }
}

/// Flow between two walls, driven along them.
const FLUID_ALONE: &str = r#"title = "Channel"
time = { step = 0.1, steps = 2 }

[fluid]
density = 1.0
viscosity = 1.0
mesh.rectangle = { size = [2.0, 1.0], divisions = [4, 4], diagonals = "alternating" }
boundary = { left = { velocity = ["4*y*(1 - y)", 0] }, right = "do_nothing", top = "no_slip", bottom = "no_slip" }

[output.probes]
centre = { fluid_value = [1.0, 0.5] }
drag = { fluid_force = "top" }
"#;

/// A beam that falls from rest under its weight.
const STRUCTURE_ALONE: &str = r#"title = "Beam"
time = { step = 0.1, steps = 2 }

[structure]
density = 1000.0
body_force = [0.0, -9810.0]
clamped = ["left"]
geometry.rectangle = { size = [1.0, 0.1], elements = [8, 1] }
material.saint_venant_kirchhoff = { young_modulus = 1e7, poisson_ratio = 0.3, plane = "stress" }

[output.probes]
tip = { structure_displacement = [1.0, 0.5] }
"#;

#[test]
fn a_fluid_alone_and_a_structure_alone_run() {
    for (scene, field) in [(FLUID_ALONE, "fluid"), (STRUCTURE_ALONE, "structure")] {
        let (_guard, folder) = folder_with(scene);
        let check = partita(&folder, &["check", "case.toml"]);
        assert_eq!(check.code, 0, "{}", check.stderr);
        assert!(check.stdout.ends_with("scene is sound\n"), "{}", check.stdout);
        let run = partita(&folder, &["run", "case.toml", "--out", "out"]);
        assert_eq!(run.code, 0, "{}", run.stderr);
        assert!(folder.join(format!("out/{field}.pvd")).is_file());
        let probes = fs::read_to_string(folder.join("out/probes.csv")).expect("probes");
        assert_eq!(probes.lines().count(), 3, "{probes}");
    }
}

/// A finished short run of the sound scene in `out`, below the folder.
fn run_in(folder: &Path, more: &[&str]) -> Outcome {
    let arguments = ["run", "case.toml", "--out", "out", "--set", "output.fields_every=0", "--steps", "2"];
    partita(folder, &[&arguments[..], more].concat())
}

#[test]
fn force_removes_nothing_where_a_run_lies_beside_other_files() {
    let (_guard, folder) = folder_with(SOUND);
    assert_eq!(run_in(&folder, &[]).code, 0);
    fs::write(folder.join("out/notes.txt"), "keep").expect("a note");
    let before = entries(&folder.join("out"));
    let outcome = run_in(&folder, &["--force"]);
    assert_eq!(outcome.code, 2);
    assert!(outcome.stderr.contains("notes.txt") && outcome.stderr.contains("nothing was removed"));
    assert_eq!(entries(&folder.join("out")), before);
}

#[test]
fn a_folder_in_use_is_left_alone() {
    let (_guard, folder) = folder_with(SOUND);
    assert_eq!(run_in(&folder, &[]).code, 0);
    let records = fs::File::open(folder.join("out/run.jsonl")).expect("records");
    records.lock().expect("another run holds the folder");
    let size = records.metadata().expect("a file").len();
    for outcome in [partita(&folder, &["resume", "out"]), run_in(&folder, &["--force"])] {
        assert_eq!(outcome.code, 2);
        assert!(outcome.stderr.contains("is being written by another run"), "{}", outcome.stderr);
    }
    assert_eq!(records.metadata().expect("a file").len(), size);
}

#[test]
fn a_scene_that_was_changed_is_not_resumed_but_a_longer_one_is() {
    let (_guard, folder) = folder_with(SOUND);
    assert_eq!(run_in(&folder, &[]).code, 0);
    let file = folder.join("out/scene.toml");
    let scene = fs::read_to_string(&file).expect("the resolved scene");
    fs::write(&file, scene.replace("viscosity = 200.0", "viscosity = 20.0")).expect("a changed scene");
    let outcome = partita(&folder, &["resume", "out"]);
    assert_eq!(outcome.code, 2);
    assert!(outcome.stderr.contains("`viscosity = 200.0` is"), "{}", outcome.stderr);
    fs::write(&file, scene.replace("steps = 50", "steps = 60")).expect("a longer scene");
    // The number of threads is no part of the scene.
    let outcome = partita(&folder, &["resume", "out", "--steps", "3", "--threads", "2"]);
    assert_eq!(outcome.code, 0, "{}", outcome.stderr);
    assert!(outcome.stderr.contains("stopped after step 3; go on with `partita resume out`"));
}

#[test]
fn accepted_steps_that_did_not_converge_are_spoken_of() {
    // As many elements as edges of the fluid, so that no other warning comes first.
    let (_guard, folder) = folder_with(&SOUND.replace("elements = [60, 1]", "elements = [10, 1]"));
    let outcome =
        run_in(&folder, &["--set", "coupling.on_limit=accept", "--set", "coupling.max_iterations=2"]);
    assert_eq!(outcome.code, 0);
    assert!(outcome.stderr.starts_with("warning: 2 of 2 steps ended on the iteration bound"));
}

#[test]
fn a_reader_who_leaves_early_is_no_failure() {
    let mut check = Command::new(env!("CARGO_BIN_EXE_partita"))
        .args(["check", &tank()])
        .stdout(std::process::Stdio::piped())
        .stderr(std::process::Stdio::piped())
        .spawn()
        .expect("the program starts");
    drop(check.stdout.take());
    let output = check.wait_with_output().expect("the program ends");
    assert_eq!((output.status.code(), output.stderr.len()), (Some(0), 0));
}

#[test]
fn a_failed_run_has_a_summary_in_json_too() {
    let (_guard, folder) = folder_with(SOUND);
    let outcome = run_in(&folder, &["--json", "--set", "coupling.max_iterations=2"]);
    assert_eq!(outcome.code, 3);
    let summary: Value = serde_json::from_str(&outcome.stdout).expect("the summary is JSON");
    assert_eq!(summary["ending"], "failed");
}

#[test]
fn a_place_that_is_no_folder_exits_2() {
    let (_guard, folder) = folder_with(SOUND);
    let outcome = partita(&folder, &["run", "case.toml", "--out", "case.toml"]);
    assert_eq!(outcome.code, 2);
    assert!(outcome.stderr.contains("--out"), "{}", outcome.stderr);
}
