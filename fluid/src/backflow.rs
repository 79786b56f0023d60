//! Where fluid enters through a boundary that lets it leave.

use partita_mesh::Facet;

use crate::model::BoundaryCondition;
use crate::solver::FluidSolver;

/// A group whose condition leaves the velocity free, and the fluid that enters there.
#[derive(Debug, Clone, PartialEq)]
pub struct Backflow {
    /// The group.
    pub group: String,
    /// Its condition.
    pub outlet: Outlet,
    /// What enters, as part of all that passes the boundary inward or outward, between 0 and 1.
    pub share: f64,
}

/// Conditions that leave the velocity free.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Outlet {
    /// [`BoundaryCondition::DoNothing`].
    DoNothing {
        /// Whether its backflow is stabilized.
        stabilized: bool,
    },
    /// [`BoundaryCondition::StressFree`].
    StressFree {
        /// Whether its backflow is stabilized.
        stabilized: bool,
    },
    /// [`BoundaryCondition::Traction`], which may as well be an inlet driven by pressure.
    Traction,
}

/// Less than this part of all that passes the boundary is no backflow to speak of.
const NOTABLE: f64 = 1e-3;

impl<const D: usize> FluidSolver<D> {
    /// The groups through which fluid enters although their condition prescribes no velocity, in the committed state: the
    /// last one that can be trusted when a step fails.
    #[must_use]
    pub fn backflows(&self) -> Vec<Backflow> {
        let points = self.committed_points();
        let flux = |facet: &Facet<D>| self.committed_flux(facet, &points);
        let passing: f64 = self.mesh.topology().boundary().iter().map(|facet| flux(facet).abs()).sum();
        let of_group = |(group, condition): &(String, BoundaryCondition<D>)| {
            let outlet = Outlet::of(condition)?;
            let entering: f64 =
                self.mesh.group(group)?.facets.iter().map(|facet| (-flux(facet)).max(0.0)).sum();
            let is_notable = entering > NOTABLE * passing;
            is_notable.then(|| Backflow { group: group.clone(), outlet, share: entering / passing })
        };
        self.model.boundary.iter().filter_map(of_group).collect()
    }

    fn committed_points(&self) -> Vec<[f64; D]> {
        let displacements = self.committed.displacement.as_chunks::<D>().0;
        let moved = |(x, d): (&[f64; D], &[f64; D])| std::array::from_fn(|c| x[c] + d[c]);
        self.mesh.points().iter().zip(displacements).map(moved).collect()
    }

    /// (u - w, n) of the committed state through a facet, outward.
    fn committed_flux(&self, facet: &Facet<D>, points: &[[f64; D]]) -> f64 {
        let area_vector = facet.area_vector(points);
        let (values, mesh_velocity) = (&self.committed.values, &self.trial.committed_mesh_velocity);
        let through = |&node: &usize| -> f64 {
            let relative = |c: usize| values[node * (D + 1) + c] - mesh_velocity[node * D + c];
            (0..D).map(|c| area_vector[c] * relative(c)).sum()
        };
        facet.nodes.iter().map(through).sum::<f64>() / D as f64
    }
}

impl Outlet {
    fn of<const D: usize>(condition: &BoundaryCondition<D>) -> Option<Self> {
        match *condition {
            BoundaryCondition::DoNothing { backflow } => Some(Self::DoNothing { stabilized: backflow }),
            BoundaryCondition::StressFree { backflow } => Some(Self::StressFree { stabilized: backflow }),
            BoundaryCondition::Traction(_) => Some(Self::Traction),
            BoundaryCondition::NoSlip
            | BoundaryCondition::Slip
            | BoundaryCondition::Velocity(_)
            | BoundaryCondition::WallMotion(_)
            | BoundaryCondition::Interface
            | BoundaryCondition::RigidInterface => None,
        }
    }
}
