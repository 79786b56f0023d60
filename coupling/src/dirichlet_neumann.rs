//! One time step of the Dirichlet-Neumann scheme: the one coupling loop of this crate.
//!
//! ```text
//! x <- prediction
//! k = 1, 2, ...
//!     d = H x                    displacement at the first participant's points
//!     f <- first(d)              load at the same points
//!     F = H^T f                  total force and virtual work kept
//!     x_tilde <- second(F)
//!     r = x_tilde - x
//!     criterion met -> leave;    else x <- accelerator(x, r)
//! ```

use std::time::Instant;

use crate::choices::{AtLimit, Choices};
use crate::divergence;
use crate::error::{IdleField, StepFailure};
use crate::observe::Observer;
use crate::participant::{Participant, ParticipantError};
use crate::port::{self, Block};
use crate::record::{FieldRecord, FieldSeconds, IterationRecord, Seconds, StepHistory};
use crate::transfer::Transfers;
use crate::vector::{dot, norm, ratio, subtract};

/// The vectors at the interface, alive as long as the run.
#[derive(Debug, Clone, PartialEq)]
pub struct Interface {
    /// `x`: interface displacement at the second participant's points, as proposed.
    pub x: Vec<f64>,
    /// `x_tilde`: the same as the second participant answered.
    pub x_tilde: Vec<f64>,
    /// `r = x_tilde - x`.
    pub r: Vec<f64>,
    /// `d = H x`: displacement at the first participant's points.
    pub displacement: Vec<f64>,
    /// `f`: load at the first participant's points.
    pub load: Vec<f64>,
    /// `F = H^T f`: load at the second participant's points.
    pub transferred_load: Vec<f64>,
}

impl Interface {
    /// Zero vectors of the right lengths.
    #[must_use]
    pub fn new(first: &impl Participant, second: &impl Participant) -> Self {
        let zeros = |blocks: &[Block]| vec![0.0; port::total_len(blocks)];
        Self {
            x: zeros(second.output()),
            x_tilde: zeros(second.output()),
            r: zeros(second.output()),
            displacement: zeros(first.input()),
            load: zeros(first.output()),
            transferred_load: zeros(second.input()),
        }
    }

    /// `F . (x_tilde - from)` \[J, in 2D J/m\]: the work of the load on the way from there.
    pub(crate) fn work_since(&self, from: &[f64]) -> f64 {
        let way = self.x_tilde.iter().zip(from).map(|(to, from)| to - from);
        way.zip(&self.transferred_load).map(|(way, load)| way * load).sum()
    }

    /// `|f . (H x) - (H^T f) . x| / (|f| |H x|)`, 0/0 = 0; zero where the coupling is one way.
    fn work_defect(&self) -> f64 {
        if self.x.is_empty() {
            return 0.0;
        }
        let defect = dot(&self.load, &self.displacement) - dot(&self.transferred_load, &self.x);
        ratio(defect.abs(), norm(&self.load) * norm(&self.displacement))
    }
}

/// Iterates until the step is converged (`true`) or accepted at the iteration bound (`false`).
///
/// Both participants have begun the step, `interface.x` holds the prediction, `history` is empty. Nothing is
/// committed here.
///
/// # Errors
/// When a participant fails, a value at the interface is not finite, the iteration diverges (see [`divergence`]), or the
/// iteration bound is reached. A participant that fails while the residual grows is reported as a divergence. The
/// history holds every finished iteration, and the observer has seen them all.
///
/// # Panics
/// When the vectors of `interface` do not have the lengths of the participants' blocks.
pub fn solve_step(
    first: &mut impl Participant,
    second: &mut impl Participant,
    transfers: &Transfers,
    choices: &mut Choices,
    interface: &mut Interface,
    history: &mut StepHistory,
    observer: &mut dyn Observer,
) -> Result<bool, StepFailure> {
    let Choices { accelerator, policy, criterion, max_iterations, at_limit, .. } = choices;
    for iteration in 1..=*max_iterations {
        let limits = policy.limits(history);
        let mut seconds = Seconds::default();
        let mut clock = Instant::now();

        transfers.apply(&interface.x, &mut interface.displacement);
        seconds.transfer += lap(&mut clock);

        let effort = first
            .advance(&interface.displacement, limits.first, &mut interface.load)
            .map_err(|error| explain(error, history))?;
        seconds.fields[0] = FieldSeconds { total: lap(&mut clock), phases: effort.time };
        let first_record = FieldRecord::new(first.name(), limits.first, effort);
        check_finite(&interface.load, first.name(), first.output())?;
        accelerator.correct_first_output(&interface.x, &mut interface.load);
        seconds.acceleration += lap(&mut clock);

        transfers.apply_transpose(&interface.load, &mut interface.transferred_load);
        seconds.transfer += lap(&mut clock);

        let effort = second
            .advance(&interface.transferred_load, limits.second, &mut interface.x_tilde)
            .map_err(|error| explain(error, history))?;
        seconds.fields[1] = FieldSeconds { total: lap(&mut clock), phases: effort.time };
        let second_record = FieldRecord::new(second.name(), limits.second, effort);
        check_finite(&interface.x_tilde, second.name(), second.output())?;

        subtract(&interface.x_tilde, &interface.x, &mut interface.r);
        let residual = finite_norm(&interface.r, second)?;
        history.iterations.push(IterationRecord {
            step: history.step.index,
            iteration,
            residual,
            relative_residual: if residual <= second.resolution() {
                0.0
            } else {
                ratio(residual, norm(&interface.x_tilde))
            },
            work_defect: interface.work_defect(),
            fields: [first_record, second_record],
            acceleration: None,
            seconds,
        });
        let (converged, at_bound) = (criterion.ends_step(history), iteration == *max_iterations);
        let growth = if converged { None } else { divergence::diverged(history, at_bound) };
        let record = history.iterations.last_mut().expect("the record was just pushed");
        if !converged && !at_bound && growth.is_none() {
            clock = Instant::now();
            let answer = record.answer();
            record.acceleration = Some(accelerator.propose(&mut interface.x, &interface.r, answer));
            record.seconds.acceleration += lap(&mut clock);
        }
        record.seconds = record.seconds.to_the_microsecond();
        observer.iteration(record);
        if converged {
            return Ok(true);
        }
        if let Some(growth) = growth {
            return Err(StepFailure::Diverges { growth, field: None });
        }
        check_finite(&interface.x, "acceleration", second.output())?;
    }
    match at_limit {
        AtLimit::Fail => Err(too_many_iterations(history, norm(&interface.x_tilde), second.resolution())),
        AtLimit::Accept => Ok(false),
    }
}

/// Seconds since `clock`, which starts anew.
fn lap(clock: &mut Instant) -> f64 {
    let now = Instant::now();
    now.duration_since(std::mem::replace(clock, now)).as_secs_f64()
}

/// A field that gives up while the residual grows was given what no field can bear.
fn explain(error: ParticipantError, history: &StepHistory) -> StepFailure {
    match divergence::suspected(history) {
        Some(growth) => StepFailure::Diverges { growth, field: Some(Box::new(error)) },
        None => error.into(),
    }
}

/// `|r|`, which may overflow where no component does.
fn finite_norm(r: &[f64], second: &impl Participant) -> Result<f64, StepFailure> {
    let largest = r.iter().enumerate().max_by(|a, b| a.1.abs().total_cmp(&b.1.abs()));
    match (norm(r), largest) {
        (residual, Some((index, &value))) if !residual.is_finite() => Err(StepFailure::NotFinite {
            origin: second.name().to_owned(),
            place: port::place(second.output(), index),
            value,
        }),
        (residual, _) => Ok(residual),
    }
}

fn check_finite(values: &[f64], origin: &str, blocks: &[Block]) -> Result<(), StepFailure> {
    match values.iter().position(|value| !value.is_finite()) {
        None => Ok(()),
        Some(index) => Err(StepFailure::NotFinite {
            origin: origin.to_owned(),
            place: port::place(blocks, index),
            value: values[index],
        }),
    }
}

/// Coupling iterations at the end of a step in which a field must have moved, unless none of them needs it to.
const LATELY: usize = 5;

/// Fields that have not moved lately, where the interface has. (Where it has not, there is nothing to answer.)
fn idle_fields(history: &StepHistory) -> Vec<IdleField> {
    let done = history.iterations.len();
    let moves = |iteration: &IterationRecord| iteration.residual > 0.0;
    if done < LATELY || !history.iterations[done - LATELY..].iter().all(moves) {
        return Vec::new();
    }
    let idle = |index: usize| {
        // What is at round-off cannot answer, however low its bound.
        if history.iterations[done - LATELY..].iter().any(|iteration| iteration.fields[index].at_round_off) {
            return None;
        }
        let moved = history.iterations.iter().rposition(|iteration| iteration.fields[index].newton > 0);
        let moved_last = moved.map_or(0, |position| position + 1);
        let name = history.iterations[0].fields[index].name.clone();
        (done - moved_last >= LATELY).then_some(IdleField { name, moved_last })
    };
    [0, 1].into_iter().filter_map(idle).collect()
}

/// An interface that moves by less than this many times its resolution hardly moves.
const HARDLY: f64 = 1e4;

fn too_many_iterations(history: &StepHistory, displacement: f64, resolution: f64) -> StepFailure {
    let last = history.last().expect("the iteration bound is at least one");
    let open: Vec<&str> =
        last.fields.iter().filter(|field| !field.converged).map(|field| field.name.as_str()).collect();
    StepFailure::TooManyIterations {
        iterations: history.iterations.len(),
        residual: last.residual,
        relative_residual: last.relative_residual,
        largest_change: last.largest_change(),
        open: if open.is_empty() {
            "both fields below their own bounds".to_owned()
        } else {
            format!("above the own residual bound: {}", open.join(", "))
        },
        stands_since: divergence::stands_since(history),
        idle: idle_fields(history),
        hardly_moves: (displacement < HARDLY * resolution).then_some(displacement),
    }
}
