//! Which fronts several threads eliminate at once.

/// A set of subtrees of the elimination tree for each thread, and the top of the tree above them.
///
/// It follows from the tree alone, so that the work of a thread, and the room it needs, are known beforehand.
pub(super) struct Split {
    /// For each front, the share that it belongs to. The last share is the top.
    pub(super) share: Vec<usize>,
    pub(super) shares: usize,
}

impl Split {
    /// Everything is the top.
    pub(super) fn none(fronts: usize) -> Self {
        Self { share: vec![0; fronts], shares: 1 }
    }

    /// Shares of about equal cost. `parent` names later fronts, `costs` is that of each front alone.
    ///
    /// The subtrees come about as Geist and Ng (1989) find them: the heaviest is opened, its root joins the top, until
    /// that helps no more. What counts is the time of the heaviest share and of the top, which waits for it.
    pub(super) fn new(parent: &[Option<usize>], costs: &[f64], threads: usize) -> Self {
        if threads < 2 {
            return Self::none(parent.len());
        }
        let (children, roots) = children(parent);
        let subtrees = subtree_costs(parent, costs);
        let mut forest = roots;
        let mut top = 0.0;
        let mut best: (f64, Vec<(usize, usize)>) = (f64::INFINITY, Vec::new());
        loop {
            forest.sort_unstable_by(|a, b| subtrees[*b].total_cmp(&subtrees[*a]).then(a.cmp(b)));
            let (longest, owners) = distribute(&forest, &subtrees, threads);
            if top + longest < best.0 {
                best = (top + longest, owners);
            }
            let heaviest = forest.first().copied().filter(|&front| !children[front].is_empty());
            let Some(heaviest) = heaviest.filter(|front| top + costs[*front] < best.0) else { break };
            top += costs[heaviest];
            forest.swap_remove(0);
            forest.extend(&children[heaviest]);
        }
        Self::of_subtrees(parent, &best.1, threads)
    }

    /// The fronts below the root of each subtree go with it.
    fn of_subtrees(parent: &[Option<usize>], owners: &[(usize, usize)], threads: usize) -> Self {
        let mut share = vec![threads; parent.len()];
        for &(root, owner) in owners {
            share[root] = owner;
        }
        for front in (0..parent.len()).rev() {
            if let Some(above) = parent[front].filter(|&above| share[above] < threads) {
                share[front] = share[above];
            }
        }
        Self { share, shares: threads + 1 }
    }
}

fn children(parent: &[Option<usize>]) -> (Vec<Vec<usize>>, Vec<usize>) {
    let mut children = vec![Vec::new(); parent.len()];
    let mut roots = Vec::new();
    for (front, parent) in parent.iter().enumerate() {
        parent.map_or(&mut roots, |parent| &mut children[parent]).push(front);
    }
    (children, roots)
}

fn subtree_costs(parent: &[Option<usize>], costs: &[f64]) -> Vec<f64> {
    let mut sums = costs.to_vec();
    for (front, parent) in parent.iter().enumerate() {
        if let Some(parent) = *parent {
            sums[parent] += sums[front];
        }
    }
    sums
}

/// Gives each subtree to the thread that has least to do so far. The load of the busiest, and pairs of root and thread.
fn distribute(forest: &[usize], costs: &[f64], threads: usize) -> (f64, Vec<(usize, usize)>) {
    let mut loads = vec![0.0; threads];
    let owners = forest.iter().map(|&root| {
        let least = (0..threads).min_by(|&a, &b| f64::total_cmp(&loads[a], &loads[b])).unwrap_or(0);
        loads[least] += costs[root];
        (root, least)
    });
    let owners = owners.collect();
    (loads.into_iter().fold(0.0, f64::max), owners)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A binary tree of seven fronts in postorder.
    const PARENT: [Option<usize>; 7] = [Some(2), Some(2), Some(6), Some(5), Some(5), Some(6), None];

    #[test]
    fn one_thread_has_no_shares() {
        let split = Split::new(&PARENT, &[1.0; 7], 1);
        assert_eq!((split.share, split.shares), (vec![0; 7], 1));
    }

    #[test]
    fn equal_subtrees_go_to_a_thread_each() {
        let split = Split::new(&PARENT, &[1.0; 7], 2);
        assert_eq!((split.share, split.shares), (vec![0, 0, 0, 1, 1, 1, 2], 3));
    }

    #[test]
    fn a_heavy_subtree_is_opened_where_that_evens_out_the_shares() {
        // Its halves cost 10 each, and its root nothing to speak of.
        let split = Split::new(&PARENT, &[10.0, 10.0, 0.1, 1.0, 1.0, 1.0, 1.0], 2);
        assert_eq!(split.share, [0, 1, 2, 0, 0, 0, 2]);
        // Here both threads would wait for that root.
        let split = Split::new(&PARENT, &[10.0, 10.0, 30.0, 16.0, 16.0, 16.0, 1.0], 2);
        assert_eq!(split.share, [0, 0, 0, 1, 1, 1, 2]);
    }

    #[test]
    fn chains_and_forests_are_split_as_far_as_they_can_be() {
        let chain = [Some(1), Some(2), None];
        assert_eq!(Split::new(&chain, &[1.0; 3], 2).share, [0, 0, 0]);
        assert_eq!(Split::new(&[None; 4], &[4.0, 3.0, 2.0, 1.0], 2).share, [0, 1, 1, 0]);
        assert!(Split::new(&[], &[], 2).share.is_empty());
    }
}
