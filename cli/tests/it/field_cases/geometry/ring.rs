//! `ring_seam`: structures that close on themselves.

use super::{Case, refusal, run, warnings};

fn sweep(degrees: &str) -> String {
    format!("structure.geometry.arc.sweep={degrees}")
}

#[test]
fn a_joined_arc_moves_as_the_closed_mesh() {
    let case = Case::new("ring_seam");
    let joined = "start_of_seam = { structure_point = [0.8, 1.0] }\ntail = { structure_point = [1.6, 1.0] }";
    case.replace("scene.toml", "[output.probes]", &format!("[output.probes]\n{joined}"));
    run(&case, "scene.toml", "arc", &[]);
    run(&case, "mesh.toml", "mesh", &[]);
    let arc = |column: &str| case.last_probe("arc", column);
    let mesh = |column: &str| case.last_probe("mesh", column);
    for component in ["x", "y"] {
        let [start, end] =
            ["seam_start", "seam_end"].map(|probe| arc(&format!("{probe}_displacement_{component}")));
        assert_eq!(start.to_bits(), end.to_bits(), "the ring falls apart");
    }
    // The fluid's nodes press on the wall like needles; how deep they sink depends on the elements, to a percent.
    let close = |arc: f64, mesh: f64| assert!((arc / mesh - 1.0).abs() < 0.02, "{arc} {mesh}");
    close(arc("seam_start_displacement_x"), mesh("seam_displacement_x"));
    close(arc("start_of_seam_displacement_x"), mesh("seam_displacement_x"));
    close(arc("tail_displacement_x"), mesh("tail_displacement_x"));
    assert!(arc("seam_start_displacement_x") > 0.08);
}

#[test]
fn a_ring_goes_on_from_its_checkpoint_bit_by_bit() {
    let case = Case::new("ring_seam");
    case.replace("scene.toml", "steps = 20", "steps = 4");
    case.replace("scene.toml", "fields_every = 20", "fields_every = 2\ncheckpoint_every = 2");
    run(&case, "scene.toml", "whole", &[]);
    run(&case, "scene.toml", "half", &["--steps", "2"]);
    let resumed = case.partita(&["resume", "half", "--quiet"]);
    assert_eq!(resumed.code, 0, "{}", resumed.stderr);
    for column in ["seam_start_displacement_x", "seam_end_displacement_y"] {
        assert_eq!(case.last_probe("half", column), case.last_probe("whole", column));
    }
    assert!(case.text("whole/fields/structure-000004.vtu").contains("displacement"));
}

/// The seam may lie between nodes of the fluid, and anywhere else gives the same motion.
#[test]
fn the_place_of_the_seam_does_not_matter() {
    let case = Case::new("ring_seam");
    case.replace("scene.toml", "[output.probes]", "[output.probes]\np = { structure_point = [0.8, 1.0] }");
    case.replace("scene.toml", "steps = 20", "steps = 8");
    let moved = |start: &str, out: &str| {
        run(&case, "scene.toml", out, &["--set", &format!("structure.geometry.arc.start={start}")]);
        case.last_probe(out, "p_displacement_x")
    };
    let (at_nose, between) = (moved("180", "a"), moved("33.3", "b"));
    // To a percent, as above.
    assert!((at_nose / between - 1.0).abs() < 0.02, "{at_nose} {between}");
}

#[test]
fn joined_sides_cannot_be_named() {
    let case = Case::new("ring_seam");
    for set in [
        "structure.clamped=[\"left\"]",
        "structure.held={right=[\"x\"]}",
        "structure.wetted=[\"top\",\"right\"]",
    ] {
        let message = refusal(&case, "scene.toml", &["--set", set]);
        assert!(message.contains("the structure closes on itself: its sides"), "{message}");
        assert!(message.contains("are joined"), "{message}");
    }
    let checked = case.partita(&["check", "scene.toml"]);
    assert!(checked.stdout.contains("closed: left and right are joined"), "{}", checked.stdout);
}

#[test]
fn a_full_turn_is_a_ring_more_is_refused_and_less_stays_open() {
    let case = Case::new("ring_seam");
    for more in ["-360.0001", "361", "720", "1e300"] {
        let message = refusal(&case, "scene.toml", &["--set", &sweep(more)]);
        assert!(
            message.contains("would lie on itself") && message.contains("at most 360 degrees"),
            "{message}"
        );
    }
    let closed = |degrees: &str| {
        let checked = case.partita(&["check", "scene.toml", "--set", &sweep(degrees)]);
        assert_eq!(checked.code, 0, "{}", checked.stderr);
        checked.stdout.contains("closed:")
    };
    assert!(closed("-360") && closed("-359.99999999"));
    // 1e-7 of the size: nobody's slit, and not round-off either.
    let gap = warnings(&case, "scene.toml", "open_seam", &["--set", &sweep("-359.99999")]);
    assert!(
        gap.len() == 1 && gap[0].contains("a gap of 7.0e-8 m keeps the sides `left` and `right` apart"),
        "{gap:?}"
    );
    assert!(warnings(&case, "scene.toml", "open_seam", &[]).is_empty());
}

const STRIP: &str = r#"
title = "Strip"
time = { step = 0.01, steps = 3 }
[structure]
density = 1000.0
clamped = []
body_force = [0, -50]
[structure.geometry.curve]
points = [[1, 0], [0.7, 0.7], [0, 1], [-0.7, 0.7], [-1, 0], [-0.7, -0.7], [0, -1], [0.7, -0.7], [1, 0]]
thickness = 0.1
elements = [20, 1]
[structure.material.linear_elastic]
young_modulus = 1e6
poisson_ratio = 0.3
[output.probes]
start = { structure_displacement = [0, 0.5] }
end = { structure_displacement = [1, 0.5] }
"#;

fn strip() -> Case {
    let case = Case::new("ring_seam");
    std::fs::write(case.path("strip.toml"), STRIP).expect("the scene is written");
    case
}

#[test]
fn a_curve_that_ends_where_it_begins_is_a_ring() {
    let case = strip();
    run(&case, "strip.toml", "out", &[]);
    let last = |probe: &str| case.last_probe("out", &format!("{probe}_displacement_y"));
    assert_eq!(last("start").to_bits(), last("end").to_bits());
    assert!(last("start") < -1e-5);
    let named = refusal(&case, "strip.toml", &["--set", "structure.clamped=[\"right\"]"]);
    assert!(named.contains("joined"), "{named}");
    let open = case.partita(&[
        "check",
        "strip.toml",
        "--set",
        "structure.geometry.curve.points=[[1,0],[0,1],[-1,0],[0,-1],[0.9,-0.3]]",
    ]);
    assert!(open.code == 0 && !open.stdout.contains("closed:"), "{}", open.stderr);
}

#[test]
fn a_strip_across_itself_is_refused() {
    let case = strip();
    let loops = "structure.geometry.curve.points=[[1,0.5],[0.5,0.3],[0,0],[-0.5,-0.4],[-1,0],[-0.5,0.4],[0,0],[0.5,-0.3],[1,-0.5]]";
    let message = refusal(&case, "strip.toml", &["--set", loops]);
    assert!(message.contains("the patch overlaps itself: its side"), "{message}");
    let eight = "structure.geometry.curve.points=[[1,0],[0.5,0.5],[0,0],[-0.5,-0.5],[-1,0],[-0.5,0.5],[0,0],[0.5,-0.5],[1,0]]";
    assert!(refusal(&case, "strip.toml", &["--set", eight]).contains("overlaps itself"));
}

/// A square ring of straight pieces: columns 0 and 4 are the same.
const SQUARE: &str = r#"
format = "partita-spline"
version = 1
dimension = 2
degrees = [1, 1]
knots = [[3, 3, 4, 5, 6, 7, 7], [0, 0, 1, 1]]
control_points = [
    [-2, -2], [2, -2], [2, 2], [-2, 2], [-2, -2],
    [-1, -1], [1, -1], [1, 1], [-1, 1], [-1, -1],
]
"#;

fn from_file(patch: &str) -> Case {
    let case = strip();
    std::fs::write(case.path("square.toml"), patch).expect("the patch is written");
    let text = case.text("strip.toml");
    let start = text.find("[structure.geometry").expect("a geometry");
    let end = text.find("[structure.material").expect("a material");
    let text =
        format!("{}[structure.geometry.spline]\nfile = \"square.toml\"\n{}", &text[..start], &text[end..]);
    std::fs::write(case.path("strip.toml"), text).expect("the scene is written");
    case
}

#[test]
fn equal_first_and_last_columns_or_rows_of_a_file_are_joined() {
    let case = from_file(SQUARE);
    let more = ["--set", "structure.geometry.spline.subdivisions=[3,2]"];
    run(&case, "strip.toml", "out", &more);
    let last = |probe: &str| case.last_probe("out", &format!("{probe}_displacement_y"));
    assert_eq!(last("start").to_bits(), last("end").to_bits());
    let checked = case.partita(&["check", "strip.toml"]);
    assert!(
        checked.stdout.contains("8 control points") && checked.stdout.contains("left and right are joined")
    );
    // The same with the parameters exchanged: rows instead of columns, counted from the inside to stay right-handed.
    let rows = SQUARE.replace(
        "knots = [[3, 3, 4, 5, 6, 7, 7], [0, 0, 1, 1]]",
        "knots = [[0, 0, 1, 1], [3, 3, 4, 5, 6, 7, 7]]",
    );
    let start = rows.find("control_points").expect("the key is there");
    let points = "control_points = [[-1, -1], [-2, -2], [1, -1], [2, -2], [1, 1], [2, 2], [-1, 1], [-2, 2], [-1, -1], [-2, -2]]\n";
    let case = from_file(&format!("{}{points}", &rows[..start]));
    let checked = case.partita(&["check", "strip.toml"]);
    assert!(checked.stdout.contains("bottom and top are joined"), "{}{}", checked.stdout, checked.stderr);
    // To the digits of a file.
    let case = from_file(&SQUARE.replacen("[-2, -2]", "[-2.0000000005, -2]", 1));
    assert!(case.partita(&["check", "strip.toml"]).stdout.contains("joined"));
}

#[test]
fn sides_that_touch_otherwise_are_refused_with_the_reason() {
    // Weights in another ratio at one end of the seam: the same line, but other points on it.
    let weights = "weights = [1, 1, 1, 1, 1, 1, 1, 1, 1, 2]\n";
    let message = refusal(&from_file(&format!("{SQUARE}{weights}")), "strip.toml", &[]);
    assert!(message.contains("the sides `left` and `right` of the patch touch"), "{message}");
    assert!(message.contains("weights in the same ratio"), "{message}");
    // A common factor of the weights is none of their business.
    let scaled = "weights = [1, 1, 1, 1, 3, 1, 1, 1, 1, 3]\n";
    let case = from_file(&format!("{SQUARE}{scaled}"));
    assert!(case.partita(&["check", "strip.toml"]).stdout.contains("joined"));
    // Half of one side on the other.
    let half = SQUARE.replacen("[-2, 2], [-2, -2],", "[-2, 2], [-1.5, -1.5],", 1);
    let message = refusal(&from_file(&half), "strip.toml", &[]);
    assert!(
        message.contains("touch near") || message.contains("folds") || message.contains("overlaps"),
        "{message}"
    );
}
