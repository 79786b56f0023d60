//! What the cells alone tell: which facets are shared, which lie on the boundary.

use crate::cell::Cells;
use crate::error::MeshError;
use crate::facet::Facet;

/// Neighbours of each cell and the boundary facets of a mesh of simplices.
///
/// Local facet `a` of a cell lies opposite to its local node `a`.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Topology<const D: usize> {
    neighbours: Vec<Option<usize>>,
    boundary: Vec<Facet<D>>,
}

impl<const D: usize> Topology<D> {
    /// Pairs the facets of all cells: `O(n log n)` by sorting.
    ///
    /// # Errors
    /// [`MeshError::SharedFacet`] when more than two cells own one facet.
    ///
    /// # Panics
    /// If the cells are not simplices with `D + 1` nodes.
    pub fn new(cells: &Cells) -> Result<Self, MeshError> {
        assert_eq!(cells.kind.node_count(), D + 1, "topology needs simplices with {} nodes", D + 1);
        let sides = sorted_sides::<D>(cells);
        let mut neighbours = vec![None; cells.nodes.len()];
        for same in sides.chunk_by(|a, b| a.key == b.key) {
            match same {
                [_] => {}
                [a, b] => {
                    neighbours[a.index(D)] = Some(b.cell);
                    neighbours[b.index(D)] = Some(a.cell);
                }
                many => {
                    return Err(MeshError::SharedFacet {
                        nodes: many[0].key.to_vec(),
                        cells: many.iter().map(|side| side.cell).collect(),
                    });
                }
            }
        }
        let boundary = (0..neighbours.len())
            .filter(|&i| neighbours[i].is_none())
            .map(|i| {
                let (cell, local) = (i / (D + 1), i % (D + 1));
                Facet { nodes: local_facet(cells.cell(cell), local), cell }
            })
            .collect();
        Ok(Self { neighbours, boundary })
    }

    /// The facets that belong to one cell only, outwards oriented, in the order of their cells.
    #[must_use]
    pub fn boundary(&self) -> &[Facet<D>] {
        &self.boundary
    }

    /// The `D + 1` neighbours of a cell: entry `a` is the cell behind the facet opposite to local node `a`,
    /// `None` on the boundary.
    ///
    /// # Panics
    /// If there is no such cell.
    #[must_use]
    pub fn neighbours(&self, cell: usize) -> &[Option<usize>] {
        &self.neighbours[cell * (D + 1)..(cell + 1) * (D + 1)]
    }
}

/// The boundary facets of a mesh of simplices, outwards oriented, in the order of their cells.
///
/// # Errors
/// [`MeshError::SharedFacet`] when more than two cells own one facet.
///
/// # Panics
/// If the cells are not simplices with `D + 1` nodes.
pub fn boundary_facets<const D: usize>(cells: &Cells) -> Result<Vec<Facet<D>>, MeshError> {
    Ok(Topology::new(cells)?.boundary)
}

/// Nodes of the facet opposite to local node `local`, ordered so that its normal points out of the cell.
///
/// # Panics
/// If the cell has no `D + 1` nodes or no such local node.
#[must_use]
pub fn local_facet<const D: usize>(cell: &[usize], local: usize) -> [usize; D] {
    assert_eq!(cell.len(), D + 1, "a simplex in {D} dimensions has {} nodes", D + 1);
    assert!(local <= D, "a simplex in {D} dimensions has no local node {local}");
    let mut others = cell.iter().enumerate().filter(|&(a, _)| a != local).map(|(_, &node)| node);
    let mut nodes: [usize; D] = std::array::from_fn(|_| others.next().expect("D other nodes remain"));
    // Leaving out an odd vertex keeps the ascending order but turns the orientation.
    if D > 1 && local % 2 == 1 {
        nodes.swap(D - 2, D - 1);
    }
    nodes
}

/// One facet as one cell sees it; equal keys are the same facet.
struct Side<const D: usize> {
    key: [usize; D],
    cell: usize,
    local: usize,
}

impl<const D: usize> Side<D> {
    fn index(&self, dimension: usize) -> usize {
        self.cell * (dimension + 1) + self.local
    }
}

fn sorted_sides<const D: usize>(cells: &Cells) -> Vec<Side<D>> {
    let mut sides = Vec::with_capacity(cells.nodes.len());
    for (cell, nodes) in cells.iter().enumerate() {
        for local in 0..=D {
            let mut key = local_facet(nodes, local);
            key.sort_unstable();
            sides.push(Side { key, cell, local });
        }
    }
    sides.sort_unstable_by_key(|side| (side.key, side.cell));
    sides
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cell::CellKind;

    #[test]
    fn two_triangles_share_one_edge() {
        let cells = Cells::new(CellKind::Triangle3, vec![0, 1, 2, 2, 1, 3]);
        let topology = Topology::<2>::new(&cells).expect("a plain mesh");
        assert_eq!(topology.neighbours(0), [Some(1), None, None]);
        assert_eq!(topology.neighbours(1), [None, None, Some(0)]);
        let edges: Vec<_> = topology.boundary().iter().map(|facet| facet.nodes).collect();
        assert_eq!(edges, [[2, 0], [0, 1], [1, 3], [3, 2]]);
    }

    #[test]
    fn three_triangles_at_one_edge_are_refused() {
        let cells = Cells::new(CellKind::Triangle3, vec![0, 1, 2, 1, 0, 3, 0, 1, 4]);
        let error = Topology::<2>::new(&cells).expect_err("an edge with three cells");
        assert_eq!(error, MeshError::SharedFacet { nodes: vec![0, 1], cells: vec![0, 1, 2] });
    }

    #[test]
    fn faces_of_a_tetrahedron_point_outwards() {
        let points = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        for local in 0..4 {
            let facet = Facet { nodes: local_facet::<3>(&[0, 1, 2, 3], local), cell: 0 };
            let (normal, centre) = (facet.normal(&points), facet.centroid(&points));
            let outwards: f64 = (0..3).map(|i| normal[i] * (centre[i] - 0.25)).sum();
            assert!(outwards > 0.0, "face {local} points inwards: {normal:?}");
        }
    }
}
