//! Maps of what converges, as a user meets them.

use std::fs;
use std::path::{Path, PathBuf};

use insta::assert_snapshot;

use crate::program::{Outcome, entries, folder_with, partita, tank};

/// A small map of the tank on a coarse mesh: a cell that converges with ease, one that diverges, and what lies between.
fn map() -> String {
    format!(
        r#"
title = "A small tank"
scene = '{}'
steps = 3
set = ["fluid.mesh.rectangle.divisions=[4, 4]", "structure.geometry.rectangle.elements=[8, 1]"]

[[parameter]]
name = "density_ratio"
label = "rho_f / rho_s"
values = [0.01, 10]
set = ["structure.density=$(1000/x)"]

[[parameter]]
name = "dt"
values = [1e-2, 1e-4]
set = ["time.step=$(x)"]

[[choice]]
name = "constant"
set = ["coupling.acceleration.constant.relaxation=0.1"]

[[choice]]
name = "IQN-IMVLS"
set = ["coupling.acceleration=iqn_imvls"]
"#,
        tank()
    )
}

fn folder_with_map(text: &str) -> (tempfile::TempDir, PathBuf) {
    let (folder, path) = folder_with("");
    fs::write(path.join("small.toml"), text).expect("the map is written");
    (folder, path)
}

fn run(folder: &Path, more: &[&str]) -> Outcome {
    partita(folder, &[&["stability", "small.toml"][..], more].concat())
}

fn table(folder: &Path, out: &str) -> String {
    fs::read_to_string(folder.join(out).join("cells.csv")).expect("a table")
}

#[test]
fn a_map_is_a_table_a_picture_and_a_line_for_each_choice() {
    let (_folder, path) = folder_with_map(&map());
    let outcome = run(&path, &["--out", "out"]);
    assert_eq!(outcome.code, 0, "{}", outcome.stderr);
    assert_snapshot!(outcome.stdout, @r"
    constant: 2 of 4 cells converged, at most 82 iterations a step, 1 iteration_bound, 1 diverged
    IQN-IMVLS: 4 of 4 cells converged, at most 13 iterations a step
    ");
    assert_eq!(entries(&path.join("out")), ["cells.csv", "map.svg", "map.toml", "runs"]);
    let table = table(&path, "out");
    let mut lines = table.lines();
    assert_eq!(
        lines.next().expect("a header"),
        "accelerator,density_ratio,dt,outcome,mean_iterations,max_iterations,cause,failing_step,steps,\
         newton_iterations,retries,energy_growth,pressure_oscillation,structure_displacement,mesh_quality,remedy"
    );
    assert_eq!(lines.clone().count(), 8);
    let diverged = lines.find(|line| line.contains(",diverged,")).expect("one cell diverges");
    assert!(diverged.starts_with("constant,10,0.0001,diverged,,,"), "{diverged}");
    assert!(diverged.contains("|r| grew from") && diverged.contains("quasi-Newton method"), "{diverged}");
    let picture = fs::read_to_string(path.join("out/map.svg")).expect("a picture");
    assert!(picture.starts_with("<svg ") && picture.ends_with("</svg>\n"));
    assert!(picture.contains("coupling diverged") && picture.contains("rho_f / rho_s"));
}

#[test]
fn any_number_of_jobs_gives_the_same_table() {
    let (_folder, path) = folder_with_map(&map());
    for (jobs, out) in [("1", "one"), ("3", "three")] {
        let outcome = run(&path, &["--out", out, "--jobs", jobs, "--quiet"]);
        assert_eq!((outcome.code, outcome.stdout.as_str()), (0, ""), "{}", outcome.stderr);
    }
    assert_eq!(table(&path, "one"), table(&path, "three"));
}

#[test]
fn finished_cells_are_kept_and_the_same_command_goes_on() {
    let (_folder, path) = folder_with_map(&map());
    assert_eq!(run(&path, &["--out", "out"]).code, 0);
    let (whole, runs) = (table(&path, "out"), path.join("out/runs"));
    // As a killed program leaves it: some cells, half a result, no table.
    let mut results = entries(&runs);
    results.retain(|name| name.len() == "0123456789abcdef.json".len());
    assert_eq!(results.len(), 8);
    let read = |name: &str| fs::read_to_string(runs.join(name)).expect("a result");
    fs::remove_file(runs.join(&results[0])).expect("a result is removed");
    fs::write(runs.join(&results[1]), &read(&results[1])[..20]).expect("a result is cut");
    for name in &results[2..] {
        fs::write(runs.join(name), read(name).replace("\"run\":\"", "\"run\":\"kept ")).expect("a mark");
    }
    fs::remove_file(path.join("out/cells.csv")).expect("the table is removed");
    let outcome = run(&path, &["--out", "out"]);
    assert_eq!(outcome.code, 0, "{}", outcome.stderr);
    assert_eq!(table(&path, "out"), whole);
    assert!(results[2..].iter().all(|name| read(name).contains("kept")), "finished cells were run again");
}

#[test]
fn cells_of_a_changed_map_are_run_and_foreign_files_are_left_alone() {
    let (_folder, path) = folder_with_map(&map());
    assert_eq!(run(&path, &["--out", "out"]).code, 0);
    fs::write(path.join("small.toml"), map().replace("steps = 3", "steps = 2")).expect("a changed map");
    let before = table(&path, "out");
    assert_eq!(run(&path, &["--out", "out"]).code, 0);
    assert_ne!(table(&path, "out"), before);
    fs::rename(path.join("small.toml"), path.join("other.toml")).expect("another name");
    let outcome = partita(&path, &["stability", "other.toml", "--out", "out"]);
    assert_eq!(outcome.code, 2);
    assert!(outcome.stderr.contains("the results of the map `small`"), "{}", outcome.stderr);
    fs::write(path.join("out/thesis.txt"), "mine").expect("a file");
    let outcome = partita(&path, &["stability", "other.toml", "--out", "out", "--force"]);
    assert_eq!(outcome.code, 2);
    assert!(outcome.stderr.contains("thesis.txt"), "{}", outcome.stderr);
}

/// What a map says when `old` is replaced by `new`: it is refused at once, and nothing is written.
fn complaint(old: &str, new: &str) -> String {
    let sound = map();
    assert!(sound.contains(old), "{old}");
    let (_folder, path) = folder_with_map(&sound.replacen(old, new, 1));
    let outcome = run(&path, &["--out", "out"]);
    assert_eq!((outcome.code, outcome.stdout.as_str()), (2, ""), "{}", outcome.stderr);
    assert!(!path.join("out").exists(), "something was written");
    outcome.stderr.replace(&tank(), "TANK")
}

#[test]
fn a_formula_that_fails_is_shown_with_its_value() {
    assert_snapshot!(complaint("values = [0.01, 10]", "values = [0.01, 0]"), @r#"
     × `1000/x` is no finite number where x = 0; a formula may use x and pi
       ╭─[small.toml:10:17]
     9 │ label = "rho_f / rho_s"
    10 │ values = [0.01, 0]
       ·                 ┬
       ·                 ╰── with this value
    11 │ set = ["structure.density=$(1000/x)"]
       ·        ──────────────┬──────────────
       ·                      ╰── in this
    12 │ 
       ╰────
     help: the formula of a value stands in `$(...)`, such as
           `structure.density=$(1000/x)`
    "#);
}

#[test]
fn a_value_that_the_scene_refuses_is_shown_in_the_map() {
    assert_snapshot!(complaint("values = [1e-2, 1e-4]", "values = [1e-2, -1e-4]"), @r#"
     × a cell of the map is no sound scene: time.step: -0.0001 is not a number
     │ above zero
       ╭─[small.toml:10:11]
     9 │ label = "rho_f / rho_s"
    10 │ values = [0.01, 10]
       ·           ──┬─
       ·             ╰── this value
    11 │ set = ["structure.density=$(1000/x)"]
    12 │ 
    13 │ [[parameter]]
    14 │ name = "dt"
    15 │ values = [1e-2, -1e-4]
       ·                 ──┬──
       ·                   ╰── this value
    16 │ set = ["time.step=$(x)"]
    17 │ 
    18 │ [[choice]]
    19 │ name = "constant"
       ·        ─────┬────
       ·             ╰── this choice
    20 │ set = ["coupling.acceleration.constant.relaxation=0.1"]
       ╰────
     help: Size of a time step [s].
           without the overrides the scene is sound: look at the `--set`s
    "#);
}

#[test]
fn other_slips_name_place_and_remedy() {
    for (old, new, words) in [
        ("steps = 3", "stepps = 3", "did you mean `steps`?"),
        ("steps = 3", "steps = 0", "steps is not a count of at least 1"),
        ("name = \"dt\"", "name = \"d t\"", "is no name of a parameter"),
        ("name = \"dt\"", "name = \"density_ratio\"", "two parameters have this name"),
        ("name = \"IQN-IMVLS\"", "name = \"constant\"", "two choices have this name"),
        ("values = [0.01, 10]", "values = []", "a parameter without values"),
        ("set = [\"time.step=$(x)\"]", "set = []", "`dt` sets nothing"),
        ("set = [\"time.step=$(x)\"]", "set = [\"time.step=$(x\"]", "a `$(` is never closed"),
        ("set = [\"time.step=$(x)\"]", "set = [\"time.stepp=$(x)\"]", "stepp"),
        ("acceleration=iqn_imvls", "acceleration=iqn_imvl", "iqn_imvl"),
        ("[[choice]]\nname = \"constant\"", "[[choices]]\nname = \"constant\"", "did you mean `choice`?"),
    ] {
        let said = complaint(old, new);
        assert!(said.contains(words), "{new}: {said}");
        assert!(said.contains("small.toml:"), "no place in the map: {said}");
    }
}
