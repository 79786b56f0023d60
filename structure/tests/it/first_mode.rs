//! The first mode, by inverse iteration, against all modes of a dense solver.
use partita_numerics::Field;

use partita_iga::Side;
use partita_structure::{StructureModel, TimeScheme};

use crate::common::{bare, beam, dynamic, linear, modes, quasi_static, solver, stepped_by, svk};

#[test]
fn it_is_the_lowest_of_all_modes() {
    for (sides, thickness) in [(vec![Side::LEFT], 0.2), (vec![Side::LEFT, Side::RIGHT], 0.01)] {
        let model = StructureModel { clamped: sides.iter().copied().collect(), ..bare(svk(100.0, 0.3)) };
        let patch = beam(1.0, thickness, 2, 8);
        let lowest = modes(&patch, &model).0[0];
        let mode = solver(patch, model, dynamic(0.5)).first_mode().expect("it is held");
        let period = mode.period().expect("it has inertia");
        let expected = std::f64::consts::TAU / lowest;
        assert!((period / expected - 1.0).abs() < 1e-4, "{period} s against {expected} s");
    }
}

#[test]
fn a_structure_that_is_not_held_has_none() {
    assert!(solver(beam(1.0, 0.2, 2, 4), bare(linear(100.0, 0.3)), dynamic(0.5)).first_mode().is_none());
}

#[test]
fn without_inertia_it_has_a_stiffness_and_no_period() {
    let model = StructureModel { clamped: Side::LEFT.into(), ..bare(linear(100.0, 0.3)) };
    let mode = solver(beam(1.0, 0.2, 2, 4), model, quasi_static()).first_mode().expect("it is held");
    assert!(mode.period().is_none() && mode.stiffness > 0.0);
}

#[test]
fn the_resistance_is_that_of_the_tangent() {
    let model = StructureModel { clamped: Side::LEFT.into(), ..bare(linear(100.0, 0.3)) };
    let dt = 0.01;
    for scheme in [TimeScheme::GeneralizedAlpha { spectral_radius: 0.5 }, TimeScheme::AVERAGE_ACCELERATION] {
        let mut beam = solver(beam(1.0, 0.2, 2, 4), model.clone(), stepped_by(scheme));
        let mode = beam.first_mode().expect("it is held");
        let (resistance, _) = beam.resistance(&mode, dt);
        beam.begin_step(dt, dt).expect("a step");
        partita_numerics::newton::Problem::assemble(&mut beam, true).expect("it can be assembled");
        let (pattern, values) = beam.tangent();
        let phi: Vec<f64> = beam.parts()[0].dofs.iter().map(|&dof| mode.shape[dof]).collect();
        let mut image = vec![0.0; phi.len()];
        pattern.multiply(values, &phi, &mut image);
        let expected: f64 = phi.iter().zip(&image).map(|(x, y)| x * y).sum();
        assert!((resistance / expected - 1.0).abs() < 1e-10, "{resistance} against {expected}");
    }
}
