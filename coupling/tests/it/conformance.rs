//! The shipped checks on the models, and on things that break their contracts.

use partita_coupling::conformance::{ParticipantCheck, check_accelerator, check_participant};
use partita_coupling::models::tank::Tank;
use partita_coupling::models::tube::Tube;
use partita_coupling::Step;

use crate::support::all_accelerations;

const STEP: Step = Step { index: 1, time: 1e-3, dt: 1e-3 };

fn wave(len: usize, amplitude: f64) -> Vec<f64> {
    (0..len).map(|i| amplitude * (0.3 + (0.2 * i as f64).sin())).collect()
}

fn check(len: usize, amplitude: f64) -> ParticipantCheck {
    ParticipantCheck { step: STEP, inputs: [wave(len, amplitude), wave(len, -0.5 * amplitude)], tolerance: 1e-8 }
}

#[test]
fn models_are_conforming_participants() {
    let (mut flow, mut wall) = Tube::default().participants().unwrap();
    check_participant(&mut flow, &check(40, 1e-5)).unwrap();
    check_participant(&mut wall, &check(40, 1e-2)).unwrap();
    check_participant(&mut Tank::default().fluid(8).unwrap(), &check(8, 1e-5)).unwrap();
    check_participant(&mut Tank::default().bottom(8).unwrap(), &check(8, 10.0)).unwrap();
}

#[test]
fn accelerators_are_conforming() {
    for (name, acceleration) in all_accelerations() {
        for size in [1, 2, 7, 40] {
            check_accelerator(name, size, &|| acceleration.build(size).unwrap()).unwrap();
        }
    }
}
