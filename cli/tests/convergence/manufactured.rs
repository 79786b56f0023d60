//! The manufactured flow against its formulas, as its scene probes it.
use partita_numerics::Field;

use std::path::Path;

use partita::{build, scene};
use partita_numerics::rates::fitted_order;

/// Elements and steps refined together; the width of the elements, and the errors of velocity and pressure at t = 0.5 s.
const WIDTHS: [f64; 3] = [1.0 / 8.0, 1.0 / 16.0, 1.0 / 32.0];

fn velocity_errors(scheme: &str, steps: [usize; 3]) -> [f64; 3] {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../scenes/manufactured-flow");
    let error = |level: usize| {
        let divisions = 8 << level;
        let overrides = [
            format!("fluid.time_scheme={scheme}"),
            format!("fluid.mesh.rectangle.divisions=[{divisions}, {divisions}]"),
            format!("time.step={}", 0.5 / steps[level] as f64),
        ];
        let scene = scene::load(&folder, &overrides).expect("the shipped scene is sound");
        let mut run = build::march(&scene).expect("it is built");
        for _ in 0..steps[level] {
            run.step(scene.scene.time.step.get(), &mut ()).expect("it converges");
        }
        let fluid = run.first().field().expect("a fluid");
        // At the nodes within, by the formulas written out here: the probe has its own test.
        let g = (4.0 * run.clock().time).cos();
        let pi = std::f64::consts::PI;
        let within = |point: &[f64; 2]| point.iter().all(|x| (1e-9..1.0 - 1e-9).contains(x));
        let nodes = fluid.points().iter().zip(fluid.values().chunks_exact(3));
        let squares = nodes.filter(|(point, _)| within(point)).map(|([x, y], value)| {
            let exact = [-g * (pi * x).cos() * (pi * y).sin(), g * (pi * x).sin() * (pi * y).cos()];
            (value[0] - exact[0]).powi(2) + (value[1] - exact[1]).powi(2)
        });
        let squares: Vec<f64> = squares.collect();
        (squares.iter().sum::<f64>() / squares.len() as f64).sqrt()
    };
    [error(0), error(1), error(2)]
}

#[test]
fn bdf2_is_of_second_order_with_steps_like_the_elements() {
    // The first step is of first order and must be small for that not to show.
    let order = fitted_order(&WIDTHS, &velocity_errors("bdf2", [10, 20, 40]));
    assert!((1.6..2.4).contains(&order), "order {order}");
}

#[test]
fn bdf1_is_of_first_order_in_the_step() {
    // The square of the width is in proportion to the step.
    let order = fitted_order(&WIDTHS.map(|h| h * h), &velocity_errors("bdf1", [5, 20, 80]));
    assert!((0.8..1.2).contains(&order), "order {order}");
}
