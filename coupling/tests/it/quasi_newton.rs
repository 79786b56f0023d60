//! Identities between the quasi-Newton methods.

use std::collections::VecDeque;

use nalgebra::{DMatrix, DVector};
use partita_coupling::accelerate::{
    Answer, Columns, DropReason, DroppedColumn, Filter, QuasiNewton, StepInverse,
};
use partita_coupling::{Acceleration, Accelerator, Proposal, SetupError, state};

/// Unfiltered, with every step kept.
const PLAIN: QuasiNewton = QuasiNewton {
    omega_0: 0.2,
    omega_unseen: 1.0,
    history: None,
    filter: Filter::None,
    relax_first_iteration: false,
    keep_last_differences: true,
};

/// Numbers between -1 and 1 without structure.
fn noise(seed: usize) -> f64 {
    ((seed as f64 * 12.9898).sin() * 43_758.547).fract()
}

/// The map `x_tilde = A x + c + bend sin(x)` with a matrix `A` that is far from symmetric.
struct Map {
    a: DMatrix<f64>,
    bend: f64,
}

impl Map {
    fn new(n: usize, bend: f64) -> Self {
        let spread = |i: usize| -3.0 * (i + 1) as f64 / n as f64;
        let a = DMatrix::from_fn(n, n, |i, j| {
            if i == j { spread(i) } else { 0.4 * noise(7 * i + j + 1) / (n as f64).sqrt() }
        });
        Self { a, bend }
    }

    fn residual(&self, x: &[f64], step: usize) -> Vec<f64> {
        let x = DVector::from_column_slice(x);
        let c = DVector::from_fn(x.len(), |i, _| noise(31 * step + i + 5));
        (&self.a * &x + c + x.map(f64::sin) * self.bend - x).as_slice().to_vec()
    }
}

fn norm(r: &[f64]) -> f64 {
    DVector::from_column_slice(r).norm()
}

/// Solves one step to `|r| < tolerance` within `most` iterations.
fn solve(accelerator: &mut dyn Accelerator, map: &Map, step: usize, tolerance: f64, most: usize) {
    let mut x = vec![0.0; map.a.nrows()];
    let mut r = map.residual(&x, step);
    let mut iterations = 1;
    while norm(&r) >= tolerance && iterations < most {
        accelerator.propose(&mut x, &r, Answer::default());
        r = map.residual(&x, step);
        iterations += 1;
    }
    assert!(norm(&r) < tolerance, "|r| = {:e} after {iterations} iterations", norm(&r));
    accelerator.step_converged(&x, &r, Answer::default());
}

fn methods(settings: QuasiNewton) -> [Acceleration; 3] {
    [Acceleration::IqnIls(settings), Acceleration::IqnImvls(settings), Acceleration::IqnMvj(settings)]
}

/// Lets two methods propose from the same iterates of a step and compares what they propose.
///
/// The step follows the first. Left to themselves, two runs that differ by a rounding drift apart as the
/// differences `v` shrink: an error eps in `r` is an error eps/|v| in a column.
fn assert_same_proposals(
    first: &mut dyn Accelerator,
    second: &mut dyn Accelerator,
    map: &Map,
    step: usize,
    tolerance: f64,
) {
    let mut x = vec![0.0; map.a.nrows()];
    let mut r = map.residual(&x, step);
    let mut iterations = 0;
    while norm(&r) >= tolerance {
        let mut other = x.clone();
        let proposals =
            [first.propose(&mut x, &r, Answer::default()), second.propose(&mut other, &r, Answer::default())];
        assert_eq!(proposals[0].dropped, proposals[1].dropped, "step {step}, iteration {iterations}");
        let apart: Vec<f64> = x.iter().zip(&other).map(|(a, b)| a - b).collect();
        let apart = norm(&apart) / norm(&x);
        assert!(apart < 1e-10, "step {step}, iteration {iterations}: proposals differ by {apart:e}");
        r = map.residual(&x, step);
        iterations += 1;
        assert!(iterations < 60, "|r| = {:e} after {iterations} iterations", norm(&r));
    }
    first.step_converged(&x, &r, Answer::default());
    second.step_converged(&x, &r, Answer::default());
}

#[test]
fn linear_problem_of_n_unknowns_ends_in_n_plus_two_iterations() {
    for n in 1..=8 {
        let map = Map::new(n, 0.0);
        for method in methods(PLAIN) {
            solve(method.build(n).unwrap().as_mut(), &map, 1, 1e-9, n + 2);
        }
    }
}

#[test]
fn known_linear_jacobian_solves_the_next_step_in_two_iterations() {
    let n = 5;
    let map = Map::new(n, 0.0);
    for method in methods(PLAIN) {
        let mut accelerator = method.build(n).unwrap();
        solve(accelerator.as_mut(), &map, 1, 1e-12, 20);
        solve(accelerator.as_mut(), &map, 2, 1e-9, 2);
    }
}

#[test]
fn implicit_multi_vector_update_equals_the_dense_one() {
    let n = 12;
    let map = Map::new(n, 0.3);
    // Without a filter a factor below 1 strays far on the way, and columns lose the digits that could be compared.
    for (filter, unseen) in [(Filter::None, &[1.0][..]), (Filter::Qr3 { limit: 1e-2 }, &[1.0, 0.3])] {
        for (history, relax_first_iteration) in
            [(None, false), (Some(2), false), (None, true), (Some(0), false)]
        {
            for &omega_unseen in unseen {
                let settings = QuasiNewton { omega_unseen, history, filter, relax_first_iteration, ..PLAIN };
                let mut implicit = Acceleration::IqnImvls(settings).build(n).unwrap();
                let mut dense = Acceleration::IqnMvj(settings).build(n).unwrap();
                for step in 1..=6 {
                    assert_same_proposals(implicit.as_mut(), dense.as_mut(), &map, step, 1e-7);
                }
            }
        }
    }
}

#[test]
fn least_squares_with_one_step_equals_multi_vector_with_none() {
    let n = 10;
    let map = Map::new(n, 0.3);
    for omega_unseen in [1.0, 0.3] {
        let settings = QuasiNewton { history: Some(0), omega_unseen, ..PLAIN };
        let mut least_squares = Acceleration::IqnIls(settings).build(n).unwrap();
        let mut multi_vector = Acceleration::IqnMvj(settings).build(n).unwrap();
        for step in 1..=3 {
            assert_same_proposals(least_squares.as_mut(), multi_vector.as_mut(), &map, step, 1e-8);
        }
    }
}

/// IQN-MVJ written as in the papers: dense matrices, a pseudo-inverse, columns oldest first.
struct Textbook {
    jacobian: DMatrix<f64>,
    v: Vec<DVector<f64>>,
    w: Vec<DVector<f64>>,
    last: Option<(DVector<f64>, DVector<f64>)>,
}

impl Textbook {
    fn observe(&mut self, x: &[f64], r: &[f64]) -> DMatrix<f64> {
        let (x, r) = (DVector::from_column_slice(x), DVector::from_column_slice(r));
        let x_tilde = x + &r;
        if let Some((r_before, x_tilde_before)) = &self.last {
            // Pairs are scaled alike, which changes no update but lets the pseudo-inverse judge ranks.
            let scale = (&r - r_before).norm();
            self.v.push((&r - r_before) / scale);
            self.w.push((&x_tilde - x_tilde_before) / scale);
        }
        self.last = Some((r, x_tilde));
        if self.v.is_empty() {
            return self.jacobian.clone();
        }
        let (v, w) = (DMatrix::from_columns(&self.v), DMatrix::from_columns(&self.w));
        let inverse = v.clone().pseudo_inverse(1e-14).unwrap();
        &self.jacobian + (w - &self.jacobian * v) * inverse
    }
}

impl Accelerator for Textbook {
    fn propose(&mut self, x: &mut [f64], r: &[f64], _: Answer) -> Proposal {
        let jacobian = self.observe(x, r);
        let known = jacobian.amax() > 0.0;
        let update = if known { &jacobian * DVector::from_column_slice(r) } else { DVector::zeros(x.len()) };
        for i in 0..x.len() {
            x[i] += if known { r[i] - update[i] } else { PLAIN.omega_0 * r[i] };
        }
        Proposal::default()
    }
    fn step_converged(&mut self, x: &[f64], r: &[f64], _: Answer) -> Vec<DroppedColumn> {
        self.jacobian = self.observe(x, r);
        self.step_failed();
        Vec::new()
    }
    fn step_failed(&mut self) {
        (self.v, self.w, self.last) = (Vec::new(), Vec::new(), None);
    }
    fn name(&self) -> &'static str {
        "textbook"
    }
    fn save(&self) -> Vec<u8> {
        state::encode(self.jacobian.as_slice())
    }
    fn restore(&mut self, bytes: &[u8]) -> Result<(), SetupError> {
        let size = self.jacobian.nrows();
        let entries: Vec<f64> = state::decode(self.name(), bytes)?;
        self.jacobian = DMatrix::from_vec(size, size, entries);
        Ok(())
    }
}

#[test]
fn multi_vector_methods_are_those_of_the_textbook() {
    let n = 12;
    let map = Map::new(n, 0.3);
    for method in [Acceleration::IqnMvj(PLAIN), Acceleration::IqnImvls(PLAIN)] {
        let mut ours = method.build(n).unwrap();
        let mut textbook =
            Textbook { jacobian: DMatrix::zeros(n, n), v: Vec::new(), w: Vec::new(), last: None };
        for step in 1..=6 {
            assert_same_proposals(ours.as_mut(), &mut textbook, &map, step, 1e-5);
        }
    }
}

#[test]
fn relaxed_first_iteration_is_a_relaxation_in_every_step() {
    let n = 6;
    let map = Map::new(n, 0.3);
    for relax_first_iteration in [false, true] {
        for method in methods(QuasiNewton { relax_first_iteration, ..PLAIN }) {
            let mut accelerator = method.build(n).unwrap();
            solve(accelerator.as_mut(), &map, 1, 1e-7, 60);
            let mut x = vec![0.0; n];
            let r = map.residual(&x, 2);
            let proposal = accelerator.propose(&mut x, &r, Answer::default());
            assert_eq!(proposal.omega.is_some(), relax_first_iteration, "{method:?}");
            if relax_first_iteration {
                let relaxed: Vec<f64> = r.iter().map(|r| PLAIN.omega_0 * r).collect();
                assert_eq!(x, relaxed);
            }
        }
    }
}

#[test]
fn what_no_difference_tells_of_is_relaxed() {
    let n = 6;
    let map = Map::new(n, 0.0);
    let omega_unseen = 0.05;
    for method in methods(QuasiNewton { omega_unseen, ..PLAIN }) {
        let mut accelerator = method.build(n).unwrap();
        let (mut x, mut before) = (vec![0.0; n], vec![0.0; n]);
        let mut seen = map.residual(&x, 1);
        accelerator.propose(&mut x, &seen, Answer::default());
        // One column: the residual across it is multiplied by the factor, whatever the matrix.
        let r = DVector::from_vec(map.residual(&x, 1));
        let v = (&r - DVector::from_vec(std::mem::take(&mut seen))).normalize();
        before.copy_from_slice(&x);
        accelerator.propose(&mut x, r.as_slice(), Answer::default());
        let unseen = &r - &v * v.dot(&r);
        let moved = DVector::from_vec(x) - DVector::from_vec(before);
        let along = map_column(&map, &v);
        let expected = &unseen * omega_unseen - along * v.dot(&r);
        assert!((moved - expected).norm() < 1e-12, "{method:?}");
    }
}

/// The `x` by which the residual of a linear map changes by `v`.
fn map_column(map: &Map, v: &DVector<f64>) -> DVector<f64> {
    let n = v.len();
    (&map.a - DMatrix::identity(n, n)).lu().solve(v).unwrap()
}

#[test]
fn last_differences_of_a_step_are_kept_or_dropped_as_asked() {
    let n = 6;
    let map = Map::new(n, 0.0);
    for (keep_last_differences, expected) in [(true, 3), (false, 2)] {
        let settings = QuasiNewton { keep_last_differences, ..PLAIN };
        for method in methods(settings) {
            let mut accelerator = method.build(n).unwrap();
            let mut x = vec![0.0; n];
            // Four iterations have three differences; the last is not proposed from.
            for _ in 0..3 {
                let r = map.residual(&x, 1);
                accelerator.propose(&mut x, &r, Answer::default());
            }
            let r = map.residual(&x, 1);
            accelerator.step_converged(&x, &r, Answer::default());
            let bytes = accelerator.save();
            let kept = match method {
                Acceleration::IqnIls(_) => state::decode::<Columns>("", &bytes).unwrap().all.len(),
                Acceleration::IqnImvls(_) => {
                    state::decode::<VecDeque<StepInverse>>("", &bytes).unwrap()[0].q.len()
                }
                _ => {
                    let (jacobian, _): (Vec<f64>, VecDeque<Columns>) = state::decode("", &bytes).unwrap();
                    DMatrix::from_row_slice(n, n, &jacobian).rank(1e-10)
                }
            };
            assert_eq!(kept, expected, "{method:?}");
        }
    }
}

#[test]
fn dependent_columns_are_dropped_and_recorded() {
    // Only two directions of the interface move, so a third column within a step depends on two newer ones.
    let n = 10;
    let direction = |seed: usize| DVector::from_fn(n, |i, _| noise(13 * seed + i));
    let a = -(direction(1) * direction(2).transpose() + direction(3) * direction(4).transpose());
    let map = Map { a: a - DMatrix::identity(n, n) * 2.0, bend: 0.0 };
    for method in methods(QuasiNewton { filter: Filter::Qr3 { limit: 1e-2 }, ..PLAIN }) {
        let mut accelerator = method.build(n).unwrap();
        let mut x = vec![0.0; n];
        let mut dropped = Vec::new();
        for _ in 0..6 {
            let r = map.residual(&x, 1);
            dropped.extend(accelerator.propose(&mut x, &r, Answer::default()).dropped);
        }
        assert!(!dropped.is_empty(), "{method:?}");
        for column in &dropped {
            assert_eq!(column.steps_ago, 0);
            assert!(column.column > 0, "the newest column is never the dependent one: {column:?}");
            let DropReason::Dependent { independent } = column.reason else { panic!("{column:?}") };
            assert!(independent < 1e-2, "{column:?}");
        }
    }
}

#[test]
fn frozen_output_stalls_no_method() {
    // The second field answers the same twice, as when its call costs no Newton iteration: w = 0, v != 0.
    let (x_tilde, n) = (vec![1.0, 2.0, 3.0], 3);
    for method in methods(PLAIN) {
        let mut accelerator = method.build(n).unwrap();
        let mut x = vec![0.0; n];
        for iteration in 0..4 {
            let r: Vec<f64> = x_tilde.iter().zip(&x).map(|(x_tilde, x)| x_tilde - x).collect();
            let before = norm(&r);
            let proposal = accelerator.propose(&mut x, &r, Answer::default());
            assert_eq!(proposal.dropped.len(), usize::from(iteration > 0), "{method:?}");
            assert_eq!(proposal.columns, 0);
            let after: Vec<f64> = x_tilde.iter().zip(&x).map(|(x_tilde, x)| x_tilde - x).collect();
            assert!(norm(&after) < 0.9 * before, "{method:?} stalls");
        }
    }
}
