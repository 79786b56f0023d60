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

/// Two plates: one under the tank from (0, -0.1) to (1, 0), whose upper edge is the group `skin`, and one with its lower
/// left corner at a place of its own.
fn plates([x, y]: [f64; 2]) -> String {
    let corners = [
        [0.0, -0.1],
        [1.0, -0.1],
        [1.0, 0.0],
        [0.0, 0.0],
        [x, y],
        [x + 0.2, y],
        [x + 0.2, y + 0.2],
        [x, y + 0.2],
    ];
    let nodes: Vec<String> =
        corners.iter().enumerate().map(|(i, [x, y])| format!("{} {x} {y} 0\n", i + 1)).collect();
    format!(
        "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n2\n1 1 \"skin\"\n1 2 \"foot\"\n$EndPhysicalNames\n\
         $Nodes\n8\n{}$EndNodes\n$Elements\n4\n1 1 2 1 1 3 4\n2 1 2 2 2 1 2\n3 3 2 3 3 1 2 3 4\n4 3 2 3 3 5 6 7 8\n\
         $EndElements\n",
        nodes.concat()
    )
}

#[test]
fn a_structure_that_reaches_into_the_fluid_is_refused() {
    let case = Case::new("overlap");
    let text = case.text("scene.toml");
    let [start, end] =
        ["[structure.geometry", "[structure.material"].map(|table| text.find(table).expect("a table"));
    let text =
        format!("{}[structure.geometry.gmsh]\nfile = \"plates.msh\"\n{}", &text[..start], &text[end..]);
    let text = text.replace("[\"bottom\"]", "[\"skin\"]").replace("[\"left\", \"right\"]", "[\"foot\"]");
    let text = text.replace("structure_displacement", "structure_point");
    std::fs::write(case.path("plates.toml"), text).expect("the scene is written");
    let with_second = |place| {
        std::fs::write(case.path("plates.msh"), plates(place)).expect("the mesh is written");
        &case
    };
    sound(with_second([1.4, 0.4]), "plates.toml", &[]);
    let message = refusal(with_second([0.4, 0.4]), "plates.toml", &[]);
    assert!(message.contains("at (0.4, 0.4) m the structure lies inside the fluid's mesh"), "{message}");
    let message = refusal(with_second([0.9, 0.7]), "plates.toml", &[]);
    assert!(message.contains("inside the fluid's mesh"), "partly: {message}");
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
    let case = Case::new("overlap");
    let text = case.text("scene.toml");
    let [start, end] =
        ["[structure.geometry", "[structure.material"].map(|table| text.find(table).expect("a table"));
    let text =
        format!("{}[structure.geometry.gmsh]\nfile = \"plates.msh\"\n{}", &text[..start], &text[end..]);
    let text = text.replace("[\"bottom\"]", "[\"foot\"]").replace("[\"left\", \"right\"]", "[\"skin\"]");
    let text = text.replace("structure_displacement", "structure_point");
    std::fs::write(case.path("plates.toml"), text).expect("the scene is written");
    // The plate from 0 to 0.1 m, held at the top.
    std::fs::write(
        case.path("plates.msh"),
        plates([3.0, 0.0]).replace(" 0 0\n", " 0.1 0\n").replace(" -0.1 0\n", " 0 0\n"),
    )
    .expect("the mesh is written");
    let message = refusal(&case, "plates.toml", &[]);
    assert!(
        message.contains("`foot` is wetted from inside") && message.contains("8 of 8 edges"),
        "{message}"
    );
}
