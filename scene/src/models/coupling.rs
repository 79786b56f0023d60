//! The scene's coupling choices in the words of the coupling crate.

use partita_coupling::accelerate::{Acceleration, Filter, QuasiNewton};
use partita_coupling::{AtLimit, Bound, CouplingSettings, Criterion, NewtonLimit, Policy, Predictor};

use crate::schema::{self, Direction};

/// The settings of a run of both fields. (A scene whose coupling is two-way has an acceleration.)
#[must_use]
pub fn settings(coupling: &schema::Coupling) -> CouplingSettings {
    let Some(chosen) = coupling.acceleration.as_ref().filter(|_| coupling.direction == Direction::TwoWay)
    else {
        return one_call();
    };
    CouplingSettings {
        acceleration: acceleration(chosen),
        policy: policy(coupling),
        criterion: criterion(coupling.convergence),
        predictor: match coupling.predictor {
            schema::Predictor::Constant => Predictor::Constant,
            schema::Predictor::Linear => Predictor::Linear,
            schema::Predictor::Quadratic => Predictor::Quadratic,
            schema::Predictor::Cubic => Predictor::Cubic,
        },
        max_iterations: coupling.max_iterations.get(),
        at_limit: match coupling.on_limit {
            schema::OnLimit::Fail => AtLimit::Fail,
            schema::OnLimit::Accept => AtLimit::Accept,
        },
    }
}

/// The settings of a run in which no displacement comes back, of one field alone say: one call a step, to convergence.
/// The empty interface has no residual.
#[must_use]
pub fn one_call() -> CouplingSettings {
    CouplingSettings {
        acceleration: Acceleration::Constant { omega: 1.0 },
        policy: Policy::Fixed { first: NewtonLimit::ToConvergence, second: NewtonLimit::ToConvergence },
        criterion: Criterion::InterfaceResidual(Bound::Absolute(f64::MIN_POSITIVE)),
        predictor: Predictor::Constant,
        max_iterations: 1,
        at_limit: AtLimit::Fail,
    }
}

pub(super) fn acceleration(acceleration: &schema::Acceleration) -> Acceleration {
    match acceleration {
        schema::Acceleration::Constant { relaxation } => Acceleration::Constant { omega: relaxation.get() },
        schema::Acceleration::Aitken { initial_relaxation } => {
            Acceleration::Aitken { omega_0: initial_relaxation.get() }
        }
        schema::Acceleration::IqnIls(options) => Acceleration::IqnIls(quasi_newton(options)),
        schema::Acceleration::IqnMvj(options) => Acceleration::IqnMvj(quasi_newton(options)),
        schema::Acceleration::IqnImvls(options) => Acceleration::IqnImvls(quasi_newton(options)),
    }
}

fn quasi_newton(options: &schema::QuasiNewton) -> QuasiNewton {
    QuasiNewton {
        omega_0: options.initial_relaxation.get(),
        omega_unseen: options.unseen_relaxation.get(),
        history: options.history_steps.get(),
        filter: match options.filter {
            schema::Filter::None => Filter::None,
            schema::Filter::Qr1(limit) => Filter::Qr1 { limit: limit.get() },
            schema::Filter::Qr2(limit) => Filter::Qr2 { limit: limit.get() },
            schema::Filter::Qr3(limit) => Filter::Qr3 { limit: limit.get() },
        },
        relax_first_iteration: options.relax_first_iteration,
        keep_last_differences: options.keep_last_differences,
    }
}

fn criterion(convergence: schema::Convergence) -> Criterion {
    match convergence {
        schema::Convergence::Changes(tolerance) => Criterion::Changes { tolerance: tolerance.get() },
        schema::Convergence::ChangesAndResidual(tolerance) => Criterion::All(vec![
            Criterion::Changes { tolerance: tolerance.get() },
            Criterion::InterfaceResidual(Bound::Relative(tolerance.get())),
        ]),
        schema::Convergence::EntryResiduals => Criterion::EntryResiduals,
        schema::Convergence::InterfaceResidual(bound) => Criterion::InterfaceResidual(match bound {
            schema::Tolerance::Relative(bound) => Bound::Relative(bound.get()),
            schema::Tolerance::Absolute(bound) => Bound::Absolute(bound.get()),
        }),
    }
}

fn policy(coupling: &schema::Coupling) -> Policy {
    match coupling.newton {
        schema::NewtonPolicy::Fixed { fluid, structure } => {
            Policy::Fixed { first: newton_limit(fluid), second: newton_limit(structure) }
        }
        schema::NewtonPolicy::UntilCoupled(at_most) => Policy::UntilCoupled {
            at_most: at_most.get(),
            tolerance: changes_tolerance(coupling.convergence),
        },
        schema::NewtonPolicy::ConvergedInterfaceData(tolerance) => {
            Policy::ConvergedInterfaceData { tolerance: tolerance.get() }
        }
    }
}

fn newton_limit(limit: schema::Limit<1>) -> NewtonLimit {
    limit.get().map_or(NewtonLimit::ToConvergence, NewtonLimit::AtMost)
}

/// Nm-CC lifts its limit when the changes meet the coupling criterion; under another criterion, at the default one.
fn changes_tolerance(convergence: schema::Convergence) -> f64 {
    match (convergence, schema::Convergence::default()) {
        (schema::Convergence::Changes(tolerance) | schema::Convergence::ChangesAndResidual(tolerance), _)
        | (_, schema::Convergence::Changes(tolerance)) => tolerance.get(),
        _ => unreachable!("the default criterion is on changes"),
    }
}
