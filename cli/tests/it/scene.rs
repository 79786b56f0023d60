//! Scene files: what is read, what is refused, and in which words.

mod broken;
mod mutilated;
mod overrides;
mod page;

use std::path::Path;

use partita::scene::{Resolved, SCENE_FILE, load, parse};

/// A small coupled scene that is sound; tests break it in one place.
pub(crate) const SOUND: &str = r#"title = "Sound"

[time]
step = 0.01
steps = 50

[fluid]
density = 1000.0
viscosity = 200.0
body_force = [0.0, -9.81]

[fluid.mesh.rectangle]
size = [1.0, 1.0]
divisions = [10, 10]

[fluid.boundary]
left = "no_slip"
right = "no_slip"
top = "stress_free"
bottom = "interface"

[structure]
density = 1000.0
clamped = ["left", "right"]
wetted = ["top"]

[structure.geometry.rectangle]
origin = [0.0, -0.05]
size = [1.0, 0.05]
elements = [60, 1]

[structure.material.saint_venant_kirchhoff]
young_modulus = 5e6
poisson_ratio = 0.3

[coupling.acceleration.iqn_imvls]
initial_relaxation = 0.1
"#;

fn shipped() -> Resolved {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../scenes/elastic-bottom");
    load(&folder, &[]).expect("the shipped scene is sound")
}

#[test]
fn the_shipped_scene_is_sound_and_named_after_its_folder() {
    let tank = shipped();
    assert_eq!(tank.name, "elastic-bottom");
    assert!(tank.file.ends_with(SCENE_FILE));
    assert!(tank.scene.fluid.is_some() && tank.scene.structure.is_some() && tank.scene.coupling.is_some());
}

#[test]
fn a_resolved_scene_reads_back_as_the_same_scene() {
    let tank = shipped();
    let text = tank.to_toml();
    assert_eq!(parse("resolved", &text, &[]).expect("a resolved scene is sound"), tank.scene);
    let sound = parse("sound", SOUND, &[]).expect("sound");
    assert_eq!(parse("resolved", &partita::scene::to_toml(&sound), &[]).expect("sound"), sound);
}

#[test]
fn a_resolved_scene_holds_every_default() {
    let scene = parse("sound", SOUND, &[]).expect("sound");
    insta::assert_snapshot!(partita::scene::to_toml(&scene), @r#"
    title = "Sound"

    [time]
    step = 0.01
    steps = 50

    [fluid]
    density = 1000.0
    viscosity = 200.0
    body_force = [0.0, -9.81]
    time_scheme = "bdf1"
    convection = true
    tangent = "full"
    inverse_constant = 36.0
    grad_div = 1.0
    initial = "rest"

    [fluid.mesh.rectangle]
    origin = [0.0, 0.0]
    size = [1.0, 1.0]
    divisions = [10, 10]
    diagonals = "crossed"

    [fluid.boundary]
    bottom = "interface"
    left = "no_slip"
    right = "no_slip"
    top = { stress_free = { backflow_stabilization = false } }

    [fluid.newton]
    tolerance = { relative = 1e-10 }
    check = "before"
    max_iterations = 50

    [fluid.mesh_motion]
    mode = "reference"
    slide = []

    [fluid.mesh_motion.law.elastic]
    poisson_ratio = 0.3
    stiffening = 1.0

    [structure]
    density = 1000.0
    body_force = [0.0, 0.0]
    clamped = ["left", "right"]
    wetted = ["top"]
    time_scheme = { generalized_alpha = { spectral_radius = 0.5 } }

    [structure.geometry.rectangle]
    origin = [0.0, -0.05]
    size = [1.0, 0.05]
    elements = [60, 1]
    degree = [2, 2]

    [structure.material.saint_venant_kirchhoff]
    young_modulus = 5000000.0
    poisson_ratio = 0.3
    plane = "strain"

    [structure.newton]
    tolerance = { relative = 1e-10 }
    check = "before"
    max_iterations = 50

    [coupling]
    direction = "two_way"
    max_iterations = 100
    on_limit = "fail"
    projection_tolerance = 1e-6
    transfer = "automatic"
    predictor = "constant"
    convergence = { changes = 1e-5 }

    [coupling.acceleration.iqn_imvls]
    initial_relaxation = 0.1
    unseen_relaxation = 1.0
    history_steps = 5
    relax_first_iteration = false
    keep_last_differences = true
    filter = { qr3 = 0.01 }

    [coupling.newton.fixed]
    fluid = "unlimited"
    structure = "unlimited"

    [output]
    fields_every = 1
    checkpoint_every = 10
    spline_subdivisions = 2
    "#);
}
