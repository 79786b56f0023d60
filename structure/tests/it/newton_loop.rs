//! Newton's method on the structure: its order, its start, its end.
use partita_numerics::Field;

use miette::Diagnostic;
use partita_iga::Side;
use partita_numerics::newton::{self, Bound, Failure, Limit, Problem, Verdict};
use partita_structure::{
    BodyForce, LineSearch, StructureError, StructureModel, StructureSettings, StructureSolver,
};

use crate::common::{bare, beam, dynamic, linear, noise, quasi_static, solver, svk};

/// A cantilever of 1 m x 0.05 m under a transverse body force that bends it by `reach` of its length in beam theory.
fn cantilever(reach: f64, settings: StructureSettings) -> StructureSolver<2> {
    let (height, young_modulus, nu): (f64, f64, f64) = (0.05, 1e6, 0.3);
    let stiffness = young_modulus / (1.0 - nu * nu) * height.powi(3) / 12.0;
    let mut model = bare(svk(young_modulus, nu));
    model.clamped = [Side::LEFT].into();
    model.wetted = [Side::TOP].into();
    model.body_force = BodyForce::Constant([0.0, -8.0 * stiffness * reach / height]);
    solver(beam(1.0, height, 3, 20), model, settings)
}

/// Relative residuals of one call to convergence, the entry first.
fn residuals(solver: &mut StructureSolver<2>) -> Vec<f64> {
    let settings = *solver.newton_settings();
    let mut sequence = vec![];
    newton::solve(solver, &settings, Limit::ToConvergence, |_, iteration| {
        if sequence.is_empty() {
            sequence.push(iteration.before.relative);
        }
        sequence.push(iteration.after.relative);
        Verdict::Continue
    })
    .unwrap();
    sequence
}

#[test]
fn newton_converges_quadratically_under_a_large_deflection() {
    let mut solver = cantilever(0.8, quasi_static());
    solver.begin_step(1.0, 1.0).expect("a step");
    let sequence = residuals(&mut solver);
    println!("relative residuals under a large deflection: {sequence:?}");
    let [_, deflection] = solver.displacement_at(&[1.0, 0.5]);
    assert!(deflection < -0.5, "a large deflection: {deflection} m");
    // log r_{i+1} / log r_i of the last two drops before round-off.
    let drops: Vec<f64> = sequence.iter().copied().filter(|r| *r < 1e-1).collect();
    assert!(drops.len() >= 2, "{sequence:?}");
    for pair in drops.windows(2).filter(|pair| pair[1] > 1e-12) {
        assert!(pair[1] < 10.0 * pair[0].powi(2), "{sequence:?}");
    }
}

#[test]
fn a_slender_body_stands_still_where_the_last_bit_of_its_displacement_moves_the_residual() {
    let mut model = bare(svk(1e7, 0.3));
    model.clamped = [Side::LEFT, Side::RIGHT].into();
    model.body_force = BodyForce::Constant([0.0, -3.5]);
    let mut solver = solver(beam(1.0, 0.01, 2, 60), model, quasi_static());
    solver.begin_step(1.0, 1.0).expect("a step");
    let settings = newton::Settings { bound: Bound::Relative(1e-30), ..*solver.newton_settings() };
    let report = newton::solve(&mut solver, &settings, Limit::AtMost(15), |_, _| Verdict::Continue).unwrap();
    let floor = report.exit.relative;
    let rounded: Vec<f64> = solver
        .values()
        .iter()
        .zip(noise(solver.values().len(), 1.0))
        .map(|(d, sign)| if sign > 0.0 { d.next_up() } else { *d })
        .collect();
    solver.guess(&rounded);
    let moved = solver.assemble(false).unwrap().relative;
    println!("slender strip: residual floor {floor:e}, after moves of one bit {moved:e}");
    assert!(report.converged && report.at_round_off && !report.stagnated && floor > 1e-12);
    assert!(moved / floor > 0.2 && moved / floor < 5.0, "{floor:e} and {moved:e}");
}

#[test]
fn a_linear_structure_takes_one_iteration() {
    for settings in [quasi_static(), dynamic(0.5)] {
        let mut model = bare(linear(1e6, 0.3));
        model.clamped = [Side::LEFT].into();
        model.body_force = BodyForce::Constant([10.0, -10.0]);
        let mut solver = solver(beam(1.0, 0.1, 2, 10), model, settings);
        assert_eq!(solver.step_alone(0.1, 0.1).unwrap().iterations, 1);
    }
}

#[test]
fn a_linear_structure_is_factored_once_for_all_steps_of_one_size() {
    let mut model = bare(linear(1e6, 0.3));
    model.clamped = [Side::LEFT].into();
    model.body_force = BodyForce::in_time(|t| [10.0 * t, -10.0]);
    let mut solver = solver(beam(1.0, 0.1, 2, 10), model, dynamic(0.5));
    solver.start_from_equilibrium(0.0).unwrap();
    let mut time = 0.0;
    let mut step = |dt: f64| {
        time += dt;
        let report = solver.step_alone(time, dt).unwrap();
        assert_eq!((report.solves, report.assemblies, report.tangents), (1, 2, report.factorizations));
        report.factorizations
    };
    assert_eq!([0.1, 0.1, 0.1, 0.05, 0.05].map(&mut step), [1, 0, 0, 1, 0]);
}

#[test]
fn a_chord_finds_the_large_deflection_with_fewer_factors() {
    let newton = |reuse_factor| newton::Settings { reuse_factor, ..newton::Settings::default() };
    let [whole, chord] = [None, Some(0.5)].map(|reuse_factor| {
        let mut solver = cantilever(0.3, StructureSettings { newton: newton(reuse_factor), ..dynamic(0.5) });
        let reports: Vec<_> = (1..=5).map(|n| solver.step_alone(0.1 * f64::from(n), 0.1).unwrap()).collect();
        let count = |of: fn(&newton::Report) -> usize| reports.iter().map(of).sum::<usize>();
        let counts = [count(|report| report.factorizations), count(|report| report.iterations)];
        (counts, solver.displacement_at(&[1.0, 0.5])[1])
    });
    assert!(chord.0[0] < whole.0[0] && chord.0[1] > whole.0[1], "{chord:?} and {whole:?}");
    assert!((chord.1 / whole.1 - 1.0).abs() < 1e-7, "{chord:?} and {whole:?}");
}

#[test]
fn a_call_that_enters_converged_costs_nothing() {
    for settings in [quasi_static(), dynamic(0.5)] {
        let mut solver = cantilever(0.1, settings);
        solver.begin_step(0.1, 0.1).expect("a step");
        let sequence = residuals(&mut solver);
        assert!(sequence.len() > 2, "{sequence:?}");
        let values = solver.values().to_vec();
        let newton = *solver.newton_settings();
        let report =
            newton::solve(&mut solver, &newton, Limit::ToConvergence, |_, _| Verdict::Continue).unwrap();
        assert!(report.converged);
        assert_eq!((report.iterations, report.assemblies, report.factorizations), (0, 1, 0));
        assert_eq!(solver.values(), values);
    }
}

#[test]
fn a_call_continues_from_the_latest_iterate_under_new_loads() {
    let mut whole = cantilever(0.3, dynamic(0.5));
    whole.begin_step(0.1, 0.1).expect("a step");
    let load = vec![0.01; whole.interface_points().len() * 2];
    whole.impose(&load).expect("a step");
    residuals(&mut whole);

    let mut split = cantilever(0.3, dynamic(0.5));
    split.begin_step(0.1, 0.1).expect("a step");
    let settings = *split.newton_settings();
    for factor in [0.2, 1.4, 1.0] {
        let part: Vec<f64> = load.iter().map(|f| factor * f).collect();
        split.impose(&part).expect("a step");
        newton::solve(&mut split, &settings, Limit::AtMost(1), |_, _| Verdict::Continue).unwrap();
    }
    newton::solve(&mut split, &settings, Limit::ToConvergence, |_, _| Verdict::Continue).unwrap();
    for (a, b) in whole.values().iter().zip(split.values()) {
        assert!((a - b).abs() < 1e-9, "{a} and {b}");
    }
}

#[test]
fn nothing_moves_from_an_exactly_zero_state_without_loads() {
    for settings in [quasi_static(), dynamic(0.0), dynamic(1.0)] {
        let mut model = bare(svk(1e6, 0.3));
        model.clamped = [Side::LEFT].into();
        model.wetted = [Side::TOP].into();
        let mut solver = solver(beam(1.0, 0.1, 2, 4), model, settings);
        solver.begin_step(0.1, 0.1).expect("a step");
        solver.impose(&vec![0.0; solver.interface_points().len() * 2]).expect("a step");
        let report =
            newton::solve(&mut solver, &settings.newton, Limit::ToConvergence, |_, _| Verdict::Continue)
                .unwrap();
        assert_eq!((report.iterations, report.entry.absolute, report.entry.relative), (0, 0.0, 0.0));
        assert!(solver.values().iter().all(|d| d.to_bits() == 0));
    }
}

#[test]
fn the_residual_is_measured_against_the_largest_of_its_terms() {
    let mut solver = cantilever(0.1, quasi_static());
    solver.begin_step(1.0, 1.0).expect("a step");
    let entry = solver.assemble(true).unwrap();
    // At rest the load is the only term, so that the residual is all of it.
    assert_eq!(entry.relative, 1.0);
    let load = solver.trial().external_force.clone();
    let free: f64 = solver.parts()[0].dofs.iter().map(|&dof| load[dof].powi(2)).sum();
    assert!((entry.absolute / free.sqrt() - 1.0).abs() < 1e-14);
}

/// A strip pulled along its axis by a force far beyond its stiffness, from rest in one step: the linear step stretches
/// it to a hundred times its length, where St. Venant-Kirchhoff material, of third order in the stretch, ends at ten.
fn strong_pull(line_search: Option<LineSearch>) -> (usize, StructureSolver<2>) {
    let model = StructureModel {
        clamped: [Side::LEFT].into(),
        body_force: BodyForce::Constant([1e5, 0.0]),
        ..bare(svk(1e3, 0.0))
    };
    let settings = StructureSettings { line_search, ..quasi_static() };
    let mut solver = solver(beam(1.0, 0.1, 2, 6), model, settings);
    solver.begin_step(1.0, 1.0).expect("a step");
    let sequence = residuals(&mut solver);
    println!("strong pull, {line_search:?}: {sequence:?}");
    (sequence.len() - 1, solver)
}

#[test]
fn line_search_saves_iterations_under_a_strong_pull_and_finds_the_same_solution() {
    let (full, without) = strong_pull(None);
    let (searched, with) = strong_pull(Some(LineSearch { tolerance: 0.8, max_evaluations: 10 }));
    assert!(searched + 3 <= full, "{searched} against {full}");
    for (a, b) in without.values().iter().zip(with.values()) {
        assert!((a - b).abs() < 1e-8, "{a} and {b}");
    }
}

#[test]
fn line_search_leaves_good_steps_alone() {
    let plain = residuals(&mut begun(cantilever(0.05, dynamic(0.5))));
    let search = Some(LineSearch { tolerance: 0.8, max_evaluations: 5 });
    let searched =
        residuals(&mut begun(cantilever(0.05, StructureSettings { line_search: search, ..dynamic(0.5) })));
    assert_eq!(plain, searched);
}

fn begun(mut solver: StructureSolver<2>) -> StructureSolver<2> {
    solver.begin_step(0.01, 0.01).expect("a step");
    solver
}

/// A slender column that carries a body force along its axis, straight.
fn column(times_buckling: f64) -> StructureSolver<2> {
    let (height, young_modulus, nu): (f64, f64, f64) = (0.05, 1e6, 0.3);
    let stiffness = young_modulus / (1.0 - nu * nu) * height.powi(3) / 12.0;
    // Greenhill: a column of weight q per length buckles at q L^3 = 7.837 EI.
    let weight = 7.837 * stiffness * times_buckling;
    let model = StructureModel {
        clamped: [Side::LEFT].into(),
        body_force: BodyForce::Constant([-weight / height, 0.0]),
        ..bare(svk(young_modulus, nu))
    };
    solver(beam(1.0, height, 3, 10), model, quasi_static())
}

#[test]
fn tangents_past_the_buckling_load_are_solved_and_counted() {
    let mut below = column(0.9);
    below.step_alone(1.0, 1.0).unwrap();
    assert_eq!(below.indefinite_tangents(), 0);
    let mut above = column(1.1);
    let report = above.step_alone(1.0, 1.0).unwrap();
    assert!(report.converged && above.indefinite_tangents() > 0);
    // The straight column is an equilibrium all the same.
    let [shortening, bending] = above.displacement_at(&[1.0, 0.5]);
    assert!(shortening < 0.0 && bending.abs() < 1e-9, "{shortening} {bending}");
}

#[test]
fn a_body_without_supports_cannot_rest() {
    let mut model = bare(svk(1.0, 0.3));
    model.body_force = BodyForce::Constant([0.0, -1.0]);
    let mut solver = solver(beam(1.0, 0.2, 2, 4), model, quasi_static());
    let failure = solver.step_alone(1.0, 1.0).unwrap_err();
    assert!(matches!(failure, Failure::Problem { iteration: 1, .. }), "{failure:?}");
    assert!(solver.values().iter().all(|d| *d == 0.0), "the step is given up");
}

#[test]
fn phases_account_for_the_time_of_a_call() {
    let mut solver = cantilever(0.3, quasi_static());
    assert_eq!(solver.phases().total(), 0.0);
    solver.step_alone(1.0, 1.0).unwrap();
    let first = solver.phases();
    assert!(first.assembly > 0.0 && first.factorization > 0.0 && first.solve > 0.0 && first.motion == 0.0);
    solver.step_alone(2.0, 1.0).unwrap();
    assert!(solver.phases().assembly > first.assembly);
}

#[test]
fn a_step_allocates_nothing() {
    let line_search = Some(LineSearch { tolerance: 0.8, max_evaluations: 5 });
    for settings in [dynamic(0.5), StructureSettings { line_search, ..quasi_static() }] {
        let mut solver = cantilever(0.3, settings);
        let load = vec![0.01; solver.interface_points().len() * 2];
        // The first factorization sizes the packing buffer of this thread's matrix kernels.
        solver.step_alone(0.1, 0.1).unwrap();
        let counted = allocation_counter::measure(|| {
            solver.begin_step(0.2, 0.1).expect("a step");
            solver.impose(&load).expect("a step");
            let report =
                newton::solve(&mut solver, &settings.newton, Limit::ToConvergence, |_, _| Verdict::Continue)
                    .unwrap();
            assert!(report.iterations > 1);
            solver.commit();
        });
        assert_eq!(counted.count_total, 0, "{counted:?}");
    }
}

#[test]
fn a_body_turned_inside_out_is_an_equilibrium_of_the_law_and_no_solution() {
    let mirrored = |material| {
        let mut model = bare(material);
        model.clamped = Side::LEFT.into();
        let patch = beam(1.0, 0.2, 2, 4);
        let guess: Vec<f64> = patch.control_points().iter().flat_map(|x| [-2.0 * x[0], 0.0]).collect();
        let mut solver = solver(patch, model, quasi_static());
        solver.begin_step(1.0, 1.0).expect("a step");
        assert!(solver.verify().is_ok(), "the reference configuration is whole");
        solver.guess(&guess);
        solver
    };
    let mut inside_out = mirrored(svk(1.0, 0.3));
    // F = diag(-1, 1) leaves F^T F = I: no strain, no stress.
    assert!(inside_out.assemble(false).unwrap().absolute < 1e-14);
    let refusal = inside_out.verify().unwrap_err();
    let StructureError::Folded { determinant, .. } = refusal else { panic!("{refusal}") };
    assert!((determinant + 1.0).abs() < 1e-12, "{determinant}");
    let message = refusal.to_string();
    assert!(message.ends_with(" m is turned inside out: det F = -1.000e0"), "{message}");
    assert!(refusal.help().is_some(), "{message}");
    assert!(mirrored(linear(1.0, 0.3)).verify().is_ok(), "small strains know no orientation");
}

#[test]
fn the_worst_equation_is_that_of_the_largest_free_residual() {
    let mut solver = cantilever(0.3, quasi_static());
    solver.begin_step(1.0, 1.0).expect("a step");
    let mut pushed = solver.values().to_vec();
    let (point, component) = (solver.interface_points()[7], 1);
    pushed[2 * point + component] += 0.01;
    solver.guess(&pushed);
    solver.assemble(false).unwrap();
    let worst = solver.largest_residual().expect("an equation");
    let free = &solver.parts()[0].dofs;
    assert!(free.iter().all(|&dof| solver.residual()[dof].abs() <= worst.residual.abs()));
    let component = usize::from(worst.equation == "force in y");
    assert!((solver.residual()[2 * worst.node + component] - worst.residual).abs() < f64::EPSILON);
    assert_eq!(worst.place.0, solver.spline().control_points()[worst.node]);
    // A residual that is no number is worse than any number.
    pushed[2 * point] = f64::NAN;
    solver.guess(&pushed);
    solver.assemble(false).unwrap();
    assert!(solver.largest_residual().expect("an equation").residual.is_nan());
}
