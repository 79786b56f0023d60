//! A square tank with slip walls on a thin elastic bottom: the case with answers on paper.

use partita::scene::{self, Resolved};

/// One metre of nearly inviscid water, 20 squares a side, on a bottom of 50 kg/m2.
const TANK: &str = r#"
title = "Linear tank"

[time]
step = 0.01
steps = 10

[fluid]
density = 1000.0
viscosity = 1e-3
body_force = [0.0, -1e-3]

[fluid.mesh.rectangle]
size = [1.0, 1.0]
divisions = [20, 20]

[fluid.boundary]
left = "slip"
right = "slip"
top = "stress_free"
bottom = "interface"

[structure]
density = 2500.0
clamped = ["left", "right"]
wetted = ["top"]

[structure.geometry.rectangle]
origin = [0.0, -0.02]
size = [1.0, 0.02]
elements = [20, 1]
degree = [3, 2]

[structure.material.linear_elastic]
young_modulus = 5e7
poisson_ratio = 0.3

[structure.time_scheme.generalized_alpha]
spectral_radius = 1.0

[coupling]
max_iterations = 30
on_limit = "accept"
convergence = { interface_residual = { relative = 1e-12 } }
acceleration = { constant = { relaxation = 0.1 } }

[output]
fields_every = 0
"#;

/// The tank with these values changed.
pub(crate) fn tank(overrides: &[&str]) -> Resolved {
    let overrides: Vec<String> = overrides.iter().map(|&given| given.to_owned()).collect();
    scene::read_in("".as_ref(), "tank", TANK, &overrides).expect("a sound scene")
}
