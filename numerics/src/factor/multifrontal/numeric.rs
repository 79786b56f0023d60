//! The numeric phase: fronts are assembled and eliminated from the leaves to the roots.
//!
//! A front adds up the contributions of its children in one order, whoever eliminated them.

use pulp::Arch;

use super::aligned::Aligned;
use super::kernels::{Eliminate, NoPivot, Scratch};
use super::layout::{Layout, Parts, padded};
use super::symbolic::{Entry, Front, Run, Share, Symbolic, wide};

/// The factors of the fronts of one share, and the room in which they come about.
pub(super) struct Numeric {
    pub(super) arch: Arch,
    factors: Aligned,
    /// For each pivot, the row of its front's diagonal block that was taken for it.
    interchanges: Vec<u32>,
    stacks: [Aligned; 2],
    scratch: Scratch,
}

impl Numeric {
    /// Nothing if memory does not suffice.
    pub(super) fn new(symbolic: &Symbolic, share: &Share) -> Option<Self> {
        let [even, odd] = share.stack_len;
        Some(Self {
            arch: Arch::new(),
            factors: Aligned::zeros(share.factor_len)?,
            interchanges: vec![0; share.pivots],
            stacks: [Aligned::zeros(even)?, Aligned::zeros(odd)?],
            scratch: Scratch::new(symbolic.widest()),
        })
    }

    pub(super) fn bytes(&self) -> usize {
        size_of_val(&*self.factors) + size_of_val(&*self.interchanges)
    }

    /// The factor of a front of this share, and the interchanges of its pivots.
    pub(super) fn of(&self, front: &Front) -> (&[f64], &[u32]) {
        let Layout { pivots, .. } = front.layout;
        let factor = &self.factors[front.factor..front.factor + front.layout.factor_len()];
        (factor, &self.interchanges[front.pivots..front.pivots + pivots])
    }

    /// Assembles and eliminates a front whose children are done, in this share or in one of the `others`.
    pub(super) fn eliminate<'a>(
        &mut self,
        symbolic: &Symbolic,
        front: &Front,
        values: &[f64],
        others: impl Fn(usize) -> &'a Self,
    ) -> Result<(), NoPivot> {
        let layout = front.layout;
        let factor = &mut self.factors[front.factor..front.factor + layout.factor_len()];
        let [even, odd] = &mut self.stacks;
        let (own, childrens) = if front.side == 0 { (even, odd) } else { (odd, even) };
        let contribution = &mut own[front.contribution..front.contribution + layout.contribution_len()];
        factor.fill(0.0);
        for &Entry { slot, place } in &symbolic.entries[front.entries.clone()] {
            factor[place as usize] = values[slot as usize];
        }
        let contributions = || {
            wide(&front.children, &symbolic.children).map(|child| {
                let child = &symbolic.fronts[child];
                let is_own = child.share == front.share;
                let stack = if is_own { &**childrens } else { &others(child.share).stacks[child.side] };
                Contribution::of(child, symbolic, stack)
            })
        };
        for child in contributions() {
            child.add_to_pivots(layout, &mut layout.parts_mut(factor));
        }
        let interchanges = &mut self.interchanges[front.pivots..front.pivots + layout.pivots];
        Eliminate { layout, factor, contribution, interchanges, scratch: &mut self.scratch }
            .run(self.arch)?;
        for child in contributions() {
            child.add_below(layout, contribution);
        }
        Ok(())
    }
}

/// What a child leaves to its parent.
struct Contribution<'a> {
    /// By columns of `height` numbers.
    values: &'a [f64],
    height: usize,
    /// Rows that are pivots of the parent, and rows that stay below them.
    inside: &'a [Run],
    below: &'a [Run],
}

impl<'a> Contribution<'a> {
    fn of(child: &Front, symbolic: &'a Symbolic, stack: &'a [f64]) -> Self {
        let runs = &symbolic.runs[child.runs.clone()];
        let (inside, below) = runs.split_at(child.split - child.runs.start);
        let values = &stack[child.contribution..child.contribution + child.layout.contribution_len()];
        Contribution { values, height: padded(child.layout.rest), inside, below }
    }

    /// Adds what lies in rows or columns of the parent's pivots.
    fn add_to_pivots(&self, parent: Layout, parts: &mut Parts<&mut [f64]>) {
        let (square, tall) = (padded(parent.pivots), padded(parent.rest));
        for (column, to) in self.columns(self.inside) {
            add(column, self.inside, &mut parts.diagonal[to * square..][..square]);
            add(column, self.below, &mut parts.lower[to * tall..][..tall]);
        }
        for (column, to) in self.columns(self.below) {
            add_transposed(column, self.inside, &mut parts.upper[to..], tall);
        }
    }

    /// Adds the others to the parent's own contribution.
    fn add_below(&self, parent: Layout, contribution: &mut [f64]) {
        let tall = padded(parent.rest);
        for (column, to) in self.columns(self.below) {
            add(column, self.below, &mut contribution[to * tall..][..tall]);
        }
    }

    /// The columns of these runs, and where they go.
    fn columns(&self, runs: &'a [Run]) -> impl Iterator<Item = (&'a [f64], usize)> {
        let Self { values, height, .. } = *self;
        runs.iter().flat_map(move |run| {
            let start = run.from as usize * height;
            let columns = values[start..].chunks_exact(height).take(run.len as usize);
            columns.zip(run.to as usize..)
        })
    }
}

fn add(column: &[f64], runs: &[Run], target: &mut [f64]) {
    for run in runs {
        let (from, to, len) = (run.from as usize, run.to as usize, run.len as usize);
        for (target, value) in target[to..to + len].iter_mut().zip(&column[from..from + len]) {
            *target += value;
        }
    }
}

/// Adds a column to a row of a matrix with columns of `height` numbers.
fn add_transposed(column: &[f64], runs: &[Run], row: &mut [f64], height: usize) {
    for run in runs {
        let (from, to, len) = (run.from as usize, run.to as usize, run.len as usize);
        for (target, value) in row[to * height..].iter_mut().step_by(height).zip(&column[from..from + len]) {
            *target += value;
        }
    }
}
