//! Reading meshes written by [gmsh](https://gmsh.info): MSH 2.0 to 2.2 and 4.1, as text and binary in either byte order.
//!
//! | module | what it holds |
//! |---|---|
//! | [`document`] | [`GmshFile`]: nodes, elements and group names as the file gives them |
//! | [`element`] | [`ElementKind`]: the element types that are read |
//! | [`convert`] | from the file to a [`Mesh`](crate::Mesh) of triangles or tetrahedra |
//! | `part` | the part of a file in some physical surfaces or volumes, and the groups at its boundary |
//! | `solid` | from the file to a [`SolidMesh`](crate::SolidMesh) of triangles or quadrilaterals of degree 1 or 2 |
//! | [`error`] | [`ParseError`], [`ConvertError`], [`ReadError`]: what went wrong and where |
//! | [`fault`] | [`Fault`]: all that can be wrong in a file, each with a hint |
//!
//! A file that contradicts itself is refused where it does; the one thing that is repaired is a mesh whose cells are all
//! turned inside out. Sizes are checked
//! against the bytes that are left before anything is allocated, so a broken count costs nothing.
//!
//! ```
//! use partita_mesh::gmsh::GmshFile;
//!
//! let text = r#"$MeshFormat
//! 2.2 0 8
//! $EndMeshFormat
//! $PhysicalNames
//! 1
//! 1 5 "bottom"
//! $EndPhysicalNames
//! $Nodes
//! 3
//! 1 0 0 0
//! 2 1 0 0
//! 3 0 1 0
//! $EndNodes
//! $Elements
//! 2
//! 1 1 2 5 1 1 2
//! 2 2 2 0 1 1 2 3
//! $EndElements
//! "#;
//! let mesh = GmshFile::parse(text.as_bytes())?.into_mesh::<2>()?;
//! assert_eq!(mesh.group("bottom").expect("a named group").facets[0].nodes, [0, 1]);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! Source: the chapter "Gmsh file formats" of gmsh's manual.

mod ascii;
mod binary;
pub mod convert;
mod cursor;
pub mod document;
pub mod element;
mod entities;
pub mod error;
pub mod fault;
mod header;
mod names;
mod numbering;
mod orientation;
mod parser;
mod part;
mod sides;
mod solid;
mod version2;
mod version4;

pub use document::{ElementBlock, GmshFile, GroupName};
pub use element::ElementKind;
pub use error::{ConvertError, ParseError, Position, ReadError};
pub use fault::Fault;
pub use part::PhysicalGroup;
