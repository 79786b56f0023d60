//! A file of one kind given to the command of another, and runs that have nothing left to do.

use std::path::Path;

use crate::program::{folder_with, partita};
use crate::scene::SOUND;

#[test]
fn the_right_command_is_named() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let path = |file: &str| root.join(file).display().to_string();
    let (scene, study, map) =
        (path("scenes/elastic-bottom/scene.toml"), path("studies/tank-time.toml"), path("maps/tank.toml"));
    for (command, file, right) in [
        ("run", &study, "partita study"),
        ("check", &study, "partita study"),
        ("plan", &map, "partita stability"),
        ("run", &map, "partita stability"),
        ("study", &scene, "partita run"),
        ("stability", &scene, "partita run"),
        ("study", &map, "partita stability"),
        ("stability", &study, "partita study"),
    ] {
        let outcome = partita(Path::new("."), &[command, file]);
        let message = outcome.stderr.split_whitespace().collect::<Vec<_>>().join(" ");
        assert!(outcome.code == 2 && message.contains(right), "{command} {file}: {message}");
    }
}

#[test]
fn a_finished_run_says_that_it_is_complete() {
    let (_guard, folder) = folder_with(SOUND);
    let run = partita(&folder, &["run", "case.toml", "--out", "out", "--quiet", "--set", "time.steps=2"]);
    assert_eq!(run.code, 0, "{}", run.stderr);
    let before = std::fs::read(folder.join("out/summary.json")).expect("a summary");
    let resumed = partita(&folder, &["resume", "out"]);
    assert_eq!((resumed.code, resumed.stdout.as_str()), (0, ""), "{}", resumed.stderr);
    assert!(resumed.stderr.contains("complete"), "{}", resumed.stderr);
    assert_eq!(std::fs::read(folder.join("out/summary.json")).expect("a summary"), before);
}

#[test]
fn steps_beyond_the_end_are_spoken_of() {
    let (_guard, folder) = folder_with(SOUND);
    let set = ["--set", "time.steps=2", "--set", "output.fields_every=0"];
    let run = partita(&folder, &[&["run", "case.toml", "--out", "out", "--steps", "9"][..], &set].concat());
    assert!(run.code == 0 && run.stderr.contains("the 2 steps of the scene"), "{}", run.stderr);
}
