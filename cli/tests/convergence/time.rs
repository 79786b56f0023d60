//! The coupled problem in time, against itself with half the step.
use partita_numerics::Field;

use partita::build;
use partita::scene;
use partita_numerics::rates::fitted_order;

/// A tank on an elastic bottom whose weight rises like t^3 from zero to its full size at 0.2 s, so that neither the load
/// nor its first two rates jump at the start.
///
/// The fluid is thick: `tau_M` holds 2/dt beside its viscous part, and what it does to a flow that is not linear in space
/// changes with the step, the more the smaller the step is. Here that stays below the errors of the time schemes. With a
/// tenth of the viscosity it outgrows them at steps of 1 ms, and the changes rise again.
const TANK: &str = r#"
title = "Tank whose weight rises smoothly"

[time]
step = 0.02
steps = 1

[fluid]
density = 1000.0
viscosity = 1e5
body_force = ["0", "-9.81 * (t / 0.2)^3 * (10 - 15 * (t / 0.2) + 6 * (t / 0.2)^2)"]

[fluid.mesh.rectangle]
size = [1.0, 1.0]
divisions = [5, 5]

[fluid.boundary]
left = "slip"
right = "slip"
top = "stress_free"
bottom = "interface"

[structure]
density = 1000.0
clamped = ["left", "right"]
wetted = ["top"]

[structure.geometry.rectangle]
origin = [0.0, -0.05]
size = [1.0, 0.05]
elements = [8, 1]

[structure.material.saint_venant_kirchhoff]
young_modulus = 5e7
poisson_ratio = 0.3

[structure.time_scheme.generalized_alpha]
spectral_radius = 0.5

[structure.newton]
tolerance = { relative = 1e-9 }

[coupling]
convergence = { changes = 1e-8 }
predictor = "quadratic"
transfer = "interpolation"

[coupling.acceleration.iqn_imvls]
history_steps = 5

[output]
fields_every = 0
"#;

const END: f64 = 0.2;

/// What the run ends with.
struct State {
    displacement: Vec<f64>,
    velocity: Vec<f64>,
    pressure: Vec<f64>,
    force: Vec<f64>,
}

impl State {
    fn quantity(&self, name: &str) -> &[f64] {
        match name {
            "displacement" => &self.displacement,
            "velocity" => &self.velocity,
            "pressure" => &self.pressure,
            _ => &self.force,
        }
    }
}

fn run(steps: u32, overrides: &[&str]) -> State {
    run_in(&vec![END / f64::from(steps); steps as usize], overrides)
}

/// A run in steps of these sizes \[s\].
fn run_in(sizes: &[f64], overrides: &[&str]) -> State {
    let overrides: Vec<String> = overrides.iter().map(|&given| given.to_owned()).collect();
    let tank = scene::read_in("".as_ref(), "tank", TANK, &overrides).expect("a sound scene");
    let mut run = build::march(&tank).expect("the scene builds");
    for &dt in sizes {
        run.step(dt, &mut ()).expect("the step converges");
    }
    let fluid = run.first().field().expect("a fluid").values().chunks_exact(3);
    State {
        displacement: run.second().field().expect("a structure").values().to_vec(),
        velocity: fluid.clone().flat_map(|node| [node[0], node[1]]).collect(),
        pressure: fluid.map(|node| node[2]).collect(),
        force: run.interface().transferred_load.clone(),
    }
}

/// `|a - b| / |b|`.
fn distance(a: &[f64], b: &[f64]) -> f64 {
    let squares = |pairs: &mut dyn Iterator<Item = f64>| pairs.map(|x| x * x).sum::<f64>();
    (squares(&mut a.iter().zip(b).map(|(a, b)| a - b)) / squares(&mut b.iter().copied())).sqrt()
}

/// Fitted order of what halving the step changes, and the change from the second smallest step to the smallest:
/// of displacement, velocity, pressure and interface force.
fn study(overrides: &[&str]) -> [(&'static str, f64, f64); 4] {
    let steps = [20_u32, 40, 80, 160];
    let runs = steps.map(|n| run(n, overrides));
    let dt: Vec<f64> = steps[1..].iter().map(|n| END / f64::from(*n)).collect();
    ["displacement", "velocity", "pressure", "force"].map(|name| {
        let changes: Vec<f64> =
            runs.windows(2).map(|pair| distance(pair[0].quantity(name), pair[1].quantity(name))).collect();
        let order = fitted_order(&dt, &changes);
        println!("{name}: order {order:.2}, changes {changes:?}");
        (name, order, changes[changes.len() - 1])
    })
}

/// What halving the step changes has the order of the scheme, and at the smallest step it is below these bounds.
fn check(time_scheme: &str, expected: f64, bounds: [f64; 4]) {
    let found = study(&[&format!("fluid.time_scheme={time_scheme}")]);
    for ((name, order, change), bound) in found.into_iter().zip(bounds) {
        assert!((order - expected).abs() < 0.1, "{name}: order {order:.2}");
        assert!(change < bound, "{name}: {change:.3e}");
    }
}

/// The fluid's scheme of first order sets the order of all.
#[test]
fn backward_euler_beside_generalized_alpha_couples_to_first_order() {
    check("bdf1", 1.0, [5.4e-3, 9.0e-4, 4.0e-4, 2.0e-3]);
}

/// Order two survives the coupling: loads are averaged like the structure's own forces, and the first step, of order one,
/// meets a load that is still of third order in the step.
#[test]
fn second_order_schemes_couple_to_second_order() {
    check("bdf2", 2.0, [7.8e-5, 1.14e-4, 5.4e-5, 1.6e-4]);
}

/// Two steps in the middle, made as after a step that failed and whose second half failed again, change the end by no
/// more than the scheme's own error does: by the second power of the step. Coefficients of equal steps would leave the
/// first.
#[test]
fn retried_steps_keep_second_order() {
    let steps = [20_u32, 40, 80];
    let dt = steps.map(|n| END / f64::from(n));
    let scheme = ["fluid.time_scheme=bdf2"];
    let pairs = steps.map(|n| {
        let mut sizes = vec![END / f64::from(n); n as usize];
        let middle = n as usize / 2;
        let parts = [0.5, 0.25, 0.25, 0.5, 0.5].map(|part| part * sizes[0]);
        sizes.splice(middle..middle + 2, parts);
        (run_in(&sizes, &scheme), run(n, &scheme))
    });
    for name in ["displacement", "velocity", "pressure", "force"] {
        let changes = pairs.each_ref().map(|(a, b)| distance(a.quantity(name), b.quantity(name)));
        let order = fitted_order(&dt, &changes);
        println!("{name}: order {order:.2}, changes {changes:?}");
        assert!(order > 1.9, "{name}: order {order:.2}");
    }
}
