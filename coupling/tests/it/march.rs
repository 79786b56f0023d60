//! Steps that end, fail and are tried again.

use std::cell::Cell;
use std::rc::Rc;

use miette::Diagnostic;
use partita_coupling::models::tank::Tank;
use partita_coupling::models::tube::Tube;
use partita_coupling::{
    Acceleration, AtLimit, CouplingSettings, Criterion, Effort, IdentityTransfer, March, MatrixTransfer,
    NewtonLimit, ParticipantError, Policy, Predictor, Record, SetupError, StepFailure, StepSizes,
};
use partita_testing::with_hint;

use crate::support::{Spoiled, all_accelerations, fixed, imvls, march, settings, tank, tube};

const DT: f64 = 1e-3;

#[test]
fn reaching_the_iteration_bound_is_an_error_with_the_history() {
    let strict = CouplingSettings { max_iterations: 3, ..settings(imvls()) };
    let mut run = tube(&Tube::default(), &strict);
    let error = run.step(DT, &mut ()).unwrap_err();
    assert!(matches!(*error.cause, StepFailure::TooManyIterations { iterations: 3, .. }));
    assert_eq!((error.step.index, error.iteration, error.history.iterations.len()), (1, 3, 3));
    assert_eq!(run.clock().steps, 0, "nothing is committed");
    let message = error.to_string();
    assert!(message.starts_with("step 1 (t = 0.001 s), coupling iteration 3, the step is not converged"));
    assert!(error.help().is_some(), "{message}");
}

#[test]
fn step_at_the_bound_is_accepted_unconverged_where_asked() {
    let lenient = CouplingSettings { max_iterations: 3, at_limit: AtLimit::Accept, ..settings(imvls()) };
    let record = tube(&Tube::default(), &lenient).step(DT, &mut ()).unwrap();
    assert!(!record.converged);
    assert_eq!(record.iterations, 3);
}

#[test]
fn convergence_in_the_last_allowed_iteration_counts() {
    let needed = tube(&Tube::default(), &settings(imvls())).step(DT, &mut ()).unwrap().iterations;
    let exact = CouplingSettings { max_iterations: needed, ..settings(imvls()) };
    assert!(tube(&Tube::default(), &exact).step(DT, &mut ()).unwrap().converged);
    let short = CouplingSettings { max_iterations: needed - 1, ..settings(imvls()) };
    assert!(tube(&Tube::default(), &short).step(DT, &mut ()).is_err());
}

#[test]
fn zero_start_stays_at_zero_with_every_acceleration() {
    let still = Tube { inflow_peak: 0.0, ..Tube::default() };
    for (name, acceleration) in all_accelerations() {
        let mut run = tube(&still, &settings(acceleration));
        for _ in 0..3 {
            let record = run.step(DT, &mut ()).unwrap();
            assert_eq!(record.iterations, 1, "{name}");
            assert_eq!(record.largest_change.to_bits(), 0, "{name}: 0/0 counts as no change");
        }
        assert!(run.interface().x.iter().all(|x| *x == 0.0), "{name}");
    }
}

#[test]
fn zero_start_with_a_criterion_that_keeps_iterating_stays_finite() {
    let still = Tube { inflow_peak: 0.0, ..Tube::default() };
    for (name, acceleration) in all_accelerations() {
        let endless = CouplingSettings {
            // A strict bound of an absolute zero never holds: no residual is below it.
            criterion: Criterion::InterfaceResidual(partita_coupling::Bound::Absolute(f64::MIN_POSITIVE)),
            max_iterations: 6,
            ..settings(acceleration)
        };
        let mut spoiled = still.participants().map(|(flow, wall)| {
            // The wall claims to be unconverged, so the step cannot end.
            let wall = Spoiled::new(wall, |_, _, effort| {
                effort.converged = false;
                Ok(())
            });
            march(flow, wall, &endless)
        });
        let run = spoiled.as_mut().unwrap();
        let error = run.step(DT, &mut ()).unwrap_err();
        assert!(matches!(*error.cause, StepFailure::TooManyIterations { .. }), "{name}: {error}");
        assert!(run.interface().x.iter().all(|x| *x == 0.0), "{name}");
    }
}

#[test]
fn value_that_is_not_finite_is_caught_where_it_appears() {
    let (flow, wall) = Tube::default().participants().unwrap();
    let flow = Spoiled::new(flow, |call, output, _| {
        if call == 2 {
            output[7] = f64::NAN;
        }
        Ok(())
    });
    let error = march(flow, wall, &settings(imvls())).step(DT, &mut ()).unwrap_err();
    assert_eq!(error.iteration, 2);
    assert!(
        error.to_string().starts_with(
            "step 1 (t = 0.001 s), coupling iteration 2, flow: NaN at interface wall, point 7, component 0"
        ),
        "{error}"
    );
}

#[test]
fn failed_step_leaves_no_trace_and_can_be_tried_again() {
    for (name, acceleration) in all_accelerations() {
        let mut clean: Vec<Record> = Vec::new();
        let mut run = tube(&Tube::default(), &settings(acceleration));
        for _ in 0..4 {
            run.step(DT, &mut clean).unwrap();
        }

        let (flow, wall) = Tube::default().participants().unwrap();
        let mut armed = true;
        let wall = Spoiled::new(wall, move |call, _, _| {
            if armed && call == 20 {
                armed = false;
                return Err(ParticipantError::new("wall", "struck by lightning"));
            }
            Ok(())
        });
        let mut bumpy: Vec<Record> = Vec::new();
        let mut run = march(flow, wall, &settings(acceleration));
        let mut failures = 0;
        while run.clock().steps < 4 {
            let (before, written) = (run.state(), bumpy.len());
            if run.step(DT, &mut bumpy).is_err() {
                assert!(run.state() == before, "{name}");
                bumpy.truncate(written);
                failures += 1;
            }
        }
        assert_eq!(failures, 1, "{name}");
        assert_eq!(strip(&bumpy), strip(&clean), "{name}");
    }
}

#[test]
fn a_first_call_that_fails_under_a_constant_predictor_points_to_a_linear_one() {
    for (predictor, told) in [(Predictor::Constant, true), (Predictor::Linear, false)] {
        let fails = Rc::new(Cell::new(false));
        let (flow, wall) = Tube::default().participants().expect("valid tube");
        let gives_way = Rc::clone(&fails);
        let wall = Spoiled::new(wall, move |_, _, _| {
            if gives_way.get() {
                return Err(ParticipantError::new("wall", "it gives way").with_hint("load it less"));
            }
            Ok(())
        });
        let mut march = march(flow, wall, &CouplingSettings { predictor, ..settings(imvls()) });
        march.step(1e-3, &mut ()).expect("the first step has no step before it to predict from");
        fails.set(true);
        let error = march.step(1e-3, &mut ()).expect_err("the wall fails");
        let hint = error.help().expect("what to try").to_string();
        assert!(hint.starts_with("load it less"), "{hint}");
        assert_eq!(hint.contains("; a constant `predictor` stops the interface"), told, "{hint}");
    }
}

fn strip(records: &[Record]) -> Vec<Record> {
    let strip = |record: &Record| match record {
        Record::Iteration(record) => Record::Iteration(record.without_seconds()),
        Record::Step(record) => Record::Step(record.without_seconds()),
        Record::Retry(record) => Record::Retry(record.clone()),
    };
    records.iter().map(strip).collect()
}

#[test]
fn failed_step_can_be_tried_with_half_the_size() {
    let (flow, wall) = Tube::default().participants().unwrap();
    let wall =
        Spoiled::new(
            wall,
            |call, _, _| {
                if call == 4 { Err(ParticipantError::new("wall", "too much")) } else { Ok(()) }
            },
        );
    let mut run = march(flow, wall, &settings(imvls()));
    assert!(run.step(DT, &mut ()).is_err());
    run.step(0.5 * DT, &mut ()).unwrap();
    run.step(0.5 * DT, &mut ()).unwrap();
    run.step(DT, &mut ()).unwrap();
    assert_eq!(run.clock().steps, 3);
    assert_eq!(run.clock().time.to_bits(), (2.0 * DT).to_bits());
}

#[test]
fn equal_steps_gather_no_round_off_in_time() {
    let still = Tank { gravity: 0.0, ballast: 0.0, ..Tank::default() };
    let mut run = tank(&still, 3, &settings(imvls()));
    for n in 1..=50 {
        let record = run.step(0.01, &mut ()).unwrap();
        assert_eq!(record.time.to_bits(), (f64::from(n) * 0.01).to_bits());
    }
}

#[test]
fn step_ends_only_when_every_field_meets_its_own_bound() {
    // One Newton iteration a call: the changes get small before the residuals do.
    let hasty = CouplingSettings {
        policy: fixed(NewtonLimit::AtMost(1)),
        criterion: Criterion::Changes { tolerance: 1e-2 },
        ..settings(imvls())
    };
    let stiffening = Tube { residual_bound: 1e-12, ..Tube::default() };
    let mut run = tube(&stiffening, &hasty);
    let mut waited = 0;
    for _ in 0..10 {
        run.step(DT, &mut ()).unwrap();
        let (last, earlier) = run.history().iterations.split_last().unwrap();
        assert!(last.fields.iter().all(|field| field.converged));
        waited += earlier.iter().filter(|record| record.largest_change() < 1e-2).count();
    }
    assert!(waited > 0, "the test needs a step that waits for a field");
}

#[test]
fn each_field_keeps_its_own_newton_limit() {
    for (first, second) in [
        (NewtonLimit::AtMost(1), NewtonLimit::ToConvergence),
        (NewtonLimit::ToConvergence, NewtonLimit::AtMost(1)),
    ] {
        let uneven = CouplingSettings { policy: Policy::Fixed { first, second }, ..settings(imvls()) };
        let mut run = tube(&Tube::default(), &uneven);
        let mut most = [0; 2];
        for _ in 0..5 {
            run.step(DT, &mut ()).unwrap();
            for record in &run.history().iterations {
                assert_eq!([record.fields[0].limit, record.fields[1].limit], [first, second]);
                most = [0, 1].map(|field| most[field].max(record.fields[field].newton));
            }
        }
        let limited = [first, second].map(|limit| limit == NewtonLimit::AtMost(1));
        assert_eq!(most.map(|newton| newton == 1), limited, "{most:?}");
    }
}

#[test]
fn entry_residuals_end_a_step_only_after_calls_that_had_nothing_to_do() {
    for policy in [fixed(NewtonLimit::AtMost(1)), fixed(NewtonLimit::ToConvergence)] {
        let spenke = CouplingSettings { policy, criterion: Criterion::EntryResiduals, ..settings(imvls()) };
        let mut run = tube(&Tube { residual_bound: 1e-8, ..Tube::default() }, &spenke);
        for _ in 0..5 {
            run.step(DT, &mut ()).unwrap();
            let last = run.history().last().unwrap();
            assert!(last.fields.iter().all(|field| field.entry_converged && field.newton == 0));
        }
    }
}

#[test]
fn coupled_solution_does_not_depend_on_the_choices() {
    let reference = after_five_steps(&CouplingSettings {
        criterion: Criterion::Changes { tolerance: 1e-9 },
        ..settings(imvls())
    });
    let policies = [
        fixed(NewtonLimit::AtMost(1)),
        Policy::UntilCoupled { at_most: 1, tolerance: 1e-9 },
        Policy::ConvergedInterfaceData { tolerance: 1e-4 },
    ];
    for (name, acceleration) in all_accelerations() {
        for policy in policies {
            let x = after_five_steps(&CouplingSettings {
                policy,
                criterion: Criterion::Changes { tolerance: 1e-9 },
                max_iterations: 5000,
                ..settings(acceleration)
            });
            let scale = reference.iter().fold(0.0_f64, |largest, x| largest.max(x.abs()));
            for (x, expected) in x.iter().zip(&reference) {
                assert!((x - expected).abs() < 1e-6 * scale, "{name}, {policy:?}");
            }
        }
    }
}

fn after_five_steps(settings: &CouplingSettings) -> Vec<f64> {
    let mut run = tube(&Tube::default(), settings);
    for _ in 0..5 {
        run.step(DT, &mut ()).unwrap();
    }
    run.second().state().displacement.clone()
}

#[test]
fn unfit_parts_are_refused_with_the_place() {
    let (flow, wall) = Tube::default().participants().unwrap();
    let Err(error) = March::new(flow, wall, vec![], &settings(imvls()), 0.0) else { panic!("no transfer") };
    assert!(matches!(error, SetupError::BlockCount { transfers: 0, .. }));

    let (flow, wall) = Tube::default().participants().unwrap();
    let short = Box::new(IdentityTransfer::new(39));
    let Err(error) = March::new(flow, wall, vec![short], &settings(imvls()), 0.0) else { panic!("short") };
    assert_eq!(
        error.to_string(),
        "interface wall: the input of the first participant has 40 values, the transfer 39"
    );

    let (flow, wall) = Tube::default().participants().unwrap();
    let transfer = Box::new(IdentityTransfer::new(40));
    let Err(error) = March::new(wall, flow, vec![transfer], &settings(imvls()), 0.0) else {
        panic!("swapped")
    };
    assert!(error.to_string().contains("must hand displacements"), "{error}");

    let (tube_flow, _) = Tube::default().participants().unwrap();
    let bottom = Tank::default().bottom(40).unwrap();
    let transfer = Box::new(IdentityTransfer::new(40));
    let Err(error) = March::new(tube_flow, bottom, vec![transfer], &settings(imvls()), 0.0) else {
        panic!("different interfaces")
    };
    assert_eq!(error.to_string(), "interface wall: meets interface bottom");

    let (flow, _) = Tube::default().participants().unwrap();
    let (other, _) = Tube::default().participants().unwrap();
    let Err(error) = March::new(flow, other, Vec::new(), &settings(imvls()), 0.0) else { panic!("twins") };
    assert!(error.to_string().starts_with("both participants are called `flow`"), "{error}");
}

#[test]
fn records_name_the_method_that_no_setting_can_name() {
    let strict = settings(imvls());
    let mut run = tube(&Tube::default(), &strict);
    let mut records: Vec<Record> = Vec::new();
    run.set_accelerator(Acceleration::Aitken { omega_0: 0.05 }.build(40).unwrap());
    run.step(DT, &mut records).unwrap();
    let Record::Iteration(first) = &records[0] else { panic!("an iteration comes first") };
    assert_eq!(first.acceleration.as_ref().unwrap().method.as_deref(), Some("aitken"));
    assert!(serde_json::to_string(first).unwrap().contains("\"method\":\"aitken\""));
    assert_eq!(run.state().accelerator.owner, "aitken");
}

#[test]
fn settings_out_of_range_are_refused() {
    let good = settings(imvls());
    let bad = [
        CouplingSettings { max_iterations: 0, ..good.clone() },
        CouplingSettings { acceleration: Acceleration::Constant { omega: 0.0 }, ..good.clone() },
        CouplingSettings { acceleration: Acceleration::Aitken { omega_0: f64::NAN }, ..good.clone() },
        CouplingSettings { policy: fixed(NewtonLimit::AtMost(0)), ..good.clone() },
        CouplingSettings { criterion: Criterion::All(vec![]), ..good.clone() },
        CouplingSettings { criterion: Criterion::Changes { tolerance: -1.0 }, ..good },
    ];
    for settings in bad {
        let Err(error) = settings.build(4) else { panic!("{settings:?} must be refused") };
        assert!(error.help().is_some(), "{error}");
    }
}

#[test]
fn unequal_resolutions_keep_the_virtual_work_in_every_iteration() {
    // 30 points of the fluid between 12 of the bottom, linear interpolation, ends held.
    let (fine, coarse): (usize, usize) = (30, 12);
    let rows: Vec<Vec<(usize, f64)>> = (0..fine)
        .map(|i| {
            let (position, cell) = ((2 * i + 1) * coarse, 2 * fine);
            let left = (position.saturating_sub(fine) / cell).min(coarse - 2);
            let within = (position as f64 - (fine + left * cell) as f64) / cell as f64;
            let right_weight = within.clamp(0.0, 1.0);
            vec![(left, 1.0 - right_weight), (left + 1, right_weight)]
        })
        .collect();
    let transfer = MatrixTransfer::from_rows(coarse, 1, &rows).unwrap();
    let heavy = Tank::default();
    let mut run = March::new(
        heavy.fluid(fine).unwrap(),
        heavy.bottom(coarse).unwrap(),
        vec![Box::new(transfer)],
        &settings(imvls()),
        0.0,
    )
    .unwrap();
    for _ in 0..5 {
        run.step(0.01, &mut ()).unwrap();
        for record in &run.history().iterations {
            assert!(record.work_defect < 1e-14, "work defect {:e}", record.work_defect);
        }
        let interface = run.interface();
        let (sent, received): (f64, f64) =
            (interface.load.iter().sum(), interface.transferred_load.iter().sum());
        assert!((sent - received).abs() < 1e-13 * sent.abs(), "{sent} N/m sent, {received} N/m received");
    }
}

/// The default tank multiplies the residual of an unrelaxed iteration by more than one.
fn unrelaxed(at_limit: AtLimit) -> CouplingSettings {
    CouplingSettings { at_limit, ..settings(Acceleration::Constant { omega: 1.0 }) }
}

#[test]
fn a_diverging_step_ends_long_before_the_bound_and_leaves_no_trace() {
    for at_limit in [AtLimit::Fail, AtLimit::Accept] {
        let mut run = tank(&Tank::default(), 12, &unrelaxed(at_limit));
        let mut seen: Vec<Record> = Vec::new();
        let error = run.step(0.01, &mut seen).unwrap_err();
        let StepFailure::Diverges { growth, field: None } = &*error.cause else { panic!("{error}") };
        assert!(error.iteration < 20, "{error}");
        assert_eq!(
            (error.iteration, growth.at, seen.len()),
            (growth.at, error.history.iterations.len(), growth.at)
        );
        assert_eq!((growth.since, run.clock().steps), (1, 0));
        let message = error.to_string();
        let expected = format!(
            "step 1 (t = 0.01 s), coupling iteration {}, interface: the coupling iteration diverges: |r| grew from ",
            growth.at
        );
        assert!(message.starts_with(&expected), "{message}");
        assert!(error.help().expect("what to try").to_string().starts_with("take a smaller relaxation"));
        assert_eq!(run.step(0.01, &mut ()).unwrap_err().to_string(), message, "tried again, it fails alike");
    }
}

#[test]
fn a_field_that_breaks_under_a_growing_residual_is_not_to_blame() {
    let broken_at = |broken: usize| {
        let (fluid, bottom) = (Tank::default().fluid(12).unwrap(), Tank::default().bottom(12).unwrap());
        let fluid = Spoiled::new(fluid, move |call, _, _| {
            let error = ParticipantError::new("fluid", "cell 7 is inverted").with_hint("smaller time steps");
            if call == broken { Err(error) } else { Ok(()) }
        });
        march(fluid, bottom, &unrelaxed(AtLimit::Fail)).step(0.01, &mut ()).unwrap_err()
    };
    assert_eq!(
        with_hint(&broken_at(1)),
        "step 1 (t = 0.01 s), coupling iteration 1, fluid: cell 7 is inverted\nhint: smaller time steps"
    );
    let error = broken_at(4);
    let StepFailure::Diverges { growth, field: Some(field) } = &*error.cause else { panic!("{error}") };
    assert_eq!((error.iteration, growth.at, field.message.as_str()), (4, 3, "cell 7 is inverted"));
    let message = with_hint(&error);
    assert!(
        message.starts_with(
            "step 1 (t = 0.01 s), coupling iteration 4, fluid: cell 7 is inverted; the coupling iteration diverges: |r| grew"
        ) && message.ends_with("added mass of an incompressible fluid"),
        "{message}"
    );
}

#[test]
fn a_residual_that_overflows_is_not_recorded() {
    let (flow, wall) = Tube::default().participants().unwrap();
    let wall = Spoiled::new(wall, |_, output, _| {
        output[3] = 1e200;
        Ok(())
    });
    let mut seen: Vec<Record> = Vec::new();
    let error = march(flow, wall, &settings(imvls())).step(DT, &mut seen).unwrap_err();
    assert!(matches!(*error.cause, StepFailure::NotFinite { .. }), "{error}");
    assert!(error.to_string().contains("wall: 1e200 at interface wall, point 3"), "{error}");
    assert!(seen.is_empty());
}

#[test]
fn a_residual_that_no_longer_falls_asks_for_another_method_not_for_more_iterations() {
    let stuck = |_: usize, output: &mut [f64], effort: &mut Effort| {
        output.fill(1e-3);
        effort.converged = false;
        Ok(())
    };
    for (max_iterations, hint) in [(8, "raise the iteration bound"), (30, "more iterations will not help")] {
        let (flow, wall) = Tube::default().participants().unwrap();
        let bound = CouplingSettings {
            max_iterations,
            criterion: Criterion::InterfaceResidual(partita_coupling::Bound::Absolute(f64::MIN_POSITIVE)),
            ..settings(Acceleration::Constant { omega: 1e-9 })
        };
        let error = march(flow, Spoiled::new(wall, stuck), &bound).step(DT, &mut ()).unwrap_err();
        assert!(error.help().expect("what to try").to_string().starts_with(hint), "{error}");
    }
}

#[test]
fn failed_step_is_halved_until_it_can_be_made_and_the_size_comes_back() {
    let (flow, wall) = Tube::default().participants().unwrap();
    let mut struck = 0;
    let wall = Spoiled::new(wall, move |call, _, _| {
        if call == 4 || call == 5 {
            struck += 1;
            return Err(ParticipantError::new("wall", format!("too much, {struck}")));
        }
        Ok(())
    });
    let mut run = march(flow, wall, &settings(imvls()));
    let sizes = StepSizes::new(DT, 2);
    let mut records: Vec<Record> = Vec::new();
    while sizes.done(&run.clock()) < 3 {
        run.step_or_halve(&sizes, &mut records).unwrap();
    }
    let made: Vec<f64> = records
        .iter()
        .filter_map(|r| if let Record::Step(step) = r { Some(step.dt / DT) } else { None })
        .collect();
    assert_eq!(made, [0.25, 0.25, 0.5, 1.0, 1.0]);
    let retries: Vec<_> = records
        .iter()
        .filter_map(|r| if let Record::Retry(retry) = r { Some(retry) } else { None })
        .collect();
    assert_eq!(retries.iter().map(|retry| retry.next_dt / retry.dt).collect::<Vec<_>>(), [0.5, 0.5]);
    assert_eq!(retries[1].cause, "wall: too much, 2");
    assert_eq!((retries[0].step, retries[1].step), (1, 1));
    assert!((run.clock().time - 3.0 * DT).abs() < 1e-12 * DT);
}

#[test]
fn the_smallest_step_that_fails_ends_the_run_where_it_began() {
    let (flow, wall) = Tube::default().participants().unwrap();
    let wall =
        Spoiled::new(
            wall,
            |call, _, _| {
                if call > 20 { Err(ParticipantError::new("wall", "gone")) } else { Ok(()) }
            },
        );
    let mut run = march(flow, wall, &settings(imvls()));
    let sizes = StepSizes::new(DT, 3);
    let mut records: Vec<Record> = Vec::new();
    let error = loop {
        let before = run.state();
        if let Err(error) = run.step_or_halve(&sizes, &mut records) {
            assert!(run.state() == before);
            break error;
        }
    };
    assert_eq!(error.step.dt.to_bits(), (DT / 8.0).to_bits());
    assert_eq!(records.iter().filter(|record| matches!(record, Record::Retry(_))).count(), 3);
}
