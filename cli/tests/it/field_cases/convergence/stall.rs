//! A bound of Newton's method that is too loose for the coupling.

use super::{Case, plain};

#[test]
fn a_structure_that_stays_below_its_loose_bound_is_named_where_the_coupling_stalls() {
    let case = Case::new("wall_cavity");
    let sets = [
        "time.steps=8",
        "structure.newton.tolerance={relative=1e-3}",
        "coupling.convergence={changes_and_residual=1e-9}",
        "coupling.acceleration={constant={relaxation=0.5}}",
        "coupling.max_iterations=25",
    ];
    let outcome = case.run_with("out", &sets);
    let message = plain(&outcome);
    assert_eq!(outcome.code, 3, "{message}");
    assert!(message.contains("the structure made no Newton iteration "), "{message}");
    assert!(message.contains("`structure.newton.tolerance`"), "{message}");
}
