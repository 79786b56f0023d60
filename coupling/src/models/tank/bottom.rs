//! The elastic bottom of the tank.

use serde::{Deserialize, Serialize};

use super::Tank;
use super::modes::Modes;
use crate::models::Field;
use crate::models::generalized_alpha::{Dof, GeneralizedAlpha};
use crate::participant::Step;
use crate::vector::{norm, ratio};

/// The bottom at one time.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct BottomState {
    /// Displacement of the points \[m\].
    pub displacement: Vec<f64>,
    /// Motion of the modes.
    pub modes: Vec<Dof>,
    /// Force on the points \[N/m\].
    pub force: Vec<f64>,
}

impl BottomState {
    pub(super) fn at_rest(points: usize) -> Self {
        let zeros = vec![0.0; points];
        Self { displacement: zeros.clone(), modes: vec![Dof::default(); points], force: zeros }
    }
}

/// The bottom: settings and workspace.
#[derive(Debug, Clone)]
pub struct Bottom {
    tank: Tank,
    scheme: GeneralizedAlpha,
    modes: Modes,
    stiffness: Vec<f64>,
    dt: f64,
    load: Vec<f64>,
    /// Amplitudes of the load, then of the residual \[Pa\].
    amplitudes: Vec<f64>,
}

impl Bottom {
    pub(super) fn new(tank: Tank, scheme: GeneralizedAlpha, modes: Modes, stiffness: Vec<f64>) -> Self {
        let zeros = vec![0.0; modes.len()];
        Self { tank, scheme, modes, stiffness, dt: 1.0, load: zeros.clone(), amplitudes: zeros }
    }
}

impl Field for Bottom {
    type State = BottomState;

    fn name(&self) -> &'static str {
        "bottom"
    }

    fn begin_step(&mut self, step: &Step, _: &BottomState, _: &mut BottomState) {
        self.dt = step.dt;
    }

    fn impose(&mut self, input: &[f64], trial: &mut BottomState) -> Result<(), String> {
        trial.force.copy_from_slice(input);
        Ok(())
    }

    fn residual(&mut self, committed: &BottomState, trial: &BottomState) -> f64 {
        let GeneralizedAlpha { alpha_m, alpha_f, .. } = self.scheme;
        let per_width = self.modes.len() as f64 / self.tank.width;
        for (point, load) in self.load.iter_mut().enumerate() {
            let ballast = if 2 * point + 1 < self.modes.len() { self.tank.ballast } else { 0.0 };
            let force = (1.0 - alpha_f) * trial.force[point] + alpha_f * committed.force[point];
            *load = force * per_width - ballast;
        }
        self.modes.amplitudes(&self.load, &mut self.amplitudes);
        let mut squares = [0.0; 3];
        for (mode, residual) in self.amplitudes.iter_mut().enumerate() {
            let (old, d) = (committed.modes[mode], trial.modes[mode].displacement);
            let new = self.scheme.acceleration(self.dt, d, old);
            let inertia = self.tank.bottom_mass * ((1.0 - alpha_m) * new + alpha_m * old.acceleration);
            let internal = self.stiffness[mode] * ((1.0 - alpha_f) * d + alpha_f * old.displacement);
            for (sum, term) in squares.iter_mut().zip([inertia, internal, *residual]) {
                *sum += term * term;
            }
            *residual = inertia + internal - *residual;
        }
        ratio(norm(&self.amplitudes), squares.into_iter().fold(0.0, f64::max).sqrt())
    }

    fn solve_and_update(&mut self, _: &BottomState, trial: &mut BottomState) {
        let inertia = self.tank.bottom_mass * self.scheme.mass_factor(self.dt);
        for (mode, residual) in self.amplitudes.iter_mut().enumerate() {
            let tangent = inertia + (1.0 - self.scheme.alpha_f) * self.stiffness[mode];
            trial.modes[mode].displacement -= *residual / tangent;
            *residual = trial.modes[mode].displacement;
        }
        self.modes.values(&self.amplitudes, &mut trial.displacement);
    }

    fn output(&self, _: &BottomState, trial: &BottomState, output: &mut [f64]) {
        output.copy_from_slice(&trial.displacement);
    }

    fn parts<'a>(&self, trial: &'a BottomState) -> Vec<(&'static str, &'a [f64])> {
        vec![("displacement", &trial.displacement)]
    }

    fn finish_step(&mut self, committed: &BottomState, trial: &mut BottomState) {
        for (dof, &old) in trial.modes.iter_mut().zip(&committed.modes) {
            dof.acceleration = self.scheme.acceleration(self.dt, dof.displacement, old);
            dof.velocity = self.scheme.velocity(self.dt, dof.acceleration, old);
        }
    }
}
