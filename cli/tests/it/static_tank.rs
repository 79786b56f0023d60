//! The weight of the tank on its bottom, against plate theory.

use partita::build;

use crate::linear_tank::tank;

/// A bottom of h/L = 0.01 that sags by W/h = 0.01: thin enough that shear adds 0.14 %, stiff enough that membrane action
/// takes 0.008 %.
///
/// ```text
/// w = rho g H L^4 / (384 D),   D = E h^3 / (12 (1 - nu^2))
/// ```
#[test]
fn bottom_sags_under_the_weight_as_plate_theory_says() {
    let resolved = tank(&[
        "fluid.time_scheme=steady",
        "fluid.body_force=[0.0,-9.81]",
        "structure.time_scheme=quasi_static",
        "structure.geometry.rectangle.origin=[0.0,-0.01]",
        "structure.geometry.rectangle.size=[1.0,0.01]",
        "structure.geometry.rectangle.elements=[40,1]",
        "structure.material={saint_venant_kirchhoff={young_modulus=2.8e12,poisson_ratio=0.3}}",
        // Round-off of the thin bottom's stiffness leaves 3e-10.
        "structure.newton.tolerance={relative=1e-8}",
        "coupling.acceleration={constant={relaxation=1.0}}",
        "coupling.convergence={changes=1e-8}",
    ]);
    let mut run = build::march(&resolved).expect("the scene builds");
    assert!(run.step(1.0, &mut ()).expect("a step").converged);
    let bottom = run.second().field().expect("the tank has a bottom");
    let stiffness = 2.8e12 * 0.01_f64.powi(3) / (12.0 * (1.0 - 0.3 * 0.3));
    let theory = 1000.0 * 9.81 / (384.0 * stiffness);
    let sag = -bottom.displacement_at(&[0.5, 1.0])[1];
    println!("sag {sag:.6e} m, plate theory {theory:.6e} m: off by {:.2e}", sag / theory - 1.0);
    assert!((sag / theory - 1.0).abs() < 0.01, "sag {sag:e} m, theory {theory:e} m");
}
