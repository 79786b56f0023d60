//! Generalized-alpha and Newmark with gamma = 1/2 are of second order: linear vibrations against their exact solution, and a nonlinear one under a
//! load that rises smoothly.
//!
//! Steps of changing size: `a_n` is the acceleration of `t_n + (alpha_m - alpha_f) dt`, so that a step of another size
//! takes it for one of another time. A change costs an error of second order, once; changes at every step add up to one
//! of first order, except at radius 1 and in Newmark's method, where both alphas are equal.
use partita_numerics::Field;

use partita_iga::Side;
use partita_numerics::rates::fitted_order;
use partita_structure::{BodyForce, Rayleigh, StructureModel, StructureSettings, TimeScheme};

use crate::common::{RADII, bare, beam, generalized_alpha, largest, linear, modes, solver, stepped_by, svk};

/// How steps follow each other.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Sizes {
    /// All equal.
    Equal,
    /// In the second half of the run half as long as in the first.
    HalvedOnce,
    /// In the ratio 2 to 1 in turn.
    Alternating,
}

impl Sizes {
    /// The sizes of some `steps` steps that add up to `end`; `steps` is a multiple of 3 and 2.
    fn steps(self, end: f64, steps: usize) -> Vec<f64> {
        let mean = end / steps as f64;
        match self {
            Self::Equal => vec![mean; steps],
            Self::HalvedOnce => [vec![1.5 * mean; steps / 3], vec![0.75 * mean; 2 * steps / 3]].concat(),
            Self::Alternating => [4.0 / 3.0 * mean, 2.0 / 3.0 * mean].repeat(steps / 2),
        }
    }
}

/// One of the modes in a free vibration from rest: with Rayleigh damping C = a M + b K it is an oscillator
/// q'' + (a + b omega^2) q' + omega^2 q = 0.
struct Oscillator {
    omega: f64,
    decay: f64,
}

impl Oscillator {
    /// q and q' at time t for q = 1, q' = 0 at the start.
    fn at(&self, t: f64) -> [f64; 2] {
        let damped = (self.omega.powi(2) - self.decay.powi(2)).sqrt();
        let (sin, cos) = (damped * t).sin_cos();
        let envelope = (-self.decay * t).exp();
        [envelope * (cos + self.decay / damped * sin), -envelope * self.omega.powi(2) / damped * sin]
    }
}

/// Largest errors over time in displacement and velocity, over their amplitudes, of a vibration in the two lowest modes.
fn vibration_errors(scheme: TimeScheme, steps: usize, sizes: Sizes, rayleigh: Rayleigh) -> [f64; 2] {
    let model = StructureModel { clamped: [Side::LEFT].into(), ..bare(linear(100.0, 0.3)) };
    let patch = beam(1.0, 0.2, 2, 4);
    let (frequencies, shapes) = modes(&patch, &model);
    let settings = StructureSettings { rayleigh: Some(rayleigh), ..stepped_by(scheme) };
    let mut solver = solver(patch, model, settings);
    let free = solver.parts()[0].dofs.clone();
    // Shape of unit size times amplitude; the second mode is fast and small.
    let amplitude = |mode: usize| [1.0, 0.1][mode] / largest(&shapes[mode]);
    let exact = |t: f64| {
        let mut exact = [vec![0.0; free.len()], vec![0.0; free.len()]];
        for mode in 0..2 {
            let omega = frequencies[mode];
            let decay = 0.5 * (rayleigh.mass + rayleigh.stiffness * omega * omega);
            let now = Oscillator { omega, decay }.at(t);
            for (field, q) in exact.iter_mut().zip(now) {
                field.iter_mut().zip(&shapes[mode]).for_each(|(x, shape)| *x += amplitude(mode) * q * shape);
            }
        }
        exact
    };

    let mut state = solver.state().clone();
    let [start, _] = exact(0.0);
    free.iter().zip(&start).for_each(|(&dof, d)| state.displacement[dof] = *d);
    solver.restore(&state).unwrap();
    solver.start_from_equilibrium(0.0).unwrap();
    let mut errors = [0.0_f64; 2];
    for dt in sizes.steps(2.0 / frequencies[0], steps) {
        let time = solver.state().time + dt;
        solver.step_alone(time, dt).unwrap();
        let found = [&solver.state().displacement, &solver.state().velocity];
        for (part, exact) in exact(time).iter().enumerate() {
            for (&dof, exact) in free.iter().zip(exact) {
                let scale = [1.0, frequencies[0]][part];
                errors[part] = errors[part].max((found[part][dof] - exact).abs() / scale);
            }
        }
    }
    errors
}

/// Orders of displacement and velocity in a linear vibration.
fn vibration_orders(scheme: TimeScheme, sizes: Sizes, rayleigh: Rayleigh) -> [f64; 2] {
    let steps = [120, 240, 480];
    let errors = steps.map(|steps| vibration_errors(scheme, steps, sizes, rayleigh));
    println!("{scheme:?}, {sizes:?}, {rayleigh:?}: {errors:?}");
    assert!(errors[2][0] < 1e-2 && errors[2][1] < 1e-2);
    [0, 1].map(|part| fitted_order(&steps.map(|steps| 1.0 / steps as f64), &errors.map(|error| error[part])))
}

const UNDAMPED: Rayleigh = Rayleigh { mass: 0.0, stiffness: 0.0 };
const DAMPED: Rayleigh = Rayleigh { mass: 0.3, stiffness: 0.01 };

fn second_order_schemes() -> [TimeScheme; 4] {
    let [a, b, c] = RADII.map(generalized_alpha);
    [a, b, c, TimeScheme::AVERAGE_ACCELERATION]
}

#[test]
fn linear_vibrations_converge_with_second_order_damped_or_not() {
    for scheme in second_order_schemes() {
        for (sizes, rayleigh) in
            [(Sizes::Equal, UNDAMPED), (Sizes::Equal, DAMPED), (Sizes::HalvedOnce, DAMPED)]
        {
            let orders = vibration_orders(scheme, sizes, rayleigh);
            println!("orders {orders:.3?}");
            assert!(orders.into_iter().all(|order| (order - 2.0).abs() < 0.1), "{orders:?}");
        }
    }
}

#[test]
fn only_radius_one_and_newmark_keep_second_order_if_the_size_changes_at_every_step() {
    for scheme in [generalized_alpha(1.0), TimeScheme::AVERAGE_ACCELERATION] {
        let [displacement, velocity] = vibration_orders(scheme, Sizes::Alternating, UNDAMPED);
        assert!((displacement - 2.0).abs() < 0.1 && (velocity - 2.0).abs() < 0.1);
    }
    let [displacement, _] = vibration_orders(generalized_alpha(0.5), Sizes::Alternating, UNDAMPED);
    assert!(displacement > 1.0 && displacement < 1.7, "{displacement}");
}

#[test]
fn newmark_with_gamma_above_one_half_is_of_first_order() {
    let scheme = TimeScheme::Newmark { beta: 0.3025, gamma: 0.6 };
    for order in vibration_orders(scheme, Sizes::Equal, UNDAMPED) {
        assert!((order - 1.0).abs() < 0.1, "order {order}");
    }
}

/// A flexible cantilever under a load that rises from zero with zero slope, swinging far.
fn swing(scheme: TimeScheme, steps: usize) -> [f64; 2] {
    let model = StructureModel {
        clamped: [Side::LEFT].into(),
        body_force: BodyForce::in_time(|t| [0.0, -9.0 * (1.0 - (1.5 * t).cos())]),
        ..bare(svk(3e3, 0.3))
    };
    let mut solver = solver(beam(1.0, 0.1, 2, 6), model, stepped_by(scheme));
    for dt in Sizes::Equal.steps(1.0, steps) {
        solver.step_alone(solver.state().time + dt, dt).unwrap();
    }
    let tip = solver.displacement_at(&[1.0, 0.5]);
    assert!(tip[1] < -0.3, "a large deflection: {tip:?}");
    tip
}

#[test]
fn a_nonlinear_swing_converges_with_second_order_from_rest_without_an_initial_acceleration() {
    let steps = [160, 320, 640];
    let reference = swing(generalized_alpha(0.8), 5120);
    for scheme in second_order_schemes() {
        let errors = steps.map(|steps| {
            let tip = swing(scheme, steps);
            (tip[0] - reference[0]).hypot(tip[1] - reference[1])
        });
        let order = fitted_order(&steps.map(|steps| 1.0 / steps as f64), &errors);
        println!("swing, {scheme:?}: order {order:.3}, errors {errors:?}");
        assert!((order - 2.0).abs() < 0.15, "{scheme:?}: order {order}");
    }
}
