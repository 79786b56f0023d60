//! What can be wrong with a gmsh file, where, and what to do about it.

use std::fmt;
use std::path::PathBuf;

use super::element::ElementKind;
use super::fault::{Fault, excerpt};
use crate::error::{MeshError, Place};

/// A place in a file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Position {
    /// A line of text, counted from 1.
    Line(usize),
    /// A byte of a binary file, counted from 0.
    Byte(usize),
}

impl fmt::Display for Position {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Line(line) => write!(f, "line {line}"),
            Self::Byte(byte) => write!(f, "byte {byte}"),
        }
    }
}

/// Why a file on disk could not be read.
#[derive(Debug, thiserror::Error)]
pub enum ReadError {
    /// The file itself.
    #[error("cannot read {}: {source}\nhint: check the path and its permissions", path.display())]
    File {
        /// The file.
        path: PathBuf,
        /// What the system says.
        source: std::io::Error,
    },
    /// What is in it.
    #[error("{}, {source}", path.display())]
    Content {
        /// The file.
        path: PathBuf,
        /// Where and what.
        source: ParseError,
    },
}

/// A fault in a gmsh file and its place.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error("{position}{}: {fault}", place_in(section.as_ref()))]
pub struct ParseError {
    /// Where the value is that cannot be accepted.
    pub position: Position,
    /// The section it is in, without `$`; `None` between sections.
    pub section: Option<String>,
    /// What is wrong, and a hint.
    pub fault: Fault,
}

fn place_in(section: Option<&String>) -> String {
    section.map_or_else(String::new, |name| format!(" in ${}", excerpt(name.as_bytes())))
}

/// Why the content of a gmsh file does not make a mesh of straight simplices, or of a solid.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum ConvertError {
    /// No cells of the dimension.
    #[error("the file has no {kind}s, which a mesh in {dimension} dimensions needs\nhint: {}", no_cells_hint(*largest, *dimension))]
    NoCells {
        /// What a cell would be.
        kind: ElementKind,
        /// Dimension of the mesh.
        dimension: usize,
        /// Largest dimension of the file's elements, if it has any.
        largest: Option<usize>,
    },
    /// Elements of a dimension more than the mesh.
    #[error(
        "the file has {kind}s ({count}), so it is no mesh in {dimension} dimensions\nhint: save the mesh of the surface only"
    )]
    TooManyDimensions {
        /// The elements.
        kind: ElementKind,
        /// How many there are.
        count: usize,
        /// Dimension of the mesh.
        dimension: usize,
    },
    /// Curved elements or quadrilaterals.
    #[error("the {kind}s of the file ({count}) cannot be used, only {wanted}s\nhint: {}", kind_hint(*kind))]
    UnsupportedKind {
        /// The elements.
        kind: ElementKind,
        /// How many there are.
        count: usize,
        /// What can be used in their place.
        wanted: ElementKind,
    },
    /// No triangles or quadrilaterals for a solid.
    #[error("the file has no triangles or quadrilaterals, which a plane solid consists of\nhint: {}", no_cells_hint(*largest, 2))]
    NoSolid {
        /// Largest dimension of the file's elements, if it has any.
        largest: Option<usize>,
    },
    /// Cells of several kinds in one solid.
    #[error(
        "the file mixes {first}s ({first_count}) and {second}s ({second_count}), a solid takes cells of one kind\nhint: drop `Recombine Surface`, or let it leave no triangles: Mesh.RecombinationAlgorithm = 3"
    )]
    MixedKinds {
        /// A kind.
        first: ElementKind,
        /// How many there are.
        first_count: usize,
        /// Another one.
        second: ElementKind,
        /// How many there are.
        second_count: usize,
    },
    /// Boundary elements that are not edges of the cells.
    #[error(
        "the {kind}s of the file ({count}) are no edges of its {cell}s, which have {wanted}s\nhint: give all elements the same order: Mesh.ElementOrder before meshing, or `SetOrder` after it"
    )]
    OtherEdges {
        /// The boundary elements.
        kind: ElementKind,
        /// How many there are.
        count: usize,
        /// The cells.
        cell: ElementKind,
        /// What their edges are.
        wanted: ElementKind,
    },
    /// A plane mesh that is not in the plane.
    #[error("node {node} at {place} is not in the plane z = 0\nhint: draw plane meshes with z = 0")]
    NotPlanar {
        /// The node's tag.
        node: u64,
        /// Where it is.
        place: Place,
    },
    /// Cells with a negative measure.
    #[error("{inverted} of {cells} cells are inverted, the first at {place}\nhint: {}", inverted_hint(*inverted == *cells))]
    Inverted {
        /// Number of such cells.
        inverted: usize,
        /// Number of all cells.
        cells: usize,
        /// Centroid of the first.
        place: Place,
    },
    /// No boundary group at all.
    #[error("no {facet} belongs to a physical group, so no part of the boundary can be named\nhint: mark the boundary in the .geo file: {} (format 2.2 loses the marks when Mesh.SaveAll is set)", physical_hint(*facet))]
    NoGroups {
        /// What a facet is.
        facet: ElementKind,
    },
    /// Boundary elements in several groups.
    #[error(
        "boundary elements are in group `{first}` and in group `{second}`\nhint: put each curve or surface of the boundary into one physical group"
    )]
    SharedFacets {
        /// A group of theirs.
        first: String,
        /// Another one.
        second: String,
    },
    /// A boundary element away from the cells.
    #[error(
        "group `{group}` has an element on node {node} at {place}, which no cell uses\nhint: put the domain beside that boundary into a physical group, too, and save again"
    )]
    OffCells {
        /// The group.
        group: String,
        /// The node's tag.
        node: u64,
        /// Where it is.
        place: Place,
    },
    /// Points, cells and groups are read but make no valid mesh.
    #[error(transparent)]
    Mesh(#[from] MeshError),
}

fn no_cells_hint(largest: Option<usize>, dimension: usize) -> &'static str {
    match largest {
        Some(2) if dimension == 3 => {
            "there are surfaces only; mesh the volume (`gmsh -3`) and put it into a physical group"
        }
        _ => {
            "mesh the domain (`gmsh -2` or `gmsh -3`) and put it into a physical group: gmsh saves only groups once there is one"
        }
    }
}

fn kind_hint(kind: ElementKind) -> &'static str {
    match kind {
        ElementKind::Quadrilateral4 | ElementKind::Quadrilateral8 | ElementKind::Quadrilateral9 => {
            "mesh without `Recombine Surface` and with Mesh.ElementOrder = 1"
        }
        _ => "set Mesh.ElementOrder = 1",
    }
}

fn inverted_hint(all: bool) -> &'static str {
    if all {
        "the surface's normal points to -z: turn its curve loop around, or add `ReverseMesh Surface{:};` to the .geo file"
    } else {
        "surfaces are oriented differently, or cells overlap: use `ReverseMesh Surface{...};` for the ones turned, or remesh"
    }
}

fn physical_hint(facet: ElementKind) -> &'static str {
    if facet.dimension() == 1 {
        "Physical Curve(\"inflow\") = {1};"
    } else {
        "Physical Surface(\"inflow\") = {1};"
    }
}
