//! What can be wrong with a gmsh file, where, and what to do about it.

use std::fmt;
use std::path::PathBuf;

use super::element::ElementKind;
use super::fault::{Fault, excerpt};
use crate::Place;
use crate::error::MeshError;

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
#[derive(Debug, thiserror::Error, miette::Diagnostic)]
pub enum ReadError {
    /// The file itself.
    #[error("cannot read {}: {source}", path.display())]
    #[diagnostic(help("check the path and its permissions"))]
    File {
        /// The file.
        path: PathBuf,
        /// What the system says.
        source: std::io::Error,
    },
    /// What is in it.
    #[error("{}, {source}", path.display())]
    #[diagnostic(forward(source))]
    Content {
        /// The file.
        path: PathBuf,
        /// Where and what.
        source: ParseError,
    },
}

/// A fault in a gmsh file and its place.
#[derive(Debug, Clone, PartialEq, thiserror::Error, miette::Diagnostic)]
#[error("{position}{}: {fault}", place_in(section.as_ref()))]
#[diagnostic(forward(fault))]
pub struct ParseError {
    /// Where the value is that cannot be accepted.
    pub position: Position,
    /// The section it is in, without `$`; `None` between sections.
    pub section: Option<String>,
    /// What is wrong.
    pub fault: Fault,
}

fn place_in(section: Option<&String>) -> String {
    section.map_or_else(String::new, |name| format!(" in ${}", excerpt(name.as_bytes())))
}

/// Why the content of a gmsh file does not make a mesh of straight simplices, or of a solid.
#[derive(Debug, Clone, PartialEq, thiserror::Error, miette::Diagnostic)]
pub enum ConvertError {
    /// No cells of the dimension.
    #[error("the file has no {kind}s, which a mesh in {dimension} dimensions needs")]
    #[diagnostic(help("{}", no_cells_hint(*largest, *dimension)))]
    NoCells {
        /// What a cell would be.
        kind: ElementKind,
        /// Dimension of the mesh.
        dimension: usize,
        /// Largest dimension of the file's elements, if it has any.
        largest: Option<usize>,
    },
    /// Elements of a dimension more than the mesh.
    #[error("the file has {kind}s ({count}), so it is no mesh in {dimension} dimensions")]
    #[diagnostic(help("save the mesh of the surface only"))]
    TooManyDimensions {
        /// The elements.
        kind: ElementKind,
        /// How many there are.
        count: usize,
        /// Dimension of the mesh.
        dimension: usize,
    },
    /// Curved elements or quadrilaterals.
    #[error("the {kind}s of the file ({count}) cannot be used, only {wanted}s")]
    #[diagnostic(help("{}", kind_hint(*kind)))]
    UnsupportedKind {
        /// The elements.
        kind: ElementKind,
        /// How many there are.
        count: usize,
        /// What can be used in their place.
        wanted: ElementKind,
    },
    /// No triangles or quadrilaterals for a solid.
    #[error("the file has no triangles or quadrilaterals, which a plane solid consists of")]
    #[diagnostic(help("{}", no_cells_hint(*largest, 2)))]
    NoSolid {
        /// Largest dimension of the file's elements, if it has any.
        largest: Option<usize>,
    },
    /// Cells of several kinds in one solid.
    #[error(
        "the file mixes {first}s ({first_count}) and {second}s ({second_count}), a solid takes cells of one kind"
    )]
    #[diagnostic(help(
        "drop `Recombine Surface`, or let it leave no triangles: Mesh.RecombinationAlgorithm = 3"
    ))]
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
    #[error("the {kind}s of the file ({count}) are no edges of its {cell}s, which have {wanted}s")]
    #[diagnostic(help(
        "give all elements the same order: Mesh.ElementOrder before meshing, or `SetOrder` after it"
    ))]
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
    #[error("node {node} at {place} is not in the plane z = 0")]
    #[diagnostic(help("draw plane meshes with z = 0"))]
    NotPlanar {
        /// The node's tag.
        node: u64,
        /// Where it is.
        place: Place,
    },
    /// Cells of both orientations.
    #[error("{fewer} of {cells} cells are oriented against the others, the first at {place}")]
    #[diagnostic(help("{}", orientation_hint(*kind)))]
    Orientation {
        /// The cells.
        kind: ElementKind,
        /// Number of cells of the rarer orientation.
        fewer: usize,
        /// Number of all cells.
        cells: usize,
        /// Centroid of the first of the fewer.
        place: Place,
    },
    /// Several physical groups of cells, and none is chosen.
    #[error("the file has several physical {}: {}", region_word(*dimension), quoted(groups))]
    #[diagnostic(help("choose those that make this mesh by their names"))]
    SeveralRegions {
        /// Dimension of the cells.
        dimension: usize,
        /// Names of the groups that have cells.
        groups: Vec<String>,
    },
    /// Cells outside of all physical groups beside others that are in one, and none is chosen.
    #[error(
        "{cells} of the file's elements of dimension {dimension} belong to no physical group, the others to {}",
        quoted(groups)
    )]
    #[diagnostic(help("choose the physical {} that make this mesh by their names, which leaves the others out, or put all of them into one", region_word(*dimension)))]
    Unassigned {
        /// Dimension of the cells.
        dimension: usize,
        /// Number of cells without a group.
        cells: usize,
        /// Names of the groups that have cells.
        groups: Vec<String>,
    },
    /// A physical group of cells that the file does not have.
    #[error("the file has no physical {} `{name}` with elements", region_word(*dimension).trim_end_matches('s'))]
    #[diagnostic(help("{}", regions_hint(*dimension, groups)))]
    UnknownRegion {
        /// Dimension of the cells.
        dimension: usize,
        /// As given.
        name: String,
        /// Names of the groups that have cells.
        groups: Vec<String>,
    },
    /// No boundary group at all.
    #[error("no {facet} belongs to a physical group, so no part of the boundary can be named")]
    #[diagnostic(help("mark the boundary in the .geo file: {} (format 2.2 loses the marks when Mesh.SaveAll is set)", physical_hint(*facet)))]
    NoGroups {
        /// What a facet is.
        facet: ElementKind,
    },
    /// Boundary elements in several groups.
    #[error("boundary elements are in group `{first}` and in group `{second}`")]
    #[diagnostic(help("put each curve or surface of the boundary into one physical group"))]
    SharedFacets {
        /// A group of theirs.
        first: String,
        /// Another one.
        second: String,
    },
    /// A boundary element away from the cells.
    #[error("group `{group}` has an element on node {node} at {place}, which no cell uses")]
    #[diagnostic(help("put the domain beside that boundary into a physical group, too, and save again"))]
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
    #[diagnostic(transparent)]
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

/// gmsh's own language turns surfaces, not cells; its Python module (`pip install gmsh`) turns the cells of any file.
fn orientation_hint(kind: ElementKind) -> String {
    if kind.dimension() != 2 {
        return "they may overlap: remesh the volume".to_owned();
    }
    format!(
        "if cells overlap, remesh; else turn the clockwise ones in Python (`pip install gmsh`):\n\
         import gmsh\n\
         gmsh.initialize(); gmsh.open(\"old.msh\"); mesh = gmsh.model.mesh\n\
         cells = mesh.getElementsByType({0})[0]\n\
         z = mesh.getJacobians({0}, [0, 0, 0])[0][8::9]\n\
         mesh.reverseElements([cell for cell, up in zip(cells, z) if up < 0])\n\
         gmsh.write(\"new.msh\")",
        kind.code()
    )
}

fn region_word(dimension: usize) -> &'static str {
    match dimension {
        2 => "surfaces",
        3 => "volumes",
        _ => "groups",
    }
}

fn quoted(names: &[String]) -> String {
    names.iter().map(|name| format!("`{name}`")).collect::<Vec<_>>().join(", ")
}

fn regions_hint(dimension: usize, groups: &[String]) -> String {
    if groups.is_empty() {
        return format!(
            "it has no physical {} at all: choose none, and all its cells are taken",
            region_word(dimension)
        );
    }
    format!("it has {}", quoted(groups))
}

fn physical_hint(facet: ElementKind) -> &'static str {
    if facet.dimension() == 1 {
        "Physical Curve(\"inflow\") = {1};"
    } else {
        "Physical Surface(\"inflow\") = {1};"
    }
}
