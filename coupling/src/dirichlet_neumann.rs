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

use crate::accelerate::{Answer, Proposal};
use crate::choices::{AtLimit, Choices};
use crate::divergence;
use crate::error::{IdleField, StepFailure};
use crate::observe::Observer;
use crate::participant::{Effort, NewtonLimit, Participant, ParticipantError};
use crate::port::{self, Block};
use crate::record::{FieldRecord, IterationRecord, Seconds, StepHistory};
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
    for iteration in 1..=choices.max_iterations {
        let limits = choices.policy.limits(history);
        let mut time = Stopwatch::start();
        let Interface { x, x_tilde, r, displacement, load, transferred_load } = interface;

        transfers.apply(x, displacement);
        time.lap(|seconds| &mut seconds.transfer);
        let first_call = call(first, limits.first, displacement, load, history)?;
        time.call(0, &first_call);
        choices.accelerator.correct_first_output(x, load);
        time.lap(|seconds| &mut seconds.acceleration);
        transfers.apply_transpose(load, transferred_load);
        time.lap(|seconds| &mut seconds.transfer);
        let second_call = call(second, limits.second, transferred_load, x_tilde, history)?;
        time.call(1, &second_call);
        subtract(x_tilde, x, r);

        let fields = [
            FieldRecord::new(first.name(), limits.first, first_call),
            FieldRecord::new(second.name(), limits.second, second_call),
        ];
        history.iterations.push(record(iteration, history.step.index, interface, fields, second)?);
        let (converged, at_bound) =
            (choices.criterion.ends_step(history), iteration == choices.max_iterations);
        let growth = if converged { None } else { divergence::diverged(history, at_bound) };
        let record = history.iterations.last_mut().expect("the record was just pushed");
        if !converged && !at_bound && growth.is_none() {
            time.restart();
            record.acceleration = Some(propose(choices, interface, record.answer()));
            time.lap(|seconds| &mut seconds.acceleration);
        }
        record.seconds = time.seconds.to_the_microsecond();
        observer.iteration(record);
        if converged {
            return Ok(true);
        }
        if let Some(growth) = growth {
            return Err(StepFailure::Diverges { growth, field: None });
        }
        check_finite(&interface.x, "acceleration", second.output())?;
    }
    match choices.at_limit {
        AtLimit::Fail => Err(too_many_iterations(history, norm(&interface.x_tilde), second.resolution())),
        AtLimit::Accept => Ok(false),
    }
}

/// Lets a participant answer `input`, and checks the answer.
fn call(
    participant: &mut impl Participant,
    limit: NewtonLimit,
    input: &[f64],
    output: &mut [f64],
    history: &StepHistory,
) -> Result<Effort, StepFailure> {
    let effort = participant.advance(input, limit, output).map_err(|error| explain(error, history))?;
    check_finite(output, participant.name(), participant.output())?;
    Ok(effort)
}

/// The next iterate, from an accelerator that is named if no setting can name it.
fn propose(choices: &mut Choices, interface: &mut Interface, answer: Answer) -> Proposal {
    let accelerator = &mut choices.accelerator;
    let proposal = accelerator.propose(&mut interface.x, &interface.r, answer);
    if choices.is_custom {
        Proposal { method: Some(accelerator.name().to_owned()), ..proposal }
    } else {
        proposal
    }
}

/// The record of an iteration, without what follows on it: acceleration and times.
fn record(
    iteration: usize,
    step: usize,
    interface: &Interface,
    fields: [FieldRecord; 2],
    second: &impl Participant,
) -> Result<IterationRecord, StepFailure> {
    let residual = finite_norm(&interface.r, second)?;
    let is_round_off = residual <= second.resolution();
    Ok(IterationRecord {
        step,
        iteration,
        residual,
        relative_residual: if is_round_off { 0.0 } else { ratio(residual, norm(&interface.x_tilde)) },
        work_defect: interface.work_defect(),
        fields,
        acceleration: None,
        seconds: Seconds::default(),
    })
}

/// Where the time of one iteration goes: each lap counts from the end of the one before.
struct Stopwatch {
    since: Instant,
    seconds: Seconds,
}

impl Stopwatch {
    fn start() -> Self {
        Self { since: Instant::now(), seconds: Seconds::default() }
    }

    fn restart(&mut self) {
        self.since = Instant::now();
    }

    /// Adds the lap to one of the sums.
    fn lap(&mut self, sum: impl FnOnce(&mut Seconds) -> &mut f64) {
        let now = Instant::now();
        *sum(&mut self.seconds) += now.duration_since(std::mem::replace(&mut self.since, now)).as_secs_f64();
    }

    /// The lap was a call of the first (0) or of the second (1) field.
    fn call(&mut self, field: usize, effort: &Effort) {
        self.lap(|seconds| &mut seconds.fields[field].total);
        self.seconds.fields[field].phases = effort.time;
    }
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
