//! The same bits from any number of threads, on matrices far smaller than those that are worth it.

use proptest::prelude::*;

use super::*;
use crate::{Connectivity, DofMap, Scatter};

/// Numbers between -1 and 1 without a pattern.
fn number(k: usize) -> f64 {
    ((1.3 + 7.7 * k as f64).sin() * 1e4).fract()
}

/// Pairs of nodes with all their dofs coupled, and a diagonal of both signs.
fn assemble(dofs_of_node: &[usize], pairs: &[(usize, usize)]) -> (Pattern, Vec<f64>) {
    let mut first = vec![0];
    first.extend(dofs_of_node.iter().scan(0, |sum, dofs| {
        *sum += dofs;
        Some(*sum)
    }));
    let dofs = DofMap::new(&vec![false; first[dofs_of_node.len()]]);
    let elements: Vec<Connectivity> = (0..dofs_of_node.len())
        .map(|node| (node, node))
        .chain(pairs.iter().copied())
        .map(|(a, b)| {
            let second = if a == b { 0..0 } else { first[b]..first[b + 1] };
            let of_pair: Vec<usize> = (first[a]..first[a + 1]).chain(second).collect();
            Connectivity::new(of_pair.len(), of_pair)
        })
        .collect();
    let pattern = Pattern::new(&dofs, &elements.iter().collect::<Vec<_>>());
    let mut values = vec![0.0; pattern.nonzeros()];
    for (element, place) in elements.iter().zip(0..) {
        let n = element.dofs_per_element();
        let local: Vec<f64> = (0..n * n).map(|k| number(k + 64 * place)).collect();
        Scatter::new(&pattern, &dofs, element).add_matrix(0, &local, &mut values);
    }
    for equation in 0..pattern.size() {
        let sign = if equation % 3 == 0 { -1.0 } else { 1.0 };
        values[pattern.slot(equation, equation).expect("a diagonal")] += sign * 5.0;
    }
    (pattern, values)
}

/// The neighbours on a grid of `n` x `n` nodes.
fn grid(n: usize) -> Vec<(usize, usize)> {
    let right = (0..n * n).filter(|node| node % n + 1 < n).map(|node| (node, node + 1));
    let up = (0..n * (n - 1)).map(|node| (node, node + n));
    right.chain(up).collect()
}

fn bits(numbers: &[f64]) -> Vec<u64> {
    numbers.iter().map(|number| number.to_bits()).collect()
}

/// What a factorization says, and both solutions that it gives.
fn outcome(factor: &mut Multifrontal, values: &[f64], size: usize) -> Result<[Vec<u64>; 2], FactorError> {
    let mut at_once: Vec<f64> = (0..size).map(number).collect();
    let mut later = at_once.iter().map(|number| 3.0 - number).collect::<Vec<_>>();
    factor.refactor_and_solve(values, &mut at_once)?;
    factor.solve(&mut later);
    Ok([bits(&at_once), bits(&later)])
}

proptest! {
    #[test]
    fn threads_change_no_bit(
        dofs_of_node in prop::collection::vec(1_usize..5, 1..60),
        pairs in prop::collection::vec((0_usize..60, 0_usize..60), 0..120),
    ) {
        let count = dofs_of_node.len();
        let pairs: Vec<_> = pairs.into_iter().map(|(a, b)| (a % count, b % count)).collect();
        let (pattern, values) = assemble(&dofs_of_node, &pairs);
        let of = |threads| outcome(&mut Multifrontal::new(&pattern, threads).unwrap(), &values, pattern.size());
        let expected = of(1);
        prop_assert!(expected.is_ok());
        prop_assert_eq!(&of(2), &expected);
        prop_assert_eq!(&of(3), &expected);
    }
}

#[test]
fn every_thread_has_its_share_of_a_grid_and_changes_no_bit() {
    let n = 24;
    let (pattern, values) = assemble(&vec![3; n * n], &grid(n));
    let expected = outcome(&mut Multifrontal::new(&pattern, 1).unwrap(), &values, pattern.size());
    for threads in [2, 3, 4] {
        let mut factor = Multifrontal::new(&pattern, threads).unwrap();
        let fronts: Vec<usize> = factor.symbolic.shares.iter().map(|share| share.fronts.len()).collect();
        assert!(fronts.len() == threads + 1 && fronts.iter().all(|&fronts| fronts > 0), "{fronts:?}");
        // The second time there are numbers everywhere.
        for _ in 0..2 {
            assert_eq!(outcome(&mut factor, &values, pattern.size()), expected, "{threads} threads");
        }
    }
}

/// A column of zeros leaves its front without a pivot, wherever that is: the first such front is the one to name.
#[test]
fn fronts_without_pivots_are_named_as_by_one_thread() {
    // Two grids side by side: the top of one comes before the subtrees of the other.
    let n = 9;
    let second = grid(n).into_iter().map(|(a, b)| (a + n * n, b + n * n));
    let pairs: Vec<_> = grid(n).into_iter().chain(second).collect();
    let (pattern, regular) = assemble(&vec![3; 2 * n * n], &pairs);
    let [mut one, mut many] = [1, 4].map(|threads| Multifrontal::new(&pattern, threads).unwrap());
    let expected = outcome(&mut one, &regular, pattern.size());
    let fronts = &many.symbolic.fronts;
    let columns: Vec<(usize, usize)> =
        fronts.iter().map(|front| (front.share, many.symbolic.equations[front.first] as usize)).collect();
    let first_at_the_top = columns.iter().position(|&(share, _)| share == 4);
    assert!(first_at_the_top < columns.iter().rposition(|&(share, _)| share < 4), "{columns:?}");
    let mut shares = Vec::new();
    for &(share, a) in columns.iter().filter(|(share, _)| *share == 4).chain(columns.iter().step_by(3)) {
        for &(_, b) in &columns {
            let mut values = regular.clone();
            for column in [a, b] {
                values[pattern.col_ptr()[column]..pattern.col_ptr()[column + 1]].fill(0.0);
            }
            let failure = outcome(&mut one, &values, pattern.size());
            assert!(matches!(failure, Err(FactorError::Singular { equation: Some(_) })), "{failure:?}");
            assert_eq!(outcome(&mut many, &values, pattern.size()), failure, "columns {a} and {b}");
        }
        shares.push(share);
        // A failure leaves nothing behind.
        assert_eq!(outcome(&mut many, &regular, pattern.size()), expected);
    }
    assert!((0..=4).all(|share| shares.contains(&share)), "{shares:?}");
}
