//! What cannot be built is refused with a message that says why.

use miette::Diagnostic;
use partita_iga::{Knots, Side, Spline, build};
use partita_structure::{
    Law, LineSearch, Material, Plane, Rayleigh, StructureError, StructureModel, StructureSettings,
    StructureSolver, TimeScheme,
};

use crate::common::{bare, beam, dynamic, quasi_static, stepped_by, svk};

fn refusal<const D: usize>(
    patch: Spline<D>,
    model: StructureModel<D>,
    settings: StructureSettings,
) -> StructureError {
    let error = StructureSolver::new(patch.into(), model, settings).err().expect("a refusal");
    assert!(error.help().is_some(), "no hint: {error}");
    error
}

#[test]
fn numbers_out_of_range_are_refused() {
    let patch = || beam(1.0, 0.1, 2, 2);
    let model = || bare(svk(1.0, 0.3));
    for density in [0.0, -1.0, f64::NAN] {
        let error = refusal(patch(), StructureModel { density, ..model() }, quasi_static());
        assert!(matches!(error, StructureError::Density { .. }), "{error}");
    }
    let error = refusal(patch(), model(), dynamic(1.2));
    assert!(matches!(error, StructureError::SpectralRadius(_)), "{error}");
    for (beta, gamma) in [(0.25, 0.4), (0.1, 0.5)] {
        let error = refusal(patch(), model(), stepped_by(TimeScheme::Newmark { beta, gamma }));
        assert!(matches!(error, StructureError::Newmark(_)), "{error}");
    }
    let rayleigh = Some(Rayleigh { mass: -1.0, stiffness: 0.0 });
    let error = refusal(patch(), model(), StructureSettings { rayleigh, ..quasi_static() });
    assert!(matches!(error, StructureError::Damping { .. }), "{error}");
    let line_search = Some(LineSearch { tolerance: 0.8, max_evaluations: 0 });
    let error = refusal(patch(), model(), StructureSettings { line_search, ..quasi_static() });
    assert!(matches!(error, StructureError::LineSearch { .. }), "{error}");
}

#[test]
fn sides_that_do_not_exist_are_refused() {
    for model in [
        StructureModel { clamped: [Side::FRONT].into(), ..bare(svk(1.0, 0.3)) },
        StructureModel { wetted: [Side::FRONT].into(), ..bare(svk(1.0, 0.3)) },
    ] {
        let error = refusal(beam(1.0, 0.1, 2, 2), model, quasi_static());
        assert_eq!(error, StructureError::NoSuchSide { side: Side::FRONT });
    }
}

#[test]
fn a_folded_patch_is_refused_with_the_place() {
    let linear = Knots::uniform(1, 1).unwrap();
    // Left-handed: the second parameter runs downwards.
    let corners = vec![[0.0, 0.0], [1.0, 0.0], [0.0, -1.0], [1.0, -1.0]];
    let patch = Spline::new(vec![linear.clone(), linear], corners).unwrap();
    let error = refusal(patch, bare(svk(1.0, 0.3)), quasi_static());
    assert!(matches!(error, StructureError::Inverted { element: 0, determinant, .. } if determinant < 0.0));
    assert!(error.to_string().contains("element 0 is inverted near ["), "{error}");
}

#[test]
fn a_curve_is_no_solid() {
    let curve = build::line([0.0, 0.0], [1.0, 0.0], 2, 2).unwrap();
    let error = refusal(curve, bare(svk(1.0, 0.3)), quasi_static());
    assert_eq!(error, StructureError::NotASolid { parameters: 1, dimensions: 2 });
}

#[test]
fn plane_stress_in_space_is_refused() {
    let cube = build::cuboid([0.0; 3], [1.0; 3], [1, 1, 1], [1, 1, 1]).unwrap();
    let material = Material::new(Law::LinearElastic, 1.0, 0.3, Plane::Stress).unwrap();
    assert_eq!(refusal(cube, bare(material), quasi_static()), StructureError::PlaneStressInSpace);
}

#[test]
fn a_structure_with_nothing_free_is_refused() {
    let patch = build::rectangle([0.0, 0.0], [1.0, 1.0], [1, 1], [1, 1]).unwrap();
    let model = StructureModel { clamped: [Side::LEFT, Side::RIGHT].into(), ..bare(svk(1.0, 0.3)) };
    assert_eq!(refusal(patch, model, quasi_static()), StructureError::NothingFree);
}
