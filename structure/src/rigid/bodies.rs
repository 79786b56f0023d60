//! Which cells move as one rigid body, and which bodies hang together.

use std::collections::BTreeMap;

use crate::space::Space;

/// Cells that move as one as long as nothing deforms.
#[derive(Debug, Clone)]
pub(super) struct Body {
    pub(super) cells: usize,
    pub(super) first_cell: usize,
    /// Ascending, each once.
    pub(super) nodes: Vec<usize>,
}

impl Body {
    /// Middle of the nodes \[m\].
    pub(super) fn centre(&self, points: &[[f64; 2]]) -> [f64; 2] {
        let count = self.nodes.len() as f64;
        [0, 1].map(|c| self.nodes.iter().map(|&node| points[node][c]).sum::<f64>() / count)
    }

    /// Largest distance of a node from the centre \[m\].
    pub(super) fn size(&self, points: &[[f64; 2]]) -> f64 {
        let [x, y] = self.centre(points);
        let distance = |&node: &usize| (points[node][0] - x).hypot(points[node][1] - y);
        self.nodes.iter().map(distance).fold(0.0, f64::max)
    }
}

/// The bodies of a space. A patch is one: its elements join along whole sides.
pub(super) fn of(space: &Space<2>) -> Vec<Body> {
    match space {
        Space::Patch(patch) => {
            let cells = patch.spline().element_count();
            vec![Body { cells, first_cell: 0, nodes: (0..space.node_count()).collect() }]
        }
        Space::Lagrange(mesh) => {
            let cells: Vec<&[usize]> = mesh.cells().iter().collect();
            let mut sets = Sets::new(cells.len());
            join_by_two_nodes(&cells, space.node_count(), &mut sets);
            gather(&cells, &mut sets)
        }
    }
}

/// Unites sets of cells that share two nodes or more, until none are left.
fn join_by_two_nodes(cells: &[&[usize]], nodes: usize, sets: &mut Sets) {
    let mut at_node: Vec<Vec<usize>> = vec![Vec::new(); nodes];
    for (cell, of_cell) in cells.iter().enumerate() {
        for &node in *of_cell {
            at_node[node].push(cell);
        }
    }
    loop {
        let mut united = false;
        // The first node that two sets share.
        let mut shared: BTreeMap<(usize, usize), usize> = BTreeMap::new();
        for (node, at) in at_node.iter_mut().enumerate() {
            for cell in at.iter_mut() {
                *cell = sets.leader(*cell);
            }
            at.sort_unstable();
            at.dedup();
            for (i, &a) in at.iter().enumerate() {
                for &b in &at[i + 1..] {
                    if *shared.entry((a, b)).or_insert(node) != node {
                        united |= sets.unite(a, b);
                    }
                }
            }
        }
        if !united {
            return;
        }
    }
}

fn gather(cells: &[&[usize]], sets: &mut Sets) -> Vec<Body> {
    let mut bodies: BTreeMap<usize, Body> = BTreeMap::new();
    for (cell, nodes) in cells.iter().enumerate() {
        let body =
            bodies.entry(sets.leader(cell)).or_insert(Body { cells: 0, first_cell: cell, nodes: Vec::new() });
        body.cells += 1;
        body.nodes.extend_from_slice(nodes);
    }
    let mut bodies: Vec<Body> = bodies.into_values().collect();
    for body in &mut bodies {
        body.nodes.sort_unstable();
        body.nodes.dedup();
    }
    bodies
}

/// Groups of bodies that share nodes.
pub(super) fn assemblies(bodies: &[Body], nodes: usize) -> Vec<Vec<Body>> {
    let mut sets = Sets::new(bodies.len());
    let mut owner = vec![usize::MAX; nodes];
    for (index, body) in bodies.iter().enumerate() {
        for &node in &body.nodes {
            if owner[node] == usize::MAX {
                owner[node] = index;
            }
            sets.unite(owner[node], index);
        }
    }
    let mut groups: BTreeMap<usize, Vec<Body>> = BTreeMap::new();
    for (index, body) in bodies.iter().enumerate() {
        groups.entry(sets.leader(index)).or_default().push(body.clone());
    }
    groups.into_values().map(stiffened).collect()
}

/// Hinged bodies beyond this number are taken for one: what two thousand loose triangles can do is nobody's question.
const MOST_BODIES: usize = 100;

fn stiffened(assembly: Vec<Body>) -> Vec<Body> {
    if assembly.len() <= MOST_BODIES {
        return assembly;
    }
    let mut whole = Body { cells: 0, first_cell: assembly[0].first_cell, nodes: Vec::new() };
    for body in assembly {
        whole.cells += body.cells;
        whole.nodes.extend(body.nodes);
    }
    whole.nodes.sort_unstable();
    whole.nodes.dedup();
    vec![whole]
}

/// Disjoint sets, led by their smallest member.
struct Sets(Vec<usize>);

impl Sets {
    fn new(count: usize) -> Self {
        Self((0..count).collect())
    }

    fn leader(&mut self, mut member: usize) -> usize {
        while self.0[member] != member {
            self.0[member] = self.0[self.0[member]];
            member = self.0[member];
        }
        member
    }

    /// Whether they were apart.
    fn unite(&mut self, a: usize, b: usize) -> bool {
        let (a, b) = (self.leader(a), self.leader(b));
        self.0[a.max(b)] = a.min(b);
        a != b
    }
}
