//! The shipped checks on the models, and on things that break their contracts.

use partita_coupling::conformance::{ParticipantCheck, check_accelerator, check_participant};
use partita_coupling::models::tank::Tank;
use partita_coupling::models::tube::Tube;
use partita_coupling::{
    Accelerator, Answer, Block, DroppedColumn, Effort, NewtonLimit, Participant, ParticipantError, Proposal,
    SetupError, Step,
};

use crate::support::{Spoiled, all_accelerations, imvls};

const STEP: Step = Step { index: 1, time: 1e-3, dt: 1e-3 };

fn wave(len: usize, amplitude: f64) -> Vec<f64> {
    (0..len).map(|i| amplitude * (0.3 + (0.2 * i as f64).sin())).collect()
}

fn check(len: usize, amplitude: f64) -> ParticipantCheck {
    ParticipantCheck {
        step: STEP,
        inputs: [wave(len, amplitude), wave(len, -0.5 * amplitude)],
        tolerance: 1e-8,
    }
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

/// The wall, with every call spoiled by `fault`, must not pass.
fn assert_caught(
    expected: &str,
    fault: impl FnMut(usize, &mut [f64], &mut Effort) -> Result<(), ParticipantError> + 'static,
) {
    let (_, wall) = Tube::default().participants().unwrap();
    let violation = check_participant(&mut Spoiled::new(wall, fault), &check(40, 1e-2)).unwrap_err();
    assert!(violation.to_string().contains(expected), "{violation}");
}

#[test]
fn inner_residual_that_is_not_evaluated_anew_is_noticed() {
    assert_caught("claims to be converged at entry although its input has changed", |_, _, effort| {
        effort.entry_converged = true;
        Ok(())
    });
}

#[test]
fn output_that_depends_on_the_call_history_is_noticed() {
    assert_caught("differs by", |call, output, _| {
        output[0] *= 1.0 + 1e-3 * call as f64;
        Ok(())
    });
}

#[test]
fn rewind_that_leaves_a_trace_is_noticed() {
    assert_caught("bit for bit", |call, output, _| {
        output[0] *= 1.0 + 1e-14 * call as f64;
        Ok(())
    });
}

/// A wall that remembers less than it needs.
struct Forgetful<P>(P);

impl<P: Participant> Participant for Forgetful<P> {
    fn name(&self) -> &str {
        self.0.name()
    }
    fn input(&self) -> &[Block] {
        self.0.input()
    }
    fn output(&self) -> &[Block] {
        self.0.output()
    }
    fn begin_step(&mut self, step: &Step) -> Result<(), ParticipantError> {
        self.0.begin_step(step)
    }
    fn advance(
        &mut self,
        input: &[f64],
        limit: NewtonLimit,
        output: &mut [f64],
    ) -> Result<Effort, ParticipantError> {
        self.0.advance(input, limit, output)
    }
    fn commit(&mut self) {
        self.0.commit();
    }
    fn rewind(&mut self) {
        self.0.rewind();
    }
}

#[test]
fn a_participant_that_saves_too_little_is_noticed() {
    let (_, wall) = Tube::default().participants().unwrap();
    let violation = check_participant(&mut Forgetful(wall), &check(40, 1e-2)).unwrap_err();
    assert!(violation.to_string().contains("after a restart"), "{violation}");
}

#[test]
fn wrong_efforts_are_noticed() {
    assert_caught("Newton iterations with a limit of", |_, _, effort| {
        effort.newton += 3;
        effort.solves += 3;
        Ok(())
    });
    assert_caught("no part reports its change", |_, _, effort| {
        effort.changes.clear();
        Ok(())
    });
    assert_caught("came back unconverged", |_, _, effort| {
        effort.converged = false;
        Ok(())
    });
    assert_caught("not finite", |_, output, _| {
        output[3] = f64::INFINITY;
        Ok(())
    });
}

/// An accelerator with a fault.
struct Faulty {
    inner: Box<dyn Accelerator>,
    forgets_to_forget: bool,
    poor_state: bool,
}

impl Accelerator for Faulty {
    fn propose(&mut self, x: &mut [f64], r: &[f64], answer: Answer) -> Proposal {
        self.inner.propose(x, r, answer)
    }
    fn step_converged(&mut self, x: &[f64], r: &[f64], answer: Answer) -> Vec<DroppedColumn> {
        self.inner.step_converged(x, r, answer)
    }
    fn step_failed(&mut self) {
        if self.forgets_to_forget {
            self.inner.step_converged(&[0.0; 6], &[0.0; 6], Answer::default());
        } else {
            self.inner.step_failed();
        }
    }
    fn name(&self) -> &'static str {
        "faulty"
    }
    fn save(&self) -> Vec<u8> {
        if self.poor_state { imvls().build(6).unwrap().save() } else { self.inner.save() }
    }
    fn restore(&mut self, bytes: &[u8]) -> Result<(), SetupError> {
        self.inner.restore(bytes)
    }
}

#[test]
fn accelerators_that_keep_too_much_or_save_too_little_are_noticed() {
    let build = |forgets_to_forget: bool, poor_state: bool| {
        move || -> Box<dyn Accelerator> {
            Box::new(Faulty { inner: imvls().build(6).unwrap(), forgets_to_forget, poor_state })
        }
    };
    check_accelerator("sound", 6, &build(false, false)).unwrap();
    assert!(check_accelerator("keeps a failed step", 6, &build(true, false)).is_err());
    assert!(check_accelerator("saves nothing", 6, &build(false, true)).is_err());
}
