//! Loads of uniform pressure on structures of any shape, against the consistent ones.

use std::f64::consts::{FRAC_PI_2, TAU};

use partita_iga::{Side, Spline, build};
use partita_mesh::{CellKind, Cells, SolidMesh};
use partita_structure::Space;
use serde_json::json;

use super::*;

fn solver(space: Space<2>, wetted: &[&str]) -> StructureSolver<2> {
    let given = json!({
        "density": 1.0,
        "wetted": wetted,
        "geometry": { "rectangle": { "size": [1.0, 1.0], "elements": [1, 1] } },
        "material": { "linear_elastic": { "young_modulus": 1.0, "poisson_ratio": 0.3 } },
    });
    let scene = serde_json::from_value(given).expect("a structure");
    crate::build::structure_solver(&scene, space).expect("a solver")
}

/// Turns a patch about the origin.
fn turned(patch: &Spline<2>, angle: f64) -> Spline<2> {
    let turn = |[x, y]: &[f64; 2]| turn([*x, *y], angle);
    let points = patch.control_points().iter().map(turn).collect();
    patch.with_control_points(points).expect("as many points")
}

fn turn([x, y]: [f64; 2], angle: f64) -> [f64; 2] {
    let (s, c) = angle.sin_cos();
    [c * x - s * y, s * x + c * y]
}

/// Nodes along a way through corners, on each leg as many edges as given and of unequal lengths.
fn way(corners: &[[f64; 2]], edges: &[usize]) -> Vec<[f64; 2]> {
    let mut points = vec![corners[0]];
    for (leg, &count) in corners.windows(2).zip(edges) {
        for k in 1..=count {
            let s = k as f64 / count as f64;
            let s = s + 0.2 * s * (1.0 - s);
            points.push([0, 1].map(|c| leg[0][c] + s * (leg[1][c] - leg[0][c])));
        }
    }
    points
}

/// Loads `[N/m]` on the nodes of the structure of unit pressure on a polygon of facets, in the way of `points`.
fn loads(
    structure: &StructureSolver<2>,
    points: &[[f64; 2]],
    closed: bool,
    by_mortar: bool,
) -> Vec<[f64; 2]> {
    let count = points.len();
    let facets: Vec<[usize; 2]> =
        (0..if closed { count } else { count - 1 }).map(|i| [i, (i + 1) % count]).collect();
    let nodal = structure.interface_rows(points, 1e-9).expect("points on the interface");
    let of_points = if by_mortar {
        mortar(points.to_vec(), facets.clone(), nodal, structure, 1e-9).expect("rows")
    } else {
        nodal
    };
    let mut loads = vec![[0.0; 2]; structure.space().node_count()];
    for facet in facets {
        let [a, b] = facet.map(|i| points[i]);
        let half = [0.5 * (b[1] - a[1]), 0.5 * (a[0] - b[0])];
        for (node, weight) in facet.iter().flat_map(|&i| &of_points[i]) {
            (0..2).for_each(|c| loads[*node][c] += weight * half[c]);
        }
    }
    loads
}

/// `integral R_a n` over a path x(s) with ds n given, by many Gauss points on each of its pieces.
fn consistent(
    structure: &StructureSolver<2>,
    pieces: &[(f64, f64)],
    at: impl Fn(f64) -> [[f64; 2]; 2],
) -> Vec<[f64; 2]> {
    let mut loads = vec![[0.0; 2]; structure.space().node_count()];
    for &(start, end) in pieces {
        for (s, weight) in gauss::line(8) {
            let [place, normal] = at(start + s * (end - start));
            let row = structure.interface_rows(&[place], 1e-6).expect("a place on the interface").remove(0);
            for (node, value) in row {
                (0..2).for_each(|c| loads[node][c] += (end - start) * weight * value * normal[c]);
            }
        }
    }
    loads
}

/// The same over straight elements.
fn on_elements(structure: &StructureSolver<2>, inside: [f64; 2]) -> Vec<[f64; 2]> {
    let mut sum = vec![[0.0; 2]; structure.space().node_count()];
    for [a, b] in structure.space().boundary_elements(&structure.model().wetted) {
        let normal = [b[1] - a[1], a[0] - b[0]];
        // The way of the loads below has the structure on its left: this normal points out of it.
        let out = (0..2).map(|c| normal[c] * (a[c] - inside[c])).sum::<f64>().signum();
        let along = |s: f64| [[0, 1].map(|c| a[c] + s * (b[c] - a[c])), normal.map(|n| n * out)];
        for (sum, part) in sum.iter_mut().zip(consistent(structure, &[(0.0, 1.0)], along)) {
            (0..2).for_each(|c| sum[c] += part[c]);
        }
    }
    sum
}

fn difference(a: &[[f64; 2]], b: &[[f64; 2]]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a[0] - b[0]).hypot(a[1] - b[1])).fold(0.0, f64::max)
}

#[test]
fn a_turned_block_wetted_on_three_sides_bears_pressure_evenly() {
    for degree in [1, 2, 3] {
        for (elements, edges) in [([8, 3], [3, 5, 2]), ([1, 1], [7, 4, 9]), ([5, 20], [13, 2, 17])] {
            let block =
                build::rectangle([0.5, 0.2], [2.0, 1.0], [degree, degree], elements).expect("a block");
            let structure = solver(turned(&block, 0.7).into(), &["left", "top", "right"]);
            let corners = [[2.5, 0.2], [2.5, 1.2], [0.5, 1.2], [0.5, 0.2]].map(|corner| turn(corner, 0.7));
            let points = way(&corners, &edges);
            let exact = on_elements(&structure, turn([1.5, 0.7], 0.7));
            let [by_mortar, by_nodes] = [true, false].map(|mortar| loads(&structure, &points, false, mortar));
            let error = difference(&by_mortar, &exact);
            assert!(error < 1e-12, "degree {degree}, {elements:?}, {edges:?}: {error:e}");
            // The trapezoidal rule is exact where linear elements hold many edges.
            let coarse = edges[1] < elements[0];
            assert!(!coarse || difference(&by_nodes, &exact) > 1e-2, "degree {degree}, {edges:?}");
        }
    }
}

/// Two quadrilaterals of degree 2 and unequal size, wetted on top.
#[test]
fn edges_of_a_mesh_bear_pressure_evenly() {
    let x = [0.0, 0.35, 0.7, 1.35, 2.0];
    let points = [0.0, 0.5, 1.0].iter().flat_map(|&y| x.map(|x| turn([x, y], -0.4))).collect();
    // Corners, then the middles of the edges, then the centre.
    let quadrilateral = |k: usize| [k, k + 2, k + 12, k + 10, k + 1, k + 7, k + 11, k + 5, k + 6];
    let cells = [quadrilateral(0), quadrilateral(2)].concat();
    let top = Cells::new(CellKind::Line3, vec![10, 12, 11, 12, 14, 13]);
    let mesh =
        SolidMesh::new(points, Cells::new(CellKind::Quadrilateral9, cells), vec![("skin".to_owned(), top)])
            .expect("a mesh");
    let structure = solver(Space::Lagrange(mesh), &["skin"]);
    let corners = [[2.0, 1.0], [0.0, 1.0]].map(|corner| turn(corner, -0.4));
    let exact = on_elements(&structure, turn([1.0, 0.5], -0.4));
    for edges in [2, 3, 5, 16] {
        let error = difference(&loads(&structure, &way(&corners, &[edges]), false, true), &exact);
        assert!(error < 1e-12, "{edges}: {error:e}");
    }
}

/// A polygon in a circle bears the pressure of the circle to second order, wherever the seam of the patch lies.
#[test]
fn a_closed_ring_bears_pressure_to_second_order() {
    let ring = build::annular_sector([0.0; 2], [1.0, 1.2], 0.3, TAU, [2, 2], [12, 1]).expect("a ring");
    // The outer side, on which the pressure acts.
    let [x, y] = ring.side(Side::TOP).0.control_points()[0];
    let outer = if x.hypot(y) > 1.1 { "top" } else { "bottom" };
    let structure = solver(ring.into(), &[outer]);
    let piece = |k: usize| (0.3 + FRAC_PI_2 / 3.0 * k as f64, 0.3 + FRAC_PI_2 / 3.0 * (k + 1) as f64);
    let pieces: Vec<_> = (0..12).map(piece).collect();
    let exact = consistent(&structure, &pieces, |angle| {
        let radial = [angle.cos(), angle.sin()];
        [radial.map(|r| 1.2 * r), radial.map(|r| 1.2 * r)]
    });
    let error = |count: usize| {
        let place = |k: usize| {
            let angle = TAU * k as f64 / count as f64;
            [1.2 * angle.cos(), 1.2 * angle.sin()]
        };
        let points: Vec<_> = (0..count).map(place).collect();
        difference(&loads(&structure, &points, true, true), &exact)
    };
    let errors = [20, 40, 80, 160].map(error);
    for pair in errors.windows(2) {
        let order = (pair[0] / pair[1]).log2();
        assert!(order > 1.7, "{errors:?}");
    }
    assert!(errors[0] < 0.05, "{errors:?}");
}
