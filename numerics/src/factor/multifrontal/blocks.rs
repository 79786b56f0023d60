//! Equations that share their neighbours, and the graph of these blocks.

use crate::Pattern;

/// Equations with one and the same column pattern, put together.
///
/// The free dofs of a node have the same neighbours, so a block is a node, whatever its number of free dofs; the
/// pattern tells it without being asked. Nodes that happen to share all neighbours become one block, which is
/// welcome: they can be eliminated together without any additional fill.
pub(super) struct Blocks {
    /// The equations of block `b` are `equations[start[b]..start[b + 1]]`, ascending.
    start: Vec<usize>,
    equations: Vec<usize>,
    /// The blocks next to block `b`, itself not among them: `neighbours[neighbour_start[b]..neighbour_start[b + 1]]`.
    neighbour_start: Vec<usize>,
    neighbours: Vec<usize>,
}

impl Blocks {
    pub(super) fn new(pattern: &Pattern) -> Self {
        let (block_of, count) = group(pattern);
        let mut start = vec![0; count + 1];
        for &block in &block_of {
            start[block + 1] += 1;
        }
        for block in 0..count {
            start[block + 1] += start[block];
        }
        let mut next = start.clone();
        let mut equations = vec![0; block_of.len()];
        for (equation, &block) in block_of.iter().enumerate() {
            equations[next[block]] = equation;
            next[block] += 1;
        }
        let (mut neighbour_start, mut neighbours) = (vec![0], Vec::new());
        let mut seen = vec![usize::MAX; count];
        for block in 0..count {
            seen[block] = block;
            let first = neighbours.len();
            for &row in rows(pattern, equations[start[block]]) {
                let other = block_of[row];
                if seen[other] != block {
                    seen[other] = block;
                    neighbours.push(other);
                }
            }
            neighbours[first..].sort_unstable();
            neighbour_start.push(neighbours.len());
        }
        Self { start, equations, neighbour_start, neighbours }
    }

    /// The number of blocks.
    pub(super) fn len(&self) -> usize {
        self.start.len() - 1
    }

    /// The equations of a block.
    pub(super) fn equations(&self, block: usize) -> &[usize] {
        &self.equations[self.start[block]..self.start[block + 1]]
    }

    /// The blocks next to a block.
    pub(super) fn neighbours(&self, block: usize) -> &[usize] {
        &self.neighbours[self.neighbour_start[block]..self.neighbour_start[block + 1]]
    }

    /// The graph as compressed lists: where the neighbours of each block start, and the neighbours.
    pub(super) fn graph(&self) -> (&[usize], &[usize]) {
        (&self.neighbour_start, &self.neighbours)
    }
}

fn rows(pattern: &Pattern, column: usize) -> &[usize] {
    &pattern.row_idx()[pattern.col_ptr()[column]..pattern.col_ptr()[column + 1]]
}

/// The block of each equation, and the number of blocks.
fn group(pattern: &Pattern) -> (Vec<usize>, usize) {
    let mut block_of = vec![usize::MAX; pattern.size()];
    // Sums of rows tell most columns apart before their rows are compared.
    let sums: Vec<usize> = (0..pattern.size()).map(|column| rows(pattern, column).iter().sum()).collect();
    let mut count = 0;
    for column in 0..pattern.size() {
        let own = rows(pattern, column);
        // Every column holds its diagonal, so equal columns are each other's neighbours.
        let twin = own
            .iter()
            .take_while(|&&row| row < column)
            .find(|&&row| sums[row] == sums[column] && rows(pattern, row) == own);
        block_of[column] = twin.map_or(count, |&row| block_of[row]);
        count += usize::from(twin.is_none());
    }
    (block_of, count)
}
