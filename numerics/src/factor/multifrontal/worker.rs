//! Who eliminates and solves: one worker for each share of the tree, all but the last at the same time.

use std::thread;

use super::kernels::NoPivot;
use super::numeric::Numeric;
use super::solve::SolveSpace;
use super::symbolic::{Front, Share, Symbolic};

/// Factors of a share, and the room to make them and to solve with them. Workers share nothing that is written.
pub(super) struct Worker {
    numeric: Numeric,
    space: SolveSpace,
    /// The front that had no pivot left, by its first one, and in which column.
    failure: Option<(usize, NoPivot)>,
    is_done: bool,
}

/// An equation, in the order of elimination, whose block has no pivot left.
pub(super) struct Stuck(pub(super) usize);

impl Worker {
    /// Nothing if memory does not suffice.
    pub(super) fn new(symbolic: &Symbolic, share: &Share) -> Option<Self> {
        Some(Self {
            numeric: Numeric::new(symbolic, share)?,
            space: SolveSpace::new(symbolic, share)?,
            failure: None,
            is_done: false,
        })
    }

    pub(super) fn factor_bytes(&self) -> usize {
        self.numeric.bytes()
    }

    /// Eliminates the fronts of a share of subtrees, and goes down the tree with the right-hand side, which reads L while it
    /// is in the cache.
    fn refactor(&mut self, symbolic: &Symbolic, share: &Share, values: &[f64], rhs: &[f64]) {
        let Self { numeric, space, .. } = self;
        space.load(symbolic, share, rhs);
        self.failure = share.fronts(symbolic).find_map(|front| {
            let nobody = |_| unreachable!("the subtrees of a share are whole");
            let outcome = numeric.eliminate(symbolic, front, values, nobody);
            if outcome.is_ok() {
                space.forward(symbolic, numeric, front);
            }
            outcome.err().map(|no_pivot| (front.first, no_pivot))
        });
    }

    /// Whether this front is where it got stuck.
    fn passed(&self, front: &Front) -> Result<(), Stuck> {
        match self.failure {
            Some((first, NoPivot(column))) if first == front.first => Err(Stuck(first + column)),
            _ => Ok(()),
        }
    }
}

/// Factors the matrix and replaces `rhs` by the solution.
///
/// Where numbers of several shares meet, the order is that of one thread: in what a front takes from its children, in what
/// the right-hand side loses to the fronts below, and in which failure is the first.
pub(super) fn refactor_and_solve(
    symbolic: &Symbolic,
    workers: &mut [Worker],
    values: &[f64],
    rhs: &mut [f64],
) -> Result<(), Stuck> {
    let (top, below) = workers.split_last_mut().expect("a top");
    at_once(symbolic, below, |worker, share| worker.refactor(symbolic, share, values, rhs));
    let Worker { numeric, space, .. } = top;
    space.load(symbolic, symbolic.top(), rhs);
    for front in &symbolic.fronts {
        if let Some(worker) = below.get(front.share) {
            worker.passed(front)?;
            space.receive(symbolic, front, &worker.space);
        } else {
            let others = |share: usize| &below[share].numeric;
            let outcome = numeric.eliminate(symbolic, front, values, others);
            outcome.map_err(|NoPivot(column)| Stuck(front.first + column))?;
            space.forward(symbolic, numeric, front);
        }
    }
    backward(symbolic, top, below);
    top.space.store(symbolic, rhs);
    Ok(())
}

/// Replaces `rhs` by the solution.
pub(super) fn solve(symbolic: &Symbolic, workers: &mut [Worker], rhs: &mut [f64]) {
    let (top, below) = workers.split_last_mut().expect("a top");
    at_once(symbolic, below, |Worker { numeric, space, .. }, share| {
        space.load(symbolic, share, rhs);
        share.fronts(symbolic).for_each(|front| space.forward(symbolic, numeric, front));
    });
    let Worker { numeric, space, .. } = top;
    space.load(symbolic, symbolic.top(), rhs);
    for front in &symbolic.fronts {
        match below.get(front.share) {
            Some(worker) => space.receive(symbolic, front, &worker.space),
            None => space.forward(symbolic, numeric, front),
        }
    }
    backward(symbolic, top, below);
    top.space.store(symbolic, rhs);
}

/// The way up: the top first, then the subtrees, which read the solution there.
fn backward(symbolic: &Symbolic, top: &mut Worker, below: &mut [Worker]) {
    let Worker { numeric, space, .. } = top;
    space.backward(symbolic, numeric, symbolic.top());
    at_once(symbolic, below, |worker, share| {
        symbolic.top().fronts(symbolic).for_each(|front| worker.space.copy_pivots(front, space));
        worker.space.backward(symbolic, &worker.numeric, share);
    });
    for (worker, share) in below.iter().zip(&symbolic.shares) {
        share.fronts(symbolic).for_each(|front| space.copy_pivots(front, &worker.space));
    }
}

/// Lets every worker do its part in a thread of its own, the first one in this thread.
///
/// The start of a thread is all that allocates here. Where the system refuses one, its part is done afterwards: a thread that
/// is missing costs time and nothing else.
fn at_once(symbolic: &Symbolic, workers: &mut [Worker], part: impl Fn(&mut Worker, &Share) + Sync) {
    if workers.is_empty() {
        return;
    }
    let work = |(worker, share): (&mut Worker, &Share)| {
        part(worker, share);
        worker.is_done = true;
    };
    for worker in &mut *workers {
        worker.is_done = false;
    }
    thread::scope(|scope| {
        let mut parts = workers.iter_mut().zip(&symbolic.shares);
        let first = parts.next();
        for part in parts {
            let started = thread::Builder::new().spawn_scoped(scope, || work(part));
            drop(started);
        }
        first.into_iter().for_each(work);
    });
    workers.iter_mut().zip(&symbolic.shares).filter(|(worker, _)| !worker.is_done).for_each(work);
}
