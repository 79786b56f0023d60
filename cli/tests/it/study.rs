//! Studies, as a user meets them.

use std::fs;
use std::path::PathBuf;

use partita_sweep::folder::{DIAGRAM, ROWS, RUNS, STUDY};

use crate::program::{entries, folder_with as folder_with_scene, partita};
use crate::retry::BEAM;

/// A cantilever, and a study of it that is sound; tests break it in one place.
pub(crate) use partita_testing::cantilever::{SCENE, STUDY as SOUND};

/// A new folder with the scene and a study in it, and the study's path.
pub(crate) fn folder_with(study: &str) -> (tempfile::TempDir, PathBuf) {
    let folder = tempfile::tempdir().expect("a temporary folder");
    fs::write(folder.path().join("cantilever.toml"), SCENE).expect("the scene is written");
    let path = folder.path().join("bending.toml");
    fs::write(&path, study).expect("the study is written");
    (folder, path)
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

    // What is finished is not run again, unless that is asked for: its times would be others.
    let rows = || fs::read_to_string(guard.path().join("runs/bending").join(ROWS)).expect("rows");
    let before = rows();
    let again = partita(guard.path(), &["study", "bending.toml", "--quiet"]);
    assert_eq!((again.code, again.stdout.as_str(), again.stderr.as_str()), (0, "", ""));
    assert_eq!(rows(), before);
    let forced = partita(guard.path(), &["study", "bending.toml", "--quiet", "--force"]);
    assert_eq!((forced.code, forced.stdout.as_str(), forced.stderr.as_str()), (0, "", ""));
    assert_ne!(rows(), before);

    fs::write(guard.path().join("runs/bending/notes.txt"), "mine").expect("a note");
    let foreign = partita(guard.path(), &["study", "bending.toml", "--quiet", "--force"]);
    assert_eq!(foreign.code, 2);
    assert_eq!(entries(&guard.path().join("runs/bending")), ["notes.txt", RUNS, ROWS, DIAGRAM, STUDY]);
}

#[test]
fn the_program_refuses_a_broken_study_before_it_writes() {
    let (guard, _) = folder_with(&SOUND.replace("degree=[3, 2]", "degree=[30, 2]"));
    let outcome = partita(guard.path(), &["study", "bending.toml"]);
    assert_eq!((outcome.code, outcome.stdout.as_str()), (2, ""));
    assert!(outcome.stderr.contains("degree=[30, 2]"), "{}", outcome.stderr);
    assert_eq!(entries(guard.path()), ["bending.toml", "cantilever.toml"]);
    let absent = partita(guard.path(), &["study", "absent.toml"]);
    assert_eq!(absent.code, 2);
    assert!(absent.stderr.contains("name a study file"), "{}", absent.stderr);
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
    let outcome = partita(&path, &["study", "pulse.toml", "--out", "out", "--quiet"]);
    assert_eq!(outcome.code, 0, "{}", outcome.stderr);
    let text = fs::read_to_string(path.join("out").join(ROWS)).expect("rows");
    let rows: Vec<Vec<&str>> = text.lines().map(|line| line.split(',').collect()).collect();
    assert!(text.starts_with("study,setting,error,") && text.contains("unconverged_steps,retries,failure\n"));
    let [_, stops, halves, small] = &rows[..] else { panic!("{text}") };
    // The name of the setting holds a comma, so that all behind it stand one further.
    let number = |row: &[&str], column: usize| row[column + 1].parse::<f64>().expect("a number");
    assert!(stops[3].is_empty() && text.contains("structure"), "{text}");
    let (error, steps, retries) = (2, 9, 14);
    assert!(number(halves, retries) > 0.0 && number(halves, steps) > 12.0, "{text}");
    assert!(number(halves, error) > 0.0, "{text}");
    assert_eq!([retries, steps, error].map(|column| small[column + 1]), ["0", "96", "0.0"]);
}
