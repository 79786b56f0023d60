//! A structure on a mesh of gmsh beside the patch of the same shape.

use std::fmt::Write;
use std::fs;
use std::path::Path;

use partita::output::Clock;
use partita::scene::{self, read_in};
use partita::session::{Options, Session};
use partita::{build, check};

/// A flag under its weight: the mesh is the square plate of the reader's fixtures.
const PLATE: &str = r#"title = "Plate"

[time]
step = 1.0
steps = 1

[structure]
density = 1000.0
body_force = [0.0, -100.0]
clamped = ["left"]
time_scheme = "quasi_static"

[structure.geometry.gmsh]
file = "plate.msh"

[structure.material.saint_venant_kirchhoff]
young_modulus = 1e6
poisson_ratio = 0.3

[output.probes]
tip = { structure_point = [1.0, 1.0] }
"#;

/// The square of one quadrilateral, its left and top side in groups.
const SQUARE: &str = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n2\n1 1 \"left\"\n1 2 \"top\"\n$EndPhysicalNames\n\
$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n$EndNodes\n\
$Elements\n3\n1 1 2 1 1 4 1\n2 1 2 2 2 3 4\n3 3 2 9 9 1 2 3 4\n$EndElements\n";

fn tip(folder: &Path, scene: &str) -> [f64; 2] {
    let resolved = read_in(folder, "scene.toml", scene, &[]).expect("the scene is sound");
    let dir = folder.join("run");
    let options = Options::default();
    let session = Session::start(&resolved, &dir, options, Clock::start()).expect("the run starts");
    session.finish().expect("the step converges");
    let probes = fs::read_to_string(dir.join("probes.csv")).expect("probes");
    let row: Vec<f64> =
        probes.lines().last().expect("a row").split(',').map(|x| x.parse().expect("a number")).collect();
    assert!(dir.join("structure.pvd").is_file());
    assert!(scene::load(&dir, &[]).is_ok(), "the folder of the run holds its mesh");
    fs::remove_dir_all(&dir).expect("the run can go");
    [row[2], row[3]]
}

/// One bilinear element is the same space as a patch of one element of degree one.
#[test]
fn a_quadrilateral_bends_like_the_patch_of_degree_one() {
    let folder = tempfile::tempdir().expect("a folder");
    fs::write(folder.path().join("plate.msh"), SQUARE).expect("a mesh");
    let patch = PLATE.replace(
        "[structure.geometry.gmsh]\nfile = \"plate.msh\"",
        "[structure.geometry.rectangle]\nsize = [1.0, 1.0]\nelements = [1, 1]\ndegree = [1, 1]",
    );
    let (mesh, patch) = (tip(folder.path(), PLATE), tip(folder.path(), &patch));
    assert!(mesh[1] < -1e-5, "it sags: {mesh:?}");
    for (mesh, patch) in mesh.iter().zip(patch) {
        assert!((mesh - patch).abs() < 1e-12, "{mesh} on the mesh, {patch} on the patch");
    }
}

#[test]
fn a_mesh_is_described_with_its_elements() {
    let folder = tempfile::tempdir().expect("a folder");
    fs::write(folder.path().join("plate.msh"), SQUARE).expect("a mesh");
    let resolved = read_in(folder.path(), "scene.toml", PLATE, &[]).expect("the scene is sound");
    let page = check::describe(&resolved, &build::march(&resolved).expect("it can be built"));
    assert!(page.contains("1 elements Quadrilateral4, 4 nodes, 4 unknowns"), "{page}");
}

/// The tank with a bottom of quadrilaterals couples as well as the one with a patch of the same functions.
#[test]
fn a_mesh_couples_like_the_patch_of_degree_one() {
    let shipped = Path::new(env!("CARGO_MANIFEST_DIR")).join("../scenes/elastic-bottom/scene.toml");
    let tank = fs::read_to_string(shipped).expect("the tank");
    let (before, after) = tank.split_once("[structure.geometry.rectangle]").expect("a geometry");
    let (_, after) = after.split_once("\n\n").expect("a table after it");
    let tank = |geometry: &str| {
        format!("{before}{geometry}\n\n{after}")
            .replace("{ structure_displacement = [0.5, 1.0] }", "{ structure_point = [0.5, 0.0] }")
    };
    let folder = tempfile::tempdir().expect("a folder");
    fs::write(folder.path().join("bottom.msh"), bottom(20)).expect("a mesh");
    let patch = "[structure.geometry.rectangle]\norigin = [0.0, -0.05]\nsize = [1.0, 0.05]\nelements = [20, 1]\ndegree = [1, 1]";
    let middle = [tank("[structure.geometry.gmsh]\nfile = \"bottom.msh\""), tank(patch)].map(|scene| {
        let resolved = read_in(folder.path(), "scene.toml", &scene, &[]).expect("the scene is sound");
        let mut run = build::march(&resolved).expect("it can be built");
        for _ in 0..2 {
            run.step(resolved.scene.time.step.get(), &mut ()).expect("the step converges");
        }
        let structure = run.second().field().expect("a structure");
        let at: &[f64] = if scene.contains("bottom.msh") { &[0.5, 0.0] } else { &[0.5, 1.0] };
        structure.displacement_at(at)[1]
    });
    assert!(middle[0] < -1e-4, "it gives way: {middle:?}");
    assert!((middle[0] / middle[1] - 1.0).abs() < 1e-6, "{middle:?}");
}

/// `elements` quadrilaterals side by side in `[0, 1] x [-0.05, 0]`.
fn bottom(elements: usize) -> String {
    let row = elements + 1;
    let node = |i: usize, j: usize| j * row + i + 1;
    let mut text = String::from(
        "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n3\n1 1 \"left\"\n1 2 \"right\"\n1 3 \"top\"\n$EndPhysicalNames\n",
    );
    let points = (0..2).flat_map(|j| (0..row).map(move |i| (i, j)));
    let places = points.map(|(i, j)| {
        format!("{} {} {} 0\n", node(i, j), i as f64 / elements as f64, if j == 0 { -0.05 } else { 0.0 })
    });
    write!(text, "$Nodes\n{}\n{}$EndNodes\n", 2 * row, places.collect::<String>())
        .expect("a string takes it");
    let mut lines = vec![
        format!("1 2 1 1 {} {}", node(0, 1), node(0, 0)),
        format!("1 2 2 2 {} {}", node(elements, 0), node(elements, 1)),
    ];
    lines.extend((0..elements).map(|i| format!("1 2 3 3 {} {}", node(i + 1, 1), node(i, 1))));
    lines.extend(
        (0..elements)
            .map(|i| format!("3 2 9 9 {} {} {} {}", node(i, 0), node(i + 1, 0), node(i + 1, 1), node(i, 1))),
    );
    let numbered = lines.iter().enumerate().map(|(k, line)| format!("{} {line}\n", k + 1));
    write!(text, "$Elements\n{}\n{}$EndElements\n", lines.len(), numbered.collect::<String>())
        .expect("a string takes it");
    text
}
