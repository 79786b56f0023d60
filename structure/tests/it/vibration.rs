//! Frequencies, energies and damping of linear vibrations.
use partita_numerics::Field;

use partita_iga::Side;
use partita_structure::{Plane, StructureModel, StructureSolver, TimeScheme};

use crate::common::{RADII, bare, beam, generalized_alpha, linear, modes, solver, stepped_by};

#[test]
fn the_lowest_frequencies_of_a_clamped_beam_are_those_of_beam_theory() {
    let (height, e, nu, rho): (f64, f64, f64, f64) = (0.01, 1e7, 0.3, 1200.0);
    let material =
        partita_structure::Material::new(partita_structure::Law::StVenantKirchhoff, e, nu, Plane::Strain)
            .unwrap();
    let model = StructureModel { density: rho, clamped: [Side::LEFT, Side::RIGHT].into(), ..bare(material) };
    let frequencies = modes(&beam(1.0, height, 2, 60), &model).0;
    // omega = beta^2 sqrt(D/(rho h)), cos(beta) cosh(beta) = 1 for the length 1.
    let scale = (e / (1.0 - nu * nu) * height.powi(3) / 12.0 / (rho * height)).sqrt();
    for (found, beta) in frequencies.iter().zip([4.730_040_745_f64, 7.853_204_624, 10.995_607_838]) {
        let expected = beta * beta * scale;
        println!("clamped beam, beta = {beta:.3}: frequency over beam theory {:.5}", found / expected);
        assert!((found / expected - 1.0).abs() < 0.01, "{found} against {expected}");
    }
}

/// A short cantilever of linear material, released from a bent state.
fn released(scheme: TimeScheme) -> (StructureSolver<2>, f64) {
    let model = StructureModel { clamped: [Side::LEFT].into(), ..bare(linear(100.0, 0.3)) };
    let patch = beam(1.0, 0.2, 2, 4);
    let (frequencies, shapes) = modes(&patch, &model);
    let mut solver = solver(patch, model, stepped_by(scheme));
    let mut state = solver.state().clone();
    for (equation, &dof) in solver.parts()[0].dofs.iter().enumerate() {
        state.displacement[dof] = 0.1 * shapes[0][equation] + 0.03 * shapes[3][equation];
    }
    solver.restore(&state).unwrap();
    solver.start_from_equilibrium(0.0).unwrap();
    (solver, frequencies[0])
}

fn energy(solver: &StructureSolver<2>) -> f64 {
    solver.kinetic_energy() + solver.strain_energy()
}

/// Over the energy at the start.
fn energy_after_500_steps(scheme: TimeScheme) -> f64 {
    let (mut solver, frequency) = released(scheme);
    let dt = 0.3 / frequency;
    let start = energy(&solver);
    for step in 1..=500 {
        solver.step_alone(f64::from(step) * dt, dt).unwrap();
    }
    energy(&solver) / start
}

#[test]
fn average_acceleration_keeps_the_energy_of_a_linear_vibration_and_a_larger_gamma_loses_it() {
    let kept = energy_after_500_steps(TimeScheme::AVERAGE_ACCELERATION);
    assert!((kept - 1.0).abs() < 1e-9, "{kept}");
    let lost = energy_after_500_steps(TimeScheme::Newmark { beta: 0.3025, gamma: 0.6 });
    assert!(lost < 0.1, "{lost}");
}

#[test]
fn radius_one_keeps_the_energy_of_a_linear_vibration_and_smaller_radii_lose_it() {
    let after = RADII.map(|radius| energy_after_500_steps(generalized_alpha(radius)));
    println!("energy after 500 steps at radius 0, 0.5, 1: {after:?}");
    assert!((after[2] - 1.0).abs() < 1e-9, "{after:?}");
    assert!(after[0] < after[1] && after[1] < 0.9, "{after:?}");
}

#[test]
fn the_highest_frequencies_decay_by_the_spectral_radius() {
    for radius in [0.0, 0.5, 0.8] {
        let (mut solver, _) = released(generalized_alpha(radius));
        // Steps so long that every mode is at its limit of infinite frequency.
        let dt = 1e6;
        let mut norms = vec![];
        for step in 1..=40 {
            solver.step_alone(f64::from(step) * dt, dt).unwrap();
            norms.push(partita_numerics::norms::norm2(solver.values()));
        }
        // A triple eigenvalue of the step: d_n ~ n^2 radius^n.
        if radius == 0.0 {
            assert!(norms[5] < 1e-9, "{norms:?}");
        } else {
            let rate = (norms[39] / norms[19] / 4.0).powf(1.0 / 20.0);
            println!("radius {radius}: decay {rate} a step");
            assert!((rate / radius - 1.0).abs() < 0.01, "radius {radius}: decay {rate}");
        }
    }
}
