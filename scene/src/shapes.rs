//! What a scene is made of in space: the fluid's mesh and the structure's patch or mesh, made or read once.

mod content;
mod fluid;
mod read;
mod structure;

use std::path::Path;

use partita_mesh::Mesh;
use partita_structure::Space;

use super::check::Check;
use super::schema::{FileName, FluidMesh, Geometry, Scene};

pub use content::{Content, Role};
pub use read::Input;

/// The fluid's mesh and the structure's patch or mesh, as far as the scene has them.
#[derive(Debug, Clone, Default)]
pub struct Shapes {
    /// The fluid's mesh before it moves.
    pub fluid: Option<Mesh<2>>,
    /// The structure before it deforms.
    pub structure: Option<Space<2>>,
    /// What the file of the fluid's mesh holds.
    pub fluid_file: Option<Content>,
    /// What the file of the structure's mesh holds.
    pub structure_file: Option<Content>,
    /// The files that were read for them.
    pub inputs: Vec<Input>,
}

impl Shapes {
    /// Makes or reads the shapes of `scene`, whose file names are relative to `folder`; adds what is wrong with them.
    pub(super) fn make(scene: &Scene, folder: &Path, check: &mut Check<'_>) -> Self {
        let mut shapes = Self::default();
        if let Some(scene) = &scene.fluid {
            shapes.fluid = fluid::mesh(&scene.mesh, folder, &mut shapes, check);
        }
        if let Some(scene) = &scene.structure {
            shapes.structure = structure::space(&scene.geometry, folder, &mut shapes, check);
        }
        shapes
    }
}

/// Folder of a run that keeps the files its scene was built from.
pub const INPUT_FOLDER: &str = "input";
/// The fluid's mesh in that folder.
const FLUID_FILE: &str = "fluid.msh";
/// The structure's patch in that folder.
const PATCH_FILE: &str = "structure.toml";
/// The structure's mesh in that folder.
const SOLID_FILE: &str = "structure.msh";
/// All files that may be in it.
pub const INPUT_FILES: [&str; 3] = [FLUID_FILE, PATCH_FILE, SOLID_FILE];

/// Lets `scene` name the copies of its files that a run keeps.
pub(super) fn name_copies(scene: &mut Scene) {
    let copy = |name: &str| FileName::literal(&format!("{INPUT_FOLDER}/{name}"));
    if let Some(FluidMesh::Gmsh(mesh)) = scene.fluid.as_mut().map(|fluid| &mut fluid.mesh) {
        mesh.file = copy(FLUID_FILE);
    }
    match scene.structure.as_mut().map(|structure| &mut structure.geometry) {
        Some(Geometry::Spline(spline)) => spline.file = copy(PATCH_FILE),
        Some(Geometry::Gmsh(mesh)) => mesh.file = copy(SOLID_FILE),
        _ => {}
    }
}
