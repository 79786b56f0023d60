//! Times as people read them, and as files keep them.

use partita_coupling::error::short;
use partita_numerics::time::shown;

use super::{Case, plain};

#[test]
fn both_ways_to_show_a_time_agree() {
    for steps in 1..2000 {
        for dt in [0.1, 0.01, 0.02, 1e-4, 0.05, 1.0 / 3.0] {
            let time = f64::from(steps) * dt;
            assert_eq!(short(time).to_string(), shown(time).to_string());
            assert!((shown(time) / time - 1.0).abs() < 1e-11);
        }
    }
    assert_eq!(shown(51.0 * 0.1).to_string(), "5.1");
}

/// `51 * 0.1` is 5.1000000000000005.
#[test]
fn messages_round_what_files_keep() {
    let case = Case::new("absolute_tolerance");
    case.replace("scene.toml", "step = 1e-4\nsteps = 5", "step = 0.1\nsteps = 51");
    case.replace(
        "scene.toml",
        "\"1e-4*(y/4e-5)*(1 - y/4e-5)\"",
        "\"1e-4*(y/4e-5)*(1 - y/4e-5)/heaviside(5.05 - t)\"",
    );
    let outcome = case.run_with("out", &[]);
    let message = plain(&outcome);
    assert!(outcome.code == 2 && message.contains("t = 5.1 s"), "{message}");
    let outcome = case.run_with("out", &["time.steps=3", "fluid.boundary.inflow={velocity=[0, 0]}"]);
    assert_eq!(outcome.code, 0, "{}", plain(&outcome));
    assert!(case.text("out/probes.csv").contains(",0.30000000000000004,"), "files keep every bit");
}
