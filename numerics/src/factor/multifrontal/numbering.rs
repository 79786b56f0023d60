//! Which equation is eliminated when, and what it leaves behind.

use super::blocks::Blocks;
use super::tree::Tree;

/// The order of elimination, equation by equation.
pub(super) struct Numbering {
    /// The equation of each pivot.
    pub(super) equations: Vec<usize>,
    /// The pivot of each equation.
    pub(super) pivots: Vec<usize>,
    /// The first pivot of each supernode, and the number of pivots.
    pub(super) first: Vec<usize>,
}

impl Numbering {
    pub(super) fn new(blocks: &Blocks, tree: &Tree, size: usize) -> Self {
        let mut equations = Vec::with_capacity(size);
        let mut first = vec![0];
        for members in &tree.members {
            equations.extend(members.iter().flat_map(|&block| blocks.equations(block)));
            first.push(equations.len());
        }
        let mut pivots = vec![0; size];
        for (pivot, &equation) in equations.iter().enumerate() {
            pivots[equation] = pivot;
        }
        Self { equations, pivots, first }
    }

    /// The first pivot of a block; a block's equations follow each other.
    fn of_block(&self, blocks: &Blocks, block: usize) -> usize {
        self.pivots[blocks.equations(block)[0]]
    }
}

/// The rows below the pivots of each supernode: its blocks' neighbours and its children's rows that come later.
pub(super) fn rows_below(blocks: &Blocks, tree: &Tree, numbering: &Numbering) -> Vec<Vec<usize>> {
    let mut later: Vec<Vec<usize>> = vec![Vec::new(); tree.members.len()];
    let mut rows = Vec::with_capacity(tree.members.len());
    let mut seen = vec![usize::MAX; blocks.len()];
    for (supernode, members) in tree.members.iter().enumerate() {
        let end = numbering.first[supernode + 1];
        // So far what the children left here.
        let mut own = std::mem::take(&mut later[supernode]);
        own.extend(members.iter().flat_map(|&block| blocks.neighbours(block)));
        own.retain(|&block| {
            let is_new = seen[block] != supernode && numbering.of_block(blocks, block) >= end;
            seen[block] = supernode;
            is_new
        });
        own.sort_unstable_by_key(|&block| numbering.of_block(blocks, block));
        let expanded = own.iter().flat_map(|&block| {
            let first = numbering.of_block(blocks, block);
            first..first + blocks.equations(block).len()
        });
        rows.push(expanded.collect());
        if let Some(parent) = tree.parent[supernode] {
            later[parent].extend(own);
        }
    }
    rows
}
