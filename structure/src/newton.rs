//! A structure as a nonlinear system for d_{n+1}.

use partita_numerics::Field;
use partita_numerics::newton::{Problem, ResidualNorm, ReusableFactor};
use partita_numerics::norms::{norm2_at, relative};
use partita_numerics::phases::{Stopwatch, timed};

use crate::assembly::Tangent;
use crate::error::StructureError;
use crate::model::LineSearch;
use crate::solver::{StructureSolver, Work};
use crate::step::average;

/// Relative error of a displacement. What is left of a residual is 0.05 to 0.3 of what this makes of it.
const ROUNDING: f64 = f64::EPSILON;

/// Relative error of a force that is a sum of some terms.
const SUMMING: f64 = 4.0 * f64::EPSILON;

impl<const D: usize> Problem for StructureSolver<D> {
    type Error = StructureError;

    /// Relative is `|R| / max(|f_int|, |C v|, |M a|, |f_ext|)`, all over the free dofs, 0/0 = 0.
    fn assemble(&mut self, with_tangent: bool) -> Result<ResidualNorm, StructureError> {
        if with_tangent {
            self.factor_log.forget();
        }
        let watch = Stopwatch::start();
        let residual = self.evaluate(with_tangent).map(|()| self.residual_norm());
        watch.stop(&mut self.phases.assembly);
        residual
    }

    fn solve_and_update(&mut self) -> Result<(), StructureError> {
        let (pattern, tangent) = (self.assembly.pattern(), &self.work.tangent);
        timed(&mut self.phases.factorization, || self.factor.refactor(pattern, tangent))?;
        self.factor_log.factored(self.coefficients());
        self.solve_reusing_factor()
    }

    /// The unit is that of the last bits: of the displacement, in every term that depends on it, and of the terms themselves.
    fn round_offs(&mut self) -> f64 {
        self.residual_in_round_off()
    }

    fn reusable_factor(&self) -> ReusableFactor {
        self.factor_log.worth(&self.coefficients(), self.is_linear())
    }

    fn take_back(&mut self) {
        self.trial.displacement.copy_from_slice(&self.work.start);
        self.update_rates();
    }

    fn drop_factor(&mut self) {
        self.factor_log.forget();
    }

    fn solve_reusing_factor(&mut self) -> Result<(), StructureError> {
        let Work { residual, increment, start, .. } = &mut self.work;
        start.copy_from_slice(&self.trial.displacement);
        let dofs = self.assembly.dofs();
        dofs.gather(residual, increment);
        timed(&mut self.phases.solve, || self.factor.solve(increment));
        for entry in &mut *increment {
            *entry = -*entry;
        }
        match self.settings.line_search {
            None => {
                dofs.add_scaled(1.0, increment, &mut self.trial.displacement);
                self.update_rates();
            }
            Some(settings) => self.search_along_increment(settings),
        }
        Ok(())
    }
}

impl<const D: usize> StructureSolver<D> {
    /// Residual, and tangent where asked for, at the trial displacement.
    fn evaluate(&mut self, with_tangent: bool) -> Result<(), StructureError> {
        let step = *self.step();
        let (new, old) = (&self.trial, &self.committed);
        let Work { motion, forces, external, residual, tangent, local, .. } = &mut self.work;
        average(step.alpha_f(), &new.displacement, &old.displacement, &mut motion.displacement);
        average(step.alpha_f(), &new.velocity, &old.velocity, &mut motion.velocity);
        average(step.alpha_m(), &new.acceleration, &old.acceleration, &mut motion.acceleration);
        average(step.alpha_f(), &new.external_force, &old.external_force, external);

        let tangent = with_tangent.then(|| Tangent { weights: step.tangent_weights(), values: tangent });
        self.assembly.evaluate(motion, tangent, local, forces)?;
        for dof in 0..residual.len() {
            residual[dof] = forces.inertia[dof] + forces.damping[dof] + forces.internal[dof] - external[dof];
        }
        Ok(())
    }

    /// The residual in units of its round-off.
    fn residual_in_round_off(&mut self) -> f64 {
        let weights = self.step().tangent_weights();
        let residual = self.residual_norm();
        let Work { motion, local, .. } = &mut self.work;
        let rounding = self.assembly.rounding(&motion.displacement, &weights, local);
        relative(residual.absolute, (ROUNDING * rounding).hypot(SUMMING * residual.scale()))
    }

    fn residual_norm(&self) -> ResidualNorm {
        let norm = |vector: &[f64]| norm2_at(vector, self.assembly.dofs().free());
        let Work { forces, external, residual, .. } = &self.work;
        let terms = [&forces.internal, &forces.damping, &forces.inertia, external];
        let scale = terms.into_iter().map(|term| norm(term)).fold(0.0, f64::max);
        ResidualNorm::new(norm(residual), scale)
    }

    /// d + s delta with the s in (0, 1] at which the work G(s) = delta . R(d + s delta) has fallen enough.
    fn search_along_increment(&mut self, settings: LineSearch) {
        let work_at_start = self.work_along_increment();
        let enough = settings.tolerance * work_at_start.abs();
        // G changes sign between `low` and `high`, once the full step has turned out to overshoot.
        let (mut low, mut work_low) = (0.0, work_at_start);
        let (mut high, mut work_high) = (1.0, 0.0);
        let mut s = 1.0;
        for evaluation in 1..=settings.max_evaluations {
            let work = self.try_step(s);
            let falls_short = work * work_at_start > 0.0;
            let is_full_step = evaluation == 1;
            if work.abs() <= enough || (is_full_step && falls_short) || evaluation == settings.max_evaluations
            {
                return;
            }
            if falls_short {
                (low, work_low) = (s, work);
            } else {
                (high, work_high) = (s, work);
            }
            // Regula falsi, kept off the ends: a stiffening structure overshoots by orders of magnitude. Where G is not
            // a number, `max` takes the shorter end.
            let root = low - work_low * (high - low) / (work_high - work_low);
            let margin = 0.1 * (high - low);
            s = root.max(low + margin).min(high - margin);
        }
    }

    /// Moves to start + s delta and returns G(s) there: no number where the material has no stress, so that the search
    /// draws back from such steps.
    fn try_step(&mut self, s: f64) -> f64 {
        self.trial.displacement.copy_from_slice(&self.work.start);
        self.assembly.dofs().add_scaled(s, &self.work.increment, &mut self.trial.displacement);
        self.update_rates();
        let watch = Stopwatch::start();
        let evaluated = self.evaluate(false);
        watch.stop(&mut self.phases.assembly);
        evaluated.map_or(f64::NAN, |()| self.work_along_increment())
    }

    /// delta . R over the free dofs.
    fn work_along_increment(&self) -> f64 {
        let Work { residual, increment, .. } = &self.work;
        let free = self.assembly.dofs().free();
        free.iter().zip(increment).map(|(&dof, delta)| delta * residual[dof]).sum()
    }
}
