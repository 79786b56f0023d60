//! More that is at rest, with each field judged at another place, and what only seems to be.

use super::{Case, plain};

const ACCELERATIONS: [&str; 5] = [
    "coupling.acceleration={constant={relaxation=0.1}}",
    "coupling.acceleration={aitken={}}",
    "coupling.acceleration={iqn_ils={}}",
    "coupling.acceleration={iqn_mvj={}}",
    "coupling.acceleration={iqn_imvls={}}",
];

const CRITERIA: [&str; 4] = [
    "coupling.convergence={changes=1e-5}",
    "coupling.convergence={changes_and_residual=1e-5}",
    "coupling.convergence=\"entry_residuals\"",
    "coupling.convergence={interface_residual={relative=1e-5}}",
];

const CHECKS: [[&str; 2]; 4] = [
    ["fluid.newton.check=\"before\"", "structure.newton.check=\"before\""],
    ["fluid.newton.check=\"before\"", "structure.newton.check=\"lagged\""],
    ["fluid.newton.check=\"lagged\"", "structure.newton.check=\"before\""],
    ["fluid.newton.check=\"lagged\"", "structure.newton.check=\"lagged\""],
];

fn completes_under_everything(case: &Case, steps: usize) {
    let steps_set = format!("time.steps={steps}");
    for acceleration in ACCELERATIONS {
        for criterion in CRITERIA {
            for [fluid, structure] in CHECKS {
                let sets =
                    [acceleration, criterion, fluid, structure, &steps_set, "coupling.max_iterations=300"];
                let outcome = case.run_with("out", &sets);
                assert_eq!(outcome.code, 0, "{sets:?}: {}", plain(&outcome));
            }
        }
    }
}

#[test]
fn a_lid_that_carries_nothing_but_round_off_rests_too() {
    // Full to an elastic lid at which the pressure is zero: all that moves the lid is the round-off of 4 kPa.
    let case = Case::new("at_rest");
    for (old, new) in [
        ("top = \"stress_free\"", "top = \"interface\""),
        ("bottom = \"interface\"", "bottom = { traction = [\"0\", \"1000*9.81*0.4\"] }"),
        ("origin = [0.0, -0.04]", "origin = [0.0, 0.4]"),
        ("wetted = [\"top\"]", "wetted = [\"bottom\"]"),
        ("fluid_force = \"bottom\"", "fluid_force = \"top\""),
    ] {
        case.replace("scene.toml", old, new);
    }
    completes_under_everything(&case, 20);
}

#[test]
fn water_without_weight_that_stands_still_from_the_start_is_at_rest() {
    let case = Case::new("at_rest");
    case.replace("scene.toml", "body_force = [0.0, -9.81]", "body_force = [0.0, 0.0]");
    completes_under_everything(&case, 3);
}

#[test]
fn a_run_at_rest_resumes_bit_for_bit() {
    let case = Case::new("at_rest");
    let sets = ["time.steps=60", "output.checkpoint_every=7"];
    assert_eq!(case.run_with("whole", &sets).code, 0);
    let half = case.partita(&[
        "run",
        "scene.toml",
        "--out",
        "half",
        "--steps",
        "33",
        "--set",
        sets[0],
        "--set",
        sets[1],
    ]);
    assert_eq!(half.code, 0, "{}", plain(&half));
    assert_eq!(case.partita(&["resume", "half"]).code, 0);
    assert_eq!(case.text("whole/probes.csv"), case.text("half/probes.csv"));
}

#[test]
fn a_flow_that_is_not_at_rest_is_not_taken_for_it() {
    // The same water, pushed to and fro by a micrometre a second: ten orders of magnitude below gravity.
    let case = Case::new("at_rest");
    case.replace("scene.toml", "body_force = [0.0, -9.81]", "body_force = [\"1e-6*sin(t)\", -9.81]");
    let outcome = case.run_with("out", &["time.steps=60"]);
    assert_eq!(outcome.code, 0, "{}", plain(&outcome));
    let summary: serde_json::Value = serde_json::from_str(&case.text("out/summary.json")).expect("JSON");
    let newton = summary["newton_fluid"].as_u64().expect("a count");
    assert!(newton >= 60, "{newton} Newton iterations of the fluid in 60 steps");
}
