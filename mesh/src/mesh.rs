//! The mesh: points, simplices and named boundary groups, checked once when it is built.

use std::collections::{HashMap, HashSet};

use crate::Place;
use crate::cell::{CellKind, Cells};
use crate::error::MeshError;
use crate::facet::Facet;
use crate::simplex;
use crate::topology::Topology;

/// A cell whose measure is below this part of `(mean edge)^D` counts as flat: round-off decides its sign.
const FLAT: f64 = 1e-14;

/// A boundary group as it is given: its name and the nodes of its facets.
pub type NamedFacets<const D: usize> = (String, Vec<[usize; D]>);

/// Boundary facets that share a name and, later, a boundary condition.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct BoundaryGroup<const D: usize> {
    /// What the user calls it.
    pub name: String,
    /// Its facets, outwards oriented.
    pub facets: Vec<Facet<D>>,
}

/// A valid mesh of triangles (`D = 2`) or tetrahedra (`D = 3`) with named boundary groups.
///
/// Every cell has a positive measure, every node belongs to a cell, every facet of a group lies on the
/// boundary, and no facet is in two groups. A mesh does not change: a moving mesh is this one plus a
/// displacement.
#[derive(Debug, Clone, PartialEq)]
pub struct Mesh<const D: usize> {
    points: Vec<[f64; D]>,
    cells: Cells,
    groups: Vec<BoundaryGroup<D>>,
    topology: Topology<D>,
}

impl<const D: usize> Mesh<D> {
    /// Builds a mesh and checks it. A group is its name and the nodes of its facets, in any order: the cell
    /// that owns a facet, and so its orientation, follows from the cells.
    ///
    /// ```
    /// use partita_mesh::{CellKind, Cells, Mesh};
    ///
    /// let points = vec![[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]];
    /// let cells = Cells::new(CellKind::Triangle3, vec![0, 1, 2]);
    /// let mesh = Mesh::new(points, cells, vec![("bottom".into(), vec![[1, 0]])])?;
    /// assert_eq!(mesh.groups()[0].facets[0].nodes, [0, 1]);
    /// assert_eq!(mesh.ungrouped_boundary().len(), 2);
    /// # Ok::<(), partita_mesh::MeshError>(())
    /// ```
    ///
    /// # Errors
    /// [`MeshError`] names the first cell, node or facet that breaks a rule, where it is, and a remedy.
    pub fn new(points: Vec<[f64; D]>, cells: Cells, groups: Vec<NamedFacets<D>>) -> Result<Self, MeshError> {
        check_kind::<D>(&cells)?;
        check_nodes(&points, &cells)?;
        check_measures(&points, &cells)?;
        let topology = Topology::new(&cells)?;
        let groups = resolve_groups(&points, &topology, groups)?;
        Ok(Self { points, cells, groups, topology })
    }

    /// The same cells and groups on other points: a mesh moved for good.
    ///
    /// # Errors
    /// [`MeshError`] when a point is not finite or a cell is no longer positive.
    ///
    /// # Panics
    /// If the number of points differs.
    pub fn with_points(&self, points: Vec<[f64; D]>) -> Result<Self, MeshError> {
        assert_eq!(points.len(), self.points.len(), "a moved mesh keeps its number of points");
        check_finite(&points)?;
        check_measures(&points, &self.cells)?;
        Ok(Self { points, ..self.clone() })
    }

    /// Coordinates of the nodes `[m]`.
    #[must_use]
    pub fn points(&self) -> &[[f64; D]] {
        &self.points
    }

    /// The simplices.
    #[must_use]
    pub fn cells(&self) -> &Cells {
        &self.cells
    }

    /// All boundary groups in the order they were given.
    #[must_use]
    pub fn groups(&self) -> &[BoundaryGroup<D>] {
        &self.groups
    }

    /// The boundary group of that name.
    #[must_use]
    pub fn group(&self, name: &str) -> Option<&BoundaryGroup<D>> {
        self.groups.iter().find(|group| group.name == name)
    }

    /// The nodes of a group's facets, sorted, each once.
    #[must_use]
    pub fn group_nodes(&self, name: &str) -> Option<Vec<usize>> {
        Some(facet_nodes(&self.group(name)?.facets))
    }

    /// Neighbours of cells and all boundary facets.
    #[must_use]
    pub fn topology(&self) -> &Topology<D> {
        &self.topology
    }

    /// The boundary facets that no group names, in the order of their cells.
    #[must_use]
    pub fn ungrouped_boundary(&self) -> Vec<Facet<D>> {
        let grouped: HashSet<_> = self.groups.iter().flat_map(|group| &group.facets).collect();
        self.topology.boundary().iter().filter(|facet| !grouped.contains(facet)).copied().collect()
    }
}

/// The nodes of some facets, sorted, each once.
#[must_use]
pub fn facet_nodes<const D: usize>(facets: &[Facet<D>]) -> Vec<usize> {
    let mut nodes: Vec<usize> = facets.iter().flat_map(|facet| facet.nodes).collect();
    nodes.sort_unstable();
    nodes.dedup();
    nodes
}

fn check_kind<const D: usize>(cells: &Cells) -> Result<(), MeshError> {
    if cells.is_empty() {
        return Err(MeshError::Empty);
    }
    if cells.kind != CellKind::simplex(D) {
        return Err(MeshError::WrongKind { found: cells.kind, dimension: D });
    }
    Ok(())
}

pub(crate) fn check_finite<const D: usize>(points: &[[f64; D]]) -> Result<(), MeshError> {
    match points.iter().position(|point| point.iter().any(|x| !x.is_finite())) {
        Some(node) => Err(MeshError::NotFinite { node, coordinates: points[node].to_vec() }),
        None => Ok(()),
    }
}

pub(crate) fn check_nodes<const D: usize>(points: &[[f64; D]], cells: &Cells) -> Result<(), MeshError> {
    check_finite(points)?;
    let mut used = vec![false; points.len()];
    for (index, nodes) in cells.iter().enumerate() {
        check_range(nodes, points.len(), || format!("cell {index}"))?;
        for &node in nodes {
            used[node] = true;
        }
    }
    match used.iter().position(|used| !used) {
        Some(node) => Err(MeshError::UnusedNode { node, place: points[node].into() }),
        None => Ok(()),
    }
}

pub(crate) fn check_range(
    nodes: &[usize],
    count: usize,
    entity: impl Fn() -> String,
) -> Result<(), MeshError> {
    match nodes.iter().find(|&&node| node >= count) {
        Some(&node) => Err(MeshError::NodeOutOfRange { entity: entity(), node, nodes: count }),
        None => Ok(()),
    }
}

fn check_measures<const D: usize>(points: &[[f64; D]], cells: &Cells) -> Result<(), MeshError> {
    for (cell, nodes) in cells.iter().enumerate() {
        let vertices = simplex::vertices(points, nodes);
        let vertices = &vertices[..=D];
        let measure = simplex::measure(vertices);
        // An overflow may leave no number at all, which compares with nothing.
        if !measure.is_finite() {
            return Err(MeshError::TooLarge { cell, centroid: simplex::centroid(vertices).into() });
        }
        let edges = (D * (D + 1) / 2) as f64;
        let mean_edge = (simplex::squared_edges(vertices) / edges).sqrt();
        let smallest = (0..D).fold(FLAT, |product, _| product * mean_edge);
        if measure <= smallest {
            let measure = if measure.abs() <= smallest { 0.0 } else { measure };
            let centroid = Place::from(simplex::centroid(vertices));
            return Err(MeshError::NotPositive { cell, centroid, measure });
        }
    }
    Ok(())
}

/// Finds each named facet among the boundary facets; takes the owner and the orientation from there.
fn resolve_groups<const D: usize>(
    points: &[[f64; D]],
    topology: &Topology<D>,
    groups: Vec<NamedFacets<D>>,
) -> Result<Vec<BoundaryGroup<D>>, MeshError> {
    let boundary: HashMap<_, _> =
        topology.boundary().iter().map(|facet| (key(facet.nodes), *facet)).collect();
    let mut named: HashMap<[usize; D], usize> = HashMap::new();
    let mut resolved: Vec<BoundaryGroup<D>> = Vec::with_capacity(groups.len());
    for (name, facets) in groups {
        if resolved.iter().any(|group| group.name == name) {
            return Err(MeshError::DuplicateGroup { name });
        }
        if facets.is_empty() {
            return Err(MeshError::EmptyGroup { name });
        }
        let mut group = BoundaryGroup { name, facets: Vec::with_capacity(facets.len()) };
        for (index, nodes) in facets.into_iter().enumerate() {
            check_range(&nodes, points.len(), || format!("facet {index} of group `{}`", group.name))?;
            let Some(&facet) = boundary.get(&key(nodes)) else {
                return Err(not_on_boundary(points, group.name, index, nodes));
            };
            if let Some(first) = named.insert(key(nodes), resolved.len()) {
                let first = resolved.get(first).map_or(&group.name, |group| &group.name).clone();
                return Err(MeshError::InTwoGroups {
                    nodes: nodes.to_vec(),
                    place: facet.centroid(points).into(),
                    first,
                    second: group.name,
                });
            }
            group.facets.push(facet);
        }
        resolved.push(group);
    }
    Ok(resolved)
}

fn key<const D: usize>(mut nodes: [usize; D]) -> [usize; D] {
    nodes.sort_unstable();
    nodes
}

fn not_on_boundary<const D: usize>(
    points: &[[f64; D]],
    group: String,
    facet: usize,
    nodes: [usize; D],
) -> MeshError {
    let place = simplex::centroid(&nodes.map(|node| points[node])).into();
    MeshError::NotOnBoundary { group, facet, nodes: nodes.to_vec(), place }
}
