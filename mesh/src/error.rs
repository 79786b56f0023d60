//! What can be wrong with a mesh, where, and what to do about it.

use partita_numerics::Place;

use crate::cell::CellKind;

/// Why points, cells and groups do not make a mesh.
#[derive(Debug, Clone, PartialEq, thiserror::Error, miette::Diagnostic)]
pub enum MeshError {
    /// The mesh has no cell.
    #[error("the mesh has no cells")]
    #[diagnostic(help("check that the mesh file holds triangles (2D) or tetrahedra (3D)"))]
    Empty,
    /// A boundary group that should lie on a circle does not.
    #[error(
        "node {node} of boundary group `{group}`, at {place}, lies {gap:.3e} m off the circle of that group"
    )]
    #[diagnostic(help(
        "compare the circle's centre and radius with the mesh; a group with straight edges beside the arc needs a name of its own for the arc"
    ))]
    OffCircle {
        /// The group.
        group: String,
        /// First node off the circle.
        node: usize,
        /// Where it is.
        place: Place,
        /// Distance from the circle `[m]`.
        gap: f64,
    },
    /// Cells that are not the simplices of this dimension.
    #[error("cells of kind {found:?} do not make a mesh in {dimension} dimensions")]
    #[diagnostic(help("only {:?} can be solved on there", CellKind::simplex(*dimension)))]
    WrongKind {
        /// The kind as given.
        found: CellKind,
        /// Dimension of the mesh.
        dimension: usize,
    },
    /// Cells on which a solid cannot be solved.
    #[error("cells of kind {found:?} do not make a solid in {dimension} dimensions")]
    #[diagnostic(help(
        "plane solids consist of triangles or quadrilaterals of degree 1 or 2; solids in space need a patch"
    ))]
    NotSolid {
        /// The kind as given.
        found: CellKind,
        /// Dimension of the mesh.
        dimension: usize,
    },
    /// A cell of a solid mesh that is turned inside out, or whose curved edges or moved points fold it.
    #[error("cell {cell} is folded near {place}: the determinant of its map is {determinant:.3e} m^2")]
    #[diagnostic(help(
        "corners run counter-clockwise, and the points on its edges stay near the middle; remesh there, or straighten the mesh"
    ))]
    Folded {
        /// The cell.
        cell: usize,
        /// The quadrature point.
        place: Place,
        /// Determinant of dx/dxi there.
        determinant: f64,
    },
    /// A coordinate that is infinite or not a number.
    #[error("node {node} has a coordinate that is not finite: {coordinates:?}")]
    #[diagnostic(help("repair the mesh file"))]
    NotFinite {
        /// The node.
        node: usize,
        /// Its coordinates `[m]`.
        coordinates: Vec<f64>,
    },
    /// A cell or facet that names a node beyond the last one.
    #[error("{entity} names node {node}, but there are only {nodes} nodes (counted from 0)")]
    #[diagnostic(help("are the nodes counted from 1?"))]
    NodeOutOfRange {
        /// Which cell, or which facet of which group.
        entity: String,
        /// The node that does not exist.
        node: usize,
        /// Number of nodes.
        nodes: usize,
    },
    /// A cell that is flat or turned inside out.
    #[error("cell {cell} at {centroid} has measure {measure:.3e} m^{}: it is {}", centroid.0.len(), if *measure < 0.0 { "inverted" } else { "flat" })]
    #[diagnostic(help("{}", degenerate_hint(*measure)))]
    NotPositive {
        /// The cell.
        cell: usize,
        /// Its centroid.
        centroid: Place,
        /// Its signed area or volume.
        measure: f64,
    },
    /// A cell so large that its measure overflows.
    #[error("cell {cell} at {centroid} is too large for its measure to be a finite number")]
    #[diagnostic(help("check the coordinates and their unit"))]
    TooLarge {
        /// The cell.
        cell: usize,
        /// Its centroid, or another place in it.
        centroid: Place,
    },
    /// A node that no cell uses; no equation would determine its values.
    #[error("node {node} at {place} belongs to no cell")]
    #[diagnostic(help("remove it from the mesh"))]
    UnusedNode {
        /// The node.
        node: usize,
        /// Where it is.
        place: Place,
    },
    /// A facet between more than two cells.
    #[error("facet with nodes {nodes:?} belongs to cells {cells:?}, at most two may share it")]
    #[diagnostic(help("look for overlapping cells or cells given twice"))]
    SharedFacet {
        /// The facet's nodes.
        nodes: Vec<usize>,
        /// All cells that own it.
        cells: Vec<usize>,
    },
    /// A facet of a group that is not on the boundary.
    #[error("group `{group}`: facet {facet} with nodes {nodes:?} at {place} is not on the boundary")]
    #[diagnostic(help("a group holds only facets that belong to exactly one cell"))]
    NotOnBoundary {
        /// The group.
        group: String,
        /// Number of the facet within the group.
        facet: usize,
        /// Its nodes.
        nodes: Vec<usize>,
        /// Its centroid.
        place: Place,
    },
    /// A facet named twice.
    #[error("facet with nodes {nodes:?} at {place} is in group `{first}` and in group `{second}`")]
    #[diagnostic(help("each boundary facet belongs to one group at most, once"))]
    InTwoGroups {
        /// The facet's nodes.
        nodes: Vec<usize>,
        /// Its centroid.
        place: Place,
        /// The group that named it first.
        first: String,
        /// The group that named it again (the same one when listed twice).
        second: String,
    },
    /// Two groups of one name.
    #[error("two boundary groups are called `{name}`")]
    #[diagnostic(help("merge them or rename one"))]
    DuplicateGroup {
        /// The name.
        name: String,
    },
    /// A group without facets: a condition given there would act nowhere.
    #[error("boundary group `{name}` has no facets")]
    #[diagnostic(help("remove it, or check how the boundary was marked"))]
    EmptyGroup {
        /// The name.
        name: String,
    },
    /// A generated box without extent or without divisions.
    #[error("a box of size {size:?} m in {divisions:?} divisions from {origin:?} m cannot be meshed")]
    #[diagnostic(help("give finite coordinates, positive sizes and at least one division a direction"))]
    InvalidBox {
        /// Lower corner `[m]`.
        origin: Vec<f64>,
        /// Edge lengths `[m]`.
        size: Vec<f64>,
        /// Divisions a direction.
        divisions: Vec<usize>,
    },
}

fn degenerate_hint(measure: f64) -> &'static str {
    if measure < 0.0 {
        "swap two of its nodes (triangles run counter-clockwise)"
    } else {
        "merge coinciding nodes or remesh there"
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_are_short_at_any_scale() {
        let shown = |point| Place::from(point).to_string();
        assert_eq!(shown([1.0 / 3.0, 0.0]), "(0.333333, 0) m");
        assert_eq!(shown([-2.5e-7, 12345.678]), "(-2.5e-7, 12345.7) m");
        assert_eq!(shown([f64::NAN, f64::NEG_INFINITY]), "(NaN, -inf) m");
    }

    #[test]
    fn message_names_entity_place_and_remedy() {
        let error = MeshError::NotPositive { cell: 7, centroid: Place::from([0.25, 0.5]), measure: -1.25e-3 };
        insta::assert_snapshot!(partita_testing::with_hint(&error), @r"
        cell 7 at (0.25, 0.5) m has measure -1.250e-3 m^2: it is inverted
        hint: swap two of its nodes (triangles run counter-clockwise)
        ");
    }
}
