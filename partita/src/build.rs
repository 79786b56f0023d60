//! From a validated scene to coupled fields that can be stepped.

use partita_fluid::FluidSolver;
use partita_structure::{Space, StructureSolver};

pub use crate::couple::FieldMarch;
pub use crate::error::BuildError;

use crate::adapt::Side;
use crate::couple;
use crate::interface;
use partita_mesh::Mesh;
use partita_scene::{Resolved, models, schema};

/// The coupled fields of a scene, at their initial state.
///
/// # Errors
/// When the parts of the scene do not fit together.
pub fn march(resolved: &Resolved) -> Result<FieldMarch, BuildError> {
    march_on(resolved, 1)
}

/// The coupled fields of a scene with their large linear systems solved by this many threads, which changes no number.
///
/// # Errors
/// When the parts of the scene do not fit together.
pub fn march_on(Resolved { scene, shapes, .. }: &Resolved, threads: usize) -> Result<FieldMarch, BuildError> {
    let fluid = scene.fluid.as_ref().zip(shapes.fluid.clone());
    let moves = scene.moves_the_interface();
    let fluid = fluid.map(|(scene, mesh)| fluid_solver(scene, mesh, moves, threads)).transpose()?;
    let structure = scene.structure.as_ref().zip(shapes.structure.clone());
    let structure = structure.map(|(scene, space)| structure_solver(scene, space)).transpose()?;
    match (fluid, structure, &scene.coupling) {
        (Some(fluid), Some(structure), Some(coupling)) => {
            let tolerance = coupling.projection_tolerance.get();
            let transfer = interface::transfer(&fluid, &structure, coupling.transfer, tolerance)?;
            let settings = models::coupling_settings(coupling);
            if moves {
                couple::two_way(fluid.into(), structure.into(), transfer, &settings)
            } else {
                couple::one_way(fluid.into(), structure.into(), transfer)
            }
        }
        (fluid, structure, _) => {
            couple::alone(fluid.map_or(Side::Absent, Side::from), structure.map_or(Side::Absent, Side::from))
        }
    }
}

/// The solver of a scene's fluid on `mesh`, at its initial state; `moves` tells whether its interface does, and `threads` how
/// many solve its linear systems.
fn fluid_solver(
    fluid: &schema::Fluid,
    mesh: Mesh<2>,
    moves: bool,
    threads: usize,
) -> Result<FluidSolver<2>, BuildError> {
    let settings = models::fluid_settings(fluid, &mesh, threads);
    Ok(FluidSolver::new(mesh, models::fluid_model(fluid, moves), settings)?)
}

/// The solver of a scene's structure in `space`, at rest.
pub(crate) fn structure_solver(
    structure: &schema::Structure,
    space: Space<2>,
) -> Result<StructureSolver<2>, BuildError> {
    let model = models::structure_model(structure, &space)?;
    Ok(StructureSolver::new(space, model, models::structure_settings(structure))?)
}
