//! The iteration matrix of the scheme, measured on the models and known in closed form.

use std::f64::consts::PI;

use partita_coupling::models::tank::{BdfOrder, Tank};
use partita_coupling::models::tube::Tube;
use partita_coupling::{
    Acceleration, AtLimit, Bound, CouplingSettings, Criterion, Participant, Predictor, StepHistory,
};

use crate::support::{settings, tank, tube};

/// A step of `iterations` iterations with constant relaxation, accepted as it is.
fn open_ended(omega: f64, iterations: usize) -> CouplingSettings {
    CouplingSettings {
        criterion: Criterion::InterfaceResidual(Bound::Absolute(1e-300)),
        predictor: Predictor::Constant,
        max_iterations: iterations,
        at_limit: AtLimit::Accept,
        ..settings(Acceleration::Constant { omega })
    }
}

/// `|r^{k+1}| / |r^k|` of the last two iterations.
fn rate(history: &StepHistory) -> f64 {
    let residuals: Vec<f64> = history.iterations.iter().map(|record| record.residual).collect();
    residuals[residuals.len() - 1] / residuals[residuals.len() - 2]
}

fn cosine_mode(points: usize, wave_number: f64, amplitude: f64) -> Vec<f64> {
    (0..points).map(|i| amplitude * (wave_number * (i as f64 + 0.5) / points as f64).cos()).collect()
}

fn rough(points: usize, amplitude: f64) -> Vec<f64> {
    (0..points).map(|i| amplitude * ((i * i) as f64 * 0.7 + 1.0).sin()).collect()
}

fn still_tank(bdf: BdfOrder, spectral_radius: f64) -> Tank {
    Tank { gravity: 0.0, ballast: 0.0, bdf, spectral_radius, residual_bound: 1e-13, ..Tank::default() }
}

fn still_tube() -> Tube {
    Tube { inflow_peak: 0.0, residual_bound: 1e-12, ..Tube::default() }
}

#[test]
fn rate_of_each_tank_mode_is_its_eigenvalue() {
    let (points, dt, omega) = (12, 0.01, 0.3);
    for spectral_radius in [0.0, 0.5, 1.0] {
        let tank_at_rest = still_tank(BdfOrder::One, spectral_radius);
        let lambda = tank_at_rest.eigenvalues(dt, true, points).unwrap();
        for mode in 0..6 {
            let start = cosine_mode(points, mode as f64 * PI, 1e-6);
            let mut march = tank(&tank_at_rest, points, &open_ended(omega, 4)).starting_from(&start);
            march.step(dt, &mut ()).unwrap();
            let expected = (1.0 - omega * (1.0 - lambda[mode])).abs();
            let measured = rate(march.history());
            assert!(
                (measured - expected).abs() < 1e-8 * expected.max(1.0),
                "mode {mode}: {measured} {expected}"
            );
        }
    }
}

#[test]
fn second_order_derivatives_raise_the_eigenvalue_after_the_first_step() {
    let (points, dt, omega) = (4, 0.01, 0.2);
    let lively = Tank { gravity: 9.81, ..still_tank(BdfOrder::Two, 0.5) };
    for steps in [1, 2] {
        let mut march = tank(&lively, points, &open_ended(omega, 3));
        for _ in 0..steps {
            march.step(dt, &mut ()).unwrap();
        }
        // Gravity moves mode 0 only.
        let lambda = lively.eigenvalues(dt, steps == 1, 1).unwrap()[0];
        let expected = (1.0 - omega * (1.0 - lambda)).abs();
        assert!((rate(march.history()) - expected).abs() < 1e-8, "step {steps}");
    }
}

#[test]
fn rate_of_each_mode_of_the_linearized_tube_is_its_eigenvalue() {
    let (dt, omega) = (1e-3, 0.02);
    let still = still_tube();
    let lambda = still.eigenvalues(dt).unwrap();
    for mode in 0..5 {
        let start = cosine_mode(still.cells, (mode as f64 + 0.5) * PI, 1e-9);
        let mut march = tube(&still, &open_ended(omega, 3)).starting_from(&start);
        march.step(dt, &mut ()).unwrap();
        let expected = (1.0 - omega * (1.0 - lambda[mode])).abs();
        let measured = rate(march.history());
        assert!((measured - expected).abs() < 1e-5, "mode {mode}: {measured} {expected}");
    }
}

/// Whether the residual shrinks over a step of 80 iterations from a rough start.
fn converges<A: Participant, B: Participant>(mut march: partita_coupling::March<A, B>, dt: f64) -> bool {
    march.step(dt, &mut ()).is_ok()
        && march.history().last().unwrap().residual < 0.1 * march.history().iterations[0].residual
}

#[test]
fn relaxation_converges_up_to_two_over_one_minus_the_smallest_eigenvalue() {
    let still = still_tube();
    let limit = 2.0 / (1.0 - still.eigenvalues(1e-3).unwrap()[0]);
    let run = |factor: f64| {
        let start = rough(still.cells, 1e-9);
        converges(tube(&still, &open_ended(factor * limit, 80)).starting_from(&start), 1e-3)
    };
    assert!(run(0.95) && !run(1.05), "tube: the limit is not {limit}");

    let still = still_tank(BdfOrder::One, 0.5);
    let limit = 2.0 / (1.0 - still.eigenvalues(0.01, true, 1).unwrap()[0]);
    let run = |factor: f64| {
        let start = rough(10, 1e-6);
        converges(tank(&still, 10, &open_ended(factor * limit, 80)).starting_from(&start), 0.01)
    };
    assert!(run(0.95) && !run(1.05), "tank: the limit is not {limit}");
}

#[test]
fn smaller_steps_make_the_added_mass_effect_worse() {
    let soft = Tank { bedding: 1e7, ..Tank::default() };
    let smallest = |dt: f64| soft.eigenvalues(dt, true, 1).unwrap()[0];
    assert!(smallest(1e-3) < smallest(1e-2) && smallest(1e-2) < smallest(1e-1));
}
