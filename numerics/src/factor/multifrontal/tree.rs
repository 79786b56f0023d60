//! The elimination tree of the blocks, and supernodes on it.

use super::blocks::Blocks;

/// Blocks that are eliminated together, in postorder: children stand before their parent.
pub(super) struct Tree {
    /// The blocks of each supernode in the order of their elimination.
    pub(super) members: Vec<Vec<usize>>,
    /// The supernode that takes up what is left of each one; nothing at the roots.
    pub(super) parent: Vec<Option<usize>>,
    /// What the elimination of each supernode costs, about.
    pub(super) operations: Vec<f64>,
}

impl Tree {
    pub(super) fn new(blocks: &Blocks, order: &[usize]) -> Self {
        let elimination = Elimination::new(blocks, order);
        let merged = amalgamate(&elimination);
        supernodes(&elimination, order, &merged)
    }
}

/// The elimination tree, numbered by the order of elimination.
struct Elimination {
    parent: Vec<Option<usize>>,
    /// Equations of each block.
    pivots: Vec<usize>,
    /// Equations of the rows below each block, fill included.
    below: Vec<usize>,
}

impl Elimination {
    /// Parents as Liu (1986) finds them, with path compression; the rows below by walking the subtree of each row.
    fn new(blocks: &Blocks, order: &[usize]) -> Self {
        let n = order.len();
        let mut position = vec![0; n];
        for (k, &block) in order.iter().enumerate() {
            position[block] = k;
        }
        let earlier = |k: usize| {
            blocks.neighbours(order[k]).iter().map(|&block| position[block]).filter(move |&other| other < k)
        };
        let mut parent = vec![None; n];
        let mut ancestor = vec![usize::MAX; n];
        for k in 0..n {
            for mut node in earlier(k) {
                while ancestor[node] != usize::MAX && ancestor[node] != k {
                    node = std::mem::replace(&mut ancestor[node], k);
                }
                if ancestor[node] == usize::MAX {
                    ancestor[node] = k;
                    parent[node] = Some(k);
                }
            }
        }
        let pivots: Vec<usize> = order.iter().map(|&block| blocks.equations(block).len()).collect();
        let mut below = vec![0; n];
        let mut seen = vec![usize::MAX; n];
        for k in 0..n {
            seen[k] = k;
            for mut node in earlier(k) {
                while seen[node] != k {
                    seen[node] = k;
                    below[node] += pivots[k];
                    node = parent[node].expect("the subtree of a row ends at the row");
                }
            }
        }
        Self { parent, pivots, below }
    }
}

/// The share of explicit zeros that a merged supernode with this many pivots may hold.
///
/// Small fronts cost more by their number than by their size.
fn allowed_zeros(pivots: usize) -> f64 {
    match pivots {
        0..=8 => 0.7,
        9..=24 => 0.4,
        25..=64 => 0.2,
        _ => 0.1,
    }
}

/// Which blocks make a supernode.
struct Merged {
    /// The block that each one is merged into, its parent always; nothing for the last block of a supernode.
    into: Vec<Option<usize>>,
    /// Equations of each supernode, at its last block.
    pivots: Vec<usize>,
}

/// A child with p pivots and q rows below merges into a parent with P pivots and Q rows below at the price of
/// p (P + Q - q) zeros in L and as many in U. Where there is none, the supernode is a fundamental one.
fn amalgamate(tree: &Elimination) -> Merged {
    let n = tree.parent.len();
    let mut pivots = tree.pivots.clone();
    let mut zeros = vec![0_usize; n];
    let mut into = vec![None; n];
    let mut children: Vec<Vec<usize>> = vec![Vec::new(); n];
    for node in 0..n {
        let mut candidates = std::mem::take(&mut children[node]);
        candidates.sort_by_key(|&child| (std::cmp::Reverse(tree.below[child]), child));
        for child in candidates {
            let padding = pivots[child] * (pivots[node] + tree.below[node] - tree.below[child]);
            let merged = pivots[child] + pivots[node];
            let merged_zeros = zeros[child] + zeros[node] + padding;
            let entries = merged * merged.div_ceil(2) + merged * tree.below[node];
            if padding == 0 || (merged_zeros as f64) < allowed_zeros(merged) * entries as f64 {
                pivots[node] = merged;
                zeros[node] = merged_zeros;
                into[child] = Some(node);
            }
        }
        if let Some(parent) = tree.parent[node] {
            children[parent].push(node);
        }
    }
    Merged { into, pivots }
}

/// Numbers the supernodes in postorder.
fn supernodes(tree: &Elimination, order: &[usize], merged: &Merged) -> Tree {
    let n = order.len();
    // Parents come later, so that one pass from the end finds the last block of every supernode.
    let mut last: Vec<usize> = (0..n).collect();
    for node in (0..n).rev() {
        if let Some(into) = merged.into[node] {
            last[node] = last[into];
        }
    }
    let mut children: Vec<Vec<usize>> = vec![Vec::new(); n];
    let mut roots = Vec::new();
    for node in (0..n).filter(|&node| merged.into[node].is_none()) {
        match tree.parent[node] {
            Some(parent) => children[last[parent]].push(node),
            None => roots.push(node),
        }
    }
    let postorder = postorder(&roots, &children);
    let mut number = vec![usize::MAX; n];
    for (supernode, &node) in postorder.iter().enumerate() {
        number[node] = supernode;
    }
    let mut members = vec![Vec::new(); postorder.len()];
    for node in 0..n {
        members[number[last[node]]].push(order[node]);
    }
    let parent = postorder.iter().map(|&node| tree.parent[node].map(|parent| number[last[parent]])).collect();
    let costs = postorder.iter().map(|&node| operations(merged.pivots[node], tree.below[node]));
    Tree { members, parent, operations: costs.collect() }
}

/// Multiplications and additions of the elimination of a dense front: 2/3 p^3 + 2 p^2 q + 2 p q^2.
fn operations(pivots: usize, below: usize) -> f64 {
    let (p, q) = (pivots as f64, below as f64);
    2.0 * p * (p * p / 3.0 + p * q + q * q)
}

fn postorder(roots: &[usize], children: &[Vec<usize>]) -> Vec<usize> {
    let mut result = Vec::new();
    let mut stack: Vec<(usize, usize)> = Vec::new();
    for &root in roots {
        stack.push((root, 0));
        while let Some((node, visited)) = stack.last_mut() {
            if let Some(&child) = children[*node].get(*visited) {
                *visited += 1;
                stack.push((child, 0));
            } else {
                result.push(*node);
                stack.pop();
            }
        }
    }
    result
}
