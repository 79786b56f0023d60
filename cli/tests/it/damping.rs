//! The default spectral radius keeps the force on a flap from oscillating from step to step (docs/damping.md).

use std::path::Path;

use partita::build;
use partita::scene;

/// The flap of the study, shorter and solved less tightly.
const FLAP: [&str; 9] = [
    "fluid.density=10",
    "fluid.viscosity=2",
    "fluid.boundary.inflow={velocity=[\"2.5*y*(4 - y)*t\", 0]}",
    "fluid.time_scheme=bdf2",
    "fluid.tangent=full",
    "fluid.newton={tolerance={relative=1e-8}}",
    "structure.newton={tolerance={relative=1e-8}}",
    "coupling.acceleration=iqn_ils",
    "time.step=0.01",
];

/// Mean absolute second difference [N/m] of the force on the flap.
fn second_difference(time_scheme: &str) -> f64 {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../scenes/beam-in-channel");
    let overrides: Vec<String> = FLAP.iter().chain([&time_scheme]).map(|&given| given.to_owned()).collect();
    let flap = scene::load(&folder, &overrides).expect("the flap is sound");
    let mut run = build::march(&flap).expect("the flap builds");
    let mut forces = Vec::new();
    for _ in 0..40 {
        run.step(flap.scene.time.step.get(), &mut ()).expect("the step converges");
        let load = run.interface().load.as_chunks::<2>().0;
        forces.push([0, 1].map(|c| load.iter().map(|force| force[c]).sum::<f64>()));
    }
    let differences = forces.windows(3).map(|f| {
        let [x, y] = [0, 1].map(|c| f[2][c] - 2.0 * f[1][c] + f[0][c]);
        x.hypot(y)
    });
    differences.sum::<f64>() / (forces.len() - 2) as f64
}

#[test]
fn the_default_leaves_at_most_a_fifth_of_the_oscillation_at_radius_one() {
    let undamped = second_difference("structure.time_scheme={generalized_alpha={spectral_radius=1}}");
    let default = second_difference("structure.time_scheme=generalized_alpha");
    assert!(default > 0.0 && default <= undamped / 5.0, "{default} and {undamped} N/m");
}
