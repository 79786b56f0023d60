//! Everything about the factorization that the pattern alone decides.

use std::ops::Range;

use super::blocks::Blocks;
use super::layout::{Layout, padded};
use super::numbering::{Numbering, rows_below};
use super::split::Split;
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
    /// What each thread eliminates, and last what is left at the top of the tree.
    pub(super) shares: Vec<Share>,
}

/// Fronts that one thread eliminates, and the room that takes.
#[derive(Default)]
pub(super) struct Share {
    /// In postorder.
    pub(super) fronts: Vec<u32>,
    /// Numbers in their factors.
    pub(super) factor_len: usize,
    pub(super) pivots: usize,
    /// Numbers in the two stacks of contributions.
    pub(super) stack_len: [usize; 2],
    /// Rows of its fronts that are pivots of other shares.
    pub(super) outside: usize,
}

/// The dense matrix in which one supernode is eliminated.
pub(super) struct Front {
    /// The first pivot; the others follow it.
    pub(super) first: usize,
    pub(super) layout: Layout,
    /// Who eliminates it, and where it stands there: its factor, its pivots, and what it leaves to rows of other shares.
    pub(super) share: usize,
    pub(super) factor: usize,
    pub(super) pivots: usize,
    pub(super) outside: usize,
    /// Where the contribution to its parent starts in the stack [`side`](Self::side) of its share.
    pub(super) contribution: usize,
    /// Fronts at an even depth use one stack, those at an odd depth the other. A front then reads the contributions of
    /// its children from the top of one stack while it builds its own on top of the other, and nothing is moved.
    pub(super) side: usize,
    pub(super) children: Range<usize>,
    /// Its rows below the pivots, as pivots of the fronts above, ascending.
    pub(super) rows: Range<usize>,
    /// How many of them are pivots of its own share. Those of other shares are higher up in the tree, so they come last.
    pub(super) inside: usize,
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

impl Front {
    /// Its pivots.
    pub(super) fn range(&self) -> Range<usize> {
        self.first..self.first + self.layout.pivots
    }
}

impl Share {
    pub(super) fn fronts<'a>(&'a self, symbolic: &'a Symbolic) -> impl DoubleEndedIterator<Item = &'a Front> {
        self.fronts.iter().map(|&front| &symbolic.fronts[front as usize])
    }
}

/// Indices are stored as 32 bits: half the traffic of the hot loops.
pub(super) fn narrow(index: usize) -> u32 {
    u32::try_from(index).expect("the factorization checks that its indices fit into 32 bits")
}

pub(super) fn wide(range: &Range<usize>, list: &[u32]) -> impl Iterator<Item = usize> {
    list[range.clone()].iter().map(|&index| index as usize)
}

impl Symbolic {
    pub(super) fn new(pattern: &Pattern, blocks: &Blocks, tree: &Tree, split: &Split) -> Self {
        let numbering = Numbering::new(blocks, tree, pattern.size());
        let mut symbolic = Self {
            equations: numbering.equations.iter().map(|&equation| narrow(equation)).collect(),
            fronts: Vec::new(),
            children: Vec::new(),
            rows: Vec::new(),
            entries: Vec::new(),
            runs: Vec::new(),
            shares: (0..split.shares).map(|_| Share::default()).collect(),
        };
        let rows = rows_below(blocks, tree, &numbering);
        symbolic.add_fronts(tree, &numbering, &rows, split);
        symbolic.place_contributions(tree);
        symbolic.map_contributions(tree);
        symbolic.map_entries(pattern, &numbering);
        symbolic
    }

    /// The share that comes after all others, which is the whole tree for one thread.
    pub(super) fn top(&self) -> &Share {
        self.shares.last().expect("a top")
    }

    fn add_fronts(&mut self, tree: &Tree, numbering: &Numbering, rows: &[Vec<usize>], split: &Split) {
        let mut children: Vec<Vec<usize>> = vec![Vec::new(); rows.len()];
        let end_of_share = ends_of_shares(tree, numbering, split);
        for (front, rows) in rows.iter().enumerate() {
            let (first, end) = (numbering.first[front], numbering.first[front + 1]);
            let layout = Layout { pivots: end - first, rest: rows.len() };
            let own_children = self.children.len()..self.children.len() + children[front].len();
            self.children.extend(children[front].iter().map(|&child| narrow(child)));
            let share = &mut self.shares[split.share[front]];
            let inside = rows.partition_point(|&row| row < end_of_share[front]);
            self.fronts.push(Front {
                first,
                layout,
                share: split.share[front],
                factor: share.factor_len,
                pivots: share.pivots,
                outside: share.outside,
                contribution: 0,
                side: 0,
                children: own_children,
                rows: self.rows.len()..self.rows.len() + rows.len(),
                inside,
                entries: 0..0,
                runs: 0..0,
                split: 0,
            });
            self.rows.extend(rows.iter().map(|&row| narrow(row)));
            share.fronts.push(narrow(front));
            share.factor_len += layout.factor_len();
            share.pivots += layout.pivots;
            share.outside += rows.len() - inside;
            if let Some(parent) = tree.parent[front] {
                children[parent].push(front);
            }
        }
    }

    /// Stack positions. Both stacks of a share are empty again at each root, but for what the roots of its subtrees leave to
    /// another share, which stays.
    fn place_contributions(&mut self, tree: &Tree) {
        for front in (0..self.fronts.len()).rev() {
            self.fronts[front].side = tree.parent[front].map_or(0, |parent| 1 - self.fronts[parent].side);
        }
        let mut tops = vec![[0; 2]; self.shares.len()];
        for front in 0..self.fronts.len() {
            let Front { side, layout, share, .. } = self.fronts[front];
            // The children's contributions are on top of the other stack, and go when this front is done.
            let first_child = wide(&self.fronts[front].children, &self.children)
                .find(|&child| self.fronts[child].share == share);
            let (top, stack_len) = (&mut tops[share], &mut self.shares[share].stack_len);
            self.fronts[front].contribution = top[side];
            top[side] += layout.contribution_len();
            stack_len[side] = stack_len[side].max(top[side]);
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

/// For each front, the first pivot behind the subtree that its share got; at the top, behind all.
fn ends_of_shares(tree: &Tree, numbering: &Numbering, split: &Split) -> Vec<usize> {
    let mut ends = vec![usize::MAX; tree.parent.len()];
    for front in (0..ends.len()).rev() {
        ends[front] = match tree.parent[front] {
            Some(parent) if split.share[parent] == split.share[front] => ends[parent],
            Some(_) => numbering.first[front + 1],
            None => usize::MAX,
        };
    }
    ends
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
