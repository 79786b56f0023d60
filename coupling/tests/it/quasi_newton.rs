//! Identities between the quasi-Newton methods.

use nalgebra::{DMatrix, DVector};
use partita_coupling::accelerate::{Filter, QuasiNewton};
use partita_coupling::{Acceleration, Accelerator};

/// Unfiltered, with every step kept.
const PLAIN: QuasiNewton = QuasiNewton {
    omega_0: 0.2,
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

/// The iterates of one step until `|r| < tolerance`.
fn solve(
    accelerator: &mut dyn Accelerator,
    map: &Map,
    step: usize,
    tolerance: f64,
    most: usize,
) -> Vec<Vec<f64>> {
    let mut x = vec![0.0; map.a.nrows()];
    let mut iterates = vec![x.clone()];
    let mut r = map.residual(&x, step);
    while norm(&r) >= tolerance && iterates.len() < most {
        accelerator.propose(&mut x, &r);
        r = map.residual(&x, step);
        iterates.push(x.clone());
    }
    assert!(norm(&r) < tolerance, "|r| = {:e} after {} iterations", norm(&r), iterates.len());
    accelerator.step_converged(&x, &r);
    iterates
}

fn methods(settings: QuasiNewton) -> [Acceleration; 3] {
    [Acceleration::IqnIls(settings), Acceleration::IqnImvls(settings), Acceleration::IqnMvj(settings)]
}

fn assert_same_iterates(a: &[Vec<f64>], b: &[Vec<f64>], tolerance: f64) {
    assert_eq!(a.len(), b.len(), "different numbers of iterations");
    for (iteration, (a, b)) in a.iter().zip(b).enumerate() {
        let apart: Vec<f64> = a.iter().zip(b).map(|(a, b)| a - b).collect();
        let apart = norm(&apart) / norm(a).max(1.0);
        assert!(apart < tolerance, "iterates {iteration} differ by {apart:e}");
    }
}

#[test]
fn linear_problem_of_n_unknowns_ends_in_n_plus_two_iterations() {
    for n in 1..=8 {
        let map = Map::new(n, 0.0);
        for method in methods(PLAIN) {
            let iterates = solve(method.build(n).unwrap().as_mut(), &map, 1, 1e-9, n + 2);
            assert!(iterates.len() <= n + 2);
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
    let qr3 = Filter::Qr3 { limit: 1e-2 };
    for filter in [Filter::None, qr3] {
        for (history, relax_first_iteration) in
            [(None, false), (Some(2), false), (None, true), (Some(0), false)]
        {
            let settings = QuasiNewton { history, filter, relax_first_iteration, ..PLAIN };
            let mut implicit = Acceleration::IqnImvls(settings).build(n).unwrap();
            let mut dense = Acceleration::IqnMvj(settings).build(n).unwrap();
            for step in 1..=5 {
                let a = solve(implicit.as_mut(), &map, step, 1e-7, 60);
                let b = solve(dense.as_mut(), &map, step, 1e-7, 60);
                assert_same_iterates(&a, &b, 1e-10);
            }
        }
    }
}

#[test]
fn least_squares_with_one_step_equals_multi_vector_with_none() {
    let n = 10;
    let map = Map::new(n, 0.3);
    let settings = QuasiNewton { history: Some(0), ..PLAIN };
    let mut least_squares = Acceleration::IqnIls(settings).build(n).unwrap();
    let mut multi_vector = Acceleration::IqnMvj(settings).build(n).unwrap();
    for step in 1..=3 {
        let a = solve(least_squares.as_mut(), &map, step, 1e-8, 60);
        let b = solve(multi_vector.as_mut(), &map, step, 1e-8, 60);
        assert_same_iterates(&a, &b, 1e-10);
    }
}

/// The update written with a pseudo-inverse, as in the papers; columns oldest first.
fn textbook_jacobian(previous: &DMatrix<f64>, v: &[DVector<f64>], w: &[DVector<f64>]) -> DMatrix<f64> {
    if v.is_empty() {
        return previous.clone();
    }
    let (v, w) = (DMatrix::from_columns(v), DMatrix::from_columns(w));
    let inverse = v.clone().pseudo_inverse(1e-14).unwrap();
    previous + (w - previous * v) * inverse
}

#[test]
fn multi_vector_jacobian_is_that_of_the_textbook() {
    let n = 9;
    let map = Map::new(n, 0.3);
    let mut accelerator = Acceleration::IqnMvj(PLAIN).build(n).unwrap();
    let mut jacobian = DMatrix::zeros(n, n);
    for step in 1..=4 {
        let ours = solve(accelerator.as_mut(), &map, step, 1e-7, 60);
        let (mut v, mut w) = (Vec::new(), Vec::new());
        let mut theirs = vec![vec![0.0; n]];
        let mut last: Option<(DVector<f64>, DVector<f64>)> = None;
        for _ in 0..ours.len() {
            let x = DVector::from_column_slice(theirs.last().unwrap());
            let r = DVector::from_vec(map.residual(x.as_slice(), step));
            let x_tilde = &x + &r;
            if let Some((r_before, x_tilde_before)) = &last {
                v.push(&r - r_before);
                w.push(&x_tilde - x_tilde_before);
            }
            last = Some((r.clone(), x_tilde.clone()));
            let next = if step == 1 && v.is_empty() {
                x + PLAIN.omega_0 * r
            } else {
                x_tilde - textbook_jacobian(&jacobian, &v, &w) * r
            };
            theirs.push(next.as_slice().to_vec());
        }
        theirs.pop();
        assert_same_iterates(&ours, &theirs, 1e-9);
        jacobian = textbook_jacobian(&jacobian, &v, &w);
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
            let proposal = accelerator.propose(&mut x, &r);
            assert_eq!(proposal.omega.is_some(), relax_first_iteration, "{method:?}");
            if relax_first_iteration {
                let relaxed: Vec<f64> = r.iter().map(|r| PLAIN.omega_0 * r).collect();
                assert_eq!(x, relaxed);
            }
        }
    }
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
                accelerator.propose(&mut x, &r);
            }
            let r = map.residual(&x, 1);
            accelerator.step_converged(&x, &r);
            let state = serde_json::to_value(accelerator.state()).unwrap();
            let kept = match method {
                Acceleration::IqnIls(_) => state["iqn_ils"]["columns"]["all"].as_array().unwrap().len(),
                Acceleration::IqnImvls(_) => state["iqn_imvls"]["steps"][0]["q"].as_array().unwrap().len(),
                _ => rank(&state["iqn_mvj"]["jacobian"], n),
            };
            assert_eq!(kept, expected, "{method:?}");
        }
    }
}

fn rank(jacobian: &serde_json::Value, n: usize) -> usize {
    let entries: Vec<f64> = serde_json::from_value(jacobian.clone()).unwrap();
    DMatrix::from_row_slice(n, n, &entries).rank(1e-10)
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
            let proposal = accelerator.propose(&mut x, &r);
            assert_eq!(proposal.dropped.len(), usize::from(iteration > 0), "{method:?}");
            assert_eq!(proposal.columns, 0);
            let after: Vec<f64> = x_tilde.iter().zip(&x).map(|(x_tilde, x)| x_tilde - x).collect();
            assert!(norm(&after) < 0.9 * before, "{method:?} stalls");
        }
    }
}
