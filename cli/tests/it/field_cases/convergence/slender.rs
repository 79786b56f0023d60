//! Slender structures, whose round-off lies far above that of a compact one.

use serde_json::Value;

use crate::field_cases::Case;

fn run(case: &Case, steps: usize, overrides: &[&str]) -> crate::program::Outcome {
    let steps = steps.to_string();
    let mut arguments =
        vec!["run", "scene.toml", "--out", "out", "--force", "--quiet", "--json", "--steps", &steps];
    for set in overrides {
        arguments.extend(["--set", set]);
    }
    case.partita(&arguments)
}

/// The membrane stopped in step 41.
#[test]
fn a_membrane_runs_beyond_where_it_stood_still() {
    let case = Case::new("wall_cavity");
    let outcome = run(&case, 50, &[]);
    assert_eq!(outcome.code, 0, "{}", outcome.stderr);
    let summary: Value = serde_json::from_str(&outcome.stdout).expect("JSON");
    assert_eq!(summary["converged"], true, "{summary}");
}

#[test]
fn so_do_thinner_ones_of_every_degree_and_law() {
    let case = Case::new("wall_cavity");
    for thickness in ["0.002", "0.0005"] {
        for degree in ["[1, 1]", "[2, 2]", "[3, 2]"] {
            for law in ["saint_venant_kirchhoff", "neo_hookean"] {
                let material =
                    format!("structure.material={{{law}={{young_modulus=250.0, poisson_ratio=0.0}}}}");
                let outcome = run(
                    &case,
                    6,
                    &[
                        &format!("structure.geometry.rectangle.size=[1.0, {thickness}]"),
                        &format!("structure.geometry.rectangle.origin=[0.0, -{thickness}]"),
                        &format!("structure.geometry.rectangle.degree={degree}"),
                        &material,
                    ],
                );
                assert_eq!(outcome.code, 0, "{thickness} m, {degree}, {law}: {}", outcome.stderr);
            }
        }
    }
}

/// What is asked for in vain is met at round-off, and recorded so.
#[test]
fn a_bound_below_round_off_is_met_there_and_recorded() {
    let case = Case::new("wall_cavity");
    let outcome = run(&case, 5, &["structure.newton.tolerance.relative=1e-15"]);
    assert_eq!(outcome.code, 0, "{}", outcome.stderr);
    let records = case.text("out/run.jsonl");
    assert!(records.contains("\"at_round_off\":true"), "the record says so");
    let summary: Value = serde_json::from_str(&outcome.stdout).expect("JSON");
    assert!(summary["structure"]["at_round_off"].as_u64() > Some(0), "{summary}");
}
