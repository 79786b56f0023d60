//! Input that is legal but hardly intended: each warning with a scene that raises it and a neighbour that does not.

use std::path::Path;

use partita::warning::Kind;
use serde_json::Value;

use crate::program::{folder_with, partita};
use crate::scene::SOUND;

/// A square of fluid with a wall that moves and an open side.
const WALL: &str = r#"title = "Moving wall"
time = { step = 0.1, steps = 100 }

[fluid]
density = 1.0
viscosity = 1.0
mesh.rectangle = { size = [1.0, 1.0], divisions = [4, 4] }
boundary = { left = { velocity = [0, 0] }, right = "do_nothing", bottom = "no_slip", top = { wall_motion = [0, 0] } }
"#;

/// The sound scene with an element of the structure for each edge of the fluid at the interface.
fn matching() -> String {
    SOUND.replace("elements = [60, 1]", &format!("elements = [{EDGES}, 1]"))
}

/// Names of the open warnings of `check`, in their order.
fn names(scene: &str, overrides: &[&str]) -> Vec<String> {
    let (_guard, folder) = folder_with(scene);
    let mut arguments = vec!["check", "case.toml", "--json"];
    for set in overrides {
        arguments.extend(["--set", set]);
    }
    let outcome = partita(&folder, &arguments);
    assert_eq!(outcome.code, 0, "{overrides:?}: {}{}", outcome.stdout, outcome.stderr);
    let object: Value = serde_json::from_str(&outcome.stdout).expect("JSON");
    let warnings = object["warnings"].as_array().expect("a list").iter();
    warnings.map(|warning| warning["name"].as_str().expect("a name").to_owned()).collect()
}

fn raises(kind: Kind, scene: &str, raising: &[&str], neighbour: &[&str]) {
    let found = names(scene, raising);
    assert!(found.iter().any(|name| name == kind.name()), "{raising:?} raises {found:?}");
    let found = names(scene, neighbour);
    assert!(found.iter().all(|name| name != kind.name()), "{neighbour:?} raises {found:?}");
}

/// Edges of the fluid along the interface of the sound scene.
const EDGES: usize = 10;

/// That many elements of its structure along them.
fn along(elements: usize) -> String {
    format!("structure.geometry.rectangle.elements=[{elements}, 1]")
}

const RADIUS: &str = "structure.time_scheme.generalized_alpha.spectral_radius=";

#[test]
fn the_sound_scene_raises_none() {
    assert_eq!(names(&matching(), &[&format!("{RADIUS}0.5")]), Vec::<String>::new());
    assert_eq!(names(WALL, &[]), Vec::<String>::new());
}

#[test]
fn a_coupled_structure_without_damping() {
    raises(Kind::UndampedStructure, SOUND, &[&format!("{RADIUS}1")], &[&format!("{RADIUS}0.9")]);
    let newmark = "structure.time_scheme.newmark.gamma=";
    raises(
        Kind::UndampedStructure,
        SOUND,
        &[&format!("{newmark}0.5")],
        &[&format!("{newmark}0.6"), "structure.time_scheme.newmark.beta=0.4"],
    );
    // Nothing comes back to the fluid, so that nothing can saw.
    raises(
        Kind::UndampedStructure,
        SOUND,
        &[&format!("{RADIUS}1")],
        &[&format!("{RADIUS}1"), "coupling.direction=one_way"],
    );
}

#[test]
fn a_step_that_is_long_against_the_first_period() {
    raises(Kind::LongStep, SOUND, &["time.step=0.1"], &["time.step=0.01"]);
    raises(
        Kind::LongStep,
        SOUND,
        &["time.step=0.1"],
        &["time.step=0.1", "structure.time_scheme=quasi_static"],
    );
}

#[test]
fn a_fluid_coarser_than_the_structure() {
    let [mortar, interpolation] = ["coupling.transfer=mortar", "coupling.transfer=interpolation"];
    raises(Kind::CoarseInterface, SOUND, &[&along(4 * EDGES)], &[&along(2 * EDGES)]);
    raises(
        Kind::CoarseInterface,
        SOUND,
        &[&along(2 * EDGES), interpolation],
        &[&along(EDGES), interpolation],
    );
    raises(Kind::CoarseInterface, SOUND, &[&along(2 * EDGES), interpolation], &[&along(2 * EDGES), mortar]);
    raises(Kind::CoarseInterface, SOUND, &[&along(4 * EDGES), mortar], &[&along(2 * EDGES), mortar]);
    raises(
        Kind::CoarseInterface,
        SOUND,
        &[&along(4 * EDGES), "coupling.direction=one_way"],
        &[&along(EDGES), "coupling.direction=one_way"],
    );
}

#[test]
fn a_modulus_in_another_unit() {
    let modulus = "structure.material.saint_venant_kirchhoff.young_modulus=";
    raises(Kind::SoftStructure, SOUND, &[&format!("{modulus}5")], &[&format!("{modulus}5e6")]);
    let steel = "structure.density=7850";
    raises(
        Kind::SoftStructure,
        SOUND,
        &[steel, &format!("{modulus}2.1e5")],
        &[steel, &format!("{modulus}2.1e11")],
    );
}

#[test]
fn a_flow_far_beyond_the_tested_range() {
    let inflow = |speed: &str| format!("fluid.boundary.left.velocity=[{speed}, 0]");
    let fast = inflow("\"1e5*t\"");
    raises(Kind::ReynoldsNumber, WALL, &[&fast], &[&inflow("\"10*t\"")]);
    raises(Kind::CellReynoldsNumber, WALL, &[&fast], &[&inflow("\"10*t\"")]);
    raises(Kind::CourantNumber, WALL, &[&fast], &[&inflow("\"5*t\"")]);
    raises(Kind::CourantNumber, WALL, &[&inflow("\"100*t\"")], &[&inflow("\"100*t\""), "time.step=0.001"]);
    raises(Kind::ReynoldsNumber, WALL, &[&fast], &[&fast, "fluid.convection=false"]);
}

#[test]
fn a_wall_that_jumps_or_starts_at_full_speed() {
    let motion = |y: &str| format!("fluid.boundary.top.wall_motion=[0, \"{y}\"]");
    raises(Kind::MotionJump, WALL, &[&motion("0.05*cos(t)")], &[&motion("0.05*(1 - cos(t))")]);
    raises(Kind::MotionJump, WALL, &[&motion("0.01*t")], &[&motion("0.01*t^2")]);
}

#[test]
fn a_relaxation_that_the_added_mass_defeats() {
    let relaxation = "coupling.acceleration.constant.relaxation=";
    raises(Kind::AddedMass, SOUND, &[&format!("{relaxation}0.5")], &[&format!("{relaxation}0.001")]);
    raises(Kind::AddedMass, SOUND, &[&format!("{relaxation}0.5")], &["coupling.acceleration=aitken"]);
}

/// The bound that the warning names is where the iteration really turns: below it the residual falls, above it grows.
#[test]
fn the_largest_relaxation_is_where_the_iteration_turns() {
    let (_guard, folder) = folder_with(SOUND);
    let relaxation = |omega: f64| format!("coupling.acceleration.constant.relaxation={omega}");
    let check = partita(&folder, &["check", "case.toml", "--set", &relaxation(0.9)]);
    let bound = check.stderr.split("diverges above ").nth(1).and_then(|rest| rest.split(';').next());
    let bound: f64 = bound.expect("the bound is named").parse().expect("a number");
    let last_residual = |omega: f64, out: &str| {
        let run = partita(
            &folder,
            &[
                "run",
                "case.toml",
                "--out",
                out,
                "--steps",
                "1",
                "--set",
                &relaxation(omega),
                "--set",
                "coupling.max_iterations=25",
                "--set",
                "coupling.on_limit=accept",
                "--set",
                "output.fields_every=0",
            ],
        );
        // Where it diverges the run may end before the limit.
        let records = std::fs::read_to_string(folder.join(out).join("run.jsonl")).expect("records");
        let residuals = records
            .lines()
            .filter_map(|line| serde_json::from_str::<Value>(line).ok()?["iteration"]["residual"].as_f64());
        let residuals: Vec<f64> = residuals.collect();
        assert!(residuals.len() > 3, "{}", run.stderr);
        residuals[residuals.len() - 1] / residuals[2]
    };
    assert!(last_residual(0.7 * bound, "below") < 1.0, "it converges below {bound}");
    assert!(last_residual(1.4 * bound, "above") > 1.0, "it diverges above {bound}");
}

#[test]
fn tolerances_below_round_off_or_above_the_load() {
    for field in ["fluid", "structure"] {
        let tolerance = |kind: &str, bound: &str| format!("{field}.newton.tolerance.{kind}={bound}");
        raises(
            Kind::TightTolerance,
            SOUND,
            &[&tolerance("relative", "1e-16")],
            &[&tolerance("relative", "1e-12")],
        );
        raises(
            Kind::TightTolerance,
            SOUND,
            &[&tolerance("absolute", "1e-12")],
            &[&tolerance("absolute", "1e-8")],
        );
        raises(
            Kind::LooseTolerance,
            SOUND,
            &[&tolerance("absolute", "1e6")],
            &[&tolerance("absolute", "1e-3")],
        );
    }
    let coupling = |choice: &str| format!("coupling.convergence={choice}");
    raises(Kind::TightTolerance, SOUND, &[&coupling("{changes=1e-17}")], &[&coupling("{changes=1e-8}")]);
    raises(Kind::LooseTolerance, SOUND, &[&coupling("{changes=0.9}")], &[&coupling("{changes=1e-3}")]);
    raises(
        Kind::LooseTolerance,
        SOUND,
        &[&coupling("{interface_residual={absolute=10.0}}")],
        &[&coupling("{interface_residual={absolute=1e-6}}")],
    );
}

#[test]
fn a_formula_that_is_not_finite_at_the_start_alone() {
    let inflow = |x: &str| format!("fluid.boundary.left.velocity=[\"{x}\", 0]");
    raises(Kind::NotFinite, WALL, &[&inflow("1e-3/t")], &[&inflow("1e-3/(t + 1)")]);
}

#[test]
fn a_formula_that_is_not_finite_where_the_run_uses_it_is_an_error() {
    for (set, place) in [
        ("fluid.boundary.left.velocity=[\"1/(y - 0.5)\", 0]", "velocity is inf at (0, 0.5) m, t = 0.1 s"),
        ("fluid.boundary.left.velocity=[\"1/(10 - t)\", 0]", "t = 10 s"),
        ("fluid.boundary.left.velocity=[0, \"sqrt(0.5 - y)\"]", "velocity is NaN at (0, 0.75) m"),
        ("fluid.body_force=[\"ln(x - 0.5)\", 0]", "body force is NaN"),
        ("fluid.initial.velocity=[\"1/x\", 0]", "initial velocity is inf"),
        ("fluid.boundary.right.traction=[\"1/y\", 0]", "traction is inf"),
        ("fluid.boundary.top.wall_motion=[\"0/(x - 0.25)\", 0]", "displacement is NaN"),
    ] {
        let (_guard, folder) = folder_with(WALL);
        for command in ["check", "run"] {
            let outcome = partita(&folder, &[command, "case.toml", "--set", set]);
            assert_eq!(outcome.code, 2, "{set}: {}", outcome.stderr);
            let words = outcome.stderr.split_whitespace().collect::<Vec<_>>().join(" ");
            assert!(words.contains(place), "{set}: {words}");
        }
    }
    // A wall holds the corner, so that no run asks for the inflow there.
    assert_eq!(names(WALL, &["fluid.boundary.left.velocity=[\"0*ln(y)*ln(1-y)\", 0]"]), Vec::<String>::new());
}

#[test]
fn warnings_are_lines_with_place_reason_and_remedy() {
    let (_guard, folder) = folder_with(&matching());
    let set = format!("{RADIUS}1");
    let check = partita(&folder, &["check", "case.toml", "--set", &set]);
    assert_eq!(check.code, 0);
    let line = format!("warning: --set {}, structure.time_scheme: ", set.replace('=', " = "));
    assert!(check.stderr.starts_with(&line) && check.stderr.lines().count() == 1, "{}", check.stderr);
    assert!(check.stderr.trim_end().ends_with("[undamped_structure]"), "{}", check.stderr);
    let run = partita(&folder, &["run", "case.toml", "--set", &set, "--steps", "1", "--out", "out"]);
    assert!(run.code == 0 && run.stderr.starts_with(&line), "{}", run.stderr);
}

#[test]
fn denied_warnings_end_before_anything_is_written() {
    let (_guard, folder) = folder_with(&matching());
    let set = format!("{RADIUS}1");
    for command in ["check", "run"] {
        let outcome = partita(&folder, &[command, "case.toml", "--set", &set, "--deny-warnings"]);
        assert_eq!((outcome.code, outcome.stdout.as_str()), (2, ""), "{}", outcome.stderr);
        assert!(outcome.stderr.contains("1 warning is denied"), "{}", outcome.stderr);
        assert_eq!(crate::program::entries(&folder), ["case.toml"]);
    }
}

#[test]
fn an_accepted_warning_is_not_denied_and_listed_with_its_reason() {
    let scene = format!("{}\n[warnings.accept]\nundamped_structure = \"as the paper has it\"\n", matching());
    let (_guard, folder) = folder_with(&scene);
    let set = format!("{RADIUS}1");
    let outcome = partita(&folder, &["check", "case.toml", "--json", "--deny-warnings", "--set", &set]);
    assert_eq!((outcome.code, outcome.stderr.as_str()), (0, ""), "{}", outcome.stdout);
    let object: Value = serde_json::from_str(&outcome.stdout).expect("JSON");
    assert_eq!(object["warnings"][0]["accepted"], "as the paper has it");
}

#[test]
fn only_warnings_that_exist_are_accepted_and_only_with_a_reason() {
    for (line, message) in [
        ("undamped_structur = \"why not\"", "did you mean `undamped_structure`?"),
        ("undamped_structure = \" \"", "a reason is not empty"),
    ] {
        let (_guard, folder) = folder_with(&format!("{SOUND}\n[warnings.accept]\n{line}\n"));
        let outcome = partita(&folder, &["check", "case.toml"]);
        assert!(outcome.code == 2 && outcome.stderr.contains(message), "{}", outcome.stderr);
    }
}

#[test]
fn errors_are_json_too() {
    let (_guard, folder) = folder_with(&SOUND.replacen("density = 1000.0", "densty = -1.0", 1));
    let outcome = partita(&folder, &["check", "case.toml", "--json"]);
    assert_eq!((outcome.code, outcome.stderr.as_str()), (2, ""));
    let object: Value = serde_json::from_str(&outcome.stdout).expect("JSON");
    assert_eq!(object["sound"], false);
    let errors = object["errors"].as_array().expect("a list");
    assert_eq!((errors.len(), errors[0]["place"].as_str()), (2, Some("case.toml:8")), "{errors:?}");
}

/// Every published scene is as it is meant to be, or says why not.
#[test]
fn published_scenes_pass_with_warnings_denied() {
    let scenes = Path::new(env!("CARGO_MANIFEST_DIR")).join("../scenes");
    let mut checked = 0;
    for entry in std::fs::read_dir(&scenes).expect("the scenes are there") {
        let folder = entry.expect("an entry").path();
        for file in ["scene.toml", "rigid.toml"].map(|name| folder.join(name)) {
            if file.is_file() {
                let path = file.display().to_string();
                let outcome = partita(Path::new("."), &["check", &path, "--deny-warnings"]);
                assert_eq!(outcome.code, 0, "{path}: {}", outcome.stderr);
                checked += 1;
            }
        }
    }
    assert!(checked >= 12, "{checked} scenes were checked");
}
