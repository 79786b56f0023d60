//! The node-block LU on matrices made of nodes, against faer's LU and against its own promises.

use nalgebra::DVector;
use partita_numerics::{Connectivity, DofMap, Factor, FactorError, Method, Pattern, Scatter};
use proptest::prelude::*;

use crate::grid::{self, Flow};
use crate::random::vector;

/// Pairs of nodes with all their dofs coupled; each node has its own number of dofs, some of them prescribed.
#[derive(Debug, Clone)]
struct Nodes {
    dofs_of_node: Vec<usize>,
    prescribed: Vec<bool>,
    pairs: Vec<(usize, usize)>,
    entries: Vec<f64>,
}

/// Any such graph: a path, a star, several parts, one node, nothing.
fn nodes(most: usize) -> impl Strategy<Value = Nodes> {
    (1..most).prop_flat_map(|count| {
        let dofs_of_node = prop::collection::vec(1_usize..5, count);
        let prescribed = prop::collection::vec(prop::bool::weighted(0.15), 4 * count);
        let pairs = prop::collection::vec((0..count, 0..count), 0..3 * count);
        let entries = prop::collection::vec(-1.0..1.0, 97);
        (dofs_of_node, prescribed, pairs, entries).prop_map(|(dofs_of_node, prescribed, pairs, entries)| {
            Nodes { dofs_of_node, prescribed, pairs, entries }
        })
    })
}

impl Nodes {
    /// Values that need pivots off the diagonal now and then: the diagonal has both signs.
    fn assemble(&self) -> (Pattern, Vec<f64>) {
        let mut first = vec![0];
        first.extend(self.dofs_of_node.iter().scan(0, |sum, dofs| {
            *sum += dofs;
            Some(*sum)
        }));
        let total = first[self.dofs_of_node.len()];
        let dofs = DofMap::new(&self.prescribed[..total]);
        let alone = (0..self.dofs_of_node.len()).map(|node| (node, node));
        let elements: Vec<Connectivity> = alone
            .chain(self.pairs.iter().copied())
            .map(|(a, b)| {
                let mut of_pair: Vec<usize> = (first[a]..first[a + 1]).collect();
                if a != b {
                    of_pair.extend(first[b]..first[b + 1]);
                }
                Connectivity::new(of_pair.len(), of_pair)
            })
            .collect();
        let pattern = Pattern::new(&dofs, &elements.iter().collect::<Vec<_>>());
        let mut values = vec![0.0; pattern.nonzeros()];
        let mut numbers = self.entries.iter().cycle();
        for element in &elements {
            let n = element.dofs_per_element();
            let local: Vec<f64> = numbers.by_ref().take(n * n).copied().collect();
            Scatter::new(&pattern, &dofs, element).add_matrix(0, &local, &mut values);
        }
        for equation in 0..pattern.size() {
            let sign = if equation % 3 == 0 { -1.0 } else { 1.0 };
            values[pattern.slot(equation, equation).unwrap()] += sign * 3.0;
        }
        (pattern, values)
    }
}

fn solved(factor: &mut Factor, rhs: &DVector<f64>) -> DVector<f64> {
    let mut x = rhs.clone();
    factor.solve(x.as_mut_slice());
    x
}

/// Refactors with both methods, and compares one solution; nothing where faer refuses the matrix. With it, whether the fast
/// method did it alone.
fn difference_to_faer(pattern: &Pattern, values: &[f64]) -> Option<(f64, bool)> {
    let rhs = vector(pattern.size());
    let mut faer = Factor::new(Method::Lu, pattern).unwrap();
    faer.refactor(values).ok().filter(|()| faer.trial_error() < 1e-11)?;
    let mut own = Factor::new(Method::NodeBlockLu, pattern).unwrap();
    own.refactor(values).unwrap();
    let expected = solved(&mut faer, &rhs);
    let difference = (solved(&mut own, &rhs) - &expected).norm() / expected.norm().max(1e-300);
    Some((difference, own.fallbacks() == 0))
}

proptest! {
    #[test]
    fn node_blocks_agree_with_faer(nodes in nodes(40)) {
        let (pattern, values) = nodes.assemble();
        if let Some((difference, _)) = difference_to_faer(&pattern, &values) {
            prop_assert!(difference < 1e-9, "{difference:e}");
        }
    }
}

#[test]
fn dense_matrices_of_any_size_agree_with_faer() {
    for size in (1..40).chain([63, 64, 65, 97, 130, 200]) {
        let all = Connectivity::new(size, (0..size).collect());
        let pattern = Pattern::new(&DofMap::new(&vec![false; size]), &[&all]);
        // The digits behind the fourth are as good as random.
        let values: Vec<f64> = vector(size * size).iter().map(|entry| (entry * 1e4).fract()).collect();
        let (difference, alone) = difference_to_faer(&pattern, &values).expect("a regular matrix");
        assert!(alone && difference < 1e-9, "{size}: {difference:e}, alone: {alone}");
    }
}

/// The number the node at (i, j) would have if somebody had shuffled the mesh.
fn shuffled(count: usize) -> Vec<usize> {
    let mut nodes: Vec<usize> = (0..count).collect();
    nodes.sort_by_key(|node| node.wrapping_mul(0x9E37_79B9_7F4A_7C15) ^ (node >> 3));
    nodes
}

#[test]
fn large_fronts_and_shuffled_nodes_agree_with_faer() {
    let n = 60;
    let names = shuffled((n + 1) * (n + 1));
    let nodes: Vec<usize> = grid::triangles(n).into_iter().map(|node| names[node]).collect();
    let triangles = Connectivity::from_nodes(3, &nodes, 3);
    let dofs = DofMap::new(&vec![false; 3 * names.len()]);
    let pattern = Pattern::new(&dofs, &[&triangles]);
    let scatter = Scatter::new(&pattern, &dofs, &triangles);
    let (mut values, numbers) = (vec![0.0; pattern.nonzeros()], vector(81 * triangles.len()));
    for (triangle, local) in numbers.as_slice().chunks_exact(81).enumerate() {
        scatter.add_matrix(triangle, local, &mut values);
    }
    for equation in 0..pattern.size() {
        values[pattern.slot(equation, equation).unwrap()] += 6.0;
    }
    let (difference, alone) = difference_to_faer(&pattern, &values).expect("a regular matrix");
    assert!(alone && difference < 1e-10, "{difference:e}, alone: {alone}");
}

/// `|b - A x|_i / (|A| |x| + |b|)_i` at its largest, after one step of iterative refinement.
fn refined_backward_error(pattern: &Pattern, values: &[f64], factor: &mut Factor) -> f64 {
    let rhs = vector(pattern.size());
    let mut x = solved(factor, &rhs);
    let mut product = rhs.clone();
    pattern.multiply(values, x.as_slice(), product.as_mut_slice());
    x += solved(factor, &(&rhs - &product));
    pattern.multiply(values, x.as_slice(), product.as_mut_slice());
    let sizes: Vec<f64> = values.iter().map(|value| value.abs()).collect();
    let mut scale = rhs.clone();
    pattern.multiply(&sizes, x.abs().as_slice(), scale.as_mut_slice());
    let scale = scale + rhs.abs();
    (&rhs - &product).abs().component_div(&scale).amax()
}

#[test]
fn one_step_of_refinement_leaves_nothing_but_round_off() {
    for reynolds in [1e-2, 1.0, 1e2, 1e4, 1e6] {
        for dt in [1e-6, 1e-2, 1e6] {
            let flow = Flow { viscosity: 1.0 / reynolds, dt, velocity: [1.0, 0.3] };
            let system = grid::flow(30, flow, true);
            let mut factor = Factor::new(Method::NodeBlockLu, &system.pattern).unwrap();
            factor.refactor(&system.values).unwrap();
            let error = refined_backward_error(&system.pattern, &system.values, &mut factor);
            assert!(error < 1e-14, "{error:e} for {flow:?}");
            // These elements are not stabilized against convection: at the highest number pivots may grow.
            assert!(factor.fallbacks() == 0 || reynolds > 1e5, "{flow:?}");
        }
    }
}

/// Beyond 50 000 equations the order is that of nested dissection alone.
#[test]
fn large_system_is_factored_to_round_off_and_tells_its_size() {
    let system = grid::flow(132, Flow { viscosity: 1e-3, dt: 1e-2, velocity: [1.0, 0.3] }, true);
    let equations = system.pattern.size();
    assert!(equations > 50_000, "{equations}");
    let mut factor = Factor::new(Method::NodeBlockLu, &system.pattern).unwrap();
    factor.refactor(&system.values).unwrap();
    let error = refined_backward_error(&system.pattern, &system.values, &mut factor);
    assert!(error < 1e-14 && factor.fallbacks() == 0, "{error:e}");
    // On a grid of N nodes, L fills up to 31/8 N log2 N entries (George 1973). Here is U, too, and nine numbers an entry.
    let bytes = factor.factor_bytes().expect("the node-block LU tells");
    let entries = bytes as f64 / 8.0;
    let nodes = equations as f64 / 3.0;
    let leading = 9.0 * 2.0 * 31.0 / 8.0 * nodes * nodes.log2();
    assert!((0.4..1.0).contains(&(entries / leading)), "{entries} entries, {leading} expected");
}

/// A chain whose diagonal is zero or next to it: the pivots it needs stand in other fronts.
#[test]
fn matrix_without_static_pivots_falls_back_and_says_so() {
    let size = 200;
    let links = Connectivity::new(2, (1..size).flat_map(|i| [i - 1, i]).collect());
    let pattern = Pattern::new(&DofMap::new(&vec![false; size]), &[&links]);
    let known: Vec<f64> = (0..size).map(|i| 1.0 + i as f64).collect();
    let mut factor = Factor::new(Method::NodeBlockLu, &pattern).unwrap();
    for (diagonal, falls_back) in [(0.0, true), (1e-13, true), (5.0, false), (0.0, true), (5.0, false)] {
        let mut values = vec![1.0; pattern.nonzeros()];
        for equation in 0..size {
            values[pattern.slot(equation, equation).unwrap()] = diagonal;
        }
        let before = factor.fallbacks();
        factor.refactor(&values).unwrap();
        assert_eq!(factor.fallbacks(), before + usize::from(falls_back), "diagonal {diagonal}");
        let mut x = vec![0.0; size];
        pattern.multiply(&values, &known, &mut x);
        factor.solve(&mut x);
        assert!(x.iter().zip(&known).all(|(x, known)| (x - known).abs() < 1e-10), "diagonal {diagonal}");
    }
}

#[test]
fn singular_matrix_is_refused_by_both_methods_in_turn() {
    let system = grid::flow(12, Flow { viscosity: 1e-3, dt: 1e-2, velocity: [1.0, 0.5] }, false);
    let mut factor = Factor::new(Method::NodeBlockLu, &system.pattern).unwrap();
    let outcome = factor.refactor(&system.values);
    assert!(
        matches!(outcome, Err(FactorError::Inaccurate { .. } | FactorError::Singular { .. })),
        "{outcome:?}"
    );
}
