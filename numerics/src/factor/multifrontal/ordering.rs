//! The order in which the blocks are eliminated.

use feral_amd::CscPattern;
use feral_metis::MetisOptions;

use super::blocks::Blocks;
use super::tree::Tree;

/// Above this many equations nested dissection is never much worse than minimum degree, and soon much better.
const DISSECT_ABOVE: usize = 50_000;

/// The elimination tree of an order with little fill; nothing if memory does not suffice.
///
/// Minimum degree (Amestoy, Davis, Duff 1996) and nested dissection (Karypis, Kumar 1998) take turns at being the better one
/// on meshes of moderate size, by up to a third of the operations, so that both are tried there.
pub(super) fn tree(blocks: &Blocks, equations: usize) -> Option<Tree> {
    let dissected = Tree::new(blocks, &nested_dissection(blocks)?);
    if equations > DISSECT_ABOVE {
        return Some(dissected);
    }
    let other = Tree::new(blocks, &minimum_degree(blocks)?);
    let cost = |tree: &Tree| tree.operations.iter().sum::<f64>();
    Some(if cost(&dissected) < cost(&other) { dissected } else { other })
}

fn minimum_degree(blocks: &Blocks) -> Option<Vec<usize>> {
    with_graph(blocks, |graph| feral_amd::amd_order(graph).ok())
}

fn nested_dissection(blocks: &Blocks) -> Option<Vec<usize>> {
    let options = MetisOptions::default();
    with_graph(blocks, |graph| feral_metis::metis_order_full(graph, &options).ok().map(|(order, ..)| order))
}

fn with_graph(
    blocks: &Blocks,
    order: impl FnOnce(&CscPattern<'_>) -> Option<Vec<i32>>,
) -> Option<Vec<usize>> {
    let (start, neighbours) = blocks.graph();
    let narrow = |list: &[usize]| list.iter().map(|&i| i32::try_from(i).ok()).collect::<Option<Vec<i32>>>();
    let (start, neighbours) = (narrow(start)?, narrow(neighbours)?);
    let order = order(&CscPattern::new(blocks.len(), &start, &neighbours)?)?;
    order.into_iter().map(|block| usize::try_from(block).ok()).collect()
}

#[cfg(test)]
mod tests {
    use super::super::layout::Layout;
    use super::super::split::Split;
    use super::super::symbolic::Symbolic;
    use super::*;
    use crate::{Connectivity, DofMap, Pattern};

    /// Three dofs a node on a grid of `n` x `n` squares, each cut into two triangles.
    fn grid(n: usize) -> Pattern {
        let node = |i, j| j * (n + 1) + i;
        let squares = (0..n * n).map(|square| (square % n, square / n)).flat_map(|(i, j)| {
            let [a, b, c, d] = [node(i, j), node(i + 1, j), node(i + 1, j + 1), node(i, j + 1)];
            [a, b, c, a, c, d]
        });
        let triangles = Connectivity::from_nodes(3, &squares.collect::<Vec<_>>(), 3);
        Pattern::new(&DofMap::new(&vec![false; 3 * (n + 1) * (n + 1)]), &[&triangles])
    }

    /// Fronts, entries of L and U, and the order folded into one number.
    fn describe(pattern: &Pattern, order: impl Fn(&Blocks) -> Option<Vec<usize>>) -> String {
        let blocks = Blocks::new(pattern);
        let order = order(&blocks).unwrap();
        let mut sorted = order.clone();
        sorted.sort_unstable();
        assert!(sorted.into_iter().eq(0..blocks.len()), "an order is a permutation");
        // Fowler, Noll and Vo's hash.
        let hash = order.iter().fold(0xCBF2_9CE4_8422_2325_u64, |hash, &block| {
            (hash ^ block as u64).wrapping_mul(0x0100_0000_01B3)
        });
        let tree = Tree::new(&blocks, &order);
        let symbolic = Symbolic::new(pattern, &blocks, &tree, &Split::none(tree.parent.len()));
        let entries = |&Layout { pivots, rest }: &Layout| pivots * pivots + 2 * pivots * rest;
        let entries: usize = symbolic.fronts.iter().map(|front| entries(&front.layout)).sum();
        format!("{} fronts, {entries} entries, {hash:016x}", symbolic.fronts.len())
    }

    /// A changed order changes the last digits of every solution: that needs a decision, not an upgrade.
    #[test]
    fn orderings_are_those_they_were() {
        let pattern = grid(40);
        insta::assert_snapshot!(describe(&pattern, minimum_degree), @"321 fronts, 672507 entries, 09efcc12a96136db");
        insta::assert_snapshot!(describe(&pattern, nested_dissection), @"277 fronts, 751041 entries, cbff69a6a369cd91");
    }
}
