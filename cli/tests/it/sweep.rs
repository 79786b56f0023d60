//! `partita sweep`: one run at a time, by several processes, by a batch system that is not there.

use std::fs;
use std::path::Path;
use std::process::Command;

use serde_json::Value;

use crate::program::{Outcome, entries, partita};
use crate::study::{SOUND, folder_with};

/// `partita sweep ACTION bending.toml --out out` and more.
fn sweep(folder: &Path, action: &str, more: &[&str]) -> Outcome {
    partita(folder, &[&["sweep", action, "bending.toml", "--out", "out"][..], more].concat())
}

fn plan(folder: &Path) -> Vec<Value> {
    let outcome = sweep(folder, "plan", &["--json"]);
    assert_eq!((outcome.code, outcome.stderr.as_str()), (0, ""));
    serde_json::from_str(&outcome.stdout).expect("a list")
}

#[test]
fn a_plan_lists_the_runs_and_how_far_they_are() {
    let (guard, _) = folder_with(SOUND);
    let folder = guard.path();
    let runs = plan(folder);
    assert_eq!(runs.len(), 7);
    assert_eq!(runs[2]["settings"]["refinement"], "4 elements");
    assert_eq!(runs[2]["overrides"][0], "structure.geometry.rectangle.elements=[4, 1]");
    assert!(runs.iter().all(|run| run["state"] == "missing"));
    assert!(!folder.join("out").exists(), "a plan writes nothing");
    assert_eq!(sweep(folder, "run", &["--index", "2"]).code, 0);
    let states: Vec<Value> = plan(folder).into_iter().map(|run| run["state"].clone()).collect();
    assert_eq!(states[1..4], ["missing", "finished", "missing"]);
    let table = sweep(folder, "plan", &[]).stdout;
    assert!(table.starts_with("run  settings") && table.contains("degree 2, 4 elements"), "{table}");
}

#[test]
fn a_run_with_an_index_is_made_once_and_only_if_it_is_the_one_that_was_meant() {
    let (guard, _) = folder_with(SOUND);
    let folder = guard.path();
    let fingerprint = plan(folder)[3]["fingerprint"].as_str().expect("digits").to_owned();
    let outcome = sweep(folder, "run", &["--index", "3", "--fingerprint", &fingerprint]);
    assert_eq!(outcome.code, 0, "{}", outcome.stderr);
    assert!(outcome.stderr.contains("run 3 (degree 2, 8 elements): finished"), "{}", outcome.stderr);
    let file = folder.join("out/runs").join(format!("{fingerprint}.json"));
    let text = fs::read_to_string(&file).expect("a result");
    assert!(text.contains("\"cpu_seconds\":null"), "who shares the folder measures no times: {text}");
    fs::write(&file, text.replace("\"run\":\"", "\"run\":\"kept ")).expect("a mark");
    assert_eq!(sweep(folder, "run", &["--index", "3", "--fingerprint", &fingerprint]).code, 0);
    assert!(fs::read_to_string(&file).expect("a result").contains("kept"), "it was made again");
    fs::write(folder.join("bending.toml"), SOUND.replace("[8, 1]", "[9, 1]")).expect("a changed study");
    let outcome = sweep(folder, "run", &["--index", "3", "--fingerprint", &fingerprint]);
    assert_eq!(outcome.code, 2);
    assert!(outcome.stderr.contains("were changed"), "{}", outcome.stderr);
    let outcome = sweep(folder, "run", &["--index", "7"]);
    assert_eq!(outcome.code, 2);
    assert!(outcome.stderr.contains("from 0 to 6"), "{}", outcome.stderr);
}

/// As the tasks of a job array do it: one process for each run, several at once, and one of them fails.
#[test]
fn processes_share_a_folder_and_one_that_fails_does_not_stop_the_others() {
    let fails = SOUND.replace("set = [] }", "set = [\"structure.newton.max_iterations=1\"] }");
    let (guard, _) = folder_with(&fails);
    let folder = guard.path();
    let start = |index: usize| {
        let mut command = Command::new(env!("CARGO_BIN_EXE_partita"));
        command.args(["sweep", "run", "bending.toml", "--out", "out", "--quiet", "--index"]);
        command.arg(index.to_string()).current_dir(folder).spawn().expect("the program starts")
    };
    let early = sweep(folder, "collect", &[]);
    assert_eq!(early.code, 2, "{}", early.stdout);
    let processes: Vec<_> = [0, 1, 2, 3, 4, 5].into_iter().map(start).collect();
    for mut process in processes {
        assert!(process.wait().expect("it ends").success());
    }
    let outcome = sweep(folder, "collect", &[]);
    assert_eq!(outcome.code, 3, "one run is missing: {}", outcome.stderr);
    assert!(outcome.stdout.contains("run 1 (degree 2, 2 elements): step 1 (t = 1 s)"), "{}", outcome.stdout);
    assert!(outcome.stdout.contains("run 6 (degree 3, 8 elements): not finished\n"), "{}", outcome.stdout);
    // The rest by threads: the tables are those of one process.
    assert_eq!(sweep(folder, "run", &["--jobs", "2", "--quiet"]).code, 0);
    let rows = |out: &str| fs::read_to_string(folder.join(out).join("study.csv")).expect("rows");
    let shared = rows("out");
    let whole = partita(folder, &["sweep", "run", "bending.toml", "--out", "whole", "--jobs", "2"]);
    assert_eq!(whole.code, 0, "{}", whole.stderr);
    assert_eq!(rows("whole"), shared);
    assert_eq!(shared.lines().count(), 7);
}

#[test]
fn a_submission_maps_tasks_to_missing_runs_in_chunks() {
    let (guard, _) = folder_with(SOUND);
    let folder = guard.path();
    assert_eq!(sweep(folder, "run", &["--index", "1"]).code, 0);
    let before = entries(&folder.join("out"));
    let options =
        ["--slurm", "--array-size", "4", "--time=5", "--sbatch=--mem=1G", "--dry-run", "--", "--nice=3"];
    let outcome = sweep(folder, "submit", &options);
    assert_eq!(outcome.code, 0, "{}", outcome.stderr);
    assert_eq!(entries(&folder.join("out")), before, "a dry run writes nothing");
    let text = outcome.stdout;
    assert_eq!(text.matches("#!/bin/bash").count(), 2, "{text}");
    for line in [
        "#SBATCH --time=5",
        "#SBATCH --mem=1G",
        "#SBATCH --nice=3",
        "#SBATCH --array=0-3",
        "runs=(0 2 3 4)",
        "#SBATCH --array=0-1",
        "runs=(5 6)",
    ] {
        assert!(text.lines().any(|other| other == line), "{line}: {text}");
    }
    let nothing = partita(folder, &["sweep", "submit", "bending.toml"]);
    assert!(nothing.code == 2 && nothing.stderr.contains("--slurm"), "{}", nothing.stderr);
}

/// A program with the name of Slurm's takes the script where it should stand.
#[cfg(unix)]
#[test]
fn what_sbatch_says_is_passed_on() {
    use std::os::unix::fs::PermissionsExt as _;

    let (guard, _) = folder_with(SOUND);
    let folder = guard.path();
    let tools = folder.join("tools");
    fs::create_dir(&tools).expect("a folder");
    let submit = |body: &str| {
        let sbatch = tools.join("sbatch");
        fs::write(&sbatch, format!("#!/bin/sh\n{body}\n")).expect("a script");
        fs::set_permissions(&sbatch, fs::Permissions::from_mode(0o755)).expect("it can be run");
        let mut command = Command::new(env!("CARGO_BIN_EXE_partita"));
        command.args(["sweep", "submit", "bending.toml", "--out", "out", "--slurm", "--array-size", "4"]);
        Outcome::of(command.env("PATH", &tools).current_dir(folder))
    };
    let refused = submit(
        "[ \"$2\" = slurm/array-1.sh ] && echo '41;here' && exit 0; echo 'no  such partition' >&2; exit 1",
    );
    assert_eq!(refused.code, 3, "{}", refused.stdout);
    let said = refused.stderr.split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(
        said.contains("sbatch slurm/array-2.sh: no such partition (submitted before that: 41)"),
        "{said}"
    );
    let taken = submit("[ -f \"$2\" ] && echo 42");
    assert_eq!((taken.code, taken.stdout.as_str()), (0, "42\n42\n"), "{}", taken.stderr);
    assert!(taken.stderr.contains("job 42: 4 runs, slurm/array-3.sh"), "{}", taken.stderr);
}
