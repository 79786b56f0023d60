//! Every method on the models, and the models themselves.

use std::fmt::Write;

use partita_coupling::models::tank::Tank;
use partita_coupling::models::tube::Tube;
use partita_coupling::{
    Acceleration, CouplingSettings, Criterion, NewtonLimit, Participant, Policy, Step, StepRecord,
};

use crate::support::{all_accelerations, fixed, imvls, settings, tank, tube};

const DT: f64 = 1e-3;

/// Sums of coupling iterations and of the Newton iterations of both fields.
fn counts(records: &[StepRecord]) -> (usize, usize, usize) {
    let sum = |count: &dyn Fn(&StepRecord) -> usize| records.iter().map(count).sum::<usize>();
    (sum(&|r| r.iterations), sum(&|r| r.fields[0].newton), sum(&|r| r.fields[1].newton))
}

fn ten_tube_steps(settings: &CouplingSettings) -> Vec<StepRecord> {
    let mut run = tube(&Tube::default(), settings);
    (0..10).map(|_| run.step(DT, &mut ()).unwrap()).collect()
}

fn ten_tank_steps(settings: &CouplingSettings) -> Vec<StepRecord> {
    let mut run = tank(&Tank::default(), 20, settings);
    (0..10).map(|_| run.step(0.01, &mut ()).unwrap()).collect()
}

#[test]
fn every_acceleration_solves_tube_and_tank() {
    let mut table = String::from("coupling iterations of ten steps\n");
    for (name, acceleration) in all_accelerations() {
        let (tube, _, _) = counts(&ten_tube_steps(&settings(acceleration)));
        let (tank, _, _) = counts(&ten_tank_steps(&settings(acceleration)));
        writeln!(table, "{name:<9} tube {tube:>4} tank {tank:>4}").unwrap();
    }
    insta::assert_snapshot!(table, @r"
    coupling iterations of ten steps
    constant  tube  987 tank  967
    aitken    tube  224 tank  149
    iqn_ils   tube   77 tank   44
    iqn_imvls tube   69 tank   48
    iqn_mvj   tube   69 tank   48
    ");
}

#[test]
fn newton_limits_trade_coupling_against_newton_iterations() {
    let at_most = |count| fixed(NewtonLimit::AtMost(count));
    let tolerance = 1e-6;
    let policies: [(&str, Policy); 6] = [
        ("1", at_most(1)),
        ("2", at_most(2)),
        ("unlimited", fixed(NewtonLimit::ToConvergence)),
        ("N1-CC", Policy::UntilCoupled { at_most: 1, tolerance }),
        ("N2-CC", Policy::UntilCoupled { at_most: 2, tolerance }),
        ("CID 1e-4", Policy::ConvergedInterfaceData { tolerance: 1e-4 }),
    ];
    let mut table = String::from("ten steps of the tube: coupling, flow Newton, wall Newton iterations\n");
    for (name, policy) in policies {
        let (coupling, flow, wall) =
            counts(&ten_tube_steps(&CouplingSettings { policy, ..settings(imvls()) }));
        writeln!(table, "{name:<9} {coupling:>4} {flow:>4} {wall:>4}").unwrap();
    }
    insta::assert_snapshot!(table, @r"
    ten steps of the tube: coupling, flow Newton, wall Newton iterations
    1          115  115  115
    2           67  111  110
    unlimited   69  113  150
    N1-CC      115  115  115
    N2-CC       67  111  110
    CID 1e-4    69  112  143
    ");
}

#[test]
fn combined_criteria_take_as_long_as_the_slower_one() {
    let run = |criterion| counts(&ten_tube_steps(&CouplingSettings { criterion, ..settings(imvls()) })).0;
    let changes = Criterion::Changes { tolerance: 1e-3 };
    let entry = Criterion::EntryResiduals;
    let (quick, slow) = (run(changes.clone()), run(entry.clone()));
    assert!(quick < slow);
    assert_eq!(run(Criterion::All(vec![changes.clone(), entry.clone()])), slow);
    assert_eq!(run(Criterion::Any(vec![changes, entry])), quick);
}

#[test]
fn more_history_helps() {
    let with = |history| {
        let quasi_newton =
            partita_coupling::QuasiNewton { history, ..partita_coupling::QuasiNewton::default() };
        counts(&ten_tube_steps(&settings(Acceleration::IqnImvls(quasi_newton)))).0
    };
    assert!(with(Some(2)) < with(Some(0)));
}

/// Entry and exit residuals of calls with one Newton iteration each, under one input.
fn residuals(participant: &mut impl Participant, input: &[f64], calls: usize) -> Vec<f64> {
    participant.begin_step(&Step { index: 1, time: 5e-3, dt: DT }).unwrap();
    let mut output = vec![0.0; input.len()];
    let mut residuals = Vec::new();
    for _ in 0..calls {
        let effort = participant.advance(input, NewtonLimit::AtMost(1), &mut output).unwrap();
        if residuals.is_empty() {
            residuals.push(effort.entry_residual);
        }
        residuals.push(effort.residual);
    }
    residuals
}

#[test]
fn newton_on_the_wall_converges_quadratically() {
    let stiffening = Tube { hardening: 100.0, tension: 500.0, ..Tube::default() };
    let (_, mut wall) = stiffening.participants().unwrap();
    let force: Vec<f64> = (0..40).map(|i| 0.2 * (1.0 + (0.3 * f64::from(i)).sin())).collect();
    let residuals = residuals(&mut wall, &force, 6);
    let last = residuals.iter().position(|r| *r < 1e-10).expect("converged");
    assert!((3..=6).contains(&last), "{residuals:?}");
    let order =
        (residuals[last - 1] / residuals[last - 2]).ln() / (residuals[last - 2] / residuals[last - 3]).ln();
    assert!(order > 1.8, "order {order}: {residuals:?}");
}

#[test]
fn newton_on_the_flow_needs_two_iterations() {
    // Continuity is linear and does not see the pressure; momentum is quadratic in a velocity that is then exact.
    let (mut flow, _) = Tube::default().participants().unwrap();
    let wave: Vec<f64> = (0..40).map(|i| 1e-4 * (0.2 * f64::from(i)).sin()).collect();
    let residuals = residuals(&mut flow, &wave, 2);
    assert!(residuals[1] > 1e-4 && residuals[2] < 1e-12, "{residuals:?}");
}

#[test]
fn one_newton_iteration_on_the_flow_leaves_an_error_of_second_order() {
    let at_hand = Tube::default();
    let mut run = tube(&at_hand, &settings(imvls()));
    for _ in 0..5 {
        run.step(DT, &mut ()).unwrap();
    }
    let (saved, committed) = (run.first().save(), run.first().state().clone());
    let rest = |disturbance: f64| {
        let (mut flow, _) = at_hand.participants().unwrap();
        flow.restore(&saved).unwrap();
        flow.begin_step(&Step { index: 6, time: 6.0 * DT, dt: DT }).unwrap();
        let mut output = vec![0.0; at_hand.cells];
        let mut wall = committed.displacement.clone();
        flow.advance(&wall, NewtonLimit::ToConvergence, &mut output).unwrap();
        for (i, d) in wall.iter_mut().enumerate() {
            *d += disturbance * (0.2 * i as f64).sin();
        }
        flow.advance(&wall, NewtonLimit::AtMost(1), &mut output).unwrap().residual
    };
    let order = (rest(1e-6) / rest(5e-7)).log2();
    assert!((order - 2.0).abs() < 0.05, "order {order}");
}

#[test]
fn tube_neither_gains_nor_loses_fluid() {
    let tube_at_hand = Tube::default();
    let mut run = tube(&tube_at_hand, &settings(imvls()));
    let area = |d: f64| std::f64::consts::PI * (tube_at_hand.radius + d).powi(2);
    let dx = tube_at_hand.length / tube_at_hand.cells as f64;
    let mut before = vec![0.0; tube_at_hand.cells];
    for _ in 0..10 {
        run.step(DT, &mut ()).unwrap();
        let flow = run.first().state();
        let (new, last) = (&flow.displacement, tube_at_hand.cells - 1);
        let growth: f64 = new.iter().zip(&before).map(|(new, old)| (area(*new) - area(*old)) * dx / DT).sum();
        let inflow = area(new[0]) * flow.velocity[0];
        let outflow = area(new[last]) * flow.velocity[last + 1];
        assert!((growth + outflow - inflow).abs() < 1e-8 * inflow, "{growth:e} {inflow:e} {outflow:e}");
        before.clone_from(new);
    }
}

#[test]
fn tank_comes_to_rest_at_its_static_deflection() {
    let heavy = Tank { ballast: 0.0, ..Tank::default() };
    let mut run = tank(&heavy, 8, &settings(imvls()));
    for _ in 0..400 {
        run.step(0.05, &mut ()).unwrap();
    }
    let expected = -heavy.fluid_density * heavy.gravity * heavy.depth / heavy.bedding;
    assert_eq!(run.second().state().displacement.len(), 8);
    for d in &run.second().state().displacement {
        assert!((d - expected).abs() < 1e-6 * expected.abs(), "{d} m instead of {expected} m");
    }
}
