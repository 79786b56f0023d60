//! How fast Newton's method converges, and how little it does when there is nothing to do.
use partita_numerics::Field;

use partita_fluid::{
    BodyForce, BoundaryCondition, FluidModel, FluidSettings, FluidSolver, PressurePin, Tangent, TimeScheme,
};
use partita_numerics::newton::{self, Bound, Check, Limit, Problem, Verdict};

use crate::common::*;

/// The lid-driven cavity at Reynolds number 100, regularized lid.
fn cavity(time: TimeScheme, tangent: Tangent) -> FluidSolver<2> {
    let lid = field(|x: &[f64; 2], _| [16.0 * x[0] * x[0] * (1.0 - x[0]).powi(2), 0.0]);
    let model = FluidModel {
        density: 1.0,
        viscosity: 0.01,
        ..model(boundary(&[
            ("left", BoundaryCondition::NoSlip),
            ("right", BoundaryCondition::NoSlip),
            ("bottom", BoundaryCondition::NoSlip),
            ("top", BoundaryCondition::Velocity(lid)),
        ]))
    };
    let settings = FluidSettings { tangent, pressure_pin: Some(PressurePin::default()), ..settings(time) };
    FluidSolver::new(unit_square(10), model, settings).expect("a fluid")
}

fn steady_cavity(tangent: Tangent) -> FluidSolver<2> {
    let mut fluid = cavity(TimeScheme::Steady, tangent);
    fluid.begin_step(1.0, 1.0).expect("a step");
    fluid
}

/// Relative residuals from the entry to the bound.
fn sequence<const D: usize>(fluid: &mut FluidSolver<D>, bound: f64) -> Vec<f64> {
    let settings = newton::Settings { bound: Bound::Relative(bound), ..*fluid.newton_settings() };
    let mut residuals = Vec::new();
    newton::solve(fluid, &settings, Limit::ToConvergence, |_, iteration| {
        if iteration.index == 1 {
            residuals.push(iteration.before.relative);
        }
        residuals.push(iteration.after.relative);
        Verdict::Continue
    })
    .expect("convergence");
    // What counts as round-off says nothing about the rate.
    residuals.retain(|residual| *residual > 1e-13);
    residuals
}

/// log(r2/r1) / log(r1/r0): 1 for linear convergence, 2 for quadratic.
fn order(residuals: &[f64]) -> f64 {
    let [r0, r1, r2] = residuals else { panic!("three residuals") };
    (r2 / r1).ln() / (r1 / r0).ln()
}

#[test]
fn full_tangent_converges_quadratically() {
    let mut fluid = steady_cavity(Tangent::Full);
    let residuals = sequence(&mut fluid, 1e-9);
    println!("full: {}", table(&residuals));
    let last = residuals.len();
    assert!(last <= 8, "{residuals:?}");
    assert!(order(&residuals[last - 3..]) > 1.8, "{residuals:?}");
}

#[test]
fn approximate_tangents_converge_linearly() {
    for tangent in [Tangent::FrozenTau, Tangent::Picard] {
        let mut fluid = steady_cavity(tangent);
        let residuals = sequence(&mut fluid, 1e-9);
        println!("{tangent:?}: {}", table(&residuals));
        let last = residuals.len();
        let order = order(&residuals[last - 3..]);
        assert!((order - 1.0).abs() < 0.25, "{tangent:?}: order {order}, {residuals:?}");
    }
}

/// All three stop at the same flow.
#[test]
fn tangents_agree_on_the_solution() {
    let mut solutions = [Tangent::Full, Tangent::FrozenTau, Tangent::Picard].into_iter().map(|tangent| {
        let mut fluid = steady_cavity(tangent);
        sequence(&mut fluid, 1e-11);
        fluid.values().to_vec()
    });
    let full = solutions.next().expect("three of them");
    for other in solutions {
        let error = full.iter().zip(&other).fold(0.0_f64, |error, (x, y)| error.max((x - y).abs()));
        assert!(error < 1e-9, "{error:.1e}");
    }
}

#[test]
fn unsteady_full_tangent_converges_quadratically_on_a_moving_mesh() {
    let mut fluid = cavity(BDF2, Tangent::Full);
    let mesh = fluid.mesh().clone();
    let mut numbers = Noise::new(5);
    for k in 1..4 {
        fluid.begin_step(0.2 * f64::from(k), 0.2).expect("a step");
        fluid.impose_mesh(&inner_motion(&mesh, 0.01, &mut numbers)).expect("no inverted cells");
        let residuals = sequence(&mut fluid, 1e-10);
        println!("step {k}: {}", table(&residuals));
        let last = residuals.len();
        assert!(order(&residuals[last - 3..]) > 1.7, "{residuals:?}");
        fluid.commit();
    }
}

fn table(residuals: &[f64]) -> String {
    residuals.iter().map(|r| format!("{r:.1e}")).collect::<Vec<_>>().join("  ")
}

#[test]
fn call_that_enters_converged_costs_no_iteration() {
    let mut fluid = steady_cavity(Tangent::Full);
    fluid.advance(Limit::ToConvergence).expect("convergence");
    let solution = fluid.values().to_vec();
    let report = fluid.advance(Limit::ToConvergence).expect("convergence");
    assert_eq!((report.iterations, report.assemblies, report.solves), (0, 1, 0));
    assert_eq!(fluid.values(), solution);
    let lagged = newton::Settings { check: Check::Lagged, ..*fluid.newton_settings() };
    let report = newton::solve(&mut fluid, &lagged, Limit::ToConvergence, |_, _| Verdict::Continue);
    assert_eq!(report.expect("convergence").iterations, 1);
}

#[test]
fn limited_calls_continue_from_the_latest_iterate() {
    let mut whole = steady_cavity(Tangent::Full);
    let report = whole.advance(Limit::ToConvergence).expect("convergence");
    let mut parts = steady_cavity(Tangent::Full);
    for _ in 0..report.iterations {
        parts.advance(Limit::AtMost(1)).expect("an iteration");
    }
    assert_eq!(parts.values(), whole.values());
}

/// Nothing moves, nothing pulls: zero residual, zero iterations, no division of zero by zero.
#[test]
fn zero_state_is_a_solution_without_an_iteration() {
    for time in [TimeScheme::Steady, BDF1] {
        for gravity in [0.0, 9.81] {
            let mut model = model(boundary(&[
                ("left", BoundaryCondition::Slip),
                ("right", BoundaryCondition::NoSlip),
                ("bottom", BoundaryCondition::NoSlip),
                ("top", BoundaryCondition::StressFree { backflow: true }),
            ]));
            model.body_force = BodyForce::Constant([0.0, -gravity]);
            let mut fluid = FluidSolver::new(unit_square(4), model, settings(time)).expect("a fluid");
            fluid.begin_step(0.1, 0.1).expect("a step");
            let report = fluid.advance(Limit::ToConvergence).expect("convergence");
            assert!(report.converged && fluid.values().iter().all(|x| x.is_finite()));
            if gravity == 0.0 {
                assert_eq!((report.iterations, report.exit.absolute, report.exit.relative), (0, 0.0, 0.0));
            }
        }
    }
}

/// Uniform flow makes every term vanish; the residual is round-off of nothing and must count as zero.
#[test]
fn uniform_flow_is_converged_though_all_its_terms_vanish() {
    let stream = |_: &[f64; 2]| [0.8, 0.6];
    let mesh = perturbed(&unit_square(8), 0.02, 6);
    let mut model = model(boundary(&[
        ("left", BoundaryCondition::Velocity(field(move |x, _| stream(x)))),
        ("right", BoundaryCondition::DoNothing { backflow: true }),
        ("bottom", BoundaryCondition::Velocity(field(move |x, _| stream(x)))),
        ("top", BoundaryCondition::DoNothing { backflow: false }),
    ]));
    model.initial = partita_fluid::InitialState::Velocity(field(move |x, _| stream(x)));
    let mut fluid = FluidSolver::new(mesh, model, settings(BDF2)).expect("a fluid");
    for k in 1..4 {
        fluid.begin_step(0.1 * f64::from(k), 0.1).expect("a step");
        let report = fluid.advance(Limit::ToConvergence).expect("convergence");
        assert_eq!(report.iterations, 0, "{report:?}");
        fluid.commit();
    }
    assert!(velocity_error(&fluid, stream) < 1e-15);
}

#[test]
fn the_worst_equation_is_where_the_balance_is_missed() {
    let mut fluid = cavity(TimeScheme::Steady, Tangent::Full);
    fluid.begin_step(1.0, 1.0).expect("a step");
    let middle = fluid.mesh().points().iter().position(|x| *x == [0.5, 0.5]).expect("a node in the middle");
    let mut values = fluid.values().to_vec();
    values[3 * middle + 1] += 1e3;
    fluid.set_values(&values).expect("finite values");
    fluid.assemble(false).expect("a residual");
    let worst = fluid.largest_residual().expect("an equation");
    assert_eq!((worst.node, worst.equation), (middle, "momentum in y"));
    assert!((worst.residual - fluid.residual()[3 * middle + 1]).abs() < 1e-12 * worst.residual.abs());
    assert_eq!(worst.to_string(), format!("momentum in y at node {middle}, (0.5, 0.5) m"));
    values[3 * middle] = f64::NAN;
    fluid.set_values(&values).expect("values");
    fluid.assemble(false).expect("a residual");
    assert!(fluid.largest_residual().expect("an equation").residual.is_nan());
}
