//! A domain without outflow: what is prescribed on its boundary must keep its volume.

use partita_mesh::Mesh;
use partita_numerics::time::Bdf;

use crate::boundary::{Boundaries, MovedMesh, evaluate};
use crate::error::FluidError;
use crate::model::BoundaryCondition;
use crate::probe::flux;
use crate::settings::TimeScheme;
use crate::solver::FluidSolver;

/// Net flux relative to the speeds on the boundary times its size that still counts as balanced. Relative to what passes
/// the boundary it would be one rounding by another where a wall turns under the fluid.
const BALANCED: f64 = 1e-8;
/// Roundings that the coordinates of a moving wall may carry.
const ROUNDINGS: f64 = 64.0;

/// The boundary at the end of a step.
pub(crate) struct State<'a, const D: usize> {
    pub(crate) time: f64,
    pub(crate) points: &'a [[f64; D]],
    /// u and p, `node * (D + 1) + c`.
    pub(crate) values: &'a [f64],
    pub(crate) bdf: Option<Bdf>,
}

/// Whether the prescribed velocities of a closed domain keep its volume: `sum over the boundary of (u, n) = 0` to round-off.
/// On moving walls u is what [`ClosedWalls`](crate::boundary::ClosedWalls) makes of w, so that this is the balance
/// `D_t V + (inflow and outflow) = 0` of the moved mesh itself.
///
/// # Errors
///
/// [`FluidError::NetFlux`] if they do not.
pub(crate) fn check<const D: usize>(
    mesh: &Mesh<D>,
    boundaries: &Boundaries<D>,
    state: &State<'_, D>,
) -> Result<(), FluidError> {
    let &State { time, points, values, bdf } = state;
    let (mut net, mut gross, mut allowed) = (0.0, 0.0, 0.0);
    // A wall at rest is a difference of equal coordinates: what is left of it are their roundings.
    let moving = boundaries.closed_walls.as_ref().and(bdf);
    let rate = moving.map_or(0.0, |bdf| bdf.c.iter().map(|c| c.abs()).sum::<f64>());
    for facet in mesh.topology().boundary() {
        let flux = flux(facet, points, values, D + 1);
        net += flux;
        gross += f64::abs(flux);
        let speed = largest(facet.nodes.iter().flat_map(|node| &values[node * (D + 1)..][..D]));
        let reach = largest(facet.nodes.iter().flat_map(|node| &points[*node]));
        allowed += facet.area(points) * (BALANCED * speed + ROUNDINGS * f64::EPSILON * rate * reach);
    }
    if f64::abs(net) > allowed {
        return Err(FluidError::NetFlux { time, net, gross, moves: moving.is_some(), dimension: D });
    }
    Ok(())
}

fn largest<'a>(numbers: impl Iterator<Item = &'a f64>) -> f64 {
    numbers.fold(0.0, |most, x| most.max(x.abs()))
}

impl<const D: usize> FluidSolver<D> {
    /// Whether the normal velocity is prescribed all round, so that the boundary has to keep the volume.
    #[must_use]
    pub fn is_closed(&self) -> bool {
        self.boundaries.is_closed
    }

    /// Whether what is prescribed at the end of a step of `dt` `[s]` that ends at `time` `[s]` is finite and keeps the volume
    /// of a closed domain. Nothing is solved and the state does not matter: walls with a motion of their own are put where
    /// their formulas say, at this time and at those of the steps before. A boundary that another field moves stays where
    /// it is.
    ///
    /// # Errors
    ///
    /// [`FluidError::NotFinite`] and [`FluidError::NetFlux`], as [`begin_step`](partita_numerics::Field::begin_step) would in a run that
    /// gets there.
    pub fn check_prescribed(&self, time: f64, dt: f64) -> Result<(), FluidError> {
        let mut boundaries = Boundaries::new(&self.mesh, &self.model, &self.settings)?;
        let bdf = match self.settings.time {
            TimeScheme::Steady => None,
            TimeScheme::Bdf(order) => Some(Bdf::of_order(order, dt, (time > 1.5 * dt).then_some(dt))),
        };
        let walls = |steps: f64| self.walls_at(time - steps * dt, 0.5 * dt);
        let (newest, current, previous) = (walls(0.0)?, walls(1.0)?, walls(2.0)?);
        let node_of = |node: usize| -> [f64; D] {
            std::array::from_fn(|c| self.mesh.points()[node][c] + newest[node * D + c])
        };
        let points: Vec<[f64; D]> = (0..self.mesh.points().len()).map(node_of).collect();
        let mut velocity = vec![0.0; newest.len()];
        if let Some(bdf) = &bdf {
            for (i, w) in velocity.iter_mut().enumerate() {
                *w = bdf.derivative(newest[i], current[i], previous[i]);
            }
            if let Some(walls) = &mut boundaries.closed_walls {
                walls.update(self.mesh.points(), [&newest, &current, &previous], bdf);
            }
        }
        let mut frames = self.frames.clone();
        frames.update(&boundaries.slip, &points);
        let mut values = vec![0.0; points.len() * (D + 1)];
        let moved = MovedMesh { time, points: &points, velocity: &velocity };
        boundaries.impose(&self.model, &moved, &frames, &mut values)?;
        if !boundaries.is_closed {
            return Ok(());
        }
        check(&self.mesh, &boundaries, &State { time, points: &points, values: &values, bdf })
    }

    /// Displacements of the walls with a motion of their own `[m]`, zero elsewhere and up to `start` `[s]`.
    fn walls_at(&self, time: f64, start: f64) -> Result<Vec<f64>, FluidError> {
        let mut displacement = vec![0.0; self.mesh.points().len() * D];
        if time < start {
            return Ok(displacement);
        }
        for &(node, condition) in &self.boundaries.wall_motion {
            let BoundaryCondition::WallMotion(field) = &self.model.boundary[condition].1 else {
                unreachable!("a moving wall comes from a wall motion")
            };
            let given = evaluate(field, &self.mesh.points()[node], time, "wall displacement", node)?;
            displacement[node * D..(node + 1) * D].copy_from_slice(&given);
        }
        Ok(displacement)
    }
}
