//! `overlap`: fluid and structure in one place.

use super::{Case, refusal};

fn sound(case: &Case, scene: &str, more: &[&str]) {
    let checked = case.partita(&[&["check", scene], more].concat());
    assert_eq!(checked.code, 0, "{}", checked.stderr);
}

#[test]
fn a_side_that_is_wetted_from_inside_is_refused_with_the_place() {
    let case = Case::new("overlap");
    let message = refusal(&case, "scene.toml", &[]);
    assert!(
        message.contains("at (0.0625, 0) m fluid and structure lie on the same side of the interface"),
        "{message}"
    );
    assert!(
        message.contains("`bottom` is wetted from inside") && message.contains("8 of 8 edges"),
        "{message}"
    );
    let ran = case.partita(&["run", "scene.toml"]);
    assert!(ran.code == 2 && ran.stderr.contains("same side"), "{}", ran.stderr);
    // Below the water it is a bottom.
    sound(
        &case,
        "scene.toml",
        &["--set", "structure.geometry.rectangle.origin=[0,-0.3]", "--set", "structure.wetted=[\"top\"]"],
    );
    // Another side of the tank, wetted from inside as well.
    case.replace("scene.toml", "bottom = \"interface\"", "bottom = \"no_slip\"");
    case.replace("scene.toml", "left = \"no_slip\"", "left = \"interface\"");
    case.replace("scene.toml", "size = [1.0, 0.3]", "size = [0.3, 1.0]");
    let sides = ["--set", "structure.clamped=[\"bottom\",\"top\"]", "--set", "structure.wetted=[\"left\"]"];
    let message = refusal(&case, "scene.toml", &sides);
    assert!(message.contains("at (0, ") && message.contains("`left` is wetted from inside"), "{message}");
}

#[test]
fn a_structure_that_reaches_into_the_fluid_is_refused() {
    let case = Case::new("overlap");
    // Wetted from the right side, but the strip leads back through the water.
    let strip = "[structure.geometry.spline]\nfile = \"hook.toml\"\n[structure.material";
    let text = case.text("scene.toml");
    let (start, end) = (text.find("[structure.geometry").unwrap(), text.find("[structure.material").unwrap());
    let text = format!("{}{strip}{}", &text[..start], &text[end + "[structure.material".len()..]);
    let text = text
        .replace("wetted = [\"bottom\"]", "wetted = [\"top\"]")
        .replace("[\"left\", \"right\"]", "[\"left\"]");
    std::fs::write(case.path("hook.toml.scene"), &text).unwrap();
    // One column beside the tank, the top of the rest is the bottom of the water.
    let patch = |far: f64| {
        format!(
            "format = \"partita-spline\"\nversion = 1\ndimension = 2\ndegrees = [1, 1]\nknots = [[0, 0, 1, 1], [0, 0, 1, 1]]\n\
             control_points = [[0, -0.1], [{far}, -0.1], [0, 0], [1, 0]]\n"
        )
    };
    std::fs::write(case.path("hook.toml"), patch(1.0)).unwrap();
    sound(&case, "hook.toml.scene", &[]);
    // A second layer above the interface: a ring round the bottom edge of the tank whose upper half is in the water.
    std::fs::write(
        case.path("hook.toml"),
        "format = \"partita-spline\"\nversion = 1\ndimension = 2\ndegrees = [1, 1]\n\
         knots = [[0, 0, 1, 2, 3, 3], [0, 0, 1, 1]]\n\
         control_points = [[0.5, 0.4], [-0.3, 0.4], [-0.3, -0.3], [1.3, -0.3], [0.5, 0.6], [-0.5, 0.6], [-0.5, -0.5], [1.3, -0.5]]\n",
    )
    .unwrap();
    let checked = case.partita(&["check", "hook.toml.scene"]);
    assert_eq!(checked.code, 2, "{}", checked.stdout);
}

/// A beam in a channel, with fluid on both sides and round its end.
#[test]
fn thin_beams_and_coarse_curves_are_no_overlap() {
    let scenes = concat!(env!("CARGO_MANIFEST_DIR"), "/../scenes");
    let case = Case::new("ring_seam");
    for name in ["beam-in-channel", "turek-hron-fsi1", "turek-hron-fsi2", "elastic-bottom"] {
        sound(&case, &format!("{scenes}/{name}"), &[]);
    }
    sound(&case, "scene.toml", &[]);
    sound(&case, "mesh.toml", &[]);
    // A ring thinner than the distance between the circle and the chords of the fluid's edges.
    sound(&case, "scene.toml", &["--set", "structure.geometry.arc.radii=[0.3995,0.4]"]);
    // From inside: the ring lies outside of the hole, in the fluid.
    let inverted =
        ["--set", "structure.geometry.arc.radii=[0.4,0.5]", "--set", "structure.wetted=[\"bottom\"]"];
    let message = refusal(&case, "scene.toml", &inverted);
    assert!(
        message.contains("40 of 40 edges") && message.contains("`bottom` is wetted from inside"),
        "{message}"
    );
}

#[test]
fn a_mesh_that_is_wetted_from_inside_is_refused_too() {
    let case = Case::new("ring_seam");
    let text = case.text("solid.msh").replace("\"outer\"", "\"skin\"").replace("\"inner\"", "\"outer\"");
    std::fs::write(case.path("solid.msh"), text).expect("the mesh is written");
    // Scaled about the origin and moved by the fluid's scale it does not fit; the message is the one of the place.
    let message = refusal(&case, "mesh.toml", &[]);
    assert!(message.contains("lie off the structure"), "{message}");
}
