//! Meshes whose cells run clockwise.

use std::fmt::Write;
use std::fs;

use super::super::Case;
use super::{refused, says, sound};

#[test]
fn a_clockwise_mesh_is_turned_round_and_check_says_so() {
    let case = Case::new("clockwise");
    let turned = "all its cells ran clockwise and were turned round";
    let pages = ["clockwise", "turned"].map(|stem| {
        let page = sound(&case, &format!("{stem}.toml"), &[]);
        says(&page, &[&format!("read from {stem}.msh: {turned}")]);
        page.replace(&format!("{stem}.msh"), "mesh.msh")
    });
    assert_eq!(pages[0], pages[1]);
    case.replace("clockwise.msh", "1 1 3 2", "1 1 2 3");
    case.replace("clockwise.msh", "1 1 4 3", "1 1 3 4");
    let upright = sound(&case, "clockwise.toml", &[]);
    assert_eq!(upright.replace("clockwise.msh", &format!("mesh.msh: {turned}")), pages[0]);
}

#[test]
fn a_mesh_of_both_orientations_is_refused_with_a_place_and_a_remedy_for_the_file() {
    let case = Case::new("clockwise");
    case.replace("clockwise.msh", "1 1 4 3", "1 1 3 4");
    let message = refused(&case, "clockwise.toml", &[]);
    says(
        &message,
        &[
            "clockwise.msh: 1 of 2 cells are oriented against the others, the first at (0.666667, 0.333333) m",
            "mesh.reverseElements([cell for cell, up in zip(cells, z) if up < 0])",
        ],
    );
    assert!(!message.contains("ReverseMesh"), "does nothing on a bare mesh: {message}");
}

/// Places of the nodes of a cell on the grid of half cells, counter-clockwise in gmsh's order.
const TRIANGLES: [[[usize; 2]; 6]; 2] =
    [[[0, 0], [2, 0], [2, 2], [1, 0], [2, 1], [1, 1]], [[0, 0], [2, 2], [0, 2], [1, 1], [1, 2], [0, 1]]];
const SQUARE: [[usize; 2]; 9] = [[0, 0], [2, 0], [2, 2], [0, 2], [1, 0], [2, 1], [1, 2], [0, 1], [1, 1]];

/// A bar of `CELLS` squares in a row, held at its left end, as a file of gmsh: elements of a type, `nodes` each.
fn bar(code: usize, nodes: usize, clockwise: bool) -> String {
    const CELLS: usize = 4;
    let at = |[i, j]: [usize; 2]| 1 + i + j * (2 * CELLS + 1);
    let mut text = String::from(
        "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n2\n1 1 \"root\"\n2 2 \"bar\"\n$EndPhysicalNames\n$Nodes\n",
    );
    writeln!(text, "{}", 3 * (2 * CELLS + 1)).expect("strings grow");
    for (i, j) in (0..3).flat_map(|j| (0..=2 * CELLS).map(move |i| (i, j))) {
        writeln!(text, "{} {} {} 0", at([i, j]), i as f64 * 0.25, j as f64 * 0.1).expect("strings grow");
    }
    let cells: Vec<&[[usize; 2]]> = match nodes {
        3 | 6 => TRIANGLES.iter().map(|cell| &cell[..nodes]).collect(),
        _ => vec![&SQUARE[..nodes]],
    };
    let (line, between) = if matches!(nodes, 3 | 4) { (1, "") } else { (8, " 10") };
    writeln!(text, "$EndNodes\n$Elements\n{}\n1 {line} 2 1 1 1 19{between}", 1 + cells.len() * CELLS)
        .expect("strings grow");
    for (number, (column, cell)) in
        (0..CELLS).flat_map(|column| cells.iter().map(move |cell| (column, cell))).enumerate()
    {
        write!(text, "{} {code} 2 2 1", number + 2).expect("strings grow");
        for &[i, j] in *cell {
            // Across the diagonal the square is itself, and its cells run clockwise.
            let [i, j] = if clockwise { [j, i] } else { [i, j] };
            write!(text, " {}", at([2 * column + i, j])).expect("strings grow");
        }
        text.push('\n');
    }
    text + "$EndElements\n"
}

const FALLING_BAR: &str = r#"title = "A bar that falls"
[time]
step = 0.05
steps = 2
[structure]
density = 1000
body_force = [0, -2000]
clamped = ["root"]
[structure.geometry.gmsh]
file = "bar.msh"
[structure.material.saint_venant_kirchhoff]
young_modulus = 1e6
poisson_ratio = 0.3
[output]
fields_every = 0
[output.probes]
tip = { structure_point = [2, 0.1] }
"#;

#[test]
fn solids_of_every_kind_move_alike_whichever_way_their_cells_run() {
    let case = Case::new("clockwise");
    fs::write(case.path("bar.toml"), FALLING_BAR).expect("the scene is written");
    for (code, nodes) in [(2, 3), (9, 6), (3, 4), (16, 8), (10, 9)] {
        let [upright, turned] = [false, true].map(|clockwise| {
            fs::write(case.path("bar.msh"), bar(code, nodes, clockwise)).expect("the mesh is written");
            let page = sound(&case, "bar.toml", &[]);
            assert_eq!(page.contains("ran clockwise"), clockwise, "{page}");
            let out = format!("{nodes}-{clockwise}");
            let run = case.partita(&["run", "bar.toml", "--out", &out, "--quiet"]);
            assert_eq!(run.code, 0, "{}", run.stderr);
            ["tip_displacement_x", "tip_displacement_y"].map(|column| case.last_probe(&out, column))
        });
        assert!(upright[1] < -1e-3, "{nodes} nodes: {upright:?}");
        for (a, b) in upright.iter().zip(turned) {
            assert!((a - b).abs() <= 1e-8 * upright[1].abs(), "{nodes} nodes: {upright:?} and {turned:?}");
        }
    }
}
