//! `traction_patch`: uniform pressure must compress a block evenly.

use super::{Case, run};

const MORTAR: &str = "coupling.transfer=mortar";
const EXACT: f64 = -5e-4;

/// The largest relative error of the vertical displacement at the probes of the wetted side.
fn error(case: &Case, out: &str) -> f64 {
    let of_probe = |name: &str| case.last_probe(out, &format!("{name}_displacement_y")) / EXACT - 1.0;
    ["end", "next", "middle"].map(of_probe).into_iter().fold(0.0, |worst, error| error.abs().max(worst))
}

#[test]
fn mortar_compresses_the_block_evenly_for_any_two_resolutions() {
    let case = Case::new("traction_patch");
    for (edges, elements, degree) in [
        (2, 1, 1),
        (2, 8, 2),
        (2, 20, 3),
        (3, 7, 1),
        (4, 8, 2),
        (5, 3, 3),
        (8, 8, 1),
        (8, 8, 2),
        (8, 8, 3),
        (16, 8, 2),
        (17, 20, 2),
        (33, 1, 2),
        (33, 20, 3),
    ] {
        let divisions = format!("fluid.mesh.rectangle.divisions=[{edges}, 4]");
        let [elements, degree] = [("elements", elements), ("degree", degree)]
            .map(|(key, value)| format!("structure.geometry.rectangle.{key}=[{value}, 2]"));
        run(&case, "scene.toml", "out", &[MORTAR, &divisions, &elements, &degree]);
        let error = error(&case, "out");
        assert!(error < 1e-9, "{divisions} {elements} {degree}: {error:e}");
    }
}

/// As the case came: nothing chosen, and any fluid not coarser than five elements of the structure.
#[test]
fn so_does_a_scene_that_does_not_choose() {
    let case = Case::new("traction_patch");
    for (edges, elements) in [(8, 8), (2, 8), (2, 10), (4, 16), (32, 8)] {
        let divisions = format!("fluid.mesh.rectangle.divisions=[{edges}, 4]");
        let elements = format!("structure.geometry.rectangle.elements=[{elements}, 2]");
        run(&case, "scene.toml", "out", &[&divisions, &elements]);
        let error = error(&case, "out");
        assert!(error < 1e-9, "{divisions} {elements}: {error:e}");
    }
}

/// A solid mesh of uneven elements is loaded as evenly as a spline.
#[test]
fn so_does_a_mesh_of_finite_elements() {
    let case = Case::new("traction_patch");
    std::fs::write(case.path("block.msh"), uneven_block()).expect("the mesh is written");
    let rectangle = case.text("scene.toml");
    let rectangle = &rectangle[rectangle.find("[structure.geometry.rectangle]").expect("the block")..];
    let rectangle = &rectangle[..rectangle.find("[structure.material").expect("its material")];
    case.replace("scene.toml", rectangle, "[structure.geometry.gmsh]\nfile = \"block.msh\"\n");
    for (parameter, x) in [("0.0", "0.0"), ("0.125", "0.25"), ("0.5", "1.0")] {
        let probe = format!("structure_displacement = [{parameter}, 1.0]");
        case.replace("scene.toml", &probe, &format!("structure_point = [{x}, 0.0]"));
    }
    for edges in [3, 5, 8, 16] {
        run(&case, "scene.toml", "out", &[&format!("fluid.mesh.rectangle.divisions=[{edges}, 4]")]);
        let error = error(&case, "out");
        assert!(error < 1e-9, "{edges} edges: {error:e}");
    }
}

/// The block in columns of different widths and two rows of quadrilaterals, as gmsh writes it.
fn uneven_block() -> String {
    let columns = [0.0, 0.3, 0.45, 0.8, 1.3, 1.55, 2.0];
    let node = |i: usize, j: usize| 1 + i + j * columns.len();
    let last = columns.len() - 1;
    let (mut nodes, mut elements) = (Vec::new(), Vec::new());
    for j in 0..3 {
        for (i, x) in columns.iter().enumerate() {
            nodes.push(format!("{} {x} {} 0", node(i, j), j as f64 / 2.0 - 1.0));
        }
    }
    let mut add = |kind: usize, group: usize, nodes: &[usize]| {
        let nodes: Vec<String> = nodes.iter().map(ToString::to_string).collect();
        elements.push(format!("{} {kind} 2 {group} {group} {}", elements.len() + 1, nodes.join(" ")));
    };
    for i in 0..last {
        add(1, 1, &[node(i, 2), node(i + 1, 2)]);
        add(1, 2, &[node(i, 0), node(i + 1, 0)]);
        for j in 0..2 {
            add(3, 3, &[node(i, j), node(i + 1, j), node(i + 1, j + 1), node(i, j + 1)]);
        }
    }
    format!(
        "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n3\n1 1 \"top\"\n1 2 \"bottom\"\n2 3 \"block\"\n\
         $EndPhysicalNames\n$Nodes\n{}\n{}\n$EndNodes\n$Elements\n{}\n{}\n$EndElements\n",
        nodes.len(),
        nodes.join("\n"),
        elements.len(),
        elements.join("\n")
    )
}

/// As bad as the case says: what the tests above see is there.
#[test]
fn interpolation_dents_the_block_at_its_ends() {
    let case = Case::new("traction_patch");
    run(&case, "scene.toml", "out", &["coupling.transfer=interpolation"]);
    let end = case.last_probe("out", "end_displacement_y") / EXACT - 1.0;
    assert!((end - 0.25).abs() < 0.01, "{end}");
}

/// Loads alone pass the same way, and the fluid sees the motion in neither.
#[test]
fn mortar_serves_one_way_coupling() {
    let case = Case::new("traction_patch");
    run(&case, "scene.toml", "out", &[MORTAR, "coupling.direction=one_way"]);
    assert!(error(&case, "out") < 1e-9);
}
