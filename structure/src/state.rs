//! What a structure carries from step to step.

use partita_numerics::field::StateMismatch;
use serde::{Deserialize, Serialize};

/// The motion of a structure at one time, with the loads that generalized-alpha averages over the step.
///
/// Plain data: a checkpoint holds it, and a solver restored from it continues with the same bits. Vectors over all
/// control points are numbered `control_point * D + c`, those of the interface `point * D + c`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct StructureState {
    /// Time t `[s]`.
    pub time: f64,
    /// Displacement d of the control points `[m]`.
    pub displacement: Vec<f64>,
    /// Velocity v of the control points `[m/s]`.
    pub velocity: Vec<f64>,
    /// Acceleration a of the control points `[m/s^2]`.
    pub acceleration: Vec<f64>,
    /// All external forces F at the control points `[N, in 2D N/m]`.
    pub external_force: Vec<f64>,
    /// The part of them that was imposed at the interface points.
    pub interface_force: Vec<f64>,
}

impl StructureState {
    /// At rest without loads at t = 0.
    pub(crate) fn at_rest(dofs: usize, interface_dofs: usize) -> Self {
        Self {
            time: 0.0,
            displacement: vec![0.0; dofs],
            velocity: vec![0.0; dofs],
            acceleration: vec![0.0; dofs],
            external_force: vec![0.0; dofs],
            interface_force: vec![0.0; interface_dofs],
        }
    }

    /// Becomes `other` without allocating.
    pub(crate) fn copy_from(&mut self, other: &Self) {
        self.time = other.time;
        self.displacement.copy_from_slice(&other.displacement);
        self.velocity.copy_from_slice(&other.velocity);
        self.acceleration.copy_from_slice(&other.acceleration);
        self.external_force.copy_from_slice(&other.external_force);
        self.interface_force.copy_from_slice(&other.interface_force);
    }

    /// Refuses a state whose lengths are not those of `self`.
    pub(crate) fn check_fits(&self, other: &Self) -> Result<(), StateMismatch> {
        let fields = |state: &Self| {
            [
                ("values of the displacement", state.displacement.len()),
                ("values of the velocity", state.velocity.len()),
                ("values of the acceleration", state.acceleration.len()),
                ("values of the external force", state.external_force.len()),
                ("values of the interface force", state.interface_force.len()),
            ]
        };
        for ((what, expected), (_, found)) in fields(self).into_iter().zip(fields(other)) {
            StateMismatch::check(what, found, expected)?;
        }
        Ok(())
    }
}
