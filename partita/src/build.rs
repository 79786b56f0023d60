//! From a validated scene to a run that can be stepped.

pub(crate) mod interface;

use miette::Diagnostic;
use partita_coupling::{Block, March, Quantity, SetupError, Transfer};
use partita_fluid::{FluidError, FluidSolver};
use partita_structure::{MaterialError, Space, StructureError, StructureSolver};
use thiserror::Error;

pub(crate) use interface::transfer;

use crate::adapt::{self, Adapter, Slot};
use partita_mesh::Mesh;
use partita_scene::{Resolved, models, schema};

/// A run of a scene: fluid first, structure second, either of them possibly absent.
pub type Run = March<Slot<FluidSolver<2>>, Slot<StructureSolver<2>>>;

/// Interface values per point.
const COMPONENTS: usize = 2;
/// Name of the interface in messages.
const INTERFACE: &str = "interface";

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
}

/// The run of a scene, at its initial state.
///
/// # Errors
/// When the parts of the scene do not fit together.
pub fn run(resolved: &Resolved) -> Result<Run, BuildError> {
    run_on(resolved, 1)
}

/// The run of a scene with its large linear systems solved by this many threads, which changes no number.
///
/// # Errors
/// When the parts of the scene do not fit together.
pub fn run_on(Resolved { scene, shapes, .. }: &Resolved, threads: usize) -> Result<Run, BuildError> {
    let fluid = scene.fluid.as_ref().zip(shapes.fluid.clone());
    let moves = scene.moves_the_interface();
    let fluid = fluid.map(|(scene, mesh)| fluid_solver(scene, mesh, moves, threads)).transpose()?;
    let structure = scene.structure.as_ref().zip(shapes.structure.clone());
    let structure = structure.map(|(scene, space)| structure_solver(scene, space)).transpose()?;
    let (settings, transfers) = match (&scene.coupling, &fluid, &structure) {
        (Some(coupling), Some(fluid), Some(structure)) => {
            (models::coupling_settings(coupling), vec![transfer(fluid, structure, coupling)?])
        }
        _ => (models::one_call(), Vec::<Box<dyn Transfer>>::new()),
    };
    let coupled = !transfers.is_empty();
    let blocks = |quantity, points| {
        if coupled { vec![Block::new(INTERFACE, quantity, COMPONENTS, points)] } else { Vec::new() }
    };
    let displacements = |points| if moves { blocks(Quantity::Displacement, points) } else { Vec::new() };
    let first = fluid.map(|fluid| {
        let points = fluid.interface_nodes().len();
        Adapter::new(fluid, displacements(points), blocks(Quantity::Force, points))
            .with_suspect(adapt::backflow)
    });
    let second = structure.map(|structure| {
        let points = structure.interface_points().len();
        Adapter::new(structure, blocks(Quantity::Force, points), displacements(points))
    });
    Ok(March::new(Slot::new(first), Slot::new(second), transfers, &settings, 0.0)?)
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
