//! Studies: what is read, what is refused, and what is left in the folder.

mod broken;

use std::fs;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};

use insta::assert_snapshot;
use partita_sweep::study::{DIAGRAM, Manner, ROWS, Report, STUDY, Study, StudyFailure};

use crate::program::{entries, folder_with as folder_with_scene, partita};
use crate::retry::BEAM;

/// A cantilever under its own weight: small enough to be run again and again.
const SCENE: &str = r#"title = "Cantilever"

[time]
step = 1.0
steps = 1

[structure]
density = 1000.0
body_force = [0.0, -2000.0]
clamped = ["left"]
time_scheme = "quasi_static"

[structure.geometry.rectangle]
size = [1.0, 0.1]
elements = [2, 1]

[structure.material.saint_venant_kirchhoff]
young_modulus = 1e6
poisson_ratio = 0.0

[structure.newton]
tolerance = { relative = 1e-10 }

[output.probes]
tip = { structure_displacement = [1.0, 0.5] }
"#;

/// A study of it that is sound; tests break it in one place.
const SOUND: &str = r#"title = "Cantilever: elements and degree"
scene = "cantilever.toml"
wanted = 1e-4
refinements = [
    { name = "2 elements", set = [] },
    { name = "4 elements", set = ["structure.geometry.rectangle.elements=[4, 1]"] },
    { name = "8 elements", set = ["structure.geometry.rectangle.elements=[8, 1]"] },
]

[quantity]
name = "deflection of the tip"
column = "tip_displacement_y"
take = "last"

[reference]
set = ["structure.geometry.rectangle.elements=[16, 1]", "structure.geometry.rectangle.degree=[4, 2]"]

[[choice]]
name = "degree 2"

[[choice]]
name = "degree 3"
set = ["structure.geometry.rectangle.degree=[3, 2]"]
"#;

/// A new folder with the scene and a study in it, and the study's path.
fn folder_with(study: &str) -> (tempfile::TempDir, PathBuf) {
    let folder = tempfile::tempdir().expect("a temporary folder");
    fs::write(folder.path().join("cantilever.toml"), SCENE).expect("the scene is written");
    let path = folder.path().join("bending.toml");
    fs::write(&path, study).expect("the study is written");
    (folder, path)
}

/// Conducts a study, stopping it after some of its lines.
fn conduct(study: &Study, dir: &Path, lines: usize) -> Result<Report, StudyFailure> {
    let stop = AtomicBool::new(false);
    let mut told = 0;
    let mut tell = |_: &str| {
        told += 1;
        stop.store(told >= lines, Ordering::Relaxed);
    };
    study.conduct(dir, Manner { force: false, stop: &stop, tell: &mut tell })
}

fn rows_in(dir: &Path) -> String {
    fs::read_to_string(dir.join(ROWS)).expect("rows")
}

/// The rows without the time.
fn errors(report: &Report) -> String {
    let line = |row: &partita_sweep::study::Row| {
        let numbers = row.outcome.as_ref().expect("it ran");
        format!("{}, {}: {:.2e}, {} unknowns\n", row.choice, row.refinement, numbers.error, numbers.unknowns)
    };
    report.rows.iter().map(line).collect()
}

#[test]
fn a_study_measures_every_refinement_of_every_choice() {
    let (guard, file) = folder_with(SOUND);
    let dir = guard.path().join("out");
    let report = conduct(&Study::load(&file).expect("sound"), &dir, usize::MAX).expect("it runs");
    assert_snapshot!(errors(&report), @r#"
    degree 2, 2 elements: 1.69e-1, 18 unknowns
    degree 2, 4 elements: 1.95e-2, 30 unknowns
    degree 2, 8 elements: 1.32e-3, 54 unknowns
    degree 3, 2 elements: 1.36e-2, 24 unknowns
    degree 3, 4 elements: 3.76e-4, 36 unknowns
    degree 3, 8 elements: 2.38e-5, 60 unknowns
    "#);
    assert!(!report.interrupted);
    assert_eq!(entries(&dir), [ROWS, DIAGRAM, STUDY]);
    assert_eq!(fs::read_to_string(dir.join(STUDY)).expect("the study"), SOUND);
    let rows = rows_in(&dir);
    assert!(rows.starts_with("study,setting,error,cpu_seconds,"), "{rows}");
    assert!(rows.contains("\nbending,\"degree 3, 4 elements\","), "{rows}");
    assert_eq!(rows.lines().count(), 7);
    for row in &report.rows {
        assert!(row.outcome.as_ref().expect("it ran").cpu_seconds > 0.0, "{row:?}");
    }
    let picture = fs::read_to_string(dir.join(DIAGRAM)).expect("a diagram");
    assert!(picture.contains("degree 3") && picture.contains("relative error of the deflection of the tip"));
    let answer = report.answer();
    assert!(answer.contains("cheapest setting that reaches 1e-4: degree "), "{answer}");
}

/// A slender cantilever of Poisson ratio 0 under a uniform load that bends it little: q L^4 / (8 E I), q = 0.2 h,
/// I = h^3 / 12. What shear adds is of the order (h / L)^2.
#[test]
fn a_value_is_a_reference_too_and_its_uncertainty_is_in_the_unit_of_the_error() {
    let start = SOUND.find("[reference]").expect("a reference");
    let end = SOUND.find("[[choice]]").expect("a choice");
    let set = r#"set = [
    "structure.body_force=[0.0, -0.2]",
    "structure.geometry.rectangle.size=[1.0, 0.05]",
    "structure.newton.tolerance.relative=1e-8",
]"#;
    let head = SOUND[..start].replace("wanted = 1e-4", set);
    let (guard, file) =
        folder_with(&format!("{head}[reference]\nvalue = -1.2e-4\nuncertainty = 6e-7\n\n{}", &SOUND[end..]));
    let report =
        conduct(&Study::load(&file).expect("sound"), &guard.path().join("out"), usize::MAX).expect("it runs");
    let error = report.rows.last().expect("six rows").outcome.as_ref().expect("it ran").error;
    assert!((report.uncertainty - 5e-3).abs() < 1e-12, "{}", report.uncertainty);
    assert!(error < 5e-3, "{error}");
}

#[test]
fn an_interrupted_study_keeps_what_it_has_measured() {
    let (guard, file) = folder_with(SOUND);
    let dir = guard.path().join("out");
    // The reference and two settings.
    let report = conduct(&Study::load(&file).expect("sound"), &dir, 3).expect("it begins");
    assert!(report.interrupted);
    assert_eq!(report.rows.len(), 2);
    assert_eq!(rows_in(&dir).lines().count(), 3);
    assert_eq!(entries(&dir), [ROWS, DIAGRAM, STUDY]);
    assert!(report.answer().contains("so far"), "{}", report.answer());
}

#[test]
fn a_setting_that_fails_is_a_row_that_says_so() {
    let (guard, file) = folder_with(&SOUND.replace(
        "set = [\"structure.geometry.rectangle.degree=[3, 2]\"]",
        "set = [\"structure.newton.max_iterations=1\"]",
    ));
    let dir = guard.path().join("out");
    let report = conduct(&Study::load(&file).expect("sound"), &dir, usize::MAX).expect("it runs");
    let failures: Vec<bool> = report.rows.iter().map(|row| row.outcome.is_err()).collect();
    assert_eq!(failures, [false, false, false, true, true, true]);
    let rows = rows_in(&dir);
    let failed = rows.lines().last().expect("a row");
    assert!(failed.starts_with("bending,\"degree 3, 8 elements\",,,degree 3,8 elements,,"), "{failed}");
    assert!(failed.contains("step 1 (t = 1 s)"), "{failed}");
}

#[test]
fn a_reference_that_fails_leaves_nothing_behind() {
    let (guard, file) = folder_with(
        &SOUND.replace("[reference]\nset = [", "[reference]\nset = [\"structure.newton.max_iterations=1\", "),
    );
    let outcome = partita(guard.path(), &["study", "bending.toml"]);
    assert_eq!((outcome.code, outcome.stdout.as_str()), (3, ""), "{}", outcome.stderr);
    assert!(outcome.stderr.contains("the reference run: step 1"), "{}", outcome.stderr);
    assert!(!guard.path().join("runs/bending").exists());
    assert!(file.exists());
}

#[test]
fn the_program_prints_the_table_and_the_answer() {
    let (guard, _) = folder_with(SOUND);
    let outcome = partita(guard.path(), &["study", "bending.toml", "--wanted", "1e-9"]);
    assert_eq!(outcome.code, 0, "{}", outcome.stderr);
    assert!(outcome.stdout.starts_with("choice    refinement"), "{}", outcome.stdout);
    assert!(outcome.stdout.contains("no setting reaches 1e-9; the most accurate is "), "{}", outcome.stdout);
    assert!(outcome.stderr.contains("output in runs/bending"), "{}", outcome.stderr);

    let again = partita(guard.path(), &["study", "bending.toml", "--quiet"]);
    assert_eq!(again.code, 2);
    assert!(again.stderr.contains("is not empty"), "{}", again.stderr);
    let forced = partita(guard.path(), &["study", "bending.toml", "--quiet", "--force"]);
    assert_eq!((forced.code, forced.stdout.as_str(), forced.stderr.as_str()), (0, "", ""));

    fs::write(guard.path().join("runs/bending/notes.txt"), "mine").expect("a note");
    let foreign = partita(guard.path(), &["study", "bending.toml", "--quiet", "--force"]);
    assert_eq!(foreign.code, 2);
    assert_eq!(entries(&guard.path().join("runs/bending")), ["notes.txt", ROWS, DIAGRAM, STUDY]);
}

/// A setting that asks for halves gets them, as in a run of the scene; its neighbour without them fails.
#[test]
fn a_study_repeats_failed_steps_in_halves_where_the_scene_asks_for_it() {
    let study = r#"title = "Pulse"
scene = "case.toml"

[quantity]
name = "deflection of the tip"
column = "tip_displacement_y"
take = "history"

[reference]
set = ["time.step=0.0025", "time.steps=96"]

[[choice]]
name = "stops"
refinements = [{ name = "dt = 0.02 s", set = [] }]

[[choice]]
name = "halves"
set = ["time.retry.halvings=4"]
refinements = [{ name = "dt = 0.02 s", set = [] }, { name = "dt = 0.0025 s", set = ["time.step=0.0025", "time.steps=96"] }]
"#;
    let (_guard, path) = folder_with_scene(BEAM);
    let file = path.join("pulse.toml");
    fs::write(&file, study).expect("the study is written");
    let dir = path.join("out");
    let report = conduct(&Study::load(&file).expect("sound"), &dir, usize::MAX).expect("it runs");
    let [stops, halves, small] = &report.rows[..] else { panic!("{:?}", report.rows) };
    assert!(stops.outcome.as_ref().is_err_and(|cause| cause.contains("structure")), "{stops:?}");
    let numbers = halves.outcome.as_ref().expect("halved steps are small enough");
    assert!(numbers.retries > 0 && numbers.steps > 12, "{numbers:?}");
    assert!(numbers.error.is_finite() && numbers.error > 0.0, "{numbers:?}");
    let small = small.outcome.as_ref().expect("small steps are solved");
    assert_eq!((small.retries, small.steps, small.error), (0, 96, 0.0));
    let rows = rows_in(&dir);
    let header = rows.lines().next().expect("a header");
    assert!(header.ends_with("unconverged_steps,retries,failure"), "{header}");
    let halved = rows.lines().nth(2).expect("a row");
    assert!(halved.ends_with(&format!(",0,{},", numbers.retries)), "{halved}");
}
