//! A factorization by several threads is that by one, in every bit and in every failure.

use partita_numerics::{Connectivity, DofMap, Factor, FactorError, Method, Pattern};

use crate::grid::{self, Flow};
use crate::random::vector;

const FLOW: Flow = Flow { viscosity: 1e-3, dt: 1e-2, velocity: [1.0, 0.5] };

/// What a factor says of a matrix: the outcome and the fallbacks so far, the error of its trial, and a solution.
#[derive(Debug, PartialEq)]
struct Answer {
    outcome: Result<(), FactorError>,
    fallbacks: usize,
    trial_error: u64,
    solution: Vec<u64>,
}

fn answer(factor: &mut Factor, values: &[f64]) -> Answer {
    let outcome = factor.refactor(values);
    let mut solution = vector(factor.size());
    if outcome.is_ok() {
        factor.solve(solution.as_mut_slice());
    }
    Answer {
        outcome,
        fallbacks: factor.fallbacks(),
        trial_error: factor.trial_error().to_bits(),
        solution: solution.iter().map(|number| number.to_bits()).collect(),
    }
}

/// The answers of one thread, compared with those of two and three.
fn answers(pattern: &Pattern, matrices: &[&[f64]]) -> Vec<Answer> {
    let of = |threads| {
        let mut factor = Factor::with_threads(Method::NodeBlockLu, pattern, threads).unwrap();
        matrices.iter().map(|values| answer(&mut factor, values)).collect::<Vec<_>>()
    };
    let one = of(1);
    // Without the numbers, which would fill the screen.
    assert!(of(2) == one && of(3) == one, "threads change the answers");
    one
}

#[test]
fn flows_have_the_same_bits() {
    let system = grid::flow(62, FLOW, true);
    assert!(system.pattern.size() > 10_000, "too small for a second thread");
    let doubled: Vec<f64> = system.values.iter().map(|value| 2.0 * value).collect();
    let answers = answers(&system.pattern, &[&system.values, &doubled]);
    assert!(answers.iter().all(|answer| answer.outcome.is_ok() && answer.fallbacks == 0));
}

#[test]
fn a_pressure_without_level_is_the_same_error() {
    let singular = grid::flow(62, FLOW, false);
    let answers = answers(&singular.pattern, &[&singular.values]);
    assert!(answers[0].outcome.is_err());
}

#[test]
fn a_chain_without_static_pivots_falls_back_the_same_way() {
    let size = 12_000;
    let links = Connectivity::new(2, (1..size).flat_map(|i| [i - 1, i]).collect());
    let pattern = Pattern::new(&DofMap::new(&vec![false; size]), &[&links]);
    let with_diagonal = |diagonal| {
        let mut values = vec![1.0; pattern.nonzeros()];
        for equation in 0..size {
            values[pattern.slot(equation, equation).unwrap()] = diagonal;
        }
        values
    };
    let [zero, sound] = [0.0, 5.0].map(with_diagonal);
    let answers = answers(&pattern, &[&zero, &sound, &zero]);
    assert_eq!(answers.iter().map(|answer| answer.fallbacks).collect::<Vec<_>>(), [1, 1, 2]);
}
