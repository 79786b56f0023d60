//! Meshes of solids: triangles and quadrilaterals of degree 1 and 2, straight or curved.
//!
//! | module | what it holds |
//! |---|---|
//! | [`mod@reference`] | shape functions, quadrature and edges of the reference cells |
//! | [`locate`] | which cell a point lies in, and where |
//! | [`transfer`] | conservative transfer between points and the boundary |
//! | `boundary` | the edges on the boundary, and the groups among them |

mod boundary;
pub mod locate;
pub mod reference;
pub mod transfer;

use partita_numerics::small;

use crate::Place;
use crate::cell::{CellKind, Cells};
use crate::error::MeshError;
use crate::mesh::{check_finite, check_nodes, check_range};

/// A boundary group as it is given: its name and its edges, of two or three nodes as the cells ask for.
pub type NamedEdges = (String, Cells);

/// Boundary edges that share a name and, later, a boundary condition.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct SolidGroup {
    /// What the user calls it.
    pub name: String,
    /// Its edges, each with the solid on its left: both ends, then the node between them for cells of degree 2.
    pub edges: Cells,
}

/// A valid mesh of a solid with named boundary groups: all cells of one kind, of degree 1 or 2.
///
/// A point of cell e is `x(xi) = sum_a N_a(xi) x_a` (isoparametric). Its determinant det(dx/dxi) is positive at all
/// quadrature points, every node belongs to a cell, every edge of a group lies on the boundary, and no edge is in two
/// groups. Only `D = 2` has kinds of cells so far.
#[derive(Debug, Clone, PartialEq)]
pub struct SolidMesh<const D: usize> {
    points: Vec<[f64; D]>,
    cells: Cells,
    groups: Vec<SolidGroup>,
    boundary_nodes: Vec<usize>,
}

impl<const D: usize> SolidMesh<D> {
    /// Builds a mesh and checks it. A group is its name and its edges, in either direction, the node between the ends
    /// last.
    ///
    /// ```
    /// use partita_mesh::{CellKind, Cells, SolidMesh};
    ///
    /// let points = vec![[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [0.0, 1.0]];
    /// let cells = Cells::new(CellKind::Quadrilateral4, vec![0, 1, 2, 3]);
    /// let wall = ("wall".to_owned(), Cells::new(CellKind::Line2, vec![0, 3]));
    /// let mesh = SolidMesh::new(points, cells, vec![wall])?;
    /// assert_eq!(mesh.group_nodes("wall"), Some(vec![0, 3]));
    /// # Ok::<(), partita_mesh::MeshError>(())
    /// ```
    ///
    /// # Errors
    /// [`MeshError`] names the first cell, node or edge that breaks a rule, where it is, and a remedy.
    ///
    /// # Panics
    /// If the edges of a group have another number of nodes than those of the cells.
    pub fn new(points: Vec<[f64; D]>, cells: Cells, groups: Vec<NamedEdges>) -> Result<Self, MeshError> {
        if cells.is_empty() {
            return Err(MeshError::Empty);
        }
        if D != 2 || !reference::is_plane_solid(cells.kind) {
            return Err(MeshError::NotSolid { found: cells.kind, dimension: D });
        }
        check_nodes(&points, &cells)?;
        check_determinants(&points, &cells)?;
        let boundary = boundary::edges(&cells)?;
        let groups = boundary::groups(&points, &cells, &boundary, groups)?;
        let boundary_nodes = ascending(boundary.into_iter().flat_map(|edge| edge.nodes).collect());
        Ok(Self { points, cells, groups, boundary_nodes })
    }

    /// The same cells and groups on other points: the mesh of another shape.
    ///
    /// # Errors
    /// [`MeshError`] when a point is not finite or a cell is folded.
    ///
    /// # Panics
    /// If the number of points differs.
    pub fn with_points(&self, points: Vec<[f64; D]>) -> Result<Self, MeshError> {
        assert_eq!(points.len(), self.points.len(), "a mesh of another shape keeps its number of points");
        check_finite(&points)?;
        check_determinants(&points, &self.cells)?;
        Ok(Self { points, ..self.clone() })
    }

    /// Coordinates of the nodes `[m]`.
    #[must_use]
    pub fn points(&self) -> &[[f64; D]] {
        &self.points
    }

    /// The cells.
    #[must_use]
    pub fn cells(&self) -> &Cells {
        &self.cells
    }

    /// All boundary groups in the order they were given.
    #[must_use]
    pub fn groups(&self) -> &[SolidGroup] {
        &self.groups
    }

    /// The boundary group of that name.
    #[must_use]
    pub fn group(&self, name: &str) -> Option<&SolidGroup> {
        self.groups.iter().find(|group| group.name == name)
    }

    /// The nodes of a group, ascending, each once.
    #[must_use]
    pub fn group_nodes(&self, name: &str) -> Option<Vec<usize>> {
        Some(ascending(self.group(name)?.edges.nodes.clone()))
    }

    /// Names of all groups, as messages list them.
    #[must_use]
    pub fn group_names(&self) -> String {
        let names: Vec<String> = self.groups.iter().map(|group| format!("`{}`", group.name)).collect();
        if names.is_empty() { "none".to_owned() } else { names.join(", ") }
    }

    /// Nodes of the whole boundary, ascending, each once.
    #[must_use]
    pub fn boundary_nodes(&self) -> &[usize] {
        &self.boundary_nodes
    }

    /// The map of cell `cell` at the point `xi` of its reference cell.
    ///
    /// # Panics
    /// If there is no such cell.
    #[must_use]
    pub fn map(&self, cell: usize, xi: [f64; 2]) -> CellMap<D> {
        map(&self.points, self.cells.kind, self.cells.cell(cell), xi)
    }
}

fn ascending(mut nodes: Vec<usize>) -> Vec<usize> {
    nodes.sort_unstable();
    nodes.dedup();
    nodes
}

/// A cell at one point of its reference cell.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CellMap<const D: usize> {
    /// The shape functions there.
    pub shape: reference::Shape,
    /// `x(xi)` `[m]`
    pub place: [f64; D],
    /// `dx_i/dxi_j` `[m]`
    pub jacobian: [[f64; D]; D],
}

fn map<const D: usize>(points: &[[f64; D]], kind: CellKind, nodes: &[usize], xi: [f64; 2]) -> CellMap<D> {
    let shape = reference::shape(kind, xi);
    let (mut place, mut jacobian) = ([0.0; D], [[0.0; D]; D]);
    for (a, &node) in nodes.iter().enumerate() {
        for i in 0..D {
            place[i] += shape.values[a] * points[node][i];
            for (j, derivative) in shape.derivatives[a].iter().enumerate().take(D) {
                jacobian[i][j] += derivative * points[node][i];
            }
        }
    }
    CellMap { shape, place, jacobian }
}

fn check_determinants<const D: usize>(points: &[[f64; D]], cells: &Cells) -> Result<(), MeshError> {
    let rule = reference::quadrature(cells.kind);
    for (cell, nodes) in cells.iter().enumerate() {
        for &(xi, _) in &rule {
            let CellMap { place, jacobian, .. } = map(points, cells.kind, nodes, xi);
            let determinant = small::determinant(&jacobian);
            // An overflow may leave no number at all, which compares with nothing.
            if !determinant.is_finite() {
                return Err(MeshError::TooLarge { cell, centroid: place.into() });
            }
            // Round-off decides the sign of what is that small beside the edges of the cell.
            let size: f64 = jacobian.iter().flatten().map(|entry| entry * entry).sum();
            if determinant <= 1e-14 * size {
                return Err(MeshError::Folded { cell, place: Place::from(place), determinant });
            }
        }
    }
    Ok(())
}
