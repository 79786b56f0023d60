//! Fluid that enters through an outlet, and failures of a fluid alone.

use crate::field_cases::Case;

/// The message of the run that fails, on one line.
fn failure(case: &Case, overrides: &[&str]) -> String {
    let mut arguments = vec!["run", "scene.toml", "--out", "out", "--force", "--quiet"];
    for set in overrides {
        arguments.extend(["--set", set]);
    }
    let outcome = case.partita(&arguments);
    assert_eq!(outcome.code, 3, "{}", outcome.stderr);
    outcome.stderr.split_whitespace().filter(|word| *word != "│").collect::<Vec<_>>().join(" ")
}

#[test]
fn the_hint_names_the_outlet_and_the_stabilization_and_no_coupling() {
    let case = Case::new("backflow");
    let message = failure(&case, &[]);
    assert!(message.contains("fluid enters through `right`"), "{message}");
    assert!(message.contains("backflow_stabilization"), "{message}");
    assert!(!message.contains("coupling"), "a fluid alone has no coupling: {message}");
}

#[test]
fn with_the_stabilization_it_runs() {
    let case = Case::new("backflow");
    let set = "fluid.boundary.right={do_nothing={backflow_stabilization=true}}";
    let outcome = case.partita(&["run", "scene.toml", "--out", "out", "--quiet", "--set", set]);
    assert_eq!(outcome.code, 0, "{}", outcome.stderr);
}

#[test]
fn a_failure_without_backflow_does_not_speak_of_it() {
    let case = Case::new("backflow");
    let message = failure(&case, &["fluid.newton.max_iterations=1", "time.steps=2"]);
    assert!(!message.contains("enters through") && !message.contains("coupling"), "{message}");
    assert!(message.contains("fluid.newton.max_iterations"), "{message}");
}
