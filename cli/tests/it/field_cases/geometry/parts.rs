//! `solid_parts`: pieces that nothing holds.

use super::{Case, refusal, run, unwrapped, warnings};

const FREE: &str = "free_structure";

fn with(case: &Case, name: &str, old: &str, new: &str) {
    let text = case.text("scene.toml");
    assert!(text.contains(old));
    std::fs::write(case.path(name), text.replace(old, new)).expect("the scene is written");
}

#[test]
fn a_piece_that_shares_no_nodes_is_named() {
    let case = Case::new("solid_parts");
    let loose = warnings(&case, "scene.toml", FREE, &[]);
    assert_eq!(loose.len(), 1);
    assert!(loose[0].contains("nothing holds the piece of 46 elements at (1.5, 0.1"), "{loose:?}");
    assert!(loose[0].contains("`Coherence;`"), "{loose:?}");
    let denied = case.partita(&["check", "scene.toml", "--deny-warnings"]);
    assert_eq!(denied.code, 2);
    with(&case, "joined.toml", "parts.msh", "joined.msh");
    assert!(warnings(&case, "joined.toml", FREE, &[]).is_empty());
    run(&case, "joined.toml", "out", &[]);
    let tip = case.last_probe("out", "tip_displacement_y");
    assert!((tip + 0.070).abs() < 0.002, "{tip}");
}

#[test]
fn a_loose_piece_has_no_place_without_inertia() {
    let case = Case::new("solid_parts");
    with(&case, "static.toml", "density = 1000.0", "density = 1000.0\ntime_scheme = \"quasi_static\"");
    let message = refusal(&case, "static.toml", &[]);
    assert!(message.contains("nothing holds the piece of 46 elements at (1.5, 0.1"), "{message}");
    assert!(!message.contains("singular"), "{message}");
    // The run says the same, not that a matrix is singular.
    let ran = case.partita(&["run", "static.toml", "--out", "out"]);
    assert!(ran.code == 2 && unwrapped(&ran.stderr).contains("46 elements"), "{}", ran.stderr);
    // Held in one direction it still moves in the other.
    let message = refusal(&case, "static.toml", &["--set", "structure.held={tip=[\"x\"]}"]);
    assert!(
        message.contains("the supports let the piece of 46 elements") && message.contains("move in y"),
        "{message}"
    );
    run(&case, "static.toml", "held", &["--set", "structure.held={tip=[\"x\",\"y\"]}"]);
    case.replace("static.toml", "parts.msh", "joined.msh");
    run(&case, "static.toml", "joined", &[]);
}

#[test]
fn a_structure_without_supports_is_named() {
    let case = Case::new("solid_parts");
    let free = warnings(&case, "scene.toml", FREE, &["--set", "structure.clamped=[]"]);
    assert_eq!(free.len(), 2, "{free:?}");
    let accepted = format!("\n[warnings.accept]\n{FREE} = \"it falls, that is the point\"\n");
    let text = case.text("scene.toml") + &accepted;
    std::fs::write(case.path("accepted.toml"), text).expect("the scene is written");
    assert!(warnings(&case, "accepted.toml", FREE, &["--deny-warnings"]).is_empty());
    let patch = Case::new("knots_not_unit");
    assert!(warnings(&patch, "scene.toml", FREE, &[]).is_empty());
    let free = warnings(&patch, "scene.toml", FREE, &["--set", "structure.clamped=[]"]);
    assert!(
        free.len() == 1 && free[0].contains("nothing holds the piece of 1 element at (1, 0.5) m"),
        "{free:?}"
    );
    let sliding = warnings(
        &patch,
        "scene.toml",
        FREE,
        &["--set", "structure.clamped=[]", "--set", "structure.held={bottom=[\"y\"]}"],
    );
    assert!(sliding.len() == 1 && sliding[0].contains("move in x"), "{sliding:?}");
}

#[test]
fn mistakes_in_supports_are_told() {
    let case = Case::new("solid_parts");
    let told = |held: &str| refusal(&case, "scene.toml", &["--set", &format!("structure.held={held}")]);
    assert!(told("{tip=[]}").contains("structure.held.tip names no component"));
    assert!(told("{tip=[\"x\",\"x\"]}").contains("names `x` twice"));
    assert!(told("{tip=[\"z\"]}").contains("cannot be `z`"));
    assert!(told("{tup=[\"x\"]}").contains("did you mean `tip`?"));
    assert!(told("{root=[\"x\"]}").contains("both clamped and held"));
}
