//! What rigid motions must not change, and totals that are known.
use partita_numerics::Field;

use partita_iga::{Side, build};
use partita_numerics::newton::Problem;
use partita_structure::{BodyForce, StructureModel, StructureSolver};
use proptest::prelude::*;

use crate::common::{
    Weights, at_control_points, bare, distorted_cube, distorted_square, dynamic, largest, linear,
    neo_hookean, noise, quasi_static, solver, svk,
};

/// Internal forces of a free patch at a displacement.
fn internal_forces<const D: usize>(solver: &mut StructureSolver<D>, displacement: &[f64]) -> Vec<f64> {
    solver.begin_step(1.0, 1.0).expect("a step");
    solver.guess(displacement);
    solver.assemble(false).unwrap();
    solver.residual().to_vec()
}

fn rotated([x, y]: [f64; 2], angle: f64) -> [f64; 2] {
    let (sin, cos) = angle.sin_cos();
    [cos * x - sin * y, sin * x + cos * y]
}

#[test]
fn rigid_rotation_gives_no_force_where_the_strain_is_that_of_green_and_lagrange() {
    let patch = distorted_square(Weights::Unequal);
    for angle in [0.1, 1.0, 3.0] {
        let turn = at_control_points(&patch, |&[x, y]| {
            let [u, v] = rotated([x, y], angle);
            [u - x + 3.0, v - y - 2.0]
        });
        for material in [svk(1.0, 0.3), neo_hookean(1.0, 0.3)] {
            let mut nonlinear = solver(patch.clone(), bare(material), quasi_static());
            assert!(largest(&internal_forces(&mut nonlinear, &turn)) < 1e-14);
            assert!(nonlinear.strain_energy() < 1e-15);
        }
        let mut small_strain = solver(patch.clone(), bare(linear(1.0, 0.3)), quasi_static());
        assert!(largest(&internal_forces(&mut small_strain, &turn)) > 1e-3);
    }
}

#[test]
fn rigid_rotation_in_space_gives_no_force() {
    let patch = distorted_cube(Weights::Unequal);
    let turn = at_control_points(&patch, |&[x, y, z]| {
        let [u, v] = rotated([x, y], 0.7);
        let [v, w] = rotated([v, z], -1.9);
        [u - x, v - y, w - z]
    });
    for material in [svk(1.0, 0.3), neo_hookean(1.0, 0.3)] {
        let mut solver = solver(patch.clone(), bare(material), quasi_static());
        assert!(largest(&internal_forces(&mut solver, &turn)) < 1e-14);
    }
}

#[test]
fn translation_gives_no_force_under_either_law() {
    let patch = distorted_square(Weights::Unequal);
    let shift = at_control_points(&patch, |_| [0.3, -0.8]);
    for material in [linear(1.0, 0.3), svk(1.0, 0.3), neo_hookean(1.0, 0.3)] {
        let mut solver = solver(patch.clone(), bare(material), quasi_static());
        assert!(largest(&internal_forces(&mut solver, &shift)) < 1e-14);
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    /// Turning a deformed body turns its forces: f_int(Q (x + d) - x) = Q f_int(d).
    #[test]
    fn forces_turn_with_the_body(angle in -3.0..3.0, seed in 0.0..100.0) {
        let patch = distorted_square(Weights::Unequal);
        let count = patch.control_points().len();
        let deformed: Vec<f64> = noise(2 * count, seed).iter().map(|x| 0.05 * x).collect();
        let mut turned = vec![];
        for ([x, y], [u, v]) in patch.control_points().iter().zip(deformed.as_chunks::<2>().0) {
            let [p, q] = rotated([x + u, y + v], angle);
            turned.extend([p - x, q - y]);
        }
        for material in [svk(1.0, 0.3), neo_hookean(1.0, 0.3)] {
            let mut solver = solver(patch.clone(), bare(material), quasi_static());
            let forces = internal_forces(&mut solver, &deformed);
            let energy = solver.strain_energy();
            let turned_forces = internal_forces(&mut solver, &turned);
            for (force, turned) in forces.as_chunks::<2>().0.iter().zip(turned_forces.as_chunks::<2>().0) {
                let [x, y] = rotated(*force, angle);
                prop_assert!((turned[0] - x).abs() < 1e-13 && (turned[1] - y).abs() < 1e-13);
            }
            prop_assert!((solver.strain_energy() / energy - 1.0).abs() < 1e-12);
        }
    }
}

#[test]
fn mass_and_weight_are_density_and_body_force_times_the_volume() {
    let ring = build::quarter_annulus(1.0, 1.5).unwrap().elevate_degree(0, 1).subdivide(1, 4).unwrap();
    let volume = std::f64::consts::FRAC_PI_4 * (1.5 * 1.5 - 1.0);
    let mut model = bare(svk(1.0, 0.3));
    model.density = 7.0;
    model.body_force = BodyForce::Constant([2.0, -5.0]);
    let mut solver = solver(ring, model, dynamic(0.5));
    // A unit velocity has the kinetic energy of half the mass.
    let mut state = solver.state().clone();
    state.velocity.as_chunks_mut::<2>().0.fill([0.6, 0.8]);
    solver.restore(&state).unwrap();
    assert!((2.0 * solver.kinetic_energy() / (7.0 * volume) - 1.0).abs() < 1e-7);

    solver.begin_step(1.0, 1.0).expect("a step");
    let mut total = [0.0; 2];
    for force in solver.trial().external_force.as_chunks::<2>().0 {
        (0..2).for_each(|i| total[i] += force[i]);
    }
    assert!((total[0] / (2.0 * volume) - 1.0).abs() < 1e-7, "{total:?}");
    assert!((total[1] / (-5.0 * volume) - 1.0).abs() < 1e-7, "{total:?}");
}

#[test]
fn a_body_force_given_as_a_field_equals_the_constant_and_the_function_of_time() {
    let external = |patch, body_force| {
        let model = StructureModel { body_force, ..bare(svk(1.0, 0.3)) };
        let mut solver = solver(patch, model, dynamic(0.5));
        solver.begin_step(0.5, 0.5).expect("a step");
        solver.trial().external_force.clone()
    };
    let patch = || distorted_square(Weights::Unequal);
    let constant = external(patch(), BodyForce::Constant([1.0, -2.0]));
    assert_eq!(constant, external(patch(), BodyForce::in_time(|t| [2.0 * t, -4.0 * t])));
    let field = external(patch(), BodyForce::in_space(|_, t| [2.0 * t, -4.0 * t]));
    for (a, b) in constant.iter().zip(&field) {
        assert!((a - b).abs() < 1e-15);
    }
    // A force that grows along x has the first moment of the unit square as its total.
    let square = build::rectangle([0.0, 0.0], [1.0, 1.0], [2, 2], [3, 2]).unwrap();
    let growing = external(square, BodyForce::in_space(|&[x, _], _| [x, 0.0]));
    assert!((growing.iter().sum::<f64>() - 0.5).abs() < 1e-14);
}

#[test]
fn a_free_body_under_a_uniform_body_force_accelerates_as_a_whole() {
    let mut model = bare(svk(100.0, 0.3));
    model.density = 4.0;
    model.body_force = BodyForce::Constant([0.0, -8.0]);
    let mut solver = solver(distorted_square(Weights::Equal), model, dynamic(0.8));
    solver.start_from_equilibrium(0.0).unwrap();
    for step in 1..=10 {
        solver.step_alone(0.1 * f64::from(step), 0.1).unwrap();
    }
    // a = b / rho: after t = 1 s every point has moved by a/2.
    for [u, v] in solver.values().as_chunks::<2>().0 {
        assert!(u.abs() < 1e-11 && (v + 1.0).abs() < 1e-11, "({u}, {v})");
    }
    assert!(solver.reaction(Side::LEFT).is_ok());
}
