//! A field that never iterates under its load.

use serde_json::Value;

use super::plain;
use crate::field_cases::Case;

#[test]
fn an_absolute_tolerance_above_the_load_is_a_warning_before_and_after_the_run_and_in_its_record() {
    let case = Case::new("absolute_tolerance");
    let check = case.partita(&["check", "scene.toml"]);
    assert!(check.code == 0 && check.stderr.contains("[loose_tolerance]"), "{}", check.stderr);
    let run = case.partita(&["run", "scene.toml", "--out", "out"]);
    assert_eq!(run.code, 0, "{}", run.stderr);
    assert!(
        run.stderr.contains("warning: the structure made no Newton iteration in 5 of 5 steps"),
        "{}",
        run.stderr
    );
    assert!(case.text("out/run.jsonl").contains("\"idle_under_load\":true"));
    let summary: Value = serde_json::from_str(&case.text("out/summary.json")).expect("JSON");
    assert!(summary.to_string().contains("\"idle_steps\":5"), "{summary}");
}

#[test]
fn a_bound_that_fits_the_load_raises_nothing() {
    let case = Case::new("absolute_tolerance");
    let set = "structure.newton.tolerance={relative=1e-10}";
    let run = case.partita(&["run", "scene.toml", "--out", "out", "--set", set]);
    assert_eq!(run.code, 0, "{}", run.stderr);
    assert!(!run.stderr.contains("no Newton iteration") && !run.stderr.contains("loose"), "{}", run.stderr);
    assert!(case.last_probe("out", "tip_displacement_x") != 0.0, "the flap moves");
}

/// A structure that carries no load is at rest, not idle.
#[test]
fn a_structure_without_a_load_is_no_cause_for_a_warning() {
    let case = Case::new("absolute_tolerance");
    let set = "fluid.boundary.inflow.velocity=[0, 0]";
    let run = case.partita(&["run", "scene.toml", "--out", "out", "--set", set]);
    assert_eq!(run.code, 0, "{}", run.stderr);
    assert!(!run.stderr.contains("no Newton iteration"), "{}", run.stderr);
}

#[test]
fn a_fluid_that_never_iterates_is_reported_too() {
    let case = Case::new("absolute_tolerance");
    let outcome = case.run_with("out", &["fluid.newton.tolerance={absolute=1e3}"]);
    let message = plain(&outcome);
    assert!(message.contains("warning: the fluid made no Newton iteration in 5 of 5 steps"), "{message}");
}

/// Water at rest under its weight is loaded, but balanced.
#[test]
fn water_at_rest_is_not_idle() {
    let tank = Case::new("at_rest");
    let outcome = tank.run_with("out", &["time.steps=100"]);
    assert!(outcome.code == 0 && !plain(&outcome).contains("no Newton iteration"), "{}", plain(&outcome));
}
