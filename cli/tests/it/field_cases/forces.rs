//! `interface_ends`: the load at the ends of an interface is the traction of its own side alone.

use super::Case;

/// What water of 0.5 m and 10 m/s2 does to the bar, which sinks by d: d = -0.2 m rho g (0.5 m - d)/E.
const SINKS: f64 = -1e-6 / (1.0 - 2e-6);
const WEIGHT: f64 = -1e4 * (0.5 - SINKS);

/// Splines that are the fluid's own hat functions: any transfer is exact.
const HATS: &str = "structure.geometry.rectangle.degree=[1, 1]";
const CUBIC: &str = "structure.geometry.rectangle.degree=[3, 2]";

fn run(case: &Case, scene: &str, sets: &[&str]) {
    let overrides = sets.iter().flat_map(|set| ["--set", set]);
    let arguments = ["run", scene, "--out", "out", "--force", "--quiet"].into_iter().chain(overrides);
    let outcome = case.partita(&arguments.collect::<Vec<_>>());
    assert_eq!(outcome.code, 0, "{sets:?}: {}", outcome.stderr);
}

/// Probes of a run by their names, all at their values. The coupling stops at changes of 1e-10, of a weight of 5000 N/m.
#[track_caller]
fn assert_probes(case: &Case, what: &str, expected: &[(&str, f64)], tolerance: f64) {
    for (column, value) in expected {
        let found = case.last_probe("out", column);
        assert!((found - value).abs() < tolerance, "{what}: {column} is {found:e}, not {value:e}");
    }
}

#[track_caller]
fn assert_even_compression(case: &Case, what: &str, [length, force]: [f64; 2], [across, along]: [&str; 2]) {
    let places = ["end", "middle"].map(|place| [across, along].map(|c| format!("{place}_displacement_{c}")));
    for [across, along] in &places {
        assert_probes(case, what, &[(across, 0.0), (along, SINKS)], length);
    }
    let pushed = -0.5 * 1e4 * (0.5 - SINKS) * (0.5 - SINKS);
    for (group, axis, value) in
        [("bottom", across, 0.0), ("bottom", along, WEIGHT), ("left", across, pushed), ("left", along, 0.0)]
    {
        assert_probes(case, what, &[(&format!("{group}_force_{axis}"), value)], force);
    }
}

#[test]
fn a_fixed_wall_puts_no_load_on_the_end_of_the_bar() {
    let case = Case::new("interface_ends");
    run(&case, "scene.toml", &[]);
    assert_even_compression(&case, "as it came", [1e-15, 1e-7], ["x", "y"]);
    for divisions in ["[8, 8]", "[16, 8]", "[32, 16]"] {
        run(&case, "scene.toml", &[CUBIC, &format!("fluid.mesh.rectangle.divisions={divisions}")]);
        assert_even_compression(&case, &format!("cubic, {divisions}"), [1e-15, 1e-7], ["x", "y"]);
    }
    for divisions in ["[16, 8]", "[32, 16]", "[64, 9]"] {
        let mesh = format!("fluid.mesh.rectangle.divisions={divisions}");
        run(&case, "scene.toml", &[HATS, &mesh]);
        assert_even_compression(&case, divisions, [1e-15, 1e-7], ["x", "y"]);
    }
}

#[test]
fn neighbours_of_every_kind_leave_the_compression_even() {
    let case = Case::new("interface_ends");
    for left in ["slip", "no_slip", "{velocity=[0, 0]}"] {
        for right in ["slip", "no_slip"] {
            let walls = [left, right];
            let sets =
                [HATS, &format!("fluid.boundary.left={left}"), &format!("fluid.boundary.right={right}")];
            run(&case, "scene.toml", &sets);
            assert_even_compression(&case, &format!("{walls:?}"), [1e-15, 1e-7], ["x", "y"]);
        }
    }
}

#[test]
fn a_bar_that_stands_is_compressed_as_evenly() {
    let case = Case::new("interface_ends");
    let text = case.text("turned.toml");
    // The wall below plays the left one, and the interface on the left the bottom.
    let probes = "bottom = { fluid_force = \"bottom\" }\nleft = { fluid_force = \"left\" }";
    assert!(text.contains(probes), "{text}");
    case.replace(
        "turned.toml",
        probes,
        "bottom = { fluid_force = \"left\" }\nleft = { fluid_force = \"bottom\" }",
    );
    run(&case, "turned.toml", &[HATS]);
    assert_even_compression(&case, "turned", [1e-15, 1e-7], ["y", "x"]);
}

/// In unsteady flow the water gets its pressure while the bar sinks, at 1e-6 m/s.
#[test]
fn unsteady_water_comes_to_the_same_compression() {
    let case = Case::new("interface_ends");
    let sets = [HATS, "fluid.time_scheme=bdf2", "time.steps=12", "time.step=10"];
    run(&case, "scene.toml", &sets);
    assert_even_compression(&case, "bdf2", [1e-13, 1e-5], ["x", "y"]);
}

/// Water and bar turned by 0.5 rad, a slip wall on one side, and an interface of two groups that meet in its middle.
#[test]
fn two_interface_groups_on_a_slope_carry_half_of_the_water_each() {
    let case = Case::new("interface_ends");
    run(&case, "tank.toml", &[]);
    let (sin, cos) = 0.5_f64.sin_cos();
    let displacement = [-SINKS * sin, SINKS * cos];
    let half = [-0.5 * WEIGHT * sin, 0.5 * WEIGHT * cos];
    let pushed = 0.5 * 1e4 * (0.5 - SINKS) * (0.5 - SINKS);
    for (place, value, tolerance) in [
        ("start_displacement", displacement, 1e-15),
        ("end_displacement", displacement, 1e-15),
        ("near_force", half, 1e-7),
        ("far_force", half, 1e-7),
        ("both_force", half.map(|force| 2.0 * force), 1e-7),
        ("left_force", [-pushed * cos, -pushed * sin], 1e-7),
        ("right_force", [pushed * cos, pushed * sin], 1e-7),
    ] {
        let columns = ["x", "y"].map(|axis| format!("{place}_{axis}"));
        assert_probes(&case, "slope", &[(&columns[0], value[0]), (&columns[1], value[1])], tolerance);
    }
}

/// The first line after a checkpoint has the forces that the whole run has there.
#[test]
fn forces_of_a_resumed_run_have_the_same_bits() {
    let case = Case::new("interface_ends");
    let sets = ["fluid.time_scheme=bdf2", "time.steps=4", "output.checkpoint_every=1"];
    run(&case, "scene.toml", &sets);
    let whole = case.text("out/probes.csv");
    let overrides = sets.iter().flat_map(|set| ["--set", set]);
    let first =
        ["run", "scene.toml", "--out", "half", "--quiet", "--steps", "2"].into_iter().chain(overrides);
    assert_eq!(case.partita(&first.collect::<Vec<_>>()).code, 0);
    assert_eq!(case.partita(&["resume", "half", "--quiet"]).code, 0);
    assert_eq!(case.text("half/probes.csv"), whole);
}
