//! The scene's fluid in the words of the fluid crate.

use partita_fluid::holding_conditions;
use partita_fluid::model::{BodyForce, BoundaryCondition, FluidModel, InitialState};
use partita_fluid::settings::{FluidSettings, PressurePin, Tangent, TimeScheme};
use partita_mesh::Mesh;
use partita_mesh::motion::{MotionLaw, MotionMode, MotionSettings};
use partita_numerics::time::BdfOrder;

use super::newton;
use crate::schema;

/// What flows, and under which conditions; `moves` tells whether the interface does.
#[must_use]
pub fn model(fluid: &schema::Fluid, moves: bool) -> FluidModel<2> {
    let conditions =
        fluid.boundary.iter().map(|(group, condition)| (group.clone(), boundary(condition, moves)));
    FluidModel {
        density: fluid.density.get(),
        viscosity: fluid.viscosity.get(),
        body_force: match fluid.body_force.constant() {
            Some(force) => BodyForce::Constant(force),
            None => BodyForce::Field(fluid.body_force.function()),
        },
        boundary: conditions.collect(),
        initial: match &fluid.initial {
            schema::Initial::Rest => InitialState::Rest,
            schema::Initial::Velocity(formula) => InitialState::Velocity(formula.function()),
        },
    }
}

fn boundary(condition: &schema::Condition, moves: bool) -> BoundaryCondition<2> {
    use schema::Condition;
    match condition {
        Condition::NoSlip => BoundaryCondition::NoSlip,
        Condition::Slip => BoundaryCondition::Slip,
        Condition::Interface if moves => BoundaryCondition::Interface,
        Condition::Interface => BoundaryCondition::RigidInterface,
        Condition::Velocity(formula) => BoundaryCondition::Velocity(formula.function()),
        Condition::WallMotion(formula) => BoundaryCondition::WallMotion(formula.function()),
        Condition::Traction(formula) => BoundaryCondition::Traction(formula.function()),
        Condition::DoNothing(outflow) => {
            BoundaryCondition::DoNothing { backflow: outflow.backflow_stabilization }
        }
        Condition::StressFree(outflow) => {
            BoundaryCondition::StressFree { backflow: outflow.backflow_stabilization }
        }
    }
}

/// How the fluid is solved on `mesh`; its linear systems by this many threads.
#[must_use]
pub fn settings(fluid: &schema::Fluid, mesh: &Mesh<2>, threads: usize) -> FluidSettings {
    FluidSettings {
        time: match fluid.time_scheme {
            schema::FluidTimeScheme::Bdf1 => TimeScheme::Bdf(BdfOrder::One),
            schema::FluidTimeScheme::Bdf2 => TimeScheme::Bdf(BdfOrder::Two),
            schema::FluidTimeScheme::Steady => TimeScheme::Steady,
        },
        tangent: match fluid.tangent {
            schema::Tangent::Full => Tangent::Full,
            schema::Tangent::FrozenTau => Tangent::FrozenTau,
            schema::Tangent::Picard => Tangent::Picard,
        },
        convection: fluid.convection,
        inverse_constant: fluid.inverse_constant.get(),
        grad_div: fluid.grad_div.get(),
        newton: newton(&fluid.newton),
        motion: motion(&fluid.mesh_motion),
        mesh_slide: fluid.mesh_motion.slide.clone(),
        pressure_pin: fluid.pressure_pin.map(|pin| PressurePin {
            node: nearest_node(mesh, pin.point.map(schema::Real::get)),
            pressure: pin.value.get(),
        }),
        threads,
    }
}

pub(super) fn motion(motion: &schema::MeshMotion) -> MotionSettings {
    MotionSettings {
        law: match motion.law {
            schema::MotionLaw::Elastic { poisson_ratio, stiffening } => {
                MotionLaw::Elastic { poisson_ratio: poisson_ratio.get(), stiffening: stiffening.get() }
            }
            schema::MotionLaw::Harmonic { stiffening } => {
                MotionLaw::Harmonic { stiffening: stiffening.get() }
            }
        },
        mode: match motion.mode {
            schema::MotionMode::Reference => MotionMode::Reference,
            schema::MotionMode::Incremental => MotionMode::Incremental,
        },
    }
}

/// For each node of `mesh` the condition that holds its velocity, by its place in the scene's order.
#[must_use]
pub fn holders(fluid: &schema::Fluid, mesh: &Mesh<2>, moves: bool) -> Vec<Option<usize>> {
    holding_conditions(mesh, &model(fluid, moves))
}

/// The node of `mesh` closest to `point`; of several the one with the smallest number.
#[must_use]
pub fn nearest_node(mesh: &Mesh<2>, point: [f64; 2]) -> usize {
    let squared = |node: &[f64; 2]| (node[0] - point[0]).powi(2) + (node[1] - point[1]).powi(2);
    let nodes = mesh.points().iter().enumerate();
    nodes.min_by(|a, b| squared(a.1).total_cmp(&squared(b.1))).map_or(0, |(index, _)| index)
}
