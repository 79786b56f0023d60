//! Meshes that do not fit the scene, the structure, or themselves.

use std::fmt::Write;
use std::fs;

use insta::assert_snapshot;
use partita::scene::read_in;
use tempfile::TempDir;

use super::super::SOUND;
use super::render;

/// A mesh as a gmsh file of format 2.2 holds it; groups of edges are numbered from 1.
struct MeshText {
    points: Vec<[f64; 2]>,
    triangles: Vec<[usize; 3]>,
    groups: Vec<(&'static str, Vec<[usize; 2]>)>,
}

impl MeshText {
    /// The unit square as 2 x 2 squares of two triangles each, its sides as groups.
    fn square() -> Self {
        let node = |i: usize, j: usize| 3 * j + i;
        let squares = [(0, 0), (1, 0), (0, 1), (1, 1)];
        Self {
            points: (0..9).map(|k| [0.5 * f64::from(k % 3), 0.5 * f64::from(k / 3)]).collect(),
            triangles: squares
                .into_iter()
                .flat_map(|(i, j)| {
                    let [a, b, c, d] = [node(i, j), node(i + 1, j), node(i + 1, j + 1), node(i, j + 1)];
                    [[a, b, c], [a, c, d]]
                })
                .collect(),
            groups: vec![
                ("left", vec![[6, 3], [3, 0]]),
                ("right", vec![[2, 5], [5, 8]]),
                ("bottom", vec![[0, 1], [1, 2]]),
                ("top", vec![[8, 7], [7, 6]]),
            ],
        }
    }

    fn scaled(mut self, factor: f64) -> Self {
        self.points.as_flattened_mut().iter_mut().for_each(|x| *x *= factor);
        self
    }

    fn write(&self) -> String {
        let mut text = String::from("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n");
        let mut line = |words: std::fmt::Arguments<'_>| writeln!(text, "{words}").expect("a string takes it");
        line(format_args!("$PhysicalNames\n{}", self.groups.len()));
        for (tag, (name, _)) in self.groups.iter().enumerate() {
            line(format_args!("1 {} \"{name}\"", tag + 1));
        }
        line(format_args!("$EndPhysicalNames\n$Nodes\n{}", self.points.len()));
        for (node, [x, y]) in self.points.iter().enumerate() {
            line(format_args!("{} {x} {y} 0", node + 1));
        }
        let edges = self.groups.iter().map(|(_, edges)| edges.len()).sum::<usize>();
        line(format_args!("$EndNodes\n$Elements\n{}", edges + self.triangles.len()));
        let mut number = 0;
        for (tag, (_, edges)) in self.groups.iter().enumerate() {
            for [a, b] in edges {
                number += 1;
                line(format_args!("{number} 1 2 {0} {0} {1} {2}", tag + 1, a + 1, b + 1));
            }
        }
        for [a, b, c] in &self.triangles {
            number += 1;
            line(format_args!("{number} 2 2 9 9 {} {} {}", a + 1, b + 1, c + 1));
        }
        line(format_args!("$EndElements"));
        text
    }
}

/// The sound scene on a mesh from a file; a coarse one needs fewer spline elements.
fn on_file() -> String {
    SOUND
        .replace(
            "[fluid.mesh.rectangle]\nsize = [1.0, 1.0]\ndivisions = [10, 10]",
            "[fluid.mesh.gmsh]\nfile = \"tank.msh\"",
        )
        .replace("elements = [60, 1]", "elements = [4, 1]")
}

/// The message for a scene beside a file `tank.msh`.
fn message(scene: &str, mesh: &str) -> String {
    let folder = TempDir::new().expect("a folder");
    fs::write(folder.path().join("tank.msh"), mesh).expect("a file");
    let error = read_in(folder.path(), "scene.toml", scene, &[]).expect_err("the scene is broken");
    render(&error).replace(&folder.path().display().to_string(), "FOLDER")
}

/// The message for a mesh that is wrong in one way.
fn broken(break_it: impl FnOnce(&mut MeshText)) -> String {
    let mut mesh = MeshText::square();
    break_it(&mut mesh);
    message(&on_file(), &mesh.write())
}

#[test]
fn the_mesh_that_the_others_break_is_sound() {
    let folder = TempDir::new().expect("a folder");
    fs::write(folder.path().join("tank.msh"), MeshText::square().write()).expect("a file");
    let resolved = read_in(folder.path(), "scene.toml", &on_file(), &[])
        .unwrap_or_else(|error| panic!("{}", render(&error)));
    assert_eq!(resolved.shapes.fluid.expect("a mesh").cells().len(), 8);
}

#[test]
fn a_file_that_is_not_there_is_named() {
    assert_snapshot!(message(&on_file().replace("tank.msh", "tnak.msh"), ""), @r#"
     × FOLDER/tnak.msh cannot be read: No such file or directory (os error 2)
       ╭─[scene.toml:13:8]
    12 │ [fluid.mesh.gmsh]
    13 │ file = "tnak.msh"
       ·        ─────┬────
       ·             ╰── this mesh
    14 │ 
       ╰────
     help: names of files are relative to the folder of the scene; check the spelling and the
           permissions
    "#);
}

#[test]
fn a_folder_is_no_mesh() {
    assert_snapshot!(message(&on_file().replace("tank.msh", "."), ""), @r#"
     × FOLDER/. is not a file
       ╭─[scene.toml:13:8]
    12 │ [fluid.mesh.gmsh]
    13 │ file = "."
       ·        ─┬─
       ·         ╰── this mesh
    14 │ 
       ╰────
     help: name a file; a folder, a pipe or a device cannot be read as one
    "#);
}

#[test]
fn a_file_without_a_name_is_refused() {
    assert_snapshot!(message(&on_file().replace("tank.msh", ""), ""), @r#"
     × fluid.mesh.gmsh.file: a file name is not empty
       ╭─[scene.toml:13:8]
    12 │ [fluid.mesh.gmsh]
    13 │ file = ""
       ·        ─┬
       ·         ╰── out of range
    14 │ 
       ╰────
     help: File of format 2.0 to 2.2 or 4.1, text or binary, relative to the scene's folder.
    "#);
}

#[test]
fn a_file_that_is_no_mesh_is_named_with_its_line() {
    assert_snapshot!(message(&on_file(), "solid tank\nfacet normal 0 0 1\n"), @r#"
     × tank.msh, line 1: a gmsh file begins with `$MeshFormat`, this one with `solid tank`
       ╭─[scene.toml:13:8]
    12 │ [fluid.mesh.gmsh]
    13 │ file = "tank.msh"
       ·        ─────┬────
       ·             ╰── this mesh
    14 │ 
       ╰────
     help: save it from gmsh as MSH 4.1 or 2.2; geometry (.geo) and other formats are not read
    "#);
}

#[test]
fn a_mesh_that_ends_early_is_named_with_its_line() {
    let text = MeshText::square().write();
    assert_snapshot!(message(&on_file(), &text[..text.len() / 2]), @r#"
     × tank.msh, line 24 in $Elements: 16 elements do not fit into the 15 bytes that are left
       ╭─[scene.toml:13:8]
    12 │ [fluid.mesh.gmsh]
    13 │ file = "tank.msh"
       ·        ─────┬────
       ·             ╰── this mesh
    14 │ 
       ╰────
     help: the count is wrong, or the file was cut short
    "#);
}

#[test]
fn a_mesh_without_groups_is_refused() {
    assert_snapshot!(broken(|mesh| mesh.groups.clear()), @r#"
     × tank.msh: no 2-node line belongs to a physical group, so no part of the boundary can be named
       ╭─[scene.toml:13:8]
    12 │ [fluid.mesh.gmsh]
    13 │ file = "tank.msh"
       ·        ─────┬────
       ·             ╰── this mesh
    14 │ 
       ╰────
     help: mark the boundary in the .geo file: Physical Curve("inflow") = {1}; (format 2.2 loses the
           marks when Mesh.SaveAll is set)
    "#);
}

#[test]
fn a_misspelled_group_names_the_nearest_one_of_the_mesh() {
    assert_snapshot!(broken(|mesh| mesh.groups[3].0 = "upper"), @r#"
      × 2 things are wrong in the scene

    Error: 
      × boundary group `upper` has no condition
        ╭─[scene.toml:15:8]
     14 │ 
     15 │ [fluid.boundary]
        ·        ────┬───
        ·            ╰── nothing about `upper` here
     16 │ left = "no_slip"
        ╰────
      help: without one the equations are not closed: add `upper = "no_slip"` or another condition

    Error: 
      × the mesh has no boundary group `top`
        ╭─[scene.toml:18:1]
     17 │ right = "no_slip"
     18 │ top = "stress_free"
        · ─┬─
        ·  ╰── unknown group
     19 │ bottom = "interface"
        ╰────
      help: groups of the mesh: left, right, bottom, upper
    "#);
    assert_snapshot!(broken(|mesh| mesh.groups[2].0 = "botom"), @r#"
     × the mesh has no boundary group `bottom`
       ╭─[scene.toml:19:1]
    18 │ top = "stress_free"
    19 │ bottom = "interface"
       · ───┬──
       ·    ╰── unknown group
    20 │ 
       ╰────
     help: did you mean `botom`?
    "#);
}

#[test]
fn a_group_without_elements_is_refused() {
    assert_snapshot!(broken(|mesh| mesh.groups.push(("outlet", Vec::new()))), @r#"
     × tank.msh: boundary group `outlet` has no facets
       ╭─[scene.toml:13:8]
    12 │ [fluid.mesh.gmsh]
    13 │ file = "tank.msh"
       ·        ─────┬────
       ·             ╰── this mesh
    14 │ 
       ╰────
     help: remove it, or check how the boundary was marked
    "#);
}

#[test]
fn an_edge_in_two_groups_is_named() {
    assert_snapshot!(broken(|mesh| mesh.groups.push(("outlet", vec![[5, 8]]))), @r#"
     × tank.msh: facet with nodes [5, 8] at (1, 0.75) m is in group `right` and in group `outlet`
       ╭─[scene.toml:13:8]
    12 │ [fluid.mesh.gmsh]
    13 │ file = "tank.msh"
       ·        ─────┬────
       ·             ╰── this mesh
    14 │ 
       ╰────
     help: each boundary facet belongs to one group at most, once
    "#);
}

#[test]
fn a_group_inside_the_fluid_is_refused() {
    assert_snapshot!(broken(|mesh| mesh.groups[0].1.push([3, 4])), @r#"
     × tank.msh: group `left`: facet 2 with nodes [3, 4] at (0.25, 0.5) m is not on the boundary
       ╭─[scene.toml:13:8]
    12 │ [fluid.mesh.gmsh]
    13 │ file = "tank.msh"
       ·        ─────┬────
       ·             ╰── this mesh
    14 │ 
       ╰────
     help: a group holds only facets that belong to exactly one cell
    "#);
}

#[test]
fn a_boundary_that_is_not_covered_is_named_with_its_place() {
    assert_snapshot!(broken(|mesh| mesh.groups[1].1.truncate(1)), @r#"
     × 1 boundary edge belongs to no group of the mesh, the first at (1, 0.75) m
       ╭─[scene.toml:12:8]
    11 │ 
    12 │ [fluid.mesh.gmsh]
       ·        ──┬─
       ·          ╰── this mesh
    13 │ file = "tank.msh"
    14 │ 
    15 │ [fluid.boundary]
       ·        ────┬───
       ·            ╰── cannot say what holds there
    16 │ left = "no_slip"
       ╰────
     help: without a condition on every edge the equations are not closed: put the curve into a group
           in the .geo file, `Physical Curve("wall") = {...};`, mesh again, and give the group a
           condition
    "#);
}

#[test]
fn an_inverted_triangle_is_named_with_its_place() {
    assert_snapshot!(broken(|mesh| mesh.triangles[3].swap(0, 1)), @r#"
     × tank.msh: 1 of 8 cells are oriented against the others, the first at (0.666667, 0.333333) m
       ╭─[scene.toml:13:8]
    12 │ [fluid.mesh.gmsh]
    13 │ file = "tank.msh"
       ·        ─────┬────
       ·             ╰── this mesh
    14 │ 
       ╰────
     help: if cells overlap, remesh; else turn the clockwise ones in Python (`pip install gmsh`):
           import gmsh
           gmsh.initialize(); gmsh.open("old.msh"); mesh = gmsh.model.mesh
           cells = mesh.getElementsByType(2)[0]
           z = mesh.getJacobians(2, [0, 0, 0])[0][8::9]
           mesh.reverseElements([cell for cell, up in zip(cells, z) if up < 0])
           gmsh.write("new.msh")
    "#);
}

#[test]
fn a_flat_triangle_is_named_with_its_place() {
    assert_snapshot!(broken(|mesh| mesh.points[4] = [0.5, 0.0]), @r#"
     × tank.msh: cell 0 at (0.333333, 0) m has measure 0.000e0 m^2: it is flat
       ╭─[scene.toml:13:8]
    12 │ [fluid.mesh.gmsh]
    13 │ file = "tank.msh"
       ·        ─────┬────
       ·             ╰── this mesh
    14 │ 
       ╰────
     help: merge coinciding nodes or remesh there
    "#);
}

#[test]
fn a_mesh_in_two_parts_is_refused() {
    assert_snapshot!(broken(|mesh| {
        mesh.points.extend([[2.0, 0.0], [3.0, 0.0], [2.0, 1.0]]);
        mesh.triangles.push([9, 10, 11]);
        mesh.groups[1].1.extend([[9, 10], [10, 11], [11, 9]]);
    }), @r#"
     × the mesh falls into 2 parts that share no edge, of 8 and 1 triangles, the second at (2.33333,
     │ 0.333333) m
       ╭─[scene.toml:12:8]
    11 │ 
    12 │ [fluid.mesh.gmsh]
       ·        ──┬─
       ·          ╰── this mesh
    13 │ file = "tank.msh"
       ╰────
     help: the flow cannot pass from one part to the other: where surfaces meet, let them share their
           curves (`Coherence;` or `BooleanFragments` in the .geo file), or leave the other part out
    "#);
}

#[test]
fn a_mesh_in_millimetres_is_recognized() {
    assert_snapshot!(message(&on_file(), &MeshText::square().scaled(1000.0).write()), @r#"
     × the fluid's interface is 1000 m across and the structure's 1 m: one of them is in millimetres,
     │ the other in metres
       ╭─[scene.toml:12:8]
    11 │ 
    12 │ [fluid.mesh.gmsh]
       ·        ──┬─
       ·          ╰── the fluid's mesh
    13 │ file = "tank.msh"
       ╰────
       ╭─[scene.toml:26:12]
    25 │ 
    26 │ [structure.geometry.rectangle]
       ·            ────┬───
       ·                ╰── the structure's geometry
    27 │ origin = [0.0, -0.05]
       ╰────
     help: give all lengths in metres: either the fluid is too large or the structure too small;
           `fluid.mesh.gmsh.scale = 0.001` reads a mesh in millimetres
    "#);
}

#[test]
fn a_mesh_in_millimetres_is_read_with_its_scale() {
    let folder = TempDir::new().expect("a folder");
    fs::write(folder.path().join("tank.msh"), MeshText::square().scaled(1000.0).write()).expect("a file");
    let scene = on_file().replace("file = \"tank.msh\"", "file = \"tank.msh\"\nscale = 0.001");
    let resolved = read_in(folder.path(), "scene.toml", &scene, &[]).expect("sound in metres");
    assert_eq!(
        resolved.shapes.fluid.expect("a mesh").points()[8].map(f64::to_bits),
        [1.0_f64; 2].map(f64::to_bits)
    );
}

#[test]
fn an_interface_off_the_structure_is_measured() {
    assert_snapshot!(message(&on_file().replace("origin = [0.0, -0.05]", "origin = [0.0, -0.06]"), &MeshText::square().write()), @r#"
     × 3 of 3 interface nodes of the fluid lie off the structure, the farthest, (1, 0) m, by 1.000e-2
     │ m from `top`
       ╭─[scene.toml:19:10]
    18 │ top = "stress_free"
    19 │ bottom = "interface"
       ·          ─────┬─────
       ·               ╰── the fluid's side of it
    20 │ 
    21 │ [structure]
    22 │ density = 1000.0
    23 │ clamped = ["left", "right"]
    24 │ wetted = ["top"]
       ·          ───┬───
       ·             ╰── the structure's side of it
    25 │ 
       ╰────
     help: loads and displacements pass between points that coincide (here within 1.0e-6 m): compare
           the two boundaries in place and shape, name every wetted part, or raise
           `coupling.projection_tolerance`
    "#);
}

#[test]
fn a_structure_that_goes_beyond_the_fluid_is_refused() {
    let wider = on_file().replace("size = [1.0, 0.05]", "size = [1.25, 0.05]");
    assert_snapshot!(message(&wider, &MeshText::square().write()), @r#"
     × `top` of the structure ends at (1.25, 0) m, where the fluid has no interface node; the nearest
     │ is 2.500e-1 m away
       ╭─[scene.toml:19:10]
    18 │ top = "stress_free"
    19 │ bottom = "interface"
       ·          ─────┬─────
       ·               ╰── ends or bends elsewhere
    20 │ 
    21 │ [structure]
    22 │ density = 1000.0
    23 │ clamped = ["left", "right"]
    24 │ wetted = ["top"]
       ·          ───┬───
       ·             ╰── wetted up to its ends
    25 │ 
       ╰────
     help: the fluid's boundary and the wetted parts must begin, bend and end in the same points: put
           a point of the .geo file there, or leave the part out of `wetted`
    "#);
}

#[test]
fn a_probe_outside_the_mesh_is_refused() {
    let probed = on_file() + "\n[output.probes]\ncorner = { fluid_value = [1.5, 0.5] }\n";
    assert_snapshot!(message(&probed, &MeshText::square().write()), @r"
     × probe `corner` lies outside the fluid's mesh
       ╭─[scene.toml:39:26]
    38 │ [output.probes]
    39 │ corner = { fluid_value = [1.5, 0.5] }
       ·                          ─────┬────
       ·                               ╰── no triangle holds (1.5, 0.5) m
       ╰────
     help: give a point [m] inside the undeformed mesh
    ");
}

#[test]
fn a_force_on_an_unknown_group_is_refused() {
    let probed = on_file() + "\n[output.probes]\nload = { fluid_force = \"botom\" }\n";
    assert_snapshot!(message(&probed, &MeshText::square().write()), @r#"
     × the mesh has no boundary group `botom`
       ╭─[scene.toml:39:24]
    38 │ [output.probes]
    39 │ load = { fluid_force = "botom" }
       ·                        ───┬───
       ·                           ╰── unknown group
       ╰────
     help: did you mean `bottom`?
    "#);
}

#[test]
fn one_of_several_unknown_groups_is_named() {
    let probed = on_file() + "\n[output.probes]\nout = { fluid_flow_rate = [\"left\", \"rigth\"] }\n";
    let shown = message(&probed, &MeshText::square().write());
    assert!(
        shown.contains("no boundary group `rigth`") && shown.contains("did you mean `right`?"),
        "{shown}"
    );
}

#[test]
fn a_line_that_leaves_the_mesh_is_refused() {
    let line = "cut = { fluid_extremes = { from = [0.5, 0], to = [0.5, 1.5] } }";
    let shown = message(&format!("{}\n[output.probes]\n{line}\n", on_file()), &MeshText::square().write());
    assert!(
        shown.contains("probe `cut` lies outside") && shown.contains("no triangle holds (0.5, 1.5) m"),
        "{shown}"
    );
}

#[test]
fn a_mesh_that_is_refined_has_four_times_the_triangles() {
    let folder = TempDir::new().expect("a folder");
    fs::write(folder.path().join("tank.msh"), MeshText::square().write()).expect("a file");
    let refined = |key: &str| {
        let text = on_file().replace("\n[fluid.boundary]", &format!("{key}\n[fluid.boundary]"));
        read_in(folder.path(), "scene.toml", &text, &[]).map_err(|error| render(&error))
    };
    let fine = refined("refine = 2\n").expect("a sound scene");
    assert_eq!(fine.shapes.fluid.expect("a mesh").cells().len(), 16 * 8);
    let off =
        refined("refine = 1\ncircles.left = { center = [0.5, 0.5], radius = 0.6 }\n").expect_err("a square");
    assert!(off.contains("off the circle of that group") && off.contains("`left`"), "{off}");
    let unknown = refined("circles.arc = { center = [0, 0], radius = 1 }\n").expect_err("no such group");
    assert!(unknown.contains("no boundary group `arc`"), "{unknown}");
    let many = refined("refine = 40\n").expect_err("more triangles than memory");
    assert!(many.contains("would not fit any machine"), "{many}");
}
