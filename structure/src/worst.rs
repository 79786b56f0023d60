//! Where a structure is worst off: the largest residual, matter that is turned inside out.

use std::fmt;

use partita_numerics::norms::largest_at;

use crate::error::{StructureError, shown};
use crate::material::Law;
use crate::solver::StructureSolver;

/// The equation of a control point that misses its balance most.
#[derive(Debug, Clone, PartialEq)]
pub struct WorstEquation {
    /// The control point.
    pub point: usize,
    /// Where it is in the reference configuration `[m]`: a displacement that has gone astray shows nobody anything.
    pub place: Vec<f64>,
    /// Direction of the force, 0 for x.
    pub component: usize,
    /// The force that is left over `[N, in 2D N/m]`.
    pub residual: f64,
}

impl fmt::Display for WorstEquation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let direction = ["x", "y", "z"][self.component];
        write!(
            f,
            "force in {direction} at control point {}, undeformed at {}",
            self.point,
            shown(&self.place)
        )
    }
}

impl<const D: usize> StructureSolver<D> {
    /// The free equation with the largest residual of the last assembly; one that is not finite is the worst.
    #[must_use]
    pub fn worst_equation(&self) -> Option<WorstEquation> {
        let residual = self.residual();
        let dof = largest_at(residual, self.assembly.dofs().free())?;
        let (point, component) = (dof / D, dof % D);
        let place = self.space.points()[point].to_vec();
        Some(WorstEquation { point, place, component, residual: residual[dof] })
    }

    /// Refuses a trial state whose det F is not positive at every quadrature point.
    ///
    /// On the way to a solution Newton's method may pass through such states; a solution that is one has no physical
    /// meaning, and St. Venant-Kirchhoff's law, whose energy stays finite there, does not keep it away. Linear
    /// elasticity takes no notice of large deformations and is left alone.
    ///
    /// # Errors
    /// [`StructureError::Folded`] names the element of the smallest determinant.
    pub fn check_orientation(&mut self) -> Result<(), StructureError> {
        if self.model.material.law() == Law::LinearElastic {
            return Ok(());
        }
        match self.assembly.fold(&self.trial.displacement, &mut self.work.local) {
            None => Ok(()),
            Some((element, place, determinant)) => {
                Err(StructureError::Folded { element, place: place.to_vec(), determinant })
            }
        }
    }
}
