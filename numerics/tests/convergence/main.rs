//! Orders of the time-integration schemes on equations with a known solution.

use partita_numerics::rates::fitted_order;
use partita_numerics::time::{Bdf, BdfOrder, GeneralizedAlpha};

const STEPS: [u32; 4] = [40, 80, 160, 320];

/// The order of an error that depends on the number of steps.
fn order_of(error: impl Fn(u32) -> f64) -> f64 {
    let h: Vec<f64> = STEPS.iter().map(|&steps| 1.0 / f64::from(steps)).collect();
    let errors: Vec<f64> = STEPS.iter().map(|&steps| error(steps)).collect();
    fitted_order(&h, &errors)
}

/// Solves u' = -u, u(0) = 1 until about t = 1 on steps of alternating length; the error at the end.
fn decay_error(order: BdfOrder, steps: u32, ratio: f64) -> f64 {
    let short = 2.0 / (1.0 + ratio) / f64::from(steps);
    let (mut t, mut u, mut u_previous, mut dt_previous) = (0.0_f64, 1.0, 1.0, None);
    for step in 0..steps {
        let dt = if step % 2 == 0 { short } else { short * ratio };
        let bdf = Bdf::of_order(order, dt, dt_previous);
        let u_new = -(bdf.c[1] * u + bdf.c[2] * u_previous) / (bdf.c[0] + 1.0);
        (u_previous, u, t, dt_previous) = (u, u_new, t + dt, Some(dt));
    }
    (u - (-t).exp()).abs()
}

#[test]
fn bdf_reaches_its_order_on_equal_and_unequal_steps() {
    for ratio in [1.0, 2.0] {
        let first = order_of(|steps| decay_error(BdfOrder::One, steps, ratio));
        let second = order_of(|steps| decay_error(BdfOrder::Two, steps, ratio));
        assert!((0.95..1.05).contains(&first), "ratio {ratio}: {first}");
        assert!((1.9..2.1).contains(&second), "ratio {ratio}: {second}");
    }
}

/// Solves d'' = -d + sin(2 t) from d = 1, d' = -2/3 until t = 1; the errors of d and d' at the end.
fn oscillator_errors(radius: f64, steps: u32) -> [f64; 2] {
    let GeneralizedAlpha { alpha_m, alpha_f, gamma, beta } =
        GeneralizedAlpha::from_spectral_radius(radius).unwrap();
    let dt = 1.0 / f64::from(steps);
    let load = |t: f64| (2.0 * t).sin();
    let (mut d, mut v, mut a) = (1.0, -2.0 / 3.0, -1.0);
    for step in 0..steps {
        let t = f64::from(step) * dt;
        let averaged_load = (1.0 - alpha_f) * load(t + dt) + alpha_f * load(t);
        let d_predicted = d + dt * v + dt * dt * (0.5 - beta) * a;
        let v_predicted = v + dt * (1.0 - gamma) * a;
        let known = averaged_load - alpha_m * a - (1.0 - alpha_f) * d_predicted - alpha_f * d;
        a = known / (1.0 - alpha_m + (1.0 - alpha_f) * beta * dt * dt);
        d = d_predicted + dt * dt * beta * a;
        v = v_predicted + dt * gamma * a;
    }
    // d = cos t - sin(2 t) / 3.
    let t = 1.0_f64;
    let d_exact = t.cos() - (2.0 * t).sin() / 3.0;
    let v_exact = -t.sin() - 2.0 / 3.0 * (2.0 * t).cos();
    [(d - d_exact).abs(), (v - v_exact).abs()]
}

#[test]
fn generalized_alpha_is_of_second_order_for_every_radius() {
    for radius in [0.0, 0.5, 0.8, 1.0] {
        for component in 0..2 {
            let order = order_of(|steps| oscillator_errors(radius, steps)[component]);
            assert!((1.9..2.1).contains(&order), "radius {radius}, component {component}: {order}");
        }
    }
}
