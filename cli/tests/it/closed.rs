//! Enclosed fluids whose boundary moves, as scenes.

use std::f64::consts::TAU;
use std::fmt::Write as _;
use std::fs;

use insta::assert_snapshot;
use tempfile::TempDir;

use super::program::{Outcome, partita};

/// A wheel of radius 0.3 m at (0.5, 0.5) m in a square box of side 1 m, groups `wheel` and `box`.
fn wheel_in_a_box() -> String {
    const AROUND: usize = 24;
    const OUTWARDS: usize = 3;
    let (mut nodes, mut elements) = (String::new(), String::new());
    for layer in 0..=OUTWARDS {
        for k in 0..AROUND {
            let angle = TAU * k as f64 / AROUND as f64;
            let part = layer as f64 / OUTWARDS as f64;
            let r = (1.0 - part) * 0.3 + part * 0.5 / angle.cos().abs().max(angle.sin().abs());
            let number = layer * AROUND + k + 1;
            writeln!(nodes, "{number} {} {} 0", 0.5 + r * angle.cos(), 0.5 + r * angle.sin()).expect("text");
        }
    }
    let node = |layer: usize, k: usize| layer * AROUND + k % AROUND + 1;
    let mut count = 0;
    let mut element = |text: String| {
        count += 1;
        writeln!(elements, "{count} {text}").expect("text");
    };
    for k in 0..AROUND {
        element(format!("1 2 1 1 {} {}", node(0, k), node(0, k + 1)));
        element(format!("1 2 2 2 {} {}", node(OUTWARDS, k), node(OUTWARDS, k + 1)));
        for layer in 0..OUTWARDS {
            let [a, b] = [node(layer, k), node(layer + 1, k)];
            let [c, d] = [node(layer + 1, k + 1), node(layer, k + 1)];
            element(format!("2 2 3 3 {a} {b} {c}"));
            element(format!("2 2 3 3 {a} {c} {d}"));
        }
    }
    format!(
        "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n3\n1 1 \"wheel\"\n1 2 \"box\"\n2 3 \"fluid\"\n\
         $EndPhysicalNames\n$Nodes\n{}\n{nodes}$EndNodes\n$Elements\n{count}\n{elements}$EndElements\n",
        (OUTWARDS + 1) * AROUND
    )
}

const WHEEL: &str = r#"
title = "a wheel in a closed box"
time = { step = 0.02, steps = 10 }
[fluid]
density = 1000.0
viscosity = 10.0
time_scheme = "bdf2"
mesh.gmsh.file = "wheel.msh"
pressure_pin = { point = [0, 0], value = 0 }
[fluid.boundary]
box = "no_slip"
wheel = { wall_motion = ["(x - 0.5)*(cos(t) - 1) - (y - 0.5)*sin(t)", "(x - 0.5)*sin(t) + (y - 0.5)*(cos(t) - 1)"] }
[output]
fields_every = 0
probes.torque.fluid_value = [0.85, 0.5]
probes.volume = "volume_defect"
"#;

const BOX: &str = r#"
title = "pistons at both ends of a closed channel"
time = { step = 0.1, steps = 10 }
[fluid]
density = 1000.0
viscosity = 1.0
mesh.rectangle = { size = [1, 0.5], divisions = [6, 3] }
mesh_motion.slide = ["bottom", "top"]
pressure_pin = { point = [0, 0], value = 0 }
[fluid.boundary]
left = { wall_motion = ["0.1*t", 0] }
right = { wall_motion = ["0.1*t", 0] }
bottom = "slip"
top = "slip"
[output]
fields_every = 0
"#;

fn folder(scene: &str) -> TempDir {
    let folder = tempfile::tempdir().expect("a folder");
    fs::write(folder.path().join("scene.toml"), scene).expect("a scene");
    fs::write(folder.path().join("wheel.msh"), wheel_in_a_box()).expect("a mesh");
    folder
}

fn outcomes(scene: &str, set: &[&str]) -> [Outcome; 2] {
    let folder = folder(scene);
    let set: Vec<&str> = set.iter().flat_map(|set| ["--set", set]).collect();
    let check = [&["check", "scene.toml"], &set[..]].concat();
    let run = [&["run", "scene.toml", "--out", "out", "--quiet"], &set[..]].concat();
    [partita(folder.path(), &check), partita(folder.path(), &run)]
}

#[test]
fn a_wheel_turns_and_a_body_shifts_in_a_closed_box() {
    let shift = r#"fluid.boundary.wheel={ wall_motion = ["0.1*sin(5*t)", "0.3*t^2"] }"#;
    let swing = r#"fluid.boundary.wheel={ wall_motion = ["(x - 0.7)*(cos(t) - 1) - y*sin(t)", "(x - 0.7)*sin(t) + y*(cos(t) - 1)"] }"#;
    let spin = r#"fluid.boundary.wheel={ velocity = ["0.5 - y", "x - 0.5"] }"#;
    for set in [&[][..], &[shift], &[swing], &[spin], &[shift, "fluid.time_scheme=bdf1"]] {
        for outcome in outcomes(WHEEL, set) {
            assert_eq!(outcome.code, 0, "{set:?}: {}", outcome.stderr);
        }
    }
}

#[test]
fn pistons_that_move_alike_run_and_others_are_refused() {
    for outcome in outcomes(BOX, &[]) {
        assert_eq!(outcome.code, 0, "{}", outcome.stderr);
    }
    // In step 6 one of them stops.
    let stops = r#"fluid.boundary.right={ wall_motion = ["0.1*min(t, 0.55)", 0] }"#;
    let [check, run] = outcomes(BOX, &[stops]);
    assert_eq!((check.code, run.code), (2, 3), "{}", check.stderr);
    assert_snapshot!(check.stderr, @r"
    × t = 0.6 s, fluid: moving walls and prescribed velocities carry a net
    │ -2.500e-2 m^2/s out of a closed domain (7.500e-2 m^2/s pass its boundary)
    help: make one boundary an outflow or a traction, or let the walls enclose
          the same volume at all times
    ");
    let run = run.stderr.split_whitespace().filter(|word| *word != "│").collect::<Vec<_>>().join(" ");
    for needed in ["step 6", "net -2.500e-2 m^2/s out", "enclose the same volume at all times"] {
        assert!(run.contains(needed), "{needed} is not in {run}");
    }
}

#[test]
fn an_inflow_without_an_outflow_is_refused() {
    let inflow = r#"fluid.boundary.left={ velocity = ["y*(0.5 - y)", 0] }"#;
    let outflow = r#"fluid.boundary.right={ velocity = ["y*(0.5 - y)", 0] }"#;
    for outcome in outcomes(BOX, &[inflow, outflow, "fluid.mesh_motion.slide=[]"]) {
        assert_eq!(outcome.code, 0, "{}", outcome.stderr);
    }
    let wall = "fluid.boundary.right=no_slip";
    let [check, run] = outcomes(BOX, &[inflow, wall, "fluid.mesh_motion.slide=[]"]);
    assert_eq!((check.code, run.code), (2, 3), "{}", check.stderr);
    assert!(
        run.stderr.contains("prescribed velocities carry a net -") && run.stderr.contains("m^2/s"),
        "{}",
        run.stderr
    );
}

#[test]
fn a_moving_wall_of_an_enclosed_fluid_needs_a_level_of_pressure() {
    let folder = folder(&BOX.replace("pressure_pin = { point = [0, 0], value = 0 }\n", ""));
    let outcome = partita(folder.path(), &["check", "scene.toml"]);
    assert_eq!(outcome.code, 2);
    assert!(outcome.stderr.contains("known only up to a constant"), "{}", outcome.stderr);
}
