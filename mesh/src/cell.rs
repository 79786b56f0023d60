//! Cells: all of one kind, their nodes in one flat list.

use std::slice::ChunksExact;

/// The shape of a cell and the order of its nodes (that of VTK).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum CellKind {
    /// Two end points.
    Line2,
    /// Two end points and a point between them.
    Line3,
    /// Three corners, counter-clockwise.
    Triangle3,
    /// Three corners, then a point on each of the edges `(0 1) (1 2) (2 0)`.
    Triangle6,
    /// Four corners, counter-clockwise.
    Quadrilateral4,
    /// Four corners, then a point on each of the edges `(0 1) (1 2) (2 3) (3 0)`.
    Quadrilateral8,
    /// As [`Quadrilateral8`](Self::Quadrilateral8), and a point in the middle.
    Quadrilateral9,
    /// Four corners; seen from outside each face `(0 2 1) (0 1 3) (1 2 3) (0 3 2)` runs counter-clockwise.
    Tetrahedron4,
}

impl CellKind {
    /// Number of nodes of one cell.
    #[must_use]
    pub const fn node_count(self) -> usize {
        match self {
            Self::Line2 => 2,
            Self::Line3 | Self::Triangle3 => 3,
            Self::Quadrilateral4 | Self::Tetrahedron4 => 4,
            Self::Triangle6 => 6,
            Self::Quadrilateral8 => 8,
            Self::Quadrilateral9 => 9,
        }
    }

    /// Dimension of the cell itself, at most that of the space it lies in.
    #[must_use]
    pub const fn dimension(self) -> usize {
        match self {
            Self::Line2 | Self::Line3 => 1,
            Self::Triangle3
            | Self::Triangle6
            | Self::Quadrilateral4
            | Self::Quadrilateral8
            | Self::Quadrilateral9 => 2,
            Self::Tetrahedron4 => 3,
        }
    }

    /// The cell type's number in VTK files.
    #[must_use]
    pub const fn vtk_id(self) -> u8 {
        match self {
            Self::Line2 => 3,
            Self::Line3 => 21,
            Self::Triangle3 => 5,
            Self::Triangle6 => 22,
            Self::Quadrilateral4 => 9,
            Self::Quadrilateral8 => 23,
            Self::Quadrilateral9 => 28,
            Self::Tetrahedron4 => 10,
        }
    }

    /// The simplex that fills a space of `dimension` 1, 2 or 3.
    ///
    /// # Panics
    /// In any other dimension.
    #[must_use]
    pub const fn simplex(dimension: usize) -> Self {
        match dimension {
            1 => Self::Line2,
            2 => Self::Triangle3,
            3 => Self::Tetrahedron4,
            _ => panic!("simplices exist here in 1, 2 and 3 dimensions"),
        }
    }
}

/// Cells of one kind; cell `e` owns the nodes `[e * n, (e + 1) * n)` of the flat list, `n = kind.node_count()`.
///
/// ```
/// use partita_mesh::{CellKind, Cells};
///
/// let cells = Cells::new(CellKind::Triangle3, vec![0, 1, 2, 2, 1, 3]);
/// assert_eq!(cells.len(), 2);
/// assert_eq!(cells.cell(1), [2, 1, 3]);
/// ```
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Cells {
    /// The kind of every cell.
    pub kind: CellKind,
    /// Nodes of all cells, cell after cell.
    pub nodes: Vec<usize>,
}

impl Cells {
    /// Cells from their flat list of nodes.
    ///
    /// # Panics
    /// If the number of nodes is no multiple of the kind's node count.
    #[must_use]
    pub fn new(kind: CellKind, nodes: Vec<usize>) -> Self {
        assert!(
            nodes.len().is_multiple_of(kind.node_count()),
            "{} nodes do not make whole cells of {} nodes",
            nodes.len(),
            kind.node_count()
        );
        Self { kind, nodes }
    }

    /// Number of cells.
    #[must_use]
    pub fn len(&self) -> usize {
        self.nodes.len() / self.kind.node_count()
    }

    /// Whether there is no cell.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.nodes.is_empty()
    }

    /// Nodes of cell `e`.
    ///
    /// # Panics
    /// If there is no cell `e`.
    #[must_use]
    pub fn cell(&self, e: usize) -> &[usize] {
        let n = self.kind.node_count();
        &self.nodes[e * n..(e + 1) * n]
    }

    /// The nodes of one cell after the other.
    pub fn iter(&self) -> ChunksExact<'_, usize> {
        self.nodes.chunks_exact(self.kind.node_count())
    }
}

impl<'a> IntoIterator for &'a Cells {
    type Item = &'a [usize];
    type IntoIter = ChunksExact<'a, usize>;

    fn into_iter(self) -> Self::IntoIter {
        self.iter()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cells_are_sliced_from_one_list() {
        let cells = Cells::new(CellKind::Quadrilateral4, (0..8).collect());
        assert_eq!(cells.len(), 2);
        assert_eq!(cells.cell(1), [4, 5, 6, 7]);
        assert_eq!(cells.iter().count(), 2);
    }

    #[test]
    #[should_panic(expected = "4 nodes do not make whole cells of 3 nodes")]
    fn incomplete_cell_is_refused() {
        let _ = Cells::new(CellKind::Triangle3, vec![0, 1, 2, 3]);
    }

    #[test]
    fn simplex_of_a_dimension_has_one_node_more() {
        for dimension in 1..=3 {
            let kind = CellKind::simplex(dimension);
            assert_eq!(kind.dimension(), dimension);
            assert_eq!(kind.node_count(), dimension + 1);
        }
    }
}
