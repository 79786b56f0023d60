//! A uniform strain is reproduced however the patch is distorted.
//!
//! Under an affine displacement the stress is the same at every quadrature point, so its nodal forces vanish inside
//! as the integrals of the gradients do. With equal weights degree + 1 Gauss points integrate these exactly and the
//! patch test holds to round-off. With unequal weights the integrands are rational: the defect is that of the
//! quadrature, and vanishes under refinement much faster than the error of any solution.
use partita_numerics::Field;

use partita_iga::{Side, Spline};
use partita_numerics::newton::{self, Limit, Problem, Verdict};
use partita_numerics::rates::fitted_order;
use partita_structure::Material;

use crate::common::{
    Weights, at_control_points, bare, distorted_cube, distorted_square, largest, linear, neo_hookean,
    quasi_static, solver, svk, traction_of_uniform_stress,
};

/// Stretch, shear and rotation together, far beyond small strains.
const PLANE: [[f64; 2]; 2] = [[0.3, -0.4], [0.5, -0.1]];
const SPACE: [[f64; 3]; 3] = [[0.3, -0.4, 0.1], [0.5, -0.1, 0.2], [0.0, -0.3, 0.2]];

/// Largest internal force at a control point inside the patch, over the largest one at all, at a displacement that is
/// affine in the place.
fn inner_force<const D: usize>(patch: &Spline<D>, material: Material, gradient: [[f64; D]; D]) -> f64 {
    let mut solver = solver(patch.clone(), bare(material), quasi_static());
    solver.begin_step(1.0, 1.0).expect("a step");
    solver.guess(&at_control_points(patch, |x| {
        std::array::from_fn(|i| 0.1 + (0..D).map(|j| gradient[i][j] * x[j]).sum::<f64>())
    }));
    solver.assemble(false).unwrap();
    let mut on_boundary = vec![false; patch.control_points().len()];
    for side in patch.sides() {
        patch.side(side).1.into_iter().for_each(|node| on_boundary[node] = true);
    }
    let forces = solver.residual().as_chunks::<D>().0;
    let inside: Vec<f64> =
        forces.iter().zip(&on_boundary).filter(|(_, on)| !**on).flat_map(|(force, _)| *force).collect();
    assert!(!inside.is_empty());
    largest(&inside) / largest(solver.residual())
}

#[test]
fn uniform_strain_leaves_no_force_inside_a_distorted_patch() {
    for material in [linear(7.0, 0.3), svk(7.0, 0.3), neo_hookean(7.0, 0.3)] {
        let square = inner_force(&distorted_square(Weights::Equal), material, PLANE);
        assert!(square < 1e-14, "{square:e}");
        // Refined first, for the coarse cube has no control point inside.
        let cube = distorted_cube(Weights::Equal).subdivide(2, 2).unwrap();
        let cube = inner_force(&cube, material, SPACE);
        assert!(cube < 1e-14, "{cube:e}");
    }
}

#[test]
fn with_unequal_weights_the_force_inside_vanishes_at_the_order_of_the_quadrature() {
    let parts = [2, 4, 8, 16];
    let force = parts.map(|parts| {
        let patch = distorted_square(Weights::Unequal);
        let patch = patch.subdivide(0, parts).unwrap().subdivide(1, parts).unwrap();
        inner_force(&patch, svk(7.0, 0.3), PLANE)
    });
    println!("patch test with unequal weights: {force:?}");
    // Order 4 for the lower degree 2: three points miss the terms of h^6 in a product that starts at h^2.
    let order =
        fitted_order(&parts[1..].iter().map(|&parts| 1.0 / parts as f64).collect::<Vec<_>>(), &force[1..]);
    assert!(force[0] < 1e-3 && order > 3.7, "order {order}, forces {force:?}");
}

#[test]
fn a_clamped_patch_under_the_tractions_of_a_uniform_stress_takes_its_uniform_strain() {
    // On the clamped side x = 0 the displacement vanishes.
    let gradient = [[0.3, 0.0], [-0.2, 0.0]];
    for material in [linear(7.0, 0.3), svk(7.0, 0.3), neo_hookean(7.0, 0.3)] {
        let patch = distorted_square(Weights::Equal);
        let mut model = bare(material);
        model.clamped = [Side::LEFT].into();
        model.wetted = [Side::RIGHT, Side::BOTTOM, Side::TOP].into();
        let mut solver = solver(patch.clone(), model, quasi_static());
        let stress = material.stress(&gradient).unwrap();
        let traction = traction_of_uniform_stress(&patch, &[Side::RIGHT, Side::BOTTOM, Side::TOP], stress);
        let traction = traction.as_chunks::<2>().0;
        let load: Vec<f64> = solver.interface_points().iter().flat_map(|&point| traction[point]).collect();

        solver.begin_step(1.0, 1.0).expect("a step");
        solver.impose(&load).expect("a step");
        let settings = *solver.newton_settings();
        newton::solve(&mut solver, &settings, Limit::ToConvergence, |_, _| Verdict::Continue).unwrap();

        let exact = at_control_points(&patch, |[x, _]| [gradient[0][0] * x, gradient[1][0] * x]);
        let error: Vec<f64> = solver.values().iter().zip(&exact).map(|(d, exact)| d - exact).collect();
        assert!(largest(&error) < 1e-11, "{:e}", largest(&error));
        let energy = material.energy(&gradient);
        assert!((solver.strain_energy() / energy - 1.0).abs() < 1e-11);
        // The support holds against the traction on the opposite side.
        let reaction = solver.reaction(Side::LEFT).unwrap();
        for i in 0..2 {
            assert!((reaction[i] + stress[i][0]).abs() < 1e-10, "{reaction:?} against {stress:?}");
        }
    }
}
