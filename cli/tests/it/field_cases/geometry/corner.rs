//! `free_corner`: ends of a structure on fixed walls.

use super::{Case, run, warnings};

const DRAGGED: &str = "dragged_corner";
const ROLLER: [&str; 2] = ["--set", "structure.held={right=[\"x\"]}"];

#[test]
fn a_roller_keeps_the_end_on_its_wall() {
    let case = Case::new("free_corner");
    run(&case, "scene.toml", "free", &[]);
    run(&case, "scene.toml", "roller", &ROLLER);
    let [free, roller] = ["free", "roller"].map(|out| case.last_probe(out, "end_displacement_x"));
    assert!(free < -0.03, "{free}");
    assert_eq!(roller, 0.0);
    let flow = case.last_probe("roller", "flow_through_right_wall_flow_rate");
    assert!(flow.abs() < 1e-15, "{flow:e}");
    // Along the wall it moves on.
    let sinks = case.last_probe("roller", "end_displacement_y");
    assert!(sinks < -0.2, "{sinks}");
}

#[test]
fn a_dragged_corner_is_named_with_its_place_and_its_remedy() {
    let case = Case::new("free_corner");
    let found = warnings(&case, "scene.toml", DRAGGED, &[]);
    assert_eq!(found.len(), 1);
    assert!(found[0].contains("fixed wall `right` at (1, 0) m off the wall"), "{found:?}");
    assert!(found[0].contains("`structure.held = { right = [\"x\"] }`"), "{found:?}");
    assert!(warnings(&case, "scene.toml", DRAGGED, &ROLLER).is_empty());
    let clamped = ["--set", "structure.clamped=[\"left\",\"right\"]"];
    assert!(warnings(&case, "scene.toml", DRAGGED, &clamped).is_empty());
    // The wrong direction does not help, and both ends may be free.
    assert_eq!(warnings(&case, "scene.toml", DRAGGED, &["--set", "structure.held={right=[\"y\"]}"]).len(), 1);
    let both = ["--set", "structure.clamped=[]", "--set", "structure.held={bottom=[\"y\"]}"];
    assert_eq!(warnings(&case, "scene.toml", DRAGGED, &both).len(), 2);
    // A wall with slip is one, too; sliding mesh nodes do not keep the corner.
    case.replace("scene.toml", "right = \"no_slip\"", "right = \"slip\"");
    assert_eq!(warnings(&case, "scene.toml", DRAGGED, &[]).len(), 1);
    // An opening has no shape to keep; a structure that does not move the fluid drags nothing.
    case.replace("scene.toml", "right = \"slip\"", "right = \"do_nothing\"");
    assert!(warnings(&case, "scene.toml", DRAGGED, &[]).is_empty());
    case.replace("scene.toml", "right = \"do_nothing\"", "right = \"no_slip\"");
    assert!(warnings(&case, "scene.toml", DRAGGED, &["--set", "coupling.direction=\"one_way\""]).is_empty());
}

/// A wetted side on rollers keeps its horizontal places: the fluid's mesh moves in y alone.
#[test]
fn a_wetted_side_may_be_held_in_one_direction() {
    let case = Case::new("free_corner");
    run(&case, "scene.toml", "out", &["--set", "structure.held={top=[\"x\"]}"]);
    assert_eq!(case.last_probe("out", "end_displacement_x"), 0.0);
    assert!(case.last_probe("out", "end_displacement_y") < -0.05);
}

#[test]
fn rollers_and_checkpoints_go_together() {
    let case = Case::new("free_corner");
    case.replace("scene.toml", "steps = 25", "steps = 6");
    case.replace("scene.toml", "fields_every = 25", "fields_every = 0\ncheckpoint_every = 3");
    run(&case, "scene.toml", "whole", &ROLLER);
    run(&case, "scene.toml", "half", &[&ROLLER[..], &["--steps", "3"]].concat());
    let resumed = case.partita(&["resume", "half", "--quiet"]);
    assert_eq!(resumed.code, 0, "{}", resumed.stderr);
    assert_eq!(case.last_probe("half", "end_displacement_y"), case.last_probe("whole", "end_displacement_y"));
    assert!(case.text("half/scene.toml").contains("held"), "the scene of the run keeps its supports");
}
