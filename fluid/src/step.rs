//! The equations of one time step, and all that follows the mesh within it.

use partita_numerics::Field;
use partita_numerics::newton::{Problem, ResidualNorm, ReusableFactor};
use partita_numerics::phases::timed;

use crate::assembly::Iterate;
use crate::balance;
use crate::boundary::{MovedMesh, evaluate};
use crate::error::FluidError;
use crate::model::{BodyForce, BoundaryCondition};
use crate::solver::FluidSolver;
use crate::state::FluidState;
use crate::trial::Trial;

impl<const D: usize> FluidSolver<D> {
    /// Moves the whole mesh: total displacement `[m]` of all nodes, `node * D + c`. Nothing is solved for; walls
    /// and interface go where it says.
    ///
    /// # Errors
    ///
    /// If a displacement is not finite or inverts a cell.
    ///
    /// # Panics
    ///
    /// If `displacement` does not have D entries a node, or outside a step.
    pub fn impose_mesh(&mut self, displacement: &[f64]) -> Result<(), FluidError> {
        let time = self.end_of_step();
        assert_eq!(
            displacement.len(),
            self.trial.displacement.len(),
            "a displacement has {D} entries a node"
        );
        self.trial.displacement.copy_from_slice(displacement);
        self.mesh_is_fixed = false;
        self.follow_mesh(time)
    }

    /// Replaces the iterate; prescribed entries of `values` are overruled.
    ///
    /// # Errors
    ///
    /// As [`begin_step`](partita_numerics::Field::begin_step).
    ///
    /// # Panics
    ///
    /// If `values` does not have one entry a dof, or outside a step.
    pub fn set_values(&mut self, values: &[f64]) -> Result<(), FluidError> {
        let time = self.end_of_step();
        assert_eq!(values.len(), self.trial.values.len(), "values have {} entries a node", D + 1);
        self.trial.values.copy_from_slice(values);
        self.prescribe(time)
    }

    /// t_{n+1}.
    pub(crate) fn end_of_step(&self) -> f64 {
        self.trial.step.expect("begin_step comes first").0
    }

    /// Displacements of the walls with a motion of their own.
    pub(crate) fn move_walls(&mut self, time: f64) -> Result<(), FluidError> {
        for &(node, condition) in &self.boundaries.wall_motion {
            let BoundaryCondition::WallMotion(field) = &self.model.boundary[condition].1 else {
                unreachable!("a moving wall comes from a wall motion")
            };
            let point = &self.mesh.points()[node];
            let displacement = evaluate(field, point, time, "wall displacement", node)?;
            self.trial.displacement[node * D..(node + 1) * D].copy_from_slice(&displacement);
        }
        Ok(())
    }

    /// The mesh follows its boundary.
    pub(crate) fn move_mesh(&mut self, time: f64) -> Result<(), FluidError> {
        let Some(motion) = &mut self.motion else { return Ok(()) };
        let (committed, displacement) = (&self.committed.displacement, &mut self.trial.displacement);
        timed(&mut self.phases.motion, || motion.displace(committed, displacement))
            .map_err(|source| FluidError::Motion { time, source })
    }

    /// All that depends on where the mesh is.
    pub(crate) fn follow_mesh(&mut self, time: f64) -> Result<(), FluidError> {
        if !self.mesh_is_fixed {
            self.factor_log.outdate();
        }
        self.trial
            .follow(&self.mesh, &self.committed)
            .map_err(|source| FluidError::Motion { time, source })?;
        if let (Some(walls), Some(bdf)) = (&mut self.boundaries.closed_walls, &self.trial.bdf) {
            let FluidState { displacement, previous_displacement, .. } = &self.committed;
            walls.update(
                self.mesh.points(),
                [&self.trial.displacement, displacement, previous_displacement],
                bdf,
            );
        }
        self.frames.update(&self.boundaries.slip, &self.trial.points);
        let mesh = MovedMesh { time, points: &self.trial.points, velocity: &self.trial.mesh_velocity };
        if let BodyForce::Field(field) = &self.model.body_force {
            for (node, nodal) in self.trial.body_force.chunks_exact_mut(D).enumerate() {
                nodal.copy_from_slice(&mesh.evaluate(field, node, "body force")?);
            }
        }
        for facet in &mut self.boundaries.natural {
            facet.update(&self.model, &mesh)?;
        }
        self.prescribe(time)
    }

    /// Prescribed values of the iterate.
    fn prescribe(&mut self, time: f64) -> Result<(), FluidError> {
        let mesh = MovedMesh { time, points: &self.trial.points, velocity: &self.trial.mesh_velocity };
        self.boundaries.impose(&self.model, &mesh, &self.frames, &mut self.trial.values)?;
        if let Some(pin) = self.settings.pressure_pin {
            self.trial.values[pin.node * (D + 1) + D] = pin.pressure;
        }
        if !self.boundaries.is_closed {
            return Ok(());
        }
        let Trial { points, values, bdf, .. } = &self.trial;
        balance::check(&self.mesh, &self.boundaries, &balance::State { time, points, values, bdf: *bdf })
    }
}

impl<const D: usize> Problem for FluidSolver<D> {
    type Error = FluidError;

    /// # Panics
    ///
    /// Outside a step.
    fn assemble(&mut self, with_tangent: bool) -> Result<ResidualNorm, FluidError> {
        assert!(self.trial.step.is_some(), "begin_step comes before assemble");
        if with_tangent {
            self.factor_log.forget();
        }
        let iterate = Iterate {
            flow: &self.trial.flow,
            cells: self.mesh.cells(),
            points: &self.trial.points,
            values: &self.trial.values,
            mesh_velocity: &self.trial.mesh_velocity,
            history: &self.trial.history,
            body_force: &self.trial.body_force,
            natural: &self.boundaries.natural,
            frames: &self.frames,
            convects: self.settings.convection,
        };
        let (assembly, shared, prescribed) =
            (&mut self.assembly, &mut self.shared, &self.boundaries.prescribed);
        Ok(timed(&mut self.phases.assembly, || {
            let norm = assembly.assemble(&iterate, with_tangent);
            // Here, so that residual and stresses are those of one iterate on one mesh.
            shared.update(&iterate, &assembly.residual, prescribed);
            norm
        }))
    }

    fn solve_and_update(&mut self) -> Result<(), FluidError> {
        let time = self.end_of_step();
        let Self { factor, assembly, phases, .. } = self;
        timed(&mut phases.factorization, || factor.refactor(&assembly.tangent))
            .map_err(|source| FluidError::Factorization { time, source })?;
        self.factor_log.factored(self.coefficients());
        self.solve_reusing_factor()
    }

    fn round_offs(&mut self) -> f64 {
        self.residual_in_round_off()
    }

    fn reusable_factor(&self) -> ReusableFactor {
        self.factor_log.worth(&self.coefficients(), self.is_linear())
    }

    fn take_back(&mut self) {
        for (value, increment) in self.trial.values.iter_mut().zip(&self.increment) {
            *value -= increment;
        }
    }

    fn drop_factor(&mut self) {
        self.factor_log.forget();
    }

    fn solve_reusing_factor(&mut self) -> Result<(), FluidError> {
        let Self { factor, assembly, phases, increment, frames, trial, .. } = self;
        timed(&mut phases.solve, || factor.solve(&mut assembly.right_hand_side));
        increment.fill(0.0);
        assembly.dofs.add_scaled(1.0, &assembly.right_hand_side, increment);
        for &node in frames.turned_nodes() {
            let frame = frames.at(node).expect("a turned node has a frame");
            let nodal = &mut increment[node * (D + 1)..node * (D + 1) + D];
            let turned: [f64; D] = std::array::from_fn(|i| nodal[i]);
            for i in 0..D {
                nodal[i] = (0..D).map(|j| frame[j][i] * turned[j]).sum();
            }
        }
        for (value, increment) in trial.values.iter_mut().zip(increment.iter()) {
            *value += increment;
        }
        Ok(())
    }
}
