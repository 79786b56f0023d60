//! A vortex that decays by viscosity alone, in a box whose walls slip.
use partita_numerics::Field;

use std::f64::consts::PI;
use std::sync::Arc;

use partita_fluid::{
    BodyForce, BoundaryCondition, FluidModel, FluidSettings, FluidSolver, InitialState, PressurePin,
    TimeScheme,
};
use partita_numerics::newton::Limit;
use partita_numerics::time::BdfOrder;

use crate::common::*;

const VISCOSITY: f64 = 0.02;
const END: f64 = 0.5;

/// ```text
/// u = (sin pi x cos pi y, -cos pi x sin pi y) e^(-2 pi^2 nu t)
/// p = rho/4 (cos 2 pi x + cos 2 pi y) e^(-4 pi^2 nu t)
/// ```
///
/// Its normal velocity and its shear vanish on the sides of the unit square.
///
/// Source: G. I. Taylor, A. E. Green, *Mechanism of the production of small eddies from large ones*, Proc. R. Soc. A 158
/// (1937), in the plane.
fn exact(x: &[f64; 2], t: f64) -> Exact {
    let [(sx, cx), (sy, cy)] = x.map(|x| (PI * x).sin_cos());
    let decay = (-2.0 * PI * PI * VISCOSITY * t).exp();
    let slope = PI * decay;
    Exact {
        velocity: [decay * sx * cy, -decay * cx * sy],
        gradient: [[slope * cx * cy, -slope * sx * sy], [slope * sx * sy, -slope * cx * cy]],
        pressure: 0.25 * decay * decay * ((2.0 * PI * x[0]).cos() + (2.0 * PI * x[1]).cos()),
    }
}

struct Outcome {
    errors: Errors,
    /// -d ln E / dt over the whole run, against 4 pi^2 nu: the relative error.
    decay: f64,
}

fn run(divisions: usize, order: BdfOrder, steps: usize) -> Outcome {
    let mesh = unit_square(divisions);
    let model = FluidModel {
        density: 1.0,
        viscosity: VISCOSITY,
        body_force: BodyForce::Constant([0.0; 2]),
        boundary: everywhere(&mesh, &BoundaryCondition::Slip),
        initial: InitialState::Velocity(Arc::new(|x, _| exact(x, 0.0).velocity)),
    };
    let settings = FluidSettings {
        time: TimeScheme::Bdf(order),
        pressure_pin: Some(PressurePin { node: 0, pressure: 0.5 }),
        ..FluidSettings::default()
    };
    let mut fluid = FluidSolver::new(mesh, model, settings).expect("a fluid");
    let start = fluid.kinetic_energy();
    let dt = END / steps as f64;
    for k in 1..=steps {
        fluid.begin_step(k as f64 * dt, dt).expect("a step");
        fluid.advance(Limit::ToConvergence).expect("convergence");
        fluid.commit();
    }
    let rate = (start / fluid.kinetic_energy()).ln() / END;
    Outcome {
        errors: errors(&fluid, |x| exact(x, END)),
        decay: (rate / (4.0 * PI * PI * VISCOSITY) - 1.0).abs(),
    }
}

/// Order two in space and time together: BDF1 with steps like h^2, BDF2 with steps like h.
fn study(order: BdfOrder, steps: [usize; 3], bounds: [f64; 4]) {
    let divisions = [8, 16, 32];
    let h = divisions.map(|n| 1.0 / n as f64);
    let outcomes: Vec<Outcome> =
        divisions.into_iter().zip(steps).map(|(n, steps)| run(n, order, steps)).collect();
    let pick = |of: fn(&Outcome) -> f64| outcomes.iter().map(of).collect::<Vec<f64>>();
    let norms = [
        ("velocity", pick(|o| o.errors.velocity), 2.0),
        ("gradient", pick(|o| o.errors.gradient), 1.0),
        ("pressure", pick(|o| o.errors.pressure), 2.0),
        ("rate of decay", pick(|o| o.decay), 2.0),
    ];
    for ((name, errors, expected), error) in norms.into_iter().zip(bounds) {
        let expected = Expected { order: expected, error };
        assert_converges(&format!("{order:?}, {name}"), &h, &errors, &expected, 0.1);
    }
}

#[test]
fn taylor_green_vortex_decays_as_it_should() {
    study(BdfOrder::Two, [8, 16, 32], [1.85e-3, 0.169, 8.7e-4, 3.6e-3]);
    study(BdfOrder::One, [4, 16, 64], [1.68e-3, 0.169, 7.6e-4, 1.84e-3]);
}
