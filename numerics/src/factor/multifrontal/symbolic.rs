//! Everything about the factorization that the pattern alone decides.

use std::ops::Range;

use super::blocks::Blocks;
use super::layout::{Layout, padded};
use super::tree::Tree;
use crate::Pattern;

/// The fronts, and the lists that move numbers between matrix, fronts and vectors.
///
/// Equations are renumbered in the order of their elimination; a *pivot* is an equation in that numbering.
pub(super) struct Symbolic {
    /// The equation of each pivot.
    pub(super) equations: Vec<u32>,
    /// In postorder.
    pub(super) fronts: Vec<Front>,
    /// Children of each front, see [`Front::children`].
    pub(super) children: Vec<u32>,
    /// Rows below the pivots of each front, see [`Front::rows`].
    pub(super) rows: Vec<u32>,
    /// Where matrix values go, see [`Front::entries`].
    pub(super) entries: Vec<Entry>,
    /// Where contributions go, see [`Front::runs`].
    pub(super) runs: Vec<Run>,
    /// Numbers in the factors of all fronts.
    pub(super) factor_len: usize,
    /// Numbers in the two stacks of contributions.
    pub(super) stack_len: [usize; 2],
}

/// The dense matrix in which one supernode is eliminated.
pub(super) struct Front {
    /// The first pivot; the others follow it.
    pub(super) first: usize,
    pub(super) layout: Layout,
    /// Where its factor starts.
    pub(super) factor: usize,
    /// Where the contribution to its parent starts in the stack [`side`](Self::side).
    pub(super) contribution: usize,
    /// Fronts at an even depth use one stack, those at an odd depth the other. A front then reads the contributions of
    /// its children from the top of one stack while it builds its own on top of the other, and nothing is moved.
    pub(super) side: usize,
    pub(super) children: Range<usize>,
    /// Its rows below the pivots, as pivots of the fronts above, ascending.
    pub(super) rows: Range<usize>,
    pub(super) entries: Range<usize>,
    /// How its rows lie in its parent; the runs among the parent's pivots end at `split`.
    pub(super) runs: Range<usize>,
    pub(super) split: usize,
}

/// One value of the matrix: where it stands in the pattern, and where in the factor of its front.
#[derive(Clone, Copy)]
pub(super) struct Entry {
    pub(super) slot: u32,
    pub(super) place: u32,
}

/// Rows that follow each other in a child and in its parent.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Run {
    /// The first of them among the rows below the child's pivots.
    pub(super) from: u32,
    /// The first of them among the parent's pivots, or among the rows below them.
    pub(super) to: u32,
    pub(super) len: u32,
}

/// Indices are stored as 32 bits: half the traffic of the hot loops.
pub(super) fn narrow(index: usize) -> u32 {
    u32::try_from(index).expect("the factorization checks that its indices fit into 32 bits")
}

pub(super) fn wide(range: &Range<usize>, list: &[u32]) -> impl Iterator<Item = usize> {
    list[range.clone()].iter().map(|&index| index as usize)
}

impl Symbolic {
    pub(super) fn new(pattern: &Pattern, blocks: &Blocks, tree: &Tree) -> Self {
        let numbering = Numbering::new(blocks, tree, pattern.size());
        let mut symbolic = Self {
            equations: numbering.equations.iter().map(|&equation| narrow(equation)).collect(),
            fronts: Vec::new(),
            children: Vec::new(),
            rows: Vec::new(),
            entries: Vec::new(),
            runs: Vec::new(),
            factor_len: 0,
            stack_len: [0; 2],
        };
        let rows = rows_below(blocks, tree, &numbering);
        symbolic.add_fronts(tree, &numbering, &rows);
        symbolic.place_contributions(tree);
        symbolic.map_contributions(tree);
        symbolic.map_entries(pattern, &numbering);
        symbolic
    }

    fn add_fronts(&mut self, tree: &Tree, numbering: &Numbering, rows: &[Vec<usize>]) {
        let mut children: Vec<Vec<usize>> = vec![Vec::new(); rows.len()];
        for (front, rows) in rows.iter().enumerate() {
            let (first, end) = (numbering.first[front], numbering.first[front + 1]);
            let layout = Layout { pivots: end - first, rest: rows.len() };
            let own_children = self.children.len()..self.children.len() + children[front].len();
            self.children.extend(children[front].iter().map(|&child| narrow(child)));
            self.fronts.push(Front {
                first,
                layout,
                factor: self.factor_len,
                contribution: 0,
                side: 0,
                children: own_children,
                rows: self.rows.len()..self.rows.len() + rows.len(),
                entries: 0..0,
                runs: 0..0,
                split: 0,
            });
            self.rows.extend(rows.iter().map(|&row| narrow(row)));
            self.factor_len += layout.factor_len();
            if let Some(parent) = tree.parent[front] {
                children[parent].push(front);
            }
        }
    }

    /// Stack positions; both stacks are empty again at each root.
    fn place_contributions(&mut self, tree: &Tree) {
        for front in (0..self.fronts.len()).rev() {
            self.fronts[front].side = tree.parent[front].map_or(0, |parent| 1 - self.fronts[parent].side);
        }
        let mut top = [0; 2];
        for front in 0..self.fronts.len() {
            // The children's contributions are on top of the other stack, and go when this front is done.
            let first_child = wide(&self.fronts[front].children, &self.children).next();
            let Front { side, layout, .. } = self.fronts[front];
            self.fronts[front].contribution = top[side];
            top[side] += layout.contribution_len();
            self.stack_len[side] = self.stack_len[side].max(top[side]);
            if let Some(child) = first_child {
                top[1 - side] = self.fronts[child].contribution;
            }
        }
    }

    fn map_contributions(&mut self, tree: &Tree) {
        for child in 0..self.fronts.len() {
            let start = self.runs.len();
            let mut split = start;
            if let Some(parent) = tree.parent[child] {
                let parent = &self.fronts[parent];
                let rows: Vec<usize> = wide(&self.fronts[child].rows, &self.rows).collect();
                let inside = rows.partition_point(|&row| row < parent.first + parent.layout.pivots);
                let below: Vec<usize> = wide(&parent.rows, &self.rows).collect();
                let targets: Vec<usize> = rows[inside..]
                    .iter()
                    .map(|row| below.binary_search(row).expect("a parent has the rows of its children"))
                    .collect();
                let pivots: Vec<usize> = rows[..inside].iter().map(|&row| row - parent.first).collect();
                push_runs(&mut self.runs, 0, &pivots);
                split = self.runs.len();
                push_runs(&mut self.runs, inside, &targets);
            }
            self.fronts[child].runs = start..self.runs.len();
            self.fronts[child].split = split;
        }
    }

    fn map_entries(&mut self, pattern: &Pattern, numbering: &Numbering) {
        // Where a row stands below the pivots of the current front.
        let mut place_below = vec![usize::MAX; pattern.size()];
        for front in &mut self.fronts {
            let start = self.entries.len();
            for (place, row) in wide(&front.rows, &self.rows).enumerate() {
                place_below[row] = place;
            }
            let (first, end) = (front.first, front.first + front.layout.pivots);
            for pivot in first..end {
                let column = numbering.equations[pivot];
                for slot in pattern.col_ptr()[column]..pattern.col_ptr()[column + 1] {
                    let equation = pattern.row_idx()[slot];
                    let row = numbering.pivots[equation];
                    if row < first {
                        continue;
                    }
                    if row < end {
                        let place = front.layout.diagonal(row - first, pivot - first);
                        self.entries.push(Entry { slot: narrow(slot), place: narrow(place) });
                        continue;
                    }
                    let mirrored = pattern.slot(column, equation).expect("patterns are symmetric");
                    let below = place_below[row];
                    let lower = front.layout.lower(below, pivot - first);
                    let upper = front.layout.upper(pivot - first, below);
                    self.entries.push(Entry { slot: narrow(slot), place: narrow(lower) });
                    self.entries.push(Entry { slot: narrow(mirrored), place: narrow(upper) });
                }
            }
            front.entries = start..self.entries.len();
        }
    }

    /// Doubles of the widest column of a front, with padding.
    pub(super) fn widest(&self) -> usize {
        let widths =
            self.fronts.iter().map(|front| padded(front.layout.rest).max(padded(front.layout.pivots)));
        widths.max().unwrap_or(0)
    }
}

/// The order of elimination, equation by equation.
struct Numbering {
    /// The equation of each pivot.
    equations: Vec<usize>,
    /// The pivot of each equation.
    pivots: Vec<usize>,
    /// The first pivot of each supernode, and the number of pivots.
    first: Vec<usize>,
}

impl Numbering {
    fn new(blocks: &Blocks, tree: &Tree, size: usize) -> Self {
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
fn rows_below(blocks: &Blocks, tree: &Tree, numbering: &Numbering) -> Vec<Vec<usize>> {
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

/// Adds runs of targets that follow each other; the first target belongs to row `from`.
fn push_runs(runs: &mut Vec<Run>, from: usize, targets: &[usize]) {
    let first_new = runs.len();
    for (k, &target) in targets.iter().enumerate() {
        let target = narrow(target);
        match runs[first_new..].last_mut() {
            Some(run) if run.to + run.len == target => run.len += 1,
            _ => runs.push(Run { from: narrow(from + k), to: target, len: 1 }),
        }
    }
}
