//! From a validated scene to coupled fields that can be stepped.

pub(crate) mod interface;

use miette::Diagnostic;
use partita_coupling::SetupError;
use partita_fluid::{FluidError, FluidSolver};
use partita_structure::{MaterialError, Space, StructureError, StructureSolver};
use thiserror::Error;

pub(crate) use interface::transfer;

pub use crate::couple::FieldMarch;

use crate::adapt::Side;
use crate::couple;
use partita_mesh::Mesh;
use partita_scene::{Resolved, models, schema};

/// A scene that reads well but cannot be built.
#[derive(Debug, Error, Diagnostic)]
pub enum BuildError {
    /// The fluid.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Fluid(#[from] FluidError),
    /// The structure's material.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Material(#[from] MaterialError),
    /// The structure.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Structure(#[from] StructureError),
    /// The coupling.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Coupling(#[from] SetupError),
    /// A field that is to be coupled has no interface.
    #[error("{field}: it has no interface")]
    #[diagnostic(help("{remedy}"))]
    NoInterface {
        /// The field.
        field: &'static str,
        /// How it gets one.
        remedy: &'static str,
    },
    /// There is no obvious way from the points of one participant to those of the other.
    #[error("the interface of {first} has {first_values} values, that of {second} {second_values}")]
    #[diagnostic(help("give the operator between them to `Run::couple_by`"))]
    Unmatched {
        /// Name of the first participant.
        first: String,
        /// Values at its interface.
        first_values: usize,
        /// Name of the second participant.
        second: String,
        /// Values at its interface.
        second_values: usize,
    },
}

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
            let transfer = transfer(&fluid, &structure, coupling.transfer, tolerance)?;
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
fn structure_solver(
    structure: &schema::Structure,
    space: Space<2>,
) -> Result<StructureSolver<2>, BuildError> {
    let model = models::structure_model(structure, &space)?;
    Ok(StructureSolver::new(space, model, models::structure_settings(structure))?)
}
