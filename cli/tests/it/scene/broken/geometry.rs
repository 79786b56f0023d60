//! Structures whose geometry is no solid.

use std::fs;

use insta::assert_snapshot;
use partita::scene::{Resolved, SceneError, read_in};
use partita_structure::Space;
use tempfile::TempDir;

use super::super::SOUND;
use super::render;

/// Reads the sound scene with another geometry, beside a file `patch.toml`.
fn read(folder: &TempDir, geometry: &str, file: &str) -> Result<Resolved, SceneError> {
    let (before, after) = SOUND.split_once("[structure.geometry.rectangle]").expect("a geometry");
    let (_, after) = after.split_once("\n\n").expect("a table after it");
    fs::write(folder.path().join("patch.toml"), file).expect("a file");
    read_in(folder.path(), "scene.toml", &format!("{before}{geometry}\n\n{after}"), &[])
}

/// Its message.
fn shaped(geometry: &str, file: &str) -> String {
    let folder = TempDir::new().expect("a folder");
    let error = read(&folder, geometry, file).expect_err("the scene is broken");
    render(&error).replace(&folder.path().display().to_string(), "FOLDER")
}

const PATCH: &str = r#"format = "partita-spline"
version = 1
dimension = 2
degrees = [1, 1]
knots = [[0, 0, 1, 1], [0, 0, 1, 1]]
control_points = [[0, -0.05], [1, -0.05], [0, 0], [1, 0]]
"#;

const FROM_FILE: &str = "[structure.geometry.spline]\nfile = \"patch.toml\"";

#[test]
fn a_patch_from_a_file_is_sound() {
    let folder = TempDir::new().expect("a folder");
    let resolved = read(&folder, FROM_FILE, PATCH).unwrap_or_else(|error| panic!("{}", render(&error)));
    assert_eq!(resolved.shapes.structure.as_ref().expect("a patch").node_count(), 4);
    assert!(resolved.to_toml().contains("file = \"input/structure.toml\""));
}

#[test]
fn a_patch_from_a_file_is_refined_without_another_shape() {
    let folder = TempDir::new().expect("a folder");
    let finer = format!("{FROM_FILE}\ndegree = [3, 2]\nsubdivisions = [4, 2]");
    let resolved = read(&folder, &finer, PATCH).unwrap_or_else(|error| panic!("{}", render(&error)));
    let Some(Space::Patch(patch)) = &resolved.shapes.structure else { panic!("no patch") };
    let patch = patch.spline();
    // The degree comes first: 4 cubic elements are as smooth as they can be.
    assert_eq!(patch.control_points().len(), (4 + 3) * (2 + 2));
    let [x, y] = patch.point(&[0.3, 0.6]);
    assert!((x - 0.3).abs() < 1e-14 && (y + 0.02).abs() < 1e-14, "({x}, {y})");
}

#[test]
fn a_degree_below_that_of_the_file_is_refused() {
    let quadratic = PATCH
        .replace("degrees = [1, 1]", "degrees = [1, 2]")
        .replace("[0, 0, 1, 1]]", "[0, 0, 0, 1, 1, 1]]")
        .replace("[0, 0], [1, 0]]", "[0, -0.02], [1, -0.02], [0, 0], [1, 0]]");
    assert_snapshot!(shaped(&format!("{FROM_FILE}\ndegree = [2, 1]"), &quadratic), @r#"
     × patch.toml has the degree 2 along side 1, not 1
       ╭─[scene.toml:28:8]
    27 │ [structure.geometry.spline]
    28 │ file = "patch.toml"
       ·        ──────┬─────
       ·              ╰── this patch
    29 │ degree = [2, 1]
       ╰────
     help: a degree can be raised, not lowered: give 2 or more
    "#);
}

#[test]
fn a_fault_in_a_spline_file_is_named_with_its_line() {
    assert_snapshot!(shaped(FROM_FILE, &PATCH.replace("[1, 0]]", "[1]]")), @r#"
     × patch.toml, line 6, control_points[3]: 1 coordinates
       ╭─[scene.toml:28:8]
    27 │ [structure.geometry.spline]
    28 │ file = "patch.toml"
       ·        ──────┬─────
       ·              ╰── this patch
    29 │ 
       ╰────
     help: with `dimension = 2` a point has 2
    "#);
}

#[test]
fn a_curve_is_no_patch() {
    let curve = "format = \"partita-spline\"\nversion = 1\ndimension = 2\ndegrees = [1]\nknots = [[0, 0, 1, 1]]\ncontrol_points = [[0, 0], [1, 0]]\n";
    assert_snapshot!(shaped(FROM_FILE, curve), @r#"
     × patch.toml holds a curve, not a patch
       ╭─[scene.toml:28:8]
    27 │ [structure.geometry.spline]
    28 │ file = "patch.toml"
       ·        ──────┬─────
       ·              ╰── this patch
    29 │ 
       ╰────
     help: a plane structure is a spline of two parameters: give two degrees and two knot vectors
    "#);
}

#[test]
fn a_mirrored_patch_is_refused() {
    let mirrored =
        PATCH.replace("[[0, -0.05], [1, -0.05], [0, 0], [1, 0]]", "[[1, -0.05], [0, -0.05], [1, 0], [0, 0]]");
    assert_snapshot!(shaped(FROM_FILE, &mirrored), @r#"
     × the patch is mirrored, its Jacobian is negative everywhere, for instance in element 0 at the
     │ parameters [0.0670, 0.0670], near [0.933013, -0.046651]
       ╭─[scene.toml:28:8]
    27 │ [structure.geometry.spline]
    28 │ file = "patch.toml"
       ·        ──────┬─────
       ·              ╰── this patch
    29 │ 
       ╰────
     help: run one parameter the other way: its control points and weights in reverse order, its
           knots mirrored
    "#);
}

#[test]
fn a_folded_patch_is_named_with_its_place() {
    assert_snapshot!(shaped(FROM_FILE, &PATCH.replace("[1, 0]]", "[0.1, -0.04]]")), @r#"
     × the patch folds over itself in element 0 at the parameters [0.9330, 0.9330], near [0.149551,
     │ -0.038170], where its scaled Jacobian is -2.12e-1
       ╭─[scene.toml:28:8]
    27 │ [structure.geometry.spline]
    28 │ file = "patch.toml"
       ·        ──────┬─────
       ·              ╰── this patch
    29 │ 
       ╰────
     help: look at the control points near there: one may lie beyond its neighbours or in another's
           place
    "#);
}

#[test]
fn an_arc_that_cannot_be_is_refused() {
    assert_snapshot!(shaped("[structure.geometry.arc]\nradii = [1.0, 0.9]\nstart = 0\nsweep = 90\nelements = [4, 1]", ""), @r"
     × a shape of extent -0.09999999999999998 does not exist
       ╭─[scene.toml:27:1]
    26 │ 
    27 │ [structure.geometry.arc]
       · ────────────┬───────────
       ·             ╰── this patch
    28 │ radii = [1.0, 0.9]
       ╰────
     help: lengths and radii are positive, finite numbers
    ");
}

#[test]
fn a_strip_that_folds_over_itself_is_refused() {
    let curve = "[structure.geometry.curve]\npoints = [[0, 0], [0.5, 0.4], [0.52, -0.4], [1, 0]]\nthickness = 0.3\nelements = [8, 1]";
    assert_snapshot!(shaped(curve, ""), @r"
     × a strip of thickness 0.3 folds over itself at the parameter 0.2325678444168901 of its curve,
     │ near [0.45277904636462213, 0.46810427634930263], where the radius of curvature is
     │ 0.049740817871746286
       ╭─[scene.toml:27:1]
    26 │ 
    27 │ [structure.geometry.curve]
       · ─────────────┬────────────
       ·              ╰── this patch
    28 │ points = [[0, 0], [0.5, 0.4], [0.52, -0.4], [1, 0]]
       ╰────
     help: make the strip thinner, lay it on the outer side of the bend, or bend the curve less;
           where the radius is not small, take more elements
    ");
}

#[test]
fn a_curve_needs_more_points_than_its_degree() {
    let curve = "[structure.geometry.curve]\npoints = [[0, 0], [1, 0]]\nthickness = 0.1\nelements = [8, 1]";
    assert_snapshot!(shaped(curve, ""), @r"
     × 2 points are too few for a curve of degree 2
       ╭─[scene.toml:27:1]
    26 │ 
    27 │ [structure.geometry.curve]
       · ─────────────┬────────────
       ·              ╰── this patch
    28 │ points = [[0, 0], [1, 0]]
       ╰────
     help: give more points or lower the degree
    ");
}

#[test]
fn newmark_parameters_that_are_not_stable_are_refused() {
    let scene = SOUND.replace(
        "[coupling.acceleration.iqn_imvls]",
        "[structure.time_scheme.newmark]\nbeta = 0.1\n\n[coupling.acceleration.iqn_imvls]",
    );
    assert_snapshot!(super::message(&scene, &[]), @r"
     × Newmark: beta = 0.1 is below gamma/2 = 0.25, and stable only while omega dt < 2.582 for the
     │ highest frequency of the mesh
       ╭─[scene.toml:36:12]
    35 │ 
    36 │ [structure.time_scheme.newmark]
       ·            ─────┬─────
       ·                 ╰── not stable
    37 │ beta = 0.1
       ╰────
     help: 0.25 belongs to gamma = 0.5 (average acceleration); (gamma + 0.5)^2/4 damps the highest
           frequencies most
    ");
}
