//! What several tests share.

use partita_coupling::accelerate::QuasiNewton;
use partita_coupling::models::Model;
use partita_coupling::models::tank::{Bottom, Fluid, Tank};
use partita_coupling::models::tube::{Flow, Tube, Wall};
use partita_coupling::{
    Acceleration, AtLimit, Block, CouplingSettings, Criterion, Effort, IdentityTransfer, March, NewtonLimit,
    Participant, ParticipantError, Policy, Predictor, Step,
};

pub(crate) type TubeMarch = March<Model<Flow>, Model<Wall>>;
pub(crate) type TankMarch = March<Model<Fluid>, Model<Bottom>>;

/// Every acceleration, with settings that suit the models.
pub(crate) fn all_accelerations() -> Vec<(&'static str, Acceleration)> {
    let quasi_newton = QuasiNewton { omega_0: 0.1, ..QuasiNewton::default() };
    vec![
        ("constant", Acceleration::Constant { omega: 0.05 }),
        ("aitken", Acceleration::Aitken { omega_0: 0.05 }),
        ("iqn_ils", Acceleration::IqnIls(quasi_newton)),
        ("iqn_imvls", Acceleration::IqnImvls(quasi_newton)),
        ("iqn_mvj", Acceleration::IqnMvj(quasi_newton)),
    ]
}

pub(crate) fn imvls() -> Acceleration {
    Acceleration::IqnImvls(QuasiNewton::default())
}

pub(crate) fn fixed(limit: NewtonLimit) -> Policy {
    Policy::Fixed { first: limit, second: limit }
}

pub(crate) fn settings(acceleration: Acceleration) -> CouplingSettings {
    CouplingSettings {
        acceleration,
        policy: fixed(NewtonLimit::ToConvergence),
        criterion: Criterion::Changes { tolerance: 1e-6 },
        predictor: Predictor::Linear,
        max_iterations: 1000,
        at_limit: AtLimit::Fail,
    }
}

/// Two participants whose points coincide.
pub(crate) fn march<A: Participant, B: Participant>(
    first: A,
    second: B,
    settings: &CouplingSettings,
) -> March<A, B> {
    let transfer = IdentityTransfer::new(first.input()[0].len());
    March::new(first, second, vec![Box::new(transfer)], settings, 0.0).expect("a fitting problem")
}

pub(crate) fn tube(tube: &Tube, settings: &CouplingSettings) -> TubeMarch {
    let (flow, wall) = tube.participants().expect("valid tube");
    march(flow, wall, settings)
}

pub(crate) fn tank(tank: &Tank, points: usize, settings: &CouplingSettings) -> TankMarch {
    march(tank.fluid(points).expect("valid tank"), tank.bottom(points).expect("valid tank"), settings)
}

/// What [`Spoiled`] does to a call, by the number of the call since the start of the run.
pub(crate) type Fault = Box<dyn FnMut(usize, &mut [f64], &mut Effort) -> Result<(), ParticipantError>>;

/// A participant whose calls are spoiled after the fact.
pub(crate) struct Spoiled<P> {
    pub(crate) inner: P,
    pub(crate) calls: usize,
    pub(crate) fault: Fault,
}

impl<P> Spoiled<P> {
    pub(crate) fn new(
        inner: P,
        fault: impl FnMut(usize, &mut [f64], &mut Effort) -> Result<(), ParticipantError> + 'static,
    ) -> Self {
        Self { inner, calls: 0, fault: Box::new(fault) }
    }
}

impl<P: Participant> Participant for Spoiled<P> {
    fn name(&self) -> &str {
        self.inner.name()
    }
    fn input(&self) -> &[Block] {
        self.inner.input()
    }
    fn output(&self) -> &[Block] {
        self.inner.output()
    }
    fn begin_step(&mut self, step: &Step) -> Result<(), ParticipantError> {
        self.inner.begin_step(step)
    }
    fn advance(
        &mut self,
        input: &[f64],
        limit: NewtonLimit,
        output: &mut [f64],
    ) -> Result<Effort, ParticipantError> {
        let mut effort = self.inner.advance(input, limit, output)?;
        self.calls += 1;
        (self.fault)(self.calls, output, &mut effort)?;
        Ok(effort)
    }
    fn commit(&mut self) {
        self.inner.commit();
    }
    fn rewind(&mut self) {
        self.inner.rewind();
    }
}
