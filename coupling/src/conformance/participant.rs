//! The contract of a participant.

use super::{Violation, expect};
use crate::participant::ParticipantError;
use crate::participant::{Effort, NewtonLimit, Participant, Step};
use crate::port::total_len;
use crate::vector::{norm, ratio, subtract};

/// What [`check_participant`] works with.
#[derive(Debug, Clone, PartialEq)]
pub struct ParticipantCheck {
    /// The next step of the participant.
    pub step: Step,
    /// Two admissible inputs with clearly different outputs.
    pub inputs: [Vec<f64>; 2],
    /// How far converged outputs may differ after different call histories, relative to the output.
    pub tolerance: f64,
}

/// Checks blocks, Newton limits, efforts, independence of the call history, rewind, and the saved state.
///
/// The participant has one step more committed when the check passes.
///
/// # Errors
/// The first violation. A participant that fails outright violates the contract too.
pub fn check_participant(
    participant: &mut impl Participant,
    check: &ParticipantCheck,
) -> Result<(), Violation> {
    check_blocks(participant, check)?;
    let mut bench = Bench { name: participant.name().to_owned(), participant };
    let [a, b] = &check.inputs;

    // Converged outputs, each from a fresh start.
    bench.begin(&check.step)?;
    let (output_a, effort) = bench.advance(a, NewtonLimit::ToConvergence)?;
    bench.expect(effort.converged, || "an unlimited call came back unconverged".to_owned())?;
    bench.rewind_and_begin(&check.step)?;
    let (output_b, _) = bench.advance(b, NewtonLimit::ToConvergence)?;
    let apart = distance(&output_a, &output_b);
    bench.expect(apart > 10.0 * check.tolerance, || {
        format!("the two inputs lead to the same output within {apart:e}: the check needs others")
    })?;

    // The same after other calls: the residual must be evaluated anew under each input.
    let (again, effort) = bench.advance(a, NewtonLimit::ToConvergence)?;
    bench.expect(!effort.entry_converged, || {
        "the field claims to be converged at entry although its input has changed".to_owned()
    })?;
    bench.expect_close("after a call under other input", &again, &output_a, check.tolerance)?;
    let (again, effort) = bench.advance(a, NewtonLimit::ToConvergence)?;
    bench.expect(effort.entry_converged, || {
        "called again with the same input, the field is not converged at entry".to_owned()
    })?;
    bench.expect_close("called again", &again, &output_a, check.tolerance)?;

    // Limits.
    for most in [1, 2] {
        let (_, effort) = bench.advance(b, NewtonLimit::AtMost(most))?;
        bench.expect(effort.newton <= most, || {
            format!("{} Newton iterations with a limit of {most}", effort.newton)
        })?;
    }
    let (again, _) = bench.advance(b, NewtonLimit::ToConvergence)?;
    bench.expect_close("after limited calls", &again, &output_b, check.tolerance)?;
    bench.advance(a, NewtonLimit::UntilOutputSettles { tolerance: 1e-3 })?;

    // Rewind leaves no trace.
    bench.rewind_and_begin(&check.step)?;
    let (again, _) = bench.advance(a, NewtonLimit::ToConvergence)?;
    bench.expect_same("after rewind", &again, &output_a)?;

    // Commit, then the next step, and rewind there.
    bench.participant.commit();
    let next = Step { index: check.step.index + 1, time: check.step.time + check.step.dt, dt: check.step.dt };
    bench.begin(&next)?;
    let (output, _) = bench.advance(a, NewtonLimit::ToConvergence)?;
    bench.rewind_and_begin(&next)?;
    let (again, _) = bench.advance(a, NewtonLimit::ToConvergence)?;
    bench.expect_same("after commit and rewind", &again, &output)?;
    bench.participant.rewind();

    // A saved state brings back everything that the next step depends on, whatever happened in between.
    let saved = bench.participant.save();
    let later = Step { index: next.index + 1, time: next.time + next.dt, dt: next.dt };
    bench.begin(&next)?;
    bench.advance(b, NewtonLimit::ToConvergence)?;
    bench.participant.commit();
    bench.begin(&later)?;
    bench.advance(b, NewtonLimit::AtMost(1))?;
    bench.participant.rewind();
    let restored = bench.participant.restore(&saved);
    bench.expect(restored.is_ok(), || format!("it refuses its own state: {restored:?}"))?;
    bench.expect(bench.participant.save() == saved, || {
        "the restored state is saved as another one".to_owned()
    })?;
    bench.begin(&next)?;
    let (again, _) = bench.advance(a, NewtonLimit::ToConvergence)?;
    bench.expect_same("after a restart", &again, &output)?;
    bench.participant.rewind();
    Ok(())
}

fn check_blocks(participant: &impl Participant, check: &ParticipantCheck) -> Result<(), Violation> {
    let name = participant.name();
    expect(name, !name.is_empty(), || "the participant has no name".to_owned())?;
    for (what, blocks) in [("input", participant.input()), ("output", participant.output())] {
        let filled = !blocks.is_empty() && blocks.iter().all(|block| !block.is_empty());
        expect(name, filled, || format!("an {what} block is empty"))?;
    }
    let expected = total_len(participant.input());
    for input in &check.inputs {
        expect(name, input.len() == expected, || {
            format!("the check's input has {} values, the blocks {expected}", input.len())
        })?;
    }
    Ok(())
}

/// A participant under test.
struct Bench<'a, P> {
    name: String,
    participant: &'a mut P,
}

impl<P: Participant> Bench<'_, P> {
    fn expect(&self, holds: bool, what: impl FnOnce() -> String) -> Result<(), Violation> {
        expect(&self.name, holds, what)
    }

    fn must<T>(&self, result: Result<T, ParticipantError>) -> Result<T, Violation> {
        result.map_err(|error| Violation { subject: self.name.clone(), what: error.to_string() })
    }

    fn begin(&mut self, step: &Step) -> Result<(), Violation> {
        let result = self.participant.begin_step(step);
        self.must(result)
    }

    fn rewind_and_begin(&mut self, step: &Step) -> Result<(), Violation> {
        self.participant.rewind();
        self.begin(step)
    }

    fn advance(&mut self, input: &[f64], limit: NewtonLimit) -> Result<(Vec<f64>, Effort), Violation> {
        let mut output = vec![f64::NAN; total_len(self.participant.output())];
        let result = self.participant.advance(input, limit, &mut output);
        let effort = self.must(result)?;
        self.expect(output.iter().all(|value| value.is_finite()), || {
            "the output is not finite, or not filled".to_owned()
        })?;
        let residuals = [effort.entry_residual, effort.residual];
        self.expect(residuals.iter().all(|value| *value >= 0.0 && value.is_finite()), || {
            format!("residuals {residuals:?} are no norms")
        })?;
        self.expect(!effort.changes.is_empty(), || "no part reports its change".to_owned())?;
        self.expect(effort.changes.iter().all(|change| change.value >= 0.0), || {
            format!("changes {:?} are no norms", effort.changes)
        })?;
        self.expect(effort.solves >= effort.newton, || {
            format!("{} Newton iterations with {} linear solves", effort.newton, effort.solves)
        })?;
        Ok((output, effort))
    }

    fn expect_close(
        &self,
        when: &str,
        got: &[f64],
        expected: &[f64],
        tolerance: f64,
    ) -> Result<(), Violation> {
        let apart = distance(got, expected);
        self.expect(apart <= tolerance, || {
            format!("{when}, the converged output differs by {apart:e} from that of a fresh start")
        })
    }

    fn expect_same(&self, when: &str, got: &[f64], expected: &[f64]) -> Result<(), Violation> {
        let same = got.iter().zip(expected).all(|(g, e)| g.to_bits() == e.to_bits());
        self.expect(same, || format!("{when}, the same call does not repeat itself bit for bit"))
    }
}

/// `|a - b| / |b|`, 0/0 = 0.
fn distance(a: &[f64], b: &[f64]) -> f64 {
    let mut difference = vec![0.0; a.len()];
    subtract(a, b, &mut difference);
    ratio(norm(&difference), norm(b))
}
