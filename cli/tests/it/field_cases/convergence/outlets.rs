//! Several outlets, stabilized ones, and inlets that are driven by pressure.

use super::{Case, plain};

#[test]
fn stabilization_that_is_on_is_not_advised() {
    let case = Case::new("backflow");
    let sets = [
        "fluid.boundary.right={do_nothing={backflow_stabilization=true}}",
        "fluid.viscosity=0.5",
        "fluid.newton.max_iterations=2",
        "fluid.newton.tolerance={relative=1e-9}",
        "fluid.initial={velocity=[\"-1.0\", \"0\"]}",
    ];
    let outcome = case.run_with("out", &[&sets[..], &["time.step=0.1"]].concat());
    let message = plain(&outcome);
    assert_eq!(outcome.code, 3, "{message}");
    assert!(!message.contains("set `fluid.boundary."), "{message}");
}

#[test]
fn an_inlet_driven_by_pressure_is_allowed_its_inflow() {
    let case = Case::new("backflow");
    case.replace(
        "scene.toml",
        "left = { velocity = [\"heaviside(y-0.6)*heaviside(0.9-y)*min(t/0.2,1)\", 0] }",
        "left = { traction = [\"1000*min(t/0.2,1)\", 0] }",
    );
    let sets = [
        "fluid.viscosity=50.0",
        "time.step=0.02",
        "time.steps=40",
        "fluid.newton.max_iterations=3",
        "fluid.tangent=\"picard\"",
    ];
    let outcome = case.run_with("out", &sets);
    let message = plain(&outcome);
    assert_eq!(outcome.code, 3, "{message}");
    if message.contains("fluid enters") {
        assert!(
            message.contains("`left` (traction, ")
                && message.contains("as it should where a pressure drives it"),
            "{message}"
        );
        assert!(!message.contains("help: fluid enters"), "the advice of the error comes first: {message}");
    }
}
