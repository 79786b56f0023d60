//! What several tests share.

use partita_coupling::accelerate::QuasiNewton;
use partita_coupling::models::Model;
use partita_coupling::models::tank::{Bottom, Fluid, Tank};
use partita_coupling::models::tube::{Flow, Tube, Wall};
use partita_coupling::{
    Acceleration, AtLimit, CouplingSettings, Criterion, IdentityTransfer, March, NewtonLimit, Policy, Predictor,
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

pub(crate) fn tube(tube: &Tube, settings: &CouplingSettings) -> TubeMarch {
    let (flow, wall) = tube.participants().expect("valid tube");
    let transfer = IdentityTransfer::new(tube.cells);
    March::new(flow, wall, vec![Box::new(transfer)], settings, 0.0).expect("a fitting problem")
}

pub(crate) fn tank(tank: &Tank, points: usize, settings: &CouplingSettings) -> TankMarch {
    let (fluid, bottom) = (tank.fluid(points).expect("valid tank"), tank.bottom(points).expect("valid tank"));
    let transfer = IdentityTransfer::new(points);
    March::new(fluid, bottom, vec![Box::new(transfer)], settings, 0.0).expect("a fitting problem")
}
