//! `traction_patch`: uniform pressure must compress a block evenly.

use super::{Case, run};

const MORTAR: &str = "coupling.transfer=mortar";
const EXACT: f64 = -5e-4;

/// The largest relative error of the vertical displacement at the probes of the wetted side.
fn error(case: &Case, out: &str) -> f64 {
    let of_probe = |name: &str| case.last_probe(out, &format!("{name}_displacement_y")) / EXACT - 1.0;
    ["end", "next", "middle"].map(of_probe).into_iter().fold(0.0, |worst, error| error.abs().max(worst))
}

#[test]
fn mortar_compresses_the_block_evenly_for_any_two_resolutions() {
    let case = Case::new("traction_patch");
    for (edges, elements, degree) in [
        (2, 1, 1),
        (2, 8, 2),
        (2, 20, 3),
        (3, 7, 1),
        (4, 8, 2),
        (5, 3, 3),
        (8, 8, 1),
        (8, 8, 2),
        (8, 8, 3),
        (16, 8, 2),
        (17, 20, 2),
        (33, 1, 2),
        (33, 20, 3),
    ] {
        let divisions = format!("fluid.mesh.rectangle.divisions=[{edges}, 4]");
        let [elements, degree] = [("elements", elements), ("degree", degree)]
            .map(|(key, value)| format!("structure.geometry.rectangle.{key}=[{value}, 2]"));
        run(&case, "scene.toml", "out", &[MORTAR, &divisions, &elements, &degree]);
        let error = error(&case, "out");
        assert!(error < 1e-9, "{divisions} {elements} {degree}: {error:e}");
    }
}

/// As bad as the case says: what the tests above see is there.
#[test]
fn interpolation_dents_the_block_at_its_ends() {
    let case = Case::new("traction_patch");
    run(&case, "scene.toml", "out", &["coupling.transfer=interpolation"]);
    let end = case.last_probe("out", "end_displacement_y") / EXACT - 1.0;
    assert!((end - 0.25).abs() < 0.01, "{end}");
}

/// Loads alone pass the same way, and the fluid sees the motion in neither.
#[test]
fn mortar_serves_one_way_coupling() {
    let case = Case::new("traction_patch");
    run(&case, "scene.toml", "out", &[MORTAR, "coupling.direction=one_way"]);
    assert!(error(&case, "out") < 1e-9);
}
