//! The tank whose Newton iterations are timed.
use partita_numerics::Field;

use std::sync::Arc;

use partita_fluid::{BodyForce, BoundaryCondition, FluidModel, FluidSettings, FluidSolver, InitialState};
use partita_mesh::generate::{Diagonal, RectangleMesh, rectangle};

/// A tank in the first step of a run, with its bottom in motion: 400 triangles for 10 divisions, 663 dofs.
pub(crate) fn tank(divisions: usize) -> FluidSolver<2> {
    tank_for(divisions, 1)
}

/// The same for a number of threads.
pub(crate) fn tank_for(divisions: usize, threads: usize) -> FluidSolver<2> {
    let mesh = RectangleMesh {
        origin: [0.0; 2],
        size: [1.0; 2],
        divisions: [divisions; 2],
        pattern: Diagonal::Crossed,
    };
    let mesh = rectangle(&mesh).expect("a square");
    let conditions: [(&str, BoundaryCondition<2>); 4] = [
        ("left", BoundaryCondition::NoSlip),
        ("right", BoundaryCondition::NoSlip),
        ("bottom", BoundaryCondition::Interface),
        ("top", BoundaryCondition::StressFree { backflow: false }),
    ];
    let model = FluidModel {
        density: 1000.0,
        viscosity: 100.0,
        body_force: BodyForce::Constant([0.0, -9.81]),
        boundary: conditions.map(|(group, condition)| (group.to_string(), condition)).to_vec(),
        initial: InitialState::Velocity(Arc::new(|x: &[f64; 2], _| [x[1] * (1.0 - x[1]), x[0]])),
    };
    let mut fluid = FluidSolver::new(mesh, model, FluidSettings { threads, ..FluidSettings::default() })
        .expect("a fluid");
    fluid.begin_step(0.01, 0.01).expect("a step");
    fluid.impose(&displacement(&fluid)).expect("a motion");
    fluid
}

/// The motion of its bottom in that step.
pub(crate) fn displacement(fluid: &FluidSolver<2>) -> Vec<f64> {
    let point = |node: &usize| fluid.mesh().points()[*node][0];
    fluid.interface_nodes().iter().flat_map(|node| [0.0, -0.01 * point(node) * (1.0 - point(node))]).collect()
}
