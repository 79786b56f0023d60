//! Calls that enter converged: what they hand out is no answer to the input, and a difference to it is no secant.

use serde_json::Value;

use crate::field_cases::Case;

/// The quasi-Newton methods, each with and without the differences of a step's last iteration.
fn quasi_newton() -> impl Iterator<Item = String> {
    ["iqn_ils", "iqn_mvj", "iqn_imvls"].into_iter().flat_map(|method| {
        [true, false].map(|kept| format!("coupling.acceleration.{method}.keep_last_differences={kept}"))
    })
}

/// Coupling iterations of the 50 steps with these overrides, which all have to be made.
fn coupling_iterations(case: &Case, overrides: &[&str]) -> u64 {
    let mut arguments = vec!["run", "scene.toml", "--out", "out", "--force", "--quiet", "--json"];
    for set in overrides {
        arguments.extend(["--set", set]);
    }
    let outcome = case.partita(&arguments);
    assert_eq!(outcome.code, 0, "{overrides:?}: {}", outcome.stderr);
    let summary: Value = serde_json::from_str(&outcome.stdout).expect("JSON");
    assert_eq!(summary["steps"], 50, "{summary}");
    summary["coupling_iterations"].as_u64().expect("a count")
}

/// All methods complete with these overrides, and none takes a tenth more iterations than another.
fn all_methods_agree(overrides: &[&str]) {
    let case = Case::new("false_secants");
    let counts = quasi_newton().map(|method| {
        let all: Vec<&str> = overrides.iter().copied().chain([method.as_str()]).collect();
        (coupling_iterations(&case, &all), method.clone())
    });
    let counts: Vec<_> = counts.collect();
    let (fewest, most) = (counts.iter().min().expect("six runs"), counts.iter().max().expect("six runs"));
    assert!(most.0 as f64 <= 1.1 * fewest.0 as f64, "{counts:?}");
}

/// Ended in steps 7 to 9 where the last differences were kept.
#[test]
fn the_last_differences_of_a_step_may_be_kept() {
    all_methods_agree(&[]);
}

/// The fluid enters converged while the criterion still wants smaller changes.
#[test]
fn a_fluid_with_a_loose_bound_is_waited_for() {
    all_methods_agree(&["fluid.newton.tolerance.absolute=1e-6"]);
}

/// The same of the structure.
#[test]
fn so_is_a_structure() {
    all_methods_agree(&["structure.newton.tolerance.absolute=1e-5"]);
}

#[test]
fn a_thinner_bottom_and_a_linearly_converging_fluid_make_no_difference() {
    all_methods_agree(&[
        "fluid.tangent=\"picard\"",
        "structure.geometry.rectangle.size=[1.0,0.02]",
        "structure.geometry.rectangle.origin=[0.0,-0.02]",
        "structure.material.saint_venant_kirchhoff.young_modulus=2e7",
    ]);
}

/// No field below its bound at the entry of its call: the criterion asks for what makes false secants.
#[test]
fn steps_that_end_at_entry_residuals_complete() {
    all_methods_agree(&["coupling.convergence=\"entry_residuals\""]);
}

/// Where the fields' bounds are too loose for the bound of the interface residual, the iteration gets there all the same.
#[test]
fn waiting_for_a_field_does_not_hold_up_a_bound_of_the_interface_residual() {
    all_methods_agree(&[
        "fluid.newton.tolerance.absolute=1e-6",
        "coupling.convergence={interface_residual={relative=1e-7}}",
    ]);
}

#[test]
fn relaxation_completes_where_it_is_stable() {
    let case = Case::new("false_secants");
    let thin = [
        "structure.geometry.rectangle.size=[1.0,0.02]",
        "structure.geometry.rectangle.origin=[0.0,-0.02]",
        "structure.material.saint_venant_kirchhoff.young_modulus=2e7",
        "coupling.max_iterations=400",
        "coupling.acceleration={aitken={initial_relaxation=0.1}}",
    ];
    coupling_iterations(&case, &thin);
}

/// What was dropped stands in the record, in the iteration and in its step.
#[test]
fn dropped_columns_are_counted() {
    let case = Case::new("false_secants");
    coupling_iterations(&case, &["fluid.newton.tolerance.absolute=1e-6"]);
    let (mut unanswered, mut in_iterations, mut in_steps) = (0, 0, 0_u64);
    for line in case.text("out/run.jsonl").lines() {
        let record: Value = serde_json::from_str(line).expect("JSON");
        if let Some(dropped) = record["iteration"]["acceleration"]["dropped"].as_array() {
            in_iterations += dropped.len() as u64;
            unanswered += dropped.iter().filter(|column| column["reason"] == "no_answer").count();
        }
        in_steps += record["step"]["dropped_columns"].as_u64().unwrap_or(0);
    }
    assert!(unanswered > 0);
    assert!(in_steps > in_iterations, "{in_steps} and {in_iterations}: the last iterations count, too");
}
