//! A structure as a field that is solved step after step.

use partita_numerics::field::{Field, FieldWork, LargestResidual, Part};
use partita_numerics::newton::{self, Coefficients, FactorLog};
use partita_numerics::norms::{extent, largest_at};
use partita_numerics::{Pattern, PhaseSeconds, Place};

use crate::error::StructureError;
use crate::solver::StructureSolver;
use crate::state::StructureState;
use crate::step::Step;

/// The equation of each component, in words.
const EQUATIONS: [&str; 3] = ["force in x", "force in y", "force in z"];

impl<const D: usize> Field for StructureSolver<D> {
    type State = StructureState;
    const NAME: &'static str = "structure";

    /// `d = d_n` under the body force of `time` and the interface force of the committed state, until
    /// [`impose`](Field::impose) replaces it.
    fn begin_step(&mut self, time: f64, dt: f64) -> Result<(), StructureError> {
        if !(time.is_finite() && dt > 0.0 && dt.is_finite()) {
            return Err(StructureError::TimeStep { time, dt });
        }
        self.step = Some(Step::new(self.scheme, dt));
        self.trial.copy_from(&self.committed);
        self.set_time(time);
        self.update_rates();
        Ok(())
    }

    /// Forces `[N, in 2D N/m]` at the interface points at `t_{n+1}`, numbered `point * D + c`. Like every load they act at
    /// `n+1-alpha_f`, averaged with those of `t_n`. No force breaks a structure before its equations are solved.
    fn impose(&mut self, interface_force: &[f64]) -> Result<(), StructureError> {
        assert_eq!(
            interface_force.len(),
            self.trial.interface_force.len(),
            "the interface force has the wrong length"
        );
        self.trial.interface_force.copy_from_slice(interface_force);
        self.update_external_force();
        Ok(())
    }

    /// Displacements `[m]` of the interface points at `t_{n+1}`, numbered `point * D + c`.
    fn output(&self, displacement: &mut [f64]) {
        let points = self.interface_points();
        assert_eq!(displacement.len(), points.len() * D, "the output has the wrong length");
        let all = self.trial.displacement.as_chunks::<D>().0;
        for (entry, &point) in displacement.as_chunks_mut::<D>().0.iter_mut().zip(points) {
            *entry = all[point];
        }
    }

    /// Refuses a trial state whose det F is not positive at every quadrature point.
    ///
    /// On the way to a solution Newton's method may pass through such states; a solution that is one has no physical
    /// meaning, and St. Venant-Kirchhoff's law, whose energy stays finite there, does not keep it away. Linear
    /// elasticity takes no notice of large deformations and is left alone.
    ///
    /// # Errors
    /// [`StructureError::Folded`] names the element of the smallest determinant.
    fn verify(&mut self) -> Result<(), StructureError> {
        if self.model.material.is_linear() {
            return Ok(());
        }
        match self.assembly.fold(&self.trial.displacement, &mut self.work.local) {
            None => Ok(()),
            Some((element, place, determinant)) => {
                Err(StructureError::Folded { element, place: place.to_vec(), determinant })
            }
        }
    }

    fn commit(&mut self) {
        self.committed.copy_from(&self.trial);
    }

    fn rewind(&mut self) {
        self.factor_log.forget();
        self.trial.copy_from(&self.committed);
    }

    fn state(&self) -> &StructureState {
        &self.committed
    }

    fn restore(&mut self, state: &StructureState) -> Result<(), StructureError> {
        self.committed.check_fits(state)?;
        self.committed.copy_from(state);
        self.rewind();
        Ok(())
    }

    /// Displacement of all control points `[m]`, numbered `control_point * D + c`.
    fn values(&self) -> &[f64] {
        &self.trial.displacement
    }

    /// One part, `displacement`.
    fn parts(&self) -> &[Part] {
        &self.parts
    }

    /// Displacements `[m]` whose difference has a smaller norm are the same shape: they differ by less than the last bit of the
    /// coordinates.
    fn resolution(&self, _: usize) -> f64 {
        f64::EPSILON * extent(self.space.points())
    }

    fn output_resolution(&self) -> f64 {
        self.resolution(0)
    }

    /// The force that is left over `[N, in 2D N/m]`. The place is that in the reference configuration: a displacement that has
    /// gone astray shows nobody anything.
    fn largest_residual(&self) -> Option<LargestResidual> {
        let residual = self.residual();
        let dof = largest_at(residual, self.assembly.dofs().free())?;
        let (node, component) = (dof / D, dof % D);
        Some(LargestResidual {
            node,
            place: Place(self.space.points()[node].to_vec()),
            equation: EQUATIONS[component],
            residual: residual[dof],
            noun: "control point",
            undeformed: true,
        })
    }

    fn newton_settings(&self) -> &newton::Settings {
        &self.settings.newton
    }

    fn phases(&self) -> PhaseSeconds {
        self.phases
    }

    /// A tangent that is not positive definite is factored twice.
    fn work(&self) -> FieldWork {
        FieldWork { fallbacks: self.indefinite_tangents(), ..FieldWork::default() }
    }

    fn is_linear(&self) -> bool {
        self.model.material.is_linear()
    }

    fn keeps_factor(&self) -> bool {
        self.is_linear() || self.settings.newton.reuse_factor.is_some()
    }

    fn coefficients(&self) -> Coefficients {
        let weights = self.step().tangent_weights();
        [weights.mass, weights.damping, weights.stiffness]
    }

    fn factor_log(&self) -> &FactorLog {
        &self.factor_log
    }

    /// dR/d(d_{n+1}) `[N/m, in 2D N/m^2]`.
    fn tangent(&self) -> (&Pattern, &[f64]) {
        (self.assembly.pattern(), &self.work.tangent)
    }

    fn factor_tangent(&mut self, values: &[f64], coefficients: Coefficients) -> Result<(), StructureError> {
        self.work.tangent.copy_from_slice(values);
        self.factor.refactor(self.assembly.pattern(), &self.work.tangent)?;
        self.factor_log.factored(coefficients);
        Ok(())
    }
}
