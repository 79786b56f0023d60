//! Meshes for fluid-structure interaction: simplices for the fluid; triangles and quadrilaterals of degree 1 and 2 for
//! plane solids.
//!
//! | module | what it holds |
//! |---|---|
//! | [`mesh`] | [`Mesh`]: points, cells and named boundary groups, validated once when it is built |
//! | [`cell`] | [`CellKind`], [`Cells`]: cells of one kind in one flat list of nodes |
//! | [`refine`] | every triangle cut into four |
//! | [`generate`] | rectangles of triangles, cuboids of tetrahedra |
//! | [`gmsh`] | reading the meshes of gmsh |
//! | [`solid`] | [`SolidMesh`]: curved triangles and quadrilaterals, their shape functions, transfer to their boundary |
//! | [`topology`] | boundary facets and neighbours, found from the cells |
//! | [`facet`] | area vectors and outward normals of boundary facets |
//! | [`simplex`] | measure, centroid and shape-function gradients of one simplex |
//! | [`quality`] | measures and an isotropic shape quality of all cells |
//! | [`motion`] | moving the mesh with its boundary |
//! | [`vtu`] | VTK files: unstructured grids and collections over time |
//!
//! Everything is generic in the dimension `D`; coordinates are `f64`, in metres by convention.
//!
//! ```
//! use partita_mesh::generate::{Diagonal, RectangleMesh, rectangle};
//!
//! let mesh = rectangle(&RectangleMesh {
//!     origin: [0.0, 0.0],
//!     size: [1.0, 1.0],
//!     divisions: [10, 10],
//!     pattern: Diagonal::Crossed,
//! })?;
//! assert_eq!(mesh.cells().len(), 400);
//! assert_eq!(mesh.points().len(), 221);
//! assert_eq!(mesh.group("top").expect("a named side").facets.len(), 10);
//! # Ok::<(), partita_mesh::MeshError>(())
//! ```

pub mod cell;
pub mod error;
pub mod facet;
pub mod generate;
pub mod gmsh;
pub mod mesh;
pub mod motion;
pub mod quality;
pub mod refine;
pub mod simplex;
pub mod solid;
pub mod topology;
pub mod vtu;

pub use cell::{CellKind, Cells};
pub use error::MeshError;
pub use facet::Facet;
pub use mesh::{BoundaryGroup, Mesh, NamedFacets};
pub use motion::{MeshMotion, MotionError, MotionLaw, MotionMode, MotionQuality, MotionSettings};
pub use partita_numerics::Place;
pub use solid::{SolidGroup, SolidMesh};
pub use topology::Topology;
