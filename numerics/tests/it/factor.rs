//! Factorizations against dense algebra, against themselves, and against matrices they must refuse.

use nalgebra::{DMatrix, DVector};
use partita_numerics::{Connectivity, DofMap, Factor, FactorError, Method, Pattern};
use proptest::prelude::*;

use crate::grid::{self, Flow, System};
use crate::random::{elements, to_dense, vector};

const METHODS: [Method; 4] = [Method::Lu, Method::NodeBlockLu, Method::Llt, Method::Ldlt];

/// Those that take unsymmetric matrices.
const UNSYMMETRIC: [Method; 2] = [Method::Lu, Method::NodeBlockLu];

const FLOW: Flow = Flow { viscosity: 1e-3, dt: 1e-2, velocity: [1.0, 0.5] };

/// Solves once, from nothing.
fn solve(method: Method, pattern: &Pattern, values: &[f64], rhs: &DVector<f64>) -> DVector<f64> {
    let mut factor = Factor::new(method, pattern).unwrap();
    factor.refactor(values).unwrap();
    let mut x = rhs.clone();
    factor.solve(x.as_mut_slice());
    x
}

/// The relative difference to the dense solution.
fn error(method: Method, pattern: &Pattern, values: &[f64]) -> f64 {
    if pattern.size() == 0 {
        return 0.0; // The dense solver takes no empty system.
    }
    let rhs = vector(pattern.size());
    let exact = to_dense(pattern, values).lu().solve(&rhs).unwrap();
    (solve(method, pattern, values, &rhs) - &exact).norm() / exact.norm()
}

fn add_to_diagonal(pattern: &Pattern, values: &mut [f64], shift: impl Fn(usize) -> f64) {
    for equation in 0..pattern.size() {
        values[pattern.slot(equation, equation).unwrap()] += shift(equation);
    }
}

/// The matrix with these rows, full.
fn full<const N: usize>(rows: [[f64; N]; N]) -> (Pattern, Vec<f64>) {
    let all = Connectivity::new(N, (0..N).collect());
    let pattern = Pattern::new(&DofMap::new(&[false; N]), &[&all]);
    let values = (0..N * N).map(|k| rows[k % N][k / N]).collect();
    (pattern, values)
}

proptest! {
    #[test]
    fn lu_agrees_with_dense_algebra(elements in elements()) {
        let (pattern, mut values) = elements.assemble();
        // Alternating signs: pivots are taken off the diagonal now and then.
        add_to_diagonal(&pattern, &mut values, |equation| if equation % 2 == 0 { 2.5 } else { -2.5 });
        prop_assume!(pattern.size() > 0);
        let singular_values = to_dense(&pattern, &values).singular_values();
        prop_assume!(singular_values.min() > 1e-3 * singular_values.max());
        for method in UNSYMMETRIC {
            prop_assert!(error(method, &pattern, &values) < 1e-11, "{method:?}");
        }
    }

    #[test]
    fn positive_definite_systems_agree_with_dense_algebra(elements in elements()) {
        let (pattern, mut values) = elements.map(|matrix| matrix.transpose() * matrix).assemble();
        add_to_diagonal(&pattern, &mut values, |_| 0.1);
        for method in METHODS {
            prop_assert!(error(method, &pattern, &values) < 1e-12, "{method:?}");
        }
    }

    #[test]
    fn ldlt_takes_indefinite_systems(elements in elements()) {
        let (pattern, mut values) = elements.map(|matrix| &matrix + matrix.transpose()).assemble();
        add_to_diagonal(&pattern, &mut values, |equation| if equation % 3 == 0 { -40.0 } else { 40.0 });
        prop_assert!(error(Method::Ldlt, &pattern, &values) < 1e-12);
    }
}

#[test]
fn flow_and_elasticity_agree_with_dense_algebra() {
    for n in [1, 4, 9] {
        let flow = grid::flow(n, FLOW, true);
        for method in UNSYMMETRIC {
            assert!(error(method, &flow.pattern, &flow.values) < 1e-11, "{method:?}");
        }
        let body = grid::elasticity(n, 0.3, true);
        for method in METHODS {
            assert!(error(method, &body.pattern, &body.values) < 1e-11, "{method:?}");
        }
    }
}

/// Refactors with other values in between and compares every bit with a fresh factorization.
fn refactored_equals_fresh(method: Method, first: &System, second: &System) {
    assert_eq!(first.pattern, second.pattern);
    let rhs = vector(first.pattern.size());
    let mut factor = Factor::new(method, &first.pattern).unwrap();
    for system in [first, second, first, second] {
        factor.refactor(&system.values).unwrap();
        let mut x = rhs.clone();
        factor.solve(x.as_mut_slice());
        assert_eq!(x, solve(method, &system.pattern, &system.values, &rhs), "{method:?}");
    }
}

#[test]
fn refactored_factor_equals_a_fresh_one_bit_for_bit() {
    let other = Flow { viscosity: 1.0, dt: 1e3, velocity: [0.1, -3.0] };
    for method in UNSYMMETRIC {
        refactored_equals_fresh(method, &grid::flow(12, FLOW, true), &grid::flow(12, other, true));
    }
    for method in METHODS {
        let [first, second] = [0.3, 0.45].map(|poisson_ratio| grid::elasticity(20, poisson_ratio, true));
        refactored_equals_fresh(method, &first, &second);
    }
}

#[test]
fn failed_refactorization_leaves_nothing_behind() {
    let system = grid::elasticity(6, 0.3, true);
    let rhs = vector(system.pattern.size());
    for method in METHODS {
        let mut factor = Factor::new(method, &system.pattern).unwrap();
        let zeros = vec![0.0; system.pattern.nonzeros()];
        assert_eq!(factor.refactor(&zeros), Err(FactorError::Singular { equation: Some(0) }));
        let negative: Vec<f64> = system.values.iter().map(|value| -value).collect();
        assert_eq!(factor.refactor(&negative).is_err(), method == Method::Llt);
        factor.refactor(&system.values).unwrap();
        let mut x = rhs.clone();
        factor.solve(x.as_mut_slice());
        assert_eq!(x, solve(method, &system.pattern, &system.values, &rhs));
    }
}

#[test]
#[should_panic(expected = "solve needs a successful refactor before it")]
fn nothing_is_solved_after_a_failure() {
    let (pattern, values) = full([[1.0, 2.0], [2.0, 4.0]]);
    let mut factor = Factor::new(Method::Lu, &pattern).unwrap();
    factor.refactor(&[1.0, 0.0, 0.0, 1.0]).unwrap();
    assert!(factor.refactor(&values).is_err());
    factor.solve(&mut [1.0, 1.0]);
}

#[test]
fn broken_values_are_named() {
    let (pattern, mut values) = full([[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]);
    for broken in [f64::NAN, f64::INFINITY] {
        values[pattern.slot(2, 1).unwrap()] = broken;
        for method in METHODS {
            let outcome = Factor::new(method, &pattern).unwrap().refactor(&values);
            assert_eq!(outcome, Err(FactorError::NotFinite { row: 2, column: 1 }));
        }
    }
}

#[test]
fn dof_without_an_element_is_named() {
    let bars = Connectivity::new(2, vec![0, 1, 1, 3]);
    let dofs = DofMap::new(&[true, false, false, false]);
    let pattern = Pattern::new(&dofs, &[&bars]);
    let mut values = vec![0.0; pattern.nonzeros()];
    add_to_diagonal(&pattern, &mut values, |equation| if equation == 1 { 0.0 } else { 1.0 });
    for method in METHODS {
        let outcome = Factor::new(method, &pattern).unwrap().refactor(&values);
        assert_eq!(outcome, Err(FactorError::Singular { equation: Some(1) }));
    }
}

#[test]
fn negative_pivot_is_named_whatever_the_ordering() {
    let pattern = grid::elasticity(4, 0.3, true).pattern;
    for negative in 0..pattern.size() {
        let mut values = vec![0.0; pattern.nonzeros()];
        add_to_diagonal(&pattern, &mut values, |equation| if equation == negative { -3.0 } else { 2.0 });
        let outcome = Factor::new(Method::Llt, &pattern).unwrap().refactor(&values);
        assert_eq!(outcome, Err(FactorError::NotPositiveDefinite { equation: negative }));
        assert!(Factor::new(Method::Ldlt, &pattern).unwrap().refactor(&values).is_ok());
    }
}

#[test]
fn small_singular_matrices_are_refused() {
    let (ones, thirds) = (full([[1.0; 3]; 3]), full([[1.0 / 3.0, 2.0 / 3.0], [0.1, 0.2]]));
    let counted = full([[1.0, 2.0, 3.0], [4.0, 5.0, 6.0], [7.0, 8.0, 9.0]]);
    let laplacian = full([[1.0, -1.0, 0.0], [-1.0, 2.0, -1.0], [0.0, -1.0, 1.0]]);
    for (pattern, values) in [&ones, &thirds, &counted, &laplacian] {
        for method in UNSYMMETRIC {
            assert!(Factor::new(method, pattern).unwrap().refactor(values).is_err(), "{method:?}");
        }
    }
    for (method, (pattern, values)) in
        [Method::Llt, Method::Ldlt].into_iter().flat_map(|method| [(method, &ones), (method, &laplacian)])
    {
        assert!(Factor::new(method, pattern).unwrap().refactor(values).is_err(), "{method:?}");
    }
}

/// Flows from creeping to fast, from tiny steps to steady.
fn flows() -> Vec<Flow> {
    let numbers =
        [1e-6, 1.0, 1e3].into_iter().flat_map(|viscosity| [1e-6, 1e-2, 1e6].map(|dt| (viscosity, dt)));
    numbers
        .flat_map(|(viscosity, dt)| {
            [[0.0, 0.0], [1.0, 0.3], [1e3, 0.0]].map(|velocity| Flow { viscosity, dt, velocity })
        })
        .collect()
}

#[test]
fn pressure_fixed_nowhere_is_singular_in_every_flow() {
    for (n, method) in [3, 10, 40].into_iter().flat_map(|n| UNSYMMETRIC.map(|method| (n, method))) {
        for flow in flows() {
            let outcome = |is_fixed| {
                let system = grid::flow(n, flow, is_fixed);
                let mut factor = Factor::new(method, &system.pattern).unwrap();
                factor.refactor(&system.values).map(|()| factor.trial_error())
            };
            let free = outcome(false);
            assert!(
                matches!(free, Err(FactorError::Inaccurate { .. } | FactorError::Singular { .. })),
                "{method:?}: {free:?} for {n}, {flow:?}"
            );
            assert!(outcome(true).unwrap() < 1e-6, "{n}, {flow:?}");
        }
    }
}

#[test]
fn body_without_supports_is_singular_with_every_method() {
    for n in [1, 6, 30, 60] {
        for (method, poisson_ratio) in
            METHODS.into_iter().flat_map(|method| [(method, 0.3), (method, 0.49999)])
        {
            let outcome = |is_fixed| {
                let system = grid::elasticity(n, poisson_ratio, is_fixed);
                let mut factor = Factor::new(method, &system.pattern).unwrap();
                factor.refactor(&system.values).map(|()| factor.trial_error())
            };
            assert!(outcome(false).is_err(), "{method:?} for {n}, {poisson_ratio}");
            assert!(outcome(true).unwrap() < 1e-6, "{method:?} for {n}, {poisson_ratio}");
        }
    }
}

#[test]
fn units_of_the_unknowns_do_not_matter() {
    let system = grid::flow(8, FLOW, true);
    let pattern = &system.pattern;
    let mut values = system.values.clone();
    for column in 0..pattern.size() {
        let unit = 10_f64.powi(i32::try_from(column % 5).unwrap() * 6 - 12);
        for slot in pattern.col_ptr()[column]..pattern.col_ptr()[column + 1] {
            values[slot] *= unit;
        }
    }
    let mut factor = Factor::new(Method::Lu, pattern).unwrap();
    factor.refactor(&values).unwrap();
    assert!(factor.trial_error() < 1e-10);
}

#[test]
fn unsymmetric_values_are_no_business_of_a_symmetric_method() {
    let (pattern, values) = full([[4.0, 1.0, 0.0], [-1.0, 4.0, 1.0], [0.0, -1.0, 4.0]]);
    for method in [Method::Llt, Method::Ldlt] {
        let outcome = Factor::new(method, &pattern).unwrap().refactor(&values);
        assert!(matches!(outcome, Err(FactorError::Inaccurate { .. })), "{method:?}: {outcome:?}");
    }
}

#[test]
fn smallest_systems_work() {
    for method in METHODS {
        assert!(error(method, &full([[3.0]]).0, &[3.0]) < 1e-15);
        let nothing = Pattern::new(&DofMap::new(&[true, true]), &[&Connectivity::new(2, vec![0, 1])]);
        assert_eq!(solve(method, &nothing, &[], &DVector::zeros(0)).len(), 0);
        let diagonal = Pattern::new(&DofMap::new(&[false; 4]), &[]);
        let x = solve(method, &diagonal, &[1.0, 2.0, 4.0, 8.0], &DVector::from_element(4, 8.0));
        assert!((x - DVector::from_vec(vec![8.0, 4.0, 2.0, 1.0])).amax() < 1e-14);
    }
}

#[test]
fn repeated_solves_share_one_factorization() {
    let system = grid::flow(6, FLOW, true);
    let mut factor = Factor::new(Method::Lu, &system.pattern).unwrap();
    factor.refactor(&system.values).unwrap();
    let dense = to_dense(&system.pattern, &system.values);
    let inverse = DMatrix::from_fn(dense.nrows(), dense.ncols(), |i, j| f64::from(u8::from(i == j)));
    for column in inverse.column_iter().take(5) {
        let mut x: DVector<f64> = column.into_owned();
        factor.solve(x.as_mut_slice());
        assert!((&dense * x - column).amax() < 1e-11);
    }
}
