//! Static deflections against beam and plate theory.

use partita_iga::Side;
use partita_numerics::rates::fitted_order;
use partita_structure::{BodyForce, Law, Material, Plane, StructureModel};

use crate::common::{bare, beam, quasi_static, settle, solver};

const YOUNG_MODULUS: f64 = 1e7;
const POISSON_RATIO: f64 = 0.3;

fn material(law: Law) -> Material {
    Material::new(law, YOUNG_MODULUS, POISSON_RATIO, Plane::Strain).unwrap()
}

/// Modulus in bending: a strip in plane strain cannot narrow.
fn bending_modulus(material: &Material) -> f64 {
    match material.plane() {
        Plane::Strain => material.young_modulus() / (1.0 - material.poisson_ratio().powi(2)),
        Plane::Stress => material.young_modulus(),
    }
}

/// Bending stiffness E' h^3/12.
fn bending_stiffness(material: &Material, height: f64) -> f64 {
    bending_modulus(material) * height.powi(3) / 12.0
}

/// Deflection at `xi` of a beam of length 1 under the load `q` [N/m] per length, downwards.
fn deflection(
    height: f64,
    degree: usize,
    elements: usize,
    material: Material,
    clamped: &[Side],
    (xi, q): (f64, f64),
) -> f64 {
    let model = StructureModel {
        clamped: clamped.to_vec().into(),
        body_force: BodyForce::Constant([0.0, -q / height]),
        ..bare(material)
    };
    let mut solver = solver(beam(1.0, height, degree, elements), model, quasi_static());
    settle(&mut solver);
    -solver.displacement_at(&[xi, 0.5])[1]
}

#[test]
fn a_clamped_strip_deflects_as_plate_theory_says() {
    // w = q L^4 / (384 D), D = E h^3 / (12 (1 - nu^2)), for w/h < 0.02 and h/L <= 0.01.
    for (height, law) in
        [(0.01, Law::StVenantKirchhoff), (0.005, Law::StVenantKirchhoff), (0.01, Law::LinearElastic)]
    {
        let material = material(law);
        let expected = 0.01 * height;
        let q = 384.0 * bending_stiffness(&material, height) * expected;
        let found = deflection(height, 2, 60, material, &[Side::LEFT, Side::RIGHT], (0.5, q));
        println!("strip h/L = {height}, {law:?}: deflection over plate theory {:.5}", found / expected);
        assert!((found / expected - 1.0).abs() < 0.01, "{}", found / expected);
    }
}

/// Deflection of a cantilever over Timoshenko's, q L^4/(8 E'I) + q L^2/(2 kappa G A) with kappa = 5/6.
fn over_timoshenko(height: f64, [degree, elements]: [usize; 2], poisson_ratio: f64, plane: Plane) -> f64 {
    let material = Material::new(Law::LinearElastic, YOUNG_MODULUS, poisson_ratio, plane).unwrap();
    let bending = bending_stiffness(&material, height);
    let shear = 5.0 / 6.0 * material.mu() * height;
    let q = 1e-3 * 8.0 * bending;
    let expected = q / (8.0 * bending) + q / (2.0 * shear);
    let found = deflection(height, degree, elements, material, &[Side::LEFT], (1.0, q));
    println!("cantilever h/L = {height}, nu = {poisson_ratio}, plane {plane:?}: {:.6}", found / expected);
    found / expected
}

#[test]
fn a_cantilever_deflects_as_timoshenko_says_in_plane_strain_and_plane_stress() {
    for plane in [Plane::Strain, Plane::Stress] {
        // Without lateral contraction the clamp is that of beam theory.
        let free_to_contract = over_timoshenko(0.05, [3, 40], 0.0, plane);
        assert!((free_to_contract - 1.0).abs() < 5e-4, "{free_to_contract}");
        // With it the clamp holds the section wide, which stiffens a piece of length h: a share of order h/L.
        // Four elements within that piece at each height.
        let deviation = [(0.1, 40), (0.05, 80), (0.025, 160)]
            .map(|(height, elements)| 1.0 - over_timoshenko(height, [3, elements], POISSON_RATIO, plane));
        assert!(deviation[1].abs() < 5e-3, "{deviation:?}");
        let order = fitted_order(&[0.1, 0.05, 0.025], &deviation);
        assert!((order - 1.0).abs() < 0.15, "order {order}: {deviation:?}");
    }
}

#[test]
fn raising_the_degree_cures_the_locking_of_a_thin_cantilever() {
    let error = |degree: usize| (over_timoshenko(0.01, [degree, 8], 0.0, Plane::Strain) - 1.0).abs();
    let errors = [1, 2, 3, 4].map(error);
    println!("thin cantilever of 8 elements, deviation by degree: {errors:?}");
    // Degree 1 locks; degree 4 holds the quartic of beam theory.
    assert!(errors[0] > 0.9 && errors[1] < 0.1 && errors[2] < 1e-3 && errors[3] < 1e-5, "{errors:?}");
}

#[test]
fn a_stretched_strip_is_stiffer_than_a_bent_one() {
    // Membrane action at W/h = 1: W (1 + 0.75 (W/h)^2) = w is an estimate, good to some ten percent.
    let height: f64 = 0.01;
    let material = material(Law::StVenantKirchhoff);
    let q = 384.0 * bending_stiffness(&material, height) * 1.75 * height;
    let found = deflection(height, 2, 60, material, &[Side::LEFT, Side::RIGHT], (0.5, q));
    println!("strip at W/h = {:.3}, estimate 1", found / height);
    assert!((found / height - 1.0).abs() < 0.15, "{}", found / height);
}
