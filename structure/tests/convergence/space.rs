//! Manufactured solutions at large strain: order degree + 1 in the displacement.

use partita_numerics::Field;
use std::f64::consts::PI;

use partita_iga::{Knots, Side, Spline};
use partita_numerics::gauss;
use partita_numerics::rates::fitted_order;
use partita_structure::{BodyForce, Law, Material, Plane, StructureModel, StructureSolver};

use crate::common::{bare, quasi_static, solver};

/// Vanishes on the border of the unit square; strains up to some 15 %.
pub(crate) fn exact([x, y]: [f64; 2]) -> [f64; 2] {
    let (sx, sy) = ((PI * x).sin(), (PI * y).sin());
    [0.04 * sx * sy, 0.02 * (2.0 * PI * x).sin() * sy]
}

fn exact_gradient([x, y]: [f64; 2]) -> [[f64; 2]; 2] {
    let ((sx, cx), (sy, cy)) = ((PI * x).sin_cos(), (PI * y).sin_cos());
    let (s2, c2) = (2.0 * PI * x).sin_cos();
    [[0.04 * PI * cx * sy, 0.04 * PI * sx * cy], [0.04 * PI * c2 * sy, 0.02 * PI * s2 * cy]]
}

/// b = -Div P, by central differences of fourth order.
pub(crate) fn body_force(material: &Material, [x, y]: [f64; 2]) -> [f64; 2] {
    let stress = |dx: f64, dy: f64| material.stress(&exact_gradient([x + dx, y + dy])).unwrap();
    let h = 1e-3;
    std::array::from_fn(|i| {
        let slope = |f: &dyn Fn(f64) -> f64| (8.0 * (f(h) - f(-h)) - (f(2.0 * h) - f(-2.0 * h))) / (12.0 * h);
        -slope(&|h| stress(h, 0.0)[i][0]) - slope(&|h| stress(0.0, h)[i][1])
    })
}

/// The unit square as a NURBS of degree 2 with unequal weights and a moved middle, raised and refined: every level has
/// the same map. Of degree 1 there are four corners with unequal weights.
fn square(degree: usize, elements: usize) -> Spline<2> {
    if degree == 1 {
        let corners = vec![[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0]];
        let patch =
            Spline::rational(vec![Knots::uniform(1, 1).unwrap(); 2], corners, vec![1.0, 0.8, 1.3, 0.9]);
        return patch.unwrap().subdivide(0, elements).unwrap().subdivide(1, elements).unwrap();
    }
    let knots = vec![Knots::uniform(2, 1).unwrap(); 2];
    let mut points: Vec<[f64; 2]> =
        (0..9).map(|a| [0.5 * f64::from(a % 3), 0.5 * f64::from(a / 3)]).collect();
    points[4] = [0.58, 0.44];
    let weights = vec![1.0, 0.9, 1.1, 1.2, 0.8, 1.0, 0.9, 1.1, 1.0];
    let patch = Spline::rational(knots, points, weights).unwrap();
    let patch = patch.elevate_degree(0, degree - 2).elevate_degree(1, degree - 2);
    patch.subdivide(0, elements).unwrap().subdivide(1, elements).unwrap()
}

/// L2 norm of the error in the displacement.
fn error(solver: &StructureSolver<2>) -> f64 {
    let patch = solver.spline();
    let rule = gauss::line(patch.knots()[0].degree() + 3);
    let mut square = 0.0;
    for element in patch.elements() {
        for (u, wu) in &rule {
            for (v, wv) in &rule {
                let xi = element.at([*u, *v]);
                let (found, exact) = (solver.displacement_at(&xi), exact(patch.point(&xi)));
                let [a, b] = [patch.tangent(&xi, 0), patch.tangent(&xi, 1)];
                let area = wu * wv * element.measure() * (a[0] * b[1] - a[1] * b[0]);
                square += area * ((found[0] - exact[0]).powi(2) + (found[1] - exact[1]).powi(2));
            }
        }
    }
    square.sqrt()
}

/// Fitted order, and the error of the finest level over the largest displacement.
fn order(degree: usize, levels: &[usize; 4], law: Law, plane: Plane) -> [f64; 2] {
    let material = Material::new(law, 10.0, 0.3, plane).unwrap();
    let errors = levels.map(|elements| {
        let model = StructureModel {
            body_force: BodyForce::in_space(move |x, _| body_force(&material, *x)),
            clamped: [Side::LEFT, Side::RIGHT, Side::BOTTOM, Side::TOP].into(),
            ..bare(material)
        };
        let mut solver = solver(square(degree, elements), model, quasi_static());
        solver.step_alone(1.0, 1.0).unwrap();
        error(&solver) / 0.04
    });
    let h = levels.map(|elements| 1.0 / elements as f64);
    // The first level is not yet asymptotic for the higher degrees.
    let order = fitted_order(&h[1..], &errors[1..]);
    println!("{law:?}, plane {plane:?}, degree {degree}: order {order:.2}, errors {errors:?}");
    [order, errors[3]]
}

#[test]
fn the_displacement_converges_with_order_degree_plus_one_on_a_distorted_nurbs_patch() {
    for (degree, levels, bound) in [
        (1, [8, 16, 32, 64], 3e-4),
        (2, [6, 12, 24, 48], 5e-6),
        (3, [6, 12, 24, 48], 1e-7),
        (4, [8, 16, 24, 32], 2e-8),
    ] {
        let [order, error] = order(degree, &levels, Law::StVenantKirchhoff, Plane::Strain);
        assert!((order - (degree as f64 + 1.0)).abs() < 0.3, "degree {degree}: order {order}");
        assert!(error < bound, "degree {degree}: error {error:e}");
    }
}

#[test]
fn the_other_laws_converge_with_the_same_order() {
    for (law, plane) in [
        (Law::StVenantKirchhoff, Plane::Stress),
        (Law::LinearElastic, Plane::Strain),
        (Law::NeoHookean, Plane::Strain),
        (Law::NeoHookean, Plane::Stress),
    ] {
        let [order, error] = order(2, &[4, 8, 16, 32], law, plane);
        assert!((order - 3.0).abs() < 0.3, "{law:?}, {plane:?}: order {order}");
        assert!(error < 1.5e-5, "{law:?}, {plane:?}: error {error:e}");
    }
}
