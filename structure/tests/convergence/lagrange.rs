//! The manufactured solution of `space` on bent meshes of triangles and quadrilaterals: order degree + 1.
use partita_numerics::Field;

use std::f64::consts::PI;

use partita_mesh::CellKind;
use partita_mesh::solid::reference;
use partita_numerics::gauss;
use partita_numerics::rates::fitted_order;
use partita_structure::{BodyForce, StructureModel, StructureSolver};

use crate::common::{bare, on_mesh, quasi_static, shaped_square, svk};
use crate::space::{body_force, exact};

/// L2 norm of the error in the displacement.
fn error(solver: &StructureSolver<2>) -> f64 {
    let partita_structure::Space::Lagrange(mesh) = solver.space() else { panic!("a mesh") };
    let is_triangle = reference::corner_count(mesh.cells().kind) == 3;
    let values = solver.values().as_chunks::<2>().0;
    let line = gauss::line(5);
    let mut square = 0.0;
    for (cell, nodes) in mesh.cells().iter().enumerate() {
        for &(u, wu) in &line {
            for &(v, wv) in &line {
                // Two corners of a square fall together to make a triangle.
                let (xi, weight) = if is_triangle {
                    ([u, v * (1.0 - u)], wu * wv * (1.0 - u))
                } else {
                    ([2.0 * u - 1.0, 2.0 * v - 1.0], 4.0 * wu * wv)
                };
                let map = mesh.map(cell, xi);
                let [[a, b], [c, d]] = map.jacobian;
                let exact = exact(map.place);
                for i in 0..2 {
                    let found: f64 =
                        nodes.iter().zip(map.shape.values).map(|(&node, n)| n * values[node][i]).sum();
                    square += weight * (a * d - b * c) * (found - exact[i]).powi(2);
                }
            }
        }
    }
    square.sqrt()
}

#[test]
fn the_displacement_converges_with_order_degree_plus_one_on_bent_meshes() {
    let material = svk(10.0, 0.3);
    for (kind, levels, bound) in [
        (CellKind::Triangle3, [8, 16, 32, 64], 8e-4),
        (CellKind::Quadrilateral4, [8, 16, 32, 64], 3e-4),
        (CellKind::Triangle6, [4, 8, 16, 32], 2.4e-5),
        (CellKind::Quadrilateral8, [4, 8, 16, 32], 1.6e-5),
        (CellKind::Quadrilateral9, [4, 8, 16, 32], 1.6e-5),
    ] {
        let errors = levels.map(|n| {
            // The sides stay where they are, for the solution vanishes there.
            let mesh = shaped_square(kind, n, |&[x, y]| {
                let bump = (PI * x).sin() * (PI * y).sin();
                [x + 0.06 * bump, y - 0.05 * bump * (2.0 * x).cos()]
            });
            let model = StructureModel {
                body_force: BodyForce::in_space(move |x, _| body_force(&material, *x)),
                clamped: ["left", "right", "bottom", "top"].into(),
                ..bare(material)
            };
            let mut solver = on_mesh(mesh, model, quasi_static());
            solver.step_alone(1.0, 1.0).unwrap();
            error(&solver) / 0.04
        });
        let h = levels.map(|n| 1.0 / n as f64);
        let order = fitted_order(&h[1..], &errors[1..]);
        println!("{kind:?}: order {order:.2}, errors {errors:?}");
        let expected = if kind.node_count() < 6 { 2.0 } else { 3.0 };
        assert!((order - expected).abs() < 0.2, "{kind:?}: order {order}");
        assert!(errors[3] < bound, "{kind:?}: error {:e}", errors[3]);
    }
}
