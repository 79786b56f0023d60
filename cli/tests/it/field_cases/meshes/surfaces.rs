//! Fluid and structure from the surfaces of one file.

use std::fs;

use super::super::Case;
use super::{refused, says, sound};

/// An override of the surfaces of the fluid's mesh.
fn fluid(names: &str) -> [String; 2] {
    ["--set".to_owned(), format!("fluid.mesh.gmsh.surfaces={names}")]
}

fn with(overrides: &[String]) -> Vec<&str> {
    overrides.iter().map(String::as_str).collect()
}

#[test]
fn a_file_with_several_surfaces_needs_a_choice() {
    let case = Case::new("two_domains");
    for stem in ["two_domains", "two_domains_iface"] {
        let message = refused(&case, &format!("{stem}.toml"), &[]);
        let surfaces = format!("{stem}.msh has 2 physical surfaces: `fluid`, `solid`");
        says(&message, &[&surfaces, "`surfaces = \"fluid\"`", "[fluid.mesh.gmsh]"]);
    }
    let message = refused(&case, "both.toml", &["--set", "structure.geometry.gmsh={ file = \"flap.msh\" }"]);
    says(
        &message,
        &["flap.msh has 2 physical surfaces: `water`, `flap`", "the structure", "[structure.geometry.gmsh]"],
    );
}

#[test]
fn a_chosen_surface_is_bounded_by_the_curves_that_touch_it() {
    let case = Case::new("two_domains");
    let scene = case.text("two_domains_iface.toml");
    let chosen = scene.replace("north = \"no_slip\"\nwest = \"no_slip\"\n", "fsi = \"no_slip\"\n");
    fs::write(case.path("chosen.toml"), &chosen).expect("the scene is written");
    let overrides = fluid("\"fluid\"");
    let page = sound(&case, "chosen.toml", &with(&overrides));
    says(
        &page,
        &[
            "1 triangles, 3 nodes",
            "fsi       1 edges  no_slip",
            "surfaces (and their elements): fluid (1), solid (1, left out)",
            "curves (and their elements): south (1), east (1), north (1, left out), west (1, left out), fsi (1)",
        ],
    );
    assert_eq!(page, sound(&case, "chosen.toml", &with(&fluid("[\"fluid\"]"))), "a list of one is that one");
    // A condition on a curve of the other part.
    says(
        &refused(&case, "two_domains_iface.toml", &with(&overrides)),
        &[
            "the curve `north` does not touch the chosen surfaces",
            "the curve `west` does not touch the chosen surfaces",
            "boundary group `fsi` has no condition",
        ],
    );
    // Both surfaces together: the curve between them is no boundary, and no condition can stand there.
    let both = fluid("[\"fluid\", \"solid\"]");
    let page = sound(&case, "two_domains_iface.toml", &with(&both));
    says(&page, &["2 triangles, 4 nodes", "fsi (1, inside)", "fluid (1), solid (1)\n"]);
    says(&refused(&case, "chosen.toml", &with(&both)), &["the curve `fsi` lies inside the mesh"]);
    // Without a curve there the chosen part has an edge that nothing is said about.
    let message = refused(&case, "two_domains.toml", &with(&overrides));
    says(&message, &["1 boundary edge belongs to no group of the mesh, the first at (0.5, 0.5) m"]);
    assert!(!message.contains("enclosed"), "{message}");
}

#[test]
fn a_choice_that_cannot_be_met_is_told() {
    let case = Case::new("two_domains");
    let of = |names: &str| refused(&case, "two_domains_iface.toml", &with(&fluid(names)));
    says(&of("\"fluidd\""), &["has no physical surface `fluidd`", "did you mean `fluid`?"]);
    says(&of("[\"fluid\", \"air\"]"), &["has no physical surface `air`", "`fluid`, `solid`"]);
    says(&of("\"fsi\""), &["`fsi` is a curve of two_domains_iface.msh, not a surface", "`fluid`, `solid`"]);
    says(&of("\"\""), &["has no physical surface ``"]);
    says(&of("[]"), &["surfaces", "the name of a group in quotes, or a list of them"]);
    says(&of("3"), &["surfaces", "the name of a group in quotes, or a list of them"]);
    says(&of("[\"fluid\", \"fluid\"]"), &["`fluid` is named twice"]);
    case.replace("two_domains_iface.msh", "$PhysicalNames\n7\n", "$PhysicalNames\n8\n2 7 \"ice\"\n");
    says(&of("\"ice\""), &["surface `ice` of two_domains_iface.msh has no cells", "it is only named"]);
}

#[test]
fn cells_outside_of_the_surfaces_are_not_taken_in_silence() {
    let case = Case::new("two_domains");
    case.replace("two_domains.msh", "6 2 2 9 1 1 3 4", "6 2 2 0 1 1 3 4");
    let message = refused(&case, "two_domains.toml", &[]);
    says(
        &message,
        &[
            "1 cells of two_domains.msh belong to no physical surface, the others to `fluid`",
            "surfaces = \"fluid\"",
        ],
    );
    // Without any surface the whole file is the mesh, as ever, and there is nothing to choose.
    case.replace("two_domains.msh", "5 2 2 8 1 1 2 3", "5 2 2 0 1 1 2 3");
    case.replace("two_domains.msh", "$PhysicalNames\n6", "$PhysicalNames\n4");
    case.replace("two_domains.msh", "2 8 \"fluid\"\n2 9 \"solid\"\n", "");
    says(&sound(&case, "two_domains.toml", &[]), &["2 triangles, 4 nodes"]);
    let message = refused(&case, "two_domains.toml", &with(&fluid("\"fluid\"")));
    says(&message, &["has no physical surface `fluid`", "leave out `surfaces`"]);
}

#[test]
fn one_surface_needs_no_choice_and_takes_one() {
    let case = Case::new("empty_boundary");
    let conditions = "south = \"no_slip\"\neast = \"do_nothing\"\nnorth = \"no_slip\"\nwest = \"no_slip\"\n";
    fs::write(case.path("scene.toml"), case.text("scene.toml") + conditions).expect("the scene is written");
    let page = sound(&case, "scene.toml", &[]);
    assert_eq!(page, sound(&case, "scene.toml", &with(&fluid("\"water\""))));
    says(&page, &["surfaces (and their elements): water (2)\n"]);
}

#[test]
fn the_fluid_of_a_file_with_a_solid_runs_alone() {
    let case = Case::new("two_domains");
    let page = sound(&case, "fluid.toml", &[]);
    says(&page, &["water (", "flap (", ", left out)", "inflow through inflow at t = 0.2 s"]);
    let run = case.partita(&["run", "fluid.toml", "--out", "out", "--quiet"]);
    assert_eq!(run.code, 0, "{}", run.stderr);
}

#[test]
fn fluid_and_structure_of_one_file_run_coupled() {
    let case = Case::new("two_domains");
    let page = sound(&case, "both.toml", &[]);
    says(&page, &["fsi", "interface", "clamped: root; wetted: fsi"]);
    let run = case.partita(&["run", "both.toml", "--out", "out", "--quiet"]);
    assert_eq!(run.code, 0, "{}", run.stderr);
    let bent = case.last_probe("out", "tip_displacement_x");
    assert!((1e-5..0.1).contains(&bent), "the flow bends the flap by {bent} m");
    // The copies that the run keeps are the whole file, with the choice beside it.
    assert_eq!(
        fs::read(case.path("out/input/fluid.msh")).expect("a copy"),
        fs::read(case.path("flap.msh")).expect("the mesh")
    );
    let again = case.partita(&["check", "out/scene.toml"]);
    assert_eq!(again.code, 0, "{}", again.stderr);
}
