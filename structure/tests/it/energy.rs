//! Energy of structures without loads over ten thousand steps.
use partita_numerics::Field;

use nalgebra::Matrix3;
use partita_iga::Side;
use partita_numerics::newton::Bound;
use partita_numerics::time::GeneralizedAlpha;
use partita_structure::{Material, StructureModel, StructureSolver, TimeScheme};

use crate::common::{
    bare, beam, generalized_alpha, largest, linear, modes, neo_hookean, solver, stepped_by, svk,
};

const STEPS: u32 = 10_000;

fn energy(solver: &StructureSolver<2>) -> f64 {
    solver.kinetic_energy() + solver.strain_energy()
}

/// A cantilever in its first mode of linear vibration, with a step that takes the angle `omega_dt` of that mode.
fn in_first_mode(scheme: TimeScheme, omega_dt: f64) -> (StructureSolver<2>, f64) {
    let model = StructureModel { clamped: [Side::LEFT].into(), ..bare(linear(100.0, 0.3)) };
    let patch = beam(1.0, 0.2, 2, 2);
    let (frequencies, shapes) = modes(&patch, &model);
    // A bound relative to the forces cannot be met where all of them pass through zero.
    let mut settings = stepped_by(scheme);
    settings.newton.bound = Bound::Absolute(1e-11);
    let mut solver = solver(patch, model, settings);
    let mut state = solver.state().clone();
    for (equation, &dof) in solver.parts()[0].dofs.iter().enumerate() {
        state.displacement[dof] = shapes[0][equation];
    }
    solver.restore(&state).unwrap();
    solver.start_from_equilibrium(0.0).unwrap();
    (solver, omega_dt / frequencies[0])
}

/// Largest eigenvalue by magnitude of the step of an oscillator, from the equations of the scheme: with the unknowns
/// (d, dt v, dt^2 a) of both ends, `A new + B old = 0`.
fn decay_of_an_oscillator(scheme: TimeScheme, omega_dt: f64) -> f64 {
    let GeneralizedAlpha { alpha_m, alpha_f, gamma, beta } = match scheme {
        TimeScheme::GeneralizedAlpha { spectral_radius } => {
            GeneralizedAlpha::from_spectral_radius(spectral_radius).unwrap()
        }
        TimeScheme::Newmark { beta, gamma } => GeneralizedAlpha::newmark(beta, gamma).unwrap(),
        TimeScheme::QuasiStatic => panic!("nothing vibrates without inertia"),
    };
    let k = omega_dt * omega_dt;
    let new = Matrix3::new(1.0, 0.0, -beta, 0.0, 1.0, -gamma, k * (1.0 - alpha_f), 0.0, 1.0 - alpha_m);
    let old = Matrix3::new(-1.0, -1.0, beta - 0.5, 0.0, -1.0, gamma - 1.0, k * alpha_f, 0.0, alpha_m);
    let step = -new.try_inverse().expect("a step can be solved for") * old;
    step.complex_eigenvalues().iter().map(|value| value.norm()).fold(0.0, f64::max)
}

#[test]
fn a_linear_vibration_decays_over_ten_thousand_steps_as_its_spectral_radius_predicts() {
    let newmark = TimeScheme::Newmark { beta: 0.3025, gamma: 0.6 };
    for (scheme, omega_dt) in [
        (generalized_alpha(0.9), 0.3),
        (generalized_alpha(0.5), 0.2),
        (generalized_alpha(0.0), 0.1),
        (newmark, 0.05),
    ] {
        let (mut solver, dt) = in_first_mode(scheme, omega_dt);
        let start = energy(&solver);
        for step in 1..=STEPS {
            solver.step_alone(f64::from(step) * dt, dt).unwrap();
        }
        let seen = (energy(&solver) / start).ln() / f64::from(STEPS);
        let predicted = 2.0 * decay_of_an_oscillator(scheme, omega_dt).ln();
        println!(
            "{scheme:?}, omega dt {omega_dt}: ln of the energy {seen:.4e} a step, predicted {predicted:.4e}"
        );
        assert!(predicted < -1e-6 && (seen / predicted - 1.0).abs() < 0.01, "{scheme:?}: {seen} {predicted}");
    }
}

#[test]
fn a_linear_vibration_keeps_its_energy_over_ten_thousand_steps_at_radius_one_and_average_acceleration() {
    for scheme in [generalized_alpha(1.0), TimeScheme::AVERAGE_ACCELERATION] {
        let (mut solver, dt) = in_first_mode(scheme, 0.3);
        let start = energy(&solver);
        let mut drift = 0.0_f64;
        for step in 1..=STEPS {
            solver.step_alone(f64::from(step) * dt, dt).unwrap();
            drift = drift.max((energy(&solver) / start - 1.0).abs());
        }
        println!("{scheme:?}: energy within {drift:.1e} of the start");
        assert!(drift < 1e-8, "{scheme:?}: {drift:e}");
    }
}

/// What became of a flexible cantilever that was thrown into a swing of nearly half its length.
struct Swing {
    /// Steps until Newton failed, or all.
    steps: u32,
    /// Lowest and highest energy over that at the start.
    energy: [f64; 2],
    /// Energy at the end over that at the start.
    last: f64,
}

fn swing(scheme: TimeScheme, material: Material, dt: f64) -> Swing {
    let model = StructureModel { clamped: [Side::LEFT].into(), ..bare(material) };
    let mut settings = stepped_by(scheme);
    settings.newton.bound = Bound::Absolute(1e-9);
    let patch = beam(1.0, 0.1, 2, 3);
    let throw: Vec<f64> = patch.control_points().iter().flat_map(|&[x, _]| [0.0, -3.0 * x * x]).collect();
    let mut solver = solver(patch, model, settings);
    let mut state = solver.state().clone();
    for &dof in &solver.parts()[0].dofs {
        state.velocity[dof] = throw[dof];
    }
    solver.restore(&state).unwrap();
    solver.start_from_equilibrium(0.0).unwrap();
    let start = energy(&solver);
    let mut swing = Swing { steps: 0, energy: [1.0; 2], last: 1.0 };
    let mut farthest = 0.0_f64;
    while swing.steps < STEPS && solver.step_alone(f64::from(swing.steps + 1) * dt, dt).is_ok() {
        swing.steps += 1;
        swing.last = energy(&solver) / start;
        swing.energy = [swing.energy[0].min(swing.last), swing.energy[1].max(swing.last)];
        farthest = farthest.max(largest(&solver.displacement_at(&[1.0, 0.5])));
    }
    let (law, Swing { steps, energy, last }) = (material.law(), &swing);
    println!("{scheme:?}, {law:?}, dt {dt}: {steps} steps, energy {energy:.5?}, at last {last:.5}");
    assert!(farthest > 0.4, "a large swing: {farthest}");
    swing
}

#[test]
fn the_energy_of_a_nonlinear_swing_stays_bounded_over_ten_thousand_steps() {
    // 108 steps a period of the first mode. The energy wavers with the swing, but does not drift away.
    for material in [svk(3e3, 0.3), neo_hookean(3e3, 0.3)] {
        for scheme in [generalized_alpha(1.0), TimeScheme::AVERAGE_ACCELERATION] {
            let swing = swing(scheme, material, 0.01);
            assert_eq!(swing.steps, STEPS);
            let [low, high] = swing.energy;
            assert!(low > 0.995 && high < 1.005, "{scheme:?}, {:?}: {low} to {high}", material.law());
        }
    }
}

#[test]
fn at_twice_that_step_the_energy_grows_until_newton_fails_unless_the_radius_is_below_one() {
    // Conservation at radius 1 is a property of linear systems: in nonlinear ones the fast modes, which the step does
    // not resolve, can be fed. Numerical dissipation is the remedy.
    let kept = swing(generalized_alpha(1.0), svk(3e3, 0.3), 0.02);
    assert!(kept.steps < STEPS && kept.energy[1] > 2.0, "{} steps, {:?}", kept.steps, kept.energy);
    let damped = swing(generalized_alpha(0.8), svk(3e3, 0.3), 0.02);
    assert_eq!(damped.steps, STEPS);
    assert!(damped.energy[1] < 1.01 && damped.last < 1.0, "{:?}, {}", damped.energy, damped.last);
}
