//! Where the equations are satisfied worst.

use std::fmt;

use partita_mesh::Place;

use crate::solver::FluidSolver;

/// The equation of a node that misses its balance most.
#[derive(Debug, Clone, PartialEq)]
pub struct WorstEquation {
    /// The node.
    pub node: usize,
    /// Where it is in the moved mesh.
    pub place: Place,
    /// `momentum in x`, `continuity` or the like.
    pub equation: &'static str,
    /// Its residual: `[N/m]` and `[m^2/s]` in 2D, `[N]` and `[m^3/s]` in 3D.
    pub residual: f64,
}

impl fmt::Display for WorstEquation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} at node {}, {}", self.equation, self.node, self.place)
    }
}

impl<const D: usize> FluidSolver<D> {
    /// The free equation with the largest residual of the last assembly, of the block, momentum or continuity, that
    /// decided the norm; one that is not finite is the worst. Nothing where no equation of the block is free.
    #[must_use]
    pub fn worst_equation(&self) -> Option<WorstEquation> {
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
        Some(WorstEquation { node, place: Place::from(self.trial.points[node]), equation, residual: -value })
    }
}
