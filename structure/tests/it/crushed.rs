//! Deformations that a neo-Hookean solid cannot take.
use partita_numerics::Field;

use miette::Diagnostic;
use partita_iga::{Side, build};
use partita_numerics::newton::{self, Failure, Limit, Problem, Verdict};
use partita_structure::{
    BodyForce, LineSearch, Material, ResponseError, StructureError, StructureModel, StructureSettings,
    StructureSolver,
};

use crate::common::{bare, neo_hookean, quasi_static, solver, svk};

/// A block of 1 m x 1 m that stands on its clamped bottom under a weight `[N/m^3]`.
fn block(material: Material, weight: f64, line_search: Option<LineSearch>) -> StructureSolver<2> {
    let patch = build::rectangle([0.0, 0.0], [1.0, 1.0], [1, 1], [2, 2]).unwrap();
    let model = StructureModel {
        clamped: [Side::BOTTOM].into(),
        body_force: BodyForce::Constant([0.0, -weight]),
        ..bare(material)
    };
    solver(patch, model, StructureSettings { line_search, ..quasi_static() })
}

#[test]
fn a_block_turned_inside_out_is_refused_with_element_place_and_remedy() {
    let mut solver = block(neo_hookean(1.0, 0.3), 0.0, None);
    solver.begin_step(1.0, 1.0).expect("a step");
    // The top row is pushed below the middle one: elements 2 and 3 are turned over.
    let pushed: Vec<f64> = (0..9).flat_map(|a| [0.0, if a >= 6 { -0.7 } else { 0.0 }]).collect();
    solver.guess(&pushed);
    for with_tangent in [false, true] {
        let error = solver.assemble(with_tangent).unwrap_err();
        let StructureError::DeformedTooFar { element: 2, place, source } = &error else { panic!("{error}") };
        assert!((0.0..0.5).contains(&place[0]) && (0.5..1.0).contains(&place[1]), "{place:?}");
        let ResponseError::Crushed { volume_ratio } = source else { panic!("{error}") };
        assert!((volume_ratio + 0.4).abs() < 1e-14, "{error}");
        assert!(error.help().is_some(), "{error}");
    }
    assert_eq!(solver.strain_energy().to_bits(), f64::INFINITY.to_bits());
    // From the reference configuration everything goes on.
    solver.rewind();
    assert!(solver.step_alone(1.0, 1.0).unwrap().converged);
}

#[test]
fn a_step_that_newton_overshoots_fails_with_its_place_and_succeeds_with_a_line_search() {
    let failure = block(neo_hookean(1.0, 0.3), 3.0, None).step_alone(1.0, 1.0).unwrap_err();
    let Failure::Problem { source: error, .. } = &failure else { panic!("{failure}") };
    assert!(matches!(error, StructureError::DeformedTooFar { .. }), "{error}");

    let search = Some(LineSearch { tolerance: 0.8, max_evaluations: 30 });
    let mut solver = block(neo_hookean(1.0, 0.3), 3.0, search);
    solver.begin_step(1.0, 1.0).expect("a step");
    let settings = newton::Settings { max_iterations: 60, ..*solver.newton_settings() };
    let report = newton::solve(&mut solver, &settings, Limit::ToConvergence, |_, _| Verdict::Continue);
    assert!(report.unwrap().converged);
    let [_, top] = solver.displacement_at(&[0.5, 1.0]);
    assert!(top < -0.5 && top > -1.0, "pressed hard, but not through the floor: {top}");
    assert!(solver.strain_energy().is_finite());
}

#[test]
fn the_neo_hookean_block_agrees_with_the_other_law_under_a_small_weight() {
    let settled = |material| {
        let mut solver = block(material, 1e-4, None);
        solver.step_alone(1.0, 1.0).unwrap();
        solver.displacement_at(&[0.5, 1.0])[1]
    };
    let ratio = settled(neo_hookean(1.0, 0.3)) / settled(svk(1.0, 0.3));
    assert!((ratio - 1.0).abs() < 1e-3, "{ratio}");
    assert!((ratio - 1.0).abs() > 1e-6, "they are two laws: {ratio}");
}
