//! Fingerprints change with what decides about a result, and with nothing else.

use std::fs;
use std::path::Path;

use partita_sweep::Sweep;

use crate::support::{Case, MAP, SCENE, SOUND};

fn fingerprints(sweep: &Sweep) -> Vec<String> {
    sweep.runs().iter().map(|run| run.fingerprint.clone()).collect()
}

/// Those of the sweep with `old` replaced by `new` in it or, where it is not there, in the scene.
fn changed(sweep: &str, old: &str, new: &str) -> Vec<String> {
    let case = Case::new(&sweep.replace(old, new));
    assert!(sweep.contains(old) != SCENE.contains(old), "{old} stands in one of the two");
    fs::write(case.path().join("cantilever.toml"), SCENE.replace(old, new)).expect("the scene is written");
    fingerprints(&case.load())
}

#[test]
fn every_run_has_its_own() {
    for sweep in [SOUND, MAP] {
        let mut all = fingerprints(&Case::new(sweep).load());
        assert!(all.iter().all(|one| one.len() == 16 && one.bytes().all(|byte| byte.is_ascii_hexdigit())));
        let count = all.len();
        all.sort();
        all.dedup();
        assert_eq!(all.len(), count);
    }
}

#[test]
fn what_decides_about_a_result_changes_all_of_them() {
    for (sweep, old, new) in [
        (SOUND, "density = 1000.0", "density = 1001.0"),
        (SOUND, "tolerance = { relative = 1e-10 }", "tolerance = { relative = 1e-11 }"),
        (SOUND, "step = 1.0\nsteps = 1", "step = 1.0\nsteps = 2"),
        (SOUND, "structure_displacement = [1.0, 0.5]", "structure_displacement = [1.0, 0.25]"),
        (SOUND, "column = \"tip_displacement_y\"", "column = \"tip_displacement_x\""),
        (MAP, "steps = 2", "steps = 3"),
        (MAP, "steps = 2", "steps = 2\nnewton_budget = 100"),
        (MAP, "max_iterations=13", "max_iterations=12"),
    ] {
        let before = fingerprints(&Case::new(sweep).load());
        let after = changed(sweep, old, new);
        assert_eq!(before.len(), after.len());
        assert!(before.iter().zip(&after).all(|(before, after)| before != after), "{new}");
    }
}

#[test]
fn what_does_not_decide_changes_none() {
    for (sweep, old, new) in [
        (SOUND, "title = \"Cantilever: ", "title = \"Another: "),
        (SOUND, "wanted = 1e-4", "wanted = 1e-6\nremark = \"why\""),
        (SOUND, "take = \"last\"", "take = \"max\"\nfrom = 0.5\nerror = \"absolute\""),
        (SOUND, "[output.probes]", "[output]\nfields_every = 7\n\n[output.probes]"),
        (SOUND, "title = \"Cantilever\"", "title = \"Cantilever\" # the same"),
        (MAP, "steps = 2", "steps = 2\nlargest_energy_growth = 3"),
        (MAP, "name = \"full Newton\"", "name = \"another name\""),
    ] {
        let before = fingerprints(&Case::new(sweep).load());
        assert_eq!(before, changed(sweep, old, new), "{new}");
    }
}

#[test]
fn a_further_value_or_choice_leaves_those_of_the_others() {
    let before = fingerprints(&Case::new(MAP).load());
    let after = changed(MAP, "values = [1, 10, 1000]", "values = [1, 10, 50, 1000]");
    assert_eq!((before.len(), after.len()), (9, 12));
    assert!(before.iter().all(|one| after.contains(one)));
}

/// A scene may name files: what stands in them decides, too.
#[test]
fn a_file_of_the_scene_counts_by_its_content() {
    let case = Case::new(
        r#"title = "Cavity"
scene = "scene.toml"
steps = 1

[[parameter]]
name = "dt"
values = [0.1]
set = ["time.step=$(x)"]

[[parameter]]
name = "tolerance"
values = [1e-6]
set = ["fluid.newton.tolerance.relative=$(x)"]

[[choice]]
name = "cavity"
"#,
    );
    let from = Path::new(env!("CARGO_MANIFEST_DIR")).join("../cli/tests/field-cases/wall_cavity");
    for name in ["scene.toml", "cavity.msh"] {
        fs::copy(from.join(name), case.path().join(name)).expect("a file of the case");
    }
    let before = fingerprints(&case.load());
    assert_eq!(before, fingerprints(&case.load()));
    let mesh = case.path().join("cavity.msh");
    let text = fs::read_to_string(&mesh).expect("a mesh");
    fs::write(&mesh, text + "\n").expect("another mesh");
    assert_ne!(before, fingerprints(&case.load()));
}
