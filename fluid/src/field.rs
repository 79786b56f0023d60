//! A fluid as a field that is solved step after step.

use partita_mesh::motion::MeshMotion;
use partita_numerics::field::{Field, FieldWork, LargestResidual, Part};
use partita_numerics::newton::{self, Coefficients, FactorLog};
use partita_numerics::phases::timed;
use partita_numerics::time::Bdf;
use partita_numerics::{Pattern, PhaseSeconds, Place};

use crate::error::FluidError;
use crate::settings::TimeScheme;
use crate::solver::FluidSolver;
use crate::state::FluidState;

impl<const D: usize> Field for FluidSolver<D> {
    type State = FluidState;
    const NAME: &'static str = "fluid";

    /// Walls with a motion of their own have moved; the interface is where it was committed until [`impose`](Field::impose)
    /// says otherwise. A steady flow takes `dt` for nothing.
    ///
    /// # Errors
    /// If `dt` is not positive, a prescribed value is not finite, prescribed velocities and moving walls of a closed
    /// domain do not keep its volume, or the mesh cannot follow its walls.
    fn begin_step(&mut self, time: f64, dt: f64) -> Result<(), FluidError> {
        if !(time.is_finite() && dt > 0.0 && dt.is_finite()) {
            return Err(FluidError::TimeStep { time, dt });
        }
        let bdf = match self.settings.time {
            TimeScheme::Steady => None,
            TimeScheme::Bdf(order) => Some(Bdf::of_order(order, dt, self.committed.last_dt)),
        };
        self.trial.begin(&self.mesh, &self.committed, (time, dt), bdf);
        if let Some(motion) = &mut self.motion {
            let begun = timed(&mut self.phases.motion, || motion.begin_step(&self.committed.displacement));
            begun.map_err(|source| FluidError::Motion { time, source })?;
        }
        if !self.boundaries.wall_motion.is_empty() {
            self.move_walls(time)?;
            self.move_mesh(time)?;
        }
        self.follow_mesh(time)
    }

    /// Moves the interface: total displacement from the reference mesh `[m]` at the
    /// [`interface_nodes`](Self::interface_nodes) that are not rigid, `point * D + c`. The mesh follows, and with it mesh
    /// velocity, prescribed values and loads.
    ///
    /// # Errors
    /// If a displacement is not finite or inverts a cell.
    fn impose(&mut self, displacement: &[f64]) -> Result<(), FluidError> {
        let time = self.end_of_step();
        let nodes = &self.boundaries.moved_interface;
        assert_eq!(displacement.len(), nodes.len() * D, "an interface displacement has {D} entries a node");
        for (node, given) in nodes.iter().zip(displacement.chunks_exact(D)) {
            self.trial.displacement[node * D..(node + 1) * D].copy_from_slice(given);
        }
        self.move_mesh(time)?;
        self.follow_mesh(time)
    }

    /// The consistent forces of the fluid on the interface, see [`interface_force`](Self::interface_force).
    fn output(&self, force: &mut [f64]) {
        self.interface_force(force);
    }

    fn commit(&mut self) {
        self.last_volume_defect = self.volume_defect();
        let (time, dt) = self.trial.step.take().expect("commit ends a step that begin_step started");
        self.committed.advance(time, dt, &self.trial.values, &self.trial.displacement);
        self.trial.committed_mesh_velocity.copy_from_slice(&self.trial.mesh_velocity);
    }

    fn rewind(&mut self) {
        self.factor_log.forget();
        self.trial.reset(&self.mesh, &self.committed);
    }

    fn state(&self) -> &FluidState {
        &self.committed
    }

    /// The volume defect of the step before the state is not part of it.
    fn restore(&mut self, state: &FluidState) -> Result<(), FluidError> {
        self.committed.check_fits(state)?;
        self.committed.clone_from(state);
        self.last_volume_defect = 0.0;
        self.mesh_is_fixed &= state.displacement.iter().all(|d| *d == 0.0);
        // A state does not hold it.
        self.trial.committed_mesh_velocity.fill(0.0);
        self.rewind();
        Ok(())
    }

    /// u `[m/s]` and p `[Pa]` on all dofs, `node * (D + 1) + c`, pressure last.
    fn values(&self) -> &[f64] {
        &self.trial.values
    }

    /// Velocity and pressure. Of a node on an inclined slip wall all velocities are listed.
    fn parts(&self) -> &[Part] {
        &self.parts
    }

    /// Lengths over the time step for the velocity beside a moving interface, the scale of the pressure for the pressure.
    fn resolution(&self, part: usize) -> f64 {
        // Velocity comes first.
        if part == 0 { self.velocity_resolution() } else { self.pressure_resolution() }
    }

    /// Of the block, momentum or continuity, that decided the norm. Nothing where no equation of the block is free. Units:
    /// `[N/m]` and `[m^2/s]` in 2D, `[N]` and `[m^3/s]` in 3D. The place is that in the moved mesh.
    fn largest_residual(&self) -> Option<LargestResidual> {
        let assembly = &self.assembly;
        let size = |value: f64| if value.is_finite() { value.abs() } else { f64::INFINITY };
        let rows = assembly.dofs.free().iter().zip(&assembly.right_hand_side);
        let (&dof, value) = rows
            .filter(|(dof, _)| (*dof % (D + 1) == D) == assembly.continuity_is_worse)
            .reduce(|worst, row| if size(*row.1) > size(*worst.1) { row } else { worst })?;
        let (node, component) = (dof / (D + 1), dof % (D + 1));
        let equation = match component {
            _ if component == D => "continuity",
            _ if self.frames.at(node).is_some() => "momentum along the slip wall",
            0 => "momentum in x",
            1 => "momentum in y",
            _ => "momentum in z",
        };
        Some(LargestResidual {
            node,
            place: Place::from(self.trial.points[node]),
            equation,
            residual: -value,
            noun: "node",
            undeformed: false,
        })
    }

    fn newton_settings(&self) -> &newton::Settings {
        &self.settings.newton
    }

    fn phases(&self) -> PhaseSeconds {
        self.phases
    }

    fn work(&self) -> FieldWork {
        let motion = self.motion.as_ref();
        FieldWork {
            fallbacks: self.factor.fallbacks(),
            mesh_factorizations: motion.map_or(0, MeshMotion::factorizations),
            mesh_solves: motion.map_or(0, MeshMotion::solves),
        }
    }

    /// Without convection; the tangent then depends on the mesh, too.
    fn is_linear(&self) -> bool {
        !self.settings.convection
    }

    fn keeps_factor(&self) -> bool {
        self.settings.newton.reuse_factor.is_some() || (self.is_linear() && self.mesh_is_fixed)
    }

    fn coefficients(&self) -> Coefficients {
        [self.trial.flow.rate, self.trial.flow.four_over_dt_squared, 0.0]
    }

    fn factor_log(&self) -> &FactorLog {
        &self.factor_log
    }

    /// Rows and columns of nodes on inclined slip walls are in the frame of the wall.
    fn tangent(&self) -> (&Pattern, &[f64]) {
        (&self.assembly.pattern, &self.assembly.tangent)
    }

    fn factor_tangent(&mut self, values: &[f64], coefficients: Coefficients) -> Result<(), FluidError> {
        self.assembly.tangent.copy_from_slice(values);
        let time = self.committed.time;
        self.factor
            .refactor(&self.assembly.tangent)
            .map_err(|source| FluidError::Factorization { time, source })?;
        self.factor_log.factored(coefficients);
        Ok(())
    }
}
