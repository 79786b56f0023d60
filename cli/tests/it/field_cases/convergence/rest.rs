//! Systems that come to rest: nothing but round-off changes, under any criterion.

use crate::field_cases::Case;

const ACCELERATIONS: [&str; 5] = ["aitken", "iqn_ils", "iqn_mvj", "iqn_imvls", "{constant={relaxation=0.5}}"];
const CRITERIA: [&str; 4] = [
    "{changes=1e-5}",
    "{changes_and_residual=1e-5}",
    "entry_residuals",
    "{interface_residual={relative=1e-6}}",
];

/// Runs the case with these settings; the message where it does not get to its end.
fn ends(case: &Case, overrides: &[String]) -> Result<(), String> {
    let mut arguments = vec!["run", "scene.toml", "--out", "out", "--force", "--quiet"];
    for set in overrides {
        arguments.extend(["--set", set]);
    }
    let outcome = case.partita(&arguments);
    if outcome.code == 0 { Ok(()) } else { Err(format!("{overrides:?}: {}", outcome.stderr)) }
}

#[test]
fn water_comes_to_rest_under_every_criterion_check_and_acceleration() {
    let case = Case::new("at_rest");
    for acceleration in ACCELERATIONS {
        for criterion in CRITERIA {
            for check in ["before", "lagged"] {
                let settings = [
                    format!("coupling.acceleration={acceleration}"),
                    format!("coupling.convergence={criterion}"),
                    format!("fluid.newton.check={check}"),
                    format!("structure.newton.check={check}"),
                    "time.steps=120".to_owned(),
                ];
                ends(&case, &settings).expect("it comes to rest");
            }
        }
    }
    assert!(
        (case.last_probe("out", "load_force_y") + 0.5 * 0.4 * 9810.0).abs() < 60.0,
        "the weight of the water"
    );
}

/// Without gravity everything decays to zero, the pressure too.
#[test]
fn a_push_decays_to_nothing() {
    let case = Case::new("at_rest");
    for scheme in ["bdf1", "bdf2"] {
        for check in ["before", "lagged"] {
            let settings = [
                "fluid.body_force=[0, \"-9.81*heaviside(0.2 - t)\"]".to_owned(),
                format!("fluid.time_scheme={scheme}"),
                format!("fluid.newton.check={check}"),
            ];
            ends(&case, &settings).expect("it comes to rest");
            assert!(case.last_probe("out", "middle_displacement_y").abs() < 1e-12);
        }
    }
}

/// A floor of the changes must not end a step of a system that moves: twice the tolerance, and it would show.
#[test]
fn a_system_that_moves_is_not_taken_for_one_at_rest() {
    let case = Case::new("at_rest");
    let middle = |criterion: &str| {
        let settings = [format!("coupling.convergence={criterion}"), "time.steps=4".to_owned()];
        ends(&case, &settings).expect("it converges");
        case.last_probe("out", "middle_displacement_y")
    };
    let (fine, exact) = (middle("{changes=1e-6}"), middle("{changes=1e-10}"));
    assert!((fine / exact - 1.0).abs() < 1e-5, "{fine} {exact}");
}
