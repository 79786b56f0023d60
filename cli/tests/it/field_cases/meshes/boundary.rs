//! Groups without a condition, conditions without a group, and what the conditions let in.

use std::fs;

use super::super::Case;
use super::{refused, says, sound};

const ALL: &str = "4 boundary groups have no condition: `south`, `east`, `north`, `west`";

/// Text of a scene in the folder of the case, under another name.
fn write(case: &Case, name: &str, text: &str) {
    fs::write(case.path(name), text).expect("the scene is written");
}

#[test]
fn a_boundary_that_is_empty_or_left_out_lists_the_groups_of_the_mesh() {
    let case = Case::new("empty_boundary");
    for scene in ["scene.toml", "none.toml"] {
        let message = refused(&case, scene, &[]);
        says(&message, &[ALL, "south = \"no_slip\""]);
        assert!(!message.contains("enclosed") && !message.contains("things are wrong"), "{message}");
    }
    says(&refused(&case, "none.toml", &[]), &["under a heading `[fluid.boundary]`"]);
}

#[test]
fn a_misspelt_group_is_named_with_those_that_have_no_condition() {
    let case = Case::new("empty_boundary");
    for (scene, condition) in [("typo.toml", "no_slip"), ("typo2.toml", "do_nothing")] {
        let message = refused(&case, scene, &[]);
        says(&message, &["no boundary group `sowth`", "did you mean `south`?"]);
        says(&message, &["3 boundary groups have no condition: `east`, `north`, `west`"]);
        assert!(!message.contains("enclosed"), "{condition}: {message}");
    }
}

#[test]
fn one_line_deleted_names_that_group_alone() {
    let case = Case::new("empty_boundary");
    let base = case.text("scene.toml");
    let lines =
        ["south = \"no_slip\"\n", "east = \"do_nothing\"\n", "north = \"no_slip\"\n", "west = \"no_slip\"\n"];
    for (deleted, name) in ["south", "east", "north", "west"].iter().enumerate() {
        let kept: String = (0..4).filter(|&line| line != deleted).map(|line| lines[line]).collect();
        write(&case, "one.toml", &(base.clone() + &kept));
        let message = refused(&case, "one.toml", &[]);
        says(&message, &[&format!("boundary group `{name}` has no condition")]);
        assert!(!message.contains("enclosed") && !message.contains("things are wrong"), "{message}");
    }
    write(&case, "all.toml", &(base.clone() + &lines.concat()));
    sound(&case, "all.toml", &[]);
    // Enclosed indeed: every group has its condition.
    write(&case, "all.toml", &(base + &lines.concat().replace("do_nothing", "no_slip")));
    says(
        &refused(&case, "all.toml", &[]),
        &["the fluid is enclosed: its pressure is known only up to a constant"],
    );
}

const RECTANGLE: &str = r#"title = "A channel"
[time]
step = 0.1
steps = 4
[fluid]
density = 1
viscosity = 1
[fluid.mesh.rectangle]
size = [2, 1]
divisions = [4, 4]
"#;

#[test]
fn the_sides_of_a_rectangle_are_listed_alike() {
    let case = Case::new("empty_boundary");
    let all = "4 boundary groups have no condition: `left`, `right`, `bottom`, `top`";
    for (boundary, expected) in [
        ("", all),
        ("[fluid.boundary]\n", all),
        (
            "[fluid.boundary]\nleft = \"no_slip\"\nrigth = \"no_slip\"\n",
            "2 boundary groups have no condition: `bottom`, `top`",
        ),
        (
            "[fluid.boundary]\nleft = \"no_slip\"\nright = \"no_slip\"\ntop = \"slip\"\n",
            "boundary group `bottom` has no condition",
        ),
    ] {
        write(&case, "rectangle.toml", &format!("{RECTANGLE}{boundary}"));
        let message = refused(&case, "rectangle.toml", &[]);
        says(&message, &[expected]);
        assert!(!message.contains("enclosed"), "{message}");
    }
}

#[test]
fn an_interface_is_asked_for_when_every_group_has_a_condition() {
    let case = Case::new("two_domains");
    let scene = case.text("both.toml");
    let conditions =
        scene.find("inflow = {").expect("conditions")..scene.find("[structure]").expect("a structure");
    let empty = format!("{}{}", &scene[..conditions.start], &scene[conditions.end..]);
    write(&case, "empty.toml", &empty);
    let message = refused(&case, "empty.toml", &[]);
    says(&message, &["4 boundary groups have no condition: `inflow`, `outflow`, `walls`, `fsi`"]);
    assert!(!message.contains("is the interface") && !message.contains("enclosed"), "{message}");
    write(&case, "rigid.toml", &scene.replace("fsi = \"interface\"", "fsi = \"no_slip\""));
    says(&refused(&case, "rigid.toml", &[]), &["no boundary group of the fluid is the interface"]);
}

#[test]
fn parts_of_a_structure_that_its_mesh_does_not_have_are_told_with_those_it_has() {
    let case = Case::new("two_domains");
    let of =
        |key: &str, value: &str| refused(&case, "both.toml", &["--set", &format!("structure.{key}={value}")]);
    says(
        &of("clamped", "[\"rot\"]"),
        &["the mesh of the structure has no part `rot`", "did you mean `root`?"],
    );
    says(&of("clamped", "[\"bolt\"]"), &["no part `bolt`", "parts of its boundary: fsi, root"]);
    says(
        &of("clamped", "[\"inflow\"]"),
        &["the curve `inflow` does not touch the chosen surfaces", "fsi, root"],
    );
    says(&of("clamped", "[\"flap\"]"), &["`flap` is a surface of flap.msh, no part of the boundary"]);
    says(
        &of("wetted", "[]"),
        &["no group of the structure touches the fluid", "groups of the mesh: fsi, root"],
    );
    says(
        &refused(&case, "both.toml", &["--set", "output.probes.force.fluid_force=\"root\""]),
        &["the curve `root` does not touch the chosen surfaces"],
    );
}

/// A uniform inflow between two walls that hold their nodes loses half an edge at each.
#[test]
fn check_prints_the_flow_of_an_inflow_on_the_mesh_and_by_its_formula() {
    let case = Case::new("empty_boundary");
    let page = |left: &str, walls: &str| {
        let boundary = format!(
            "[fluid.boundary]\nleft = {{ velocity = {left} }}\nright = \"do_nothing\"\ntop = \"{walls}\"\nbottom = \"{walls}\"\n"
        );
        write(&case, "channel.toml", &format!("{RECTANGLE}{boundary}"));
        sound(&case, "channel.toml", &[])
    };
    let uniform = page("[1, 0]", "no_slip");
    says(
        &uniform,
        &["inflow through left at t = 0.4 s: 0.75 m2/s on this mesh (-25.0 %), 1 m2/s by its formula"],
    );
    let slip = page("[1, 0]", "slip");
    says(&slip, &["inflow through left at t = 0.4 s: 1 m2/s on this mesh, 1 m2/s by its formula"]);
    // The trapezoidal rule on four edges, 5/8, against 2/3.
    let parabola = page("[\"4*y*(1 - y)*t/0.4\", 0]", "no_slip");
    says(&parabola, &["at t = 0.4 s: 0.625 m2/s on this mesh (-6.2 %), 0.666667 m2/s by its formula"]);
    // The largest flow, not that of the last step.
    let pulse = page("[\"sin(pi*t/0.4)\", 0]", "slip");
    says(&pulse, &["inflow through left at t = 0.2 s: 1 m2/s on this mesh"]);
    let suction = page("[\"-2\", 0]", "slip");
    says(&suction, &["outflow through left at t = 0.4 s: 2 m2/s on this mesh, 2 m2/s by its formula"]);
    let tangential = page("[0, 1]", "slip");
    says(&tangential, &["through left at t = 0.4 s: 0 m2/s on this mesh, 0 m2/s by its formula"]);
    let reference =
        fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/../docs/scene.md")).expect("the docs");
    says(&reference, &["`interface` before `wall_motion`, then `no_slip`, `velocity`, `slip`"]);
}
