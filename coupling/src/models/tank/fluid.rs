//! The water of the tank.

use serde::{Deserialize, Serialize};

use super::modes::Modes;
use super::{BdfOrder, Tank};
use crate::models::Field;
use crate::participant::Step;
use crate::vector::{norm, ratio, subtract};

/// The fluid at one time.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct FluidState {
    /// Pressure at the bottom \[Pa\].
    pub pressure: Vec<f64>,
    /// Displacement of the bottom at this time and one step before \[m\].
    pub displacement: [Vec<f64>; 2],
    /// Velocity of the bottom at this time and one step before \[m/s\].
    pub velocity: [Vec<f64>; 2],
    /// Size of the last step \[s\]; 0 at rest.
    pub dt: f64,
}

impl FluidState {
    pub(super) fn at_rest(points: usize) -> Self {
        let zeros = || [vec![0.0; points], vec![0.0; points]];
        Self { pressure: vec![0.0; points], displacement: zeros(), velocity: zeros(), dt: 0.0 }
    }
}

/// The fluid: settings and workspace.
#[derive(Debug, Clone)]
pub struct Fluid {
    tank: Tank,
    modes: Modes,
    added_mass: Vec<f64>,
    dt: f64,
    /// BDF coefficients of the new value, the last one and the one before \[1/s\].
    bdf: [f64; 3],
    amplitudes: Vec<f64>,
    acceleration: Vec<f64>,
    /// The pressure that belongs to the displacement.
    target: Vec<f64>,
}

impl Fluid {
    pub(super) fn new(tank: Tank, modes: Modes, added_mass: Vec<f64>) -> Self {
        let zeros = vec![0.0; modes.len()];
        let (amplitudes, acceleration, target) = (zeros.clone(), zeros.clone(), zeros);
        Self { tank, modes, added_mass, dt: 1.0, bdf: [0.0; 3], amplitudes, acceleration, target }
    }

    /// `D_t q = c0 q^{n+1} + c1 q^n + c2 q^{n-1}`, for steps of any size.
    fn coefficients(&self, dt: f64, before: f64) -> [f64; 3] {
        if self.tank.bdf == BdfOrder::One || before == 0.0 {
            return [1.0 / dt, -1.0 / dt, 0.0];
        }
        let growth = dt / before;
        [
            (1.0 + 2.0 * growth) / (1.0 + growth) / dt,
            -(1.0 + growth) / dt,
            growth * growth / (1.0 + growth) / dt,
        ]
    }

    fn derivative(&self, new: f64, old: &[Vec<f64>; 2], point: usize) -> f64 {
        self.bdf[0] * new + self.bdf[1] * old[0][point] + self.bdf[2] * old[1][point]
    }
}

impl Field for Fluid {
    type State = FluidState;

    fn name(&self) -> &'static str {
        "fluid"
    }

    fn begin_step(&mut self, step: &Step, committed: &FluidState, _: &mut FluidState) {
        self.dt = step.dt;
        self.bdf = self.coefficients(step.dt, committed.dt);
    }

    fn impose(&mut self, input: &[f64], trial: &mut FluidState) -> Result<(), String> {
        trial.displacement[0].copy_from_slice(input);
        Ok(())
    }

    fn residual(&mut self, committed: &FluidState, trial: &FluidState) -> f64 {
        for point in 0..self.modes.len() {
            let velocity = self.derivative(trial.displacement[0][point], &committed.displacement, point);
            self.acceleration[point] = self.derivative(velocity, &committed.velocity, point);
        }
        self.modes.amplitudes(&self.acceleration, &mut self.amplitudes);
        for (amplitude, mass) in self.amplitudes.iter_mut().zip(&self.added_mass) {
            *amplitude *= mass;
        }
        self.modes.values(&self.amplitudes, &mut self.target);
        let weight = self.tank.fluid_density * self.tank.gravity * self.tank.depth;
        for pressure in &mut self.target {
            *pressure += weight;
        }
        let largest = norm(&self.target).max(norm(&trial.pressure));
        subtract(&trial.pressure, &self.target, &mut self.acceleration);
        ratio(norm(&self.acceleration), largest)
    }

    fn solve_and_update(&mut self, _: &FluidState, trial: &mut FluidState) {
        trial.pressure.copy_from_slice(&self.target);
    }

    fn output(&self, _: &FluidState, trial: &FluidState, output: &mut [f64]) {
        let share = self.tank.width / self.modes.len() as f64;
        for (force, pressure) in output.iter_mut().zip(&trial.pressure) {
            *force = -pressure * share;
        }
    }

    fn parts<'a>(&self, trial: &'a FluidState) -> Vec<(&'static str, &'a [f64])> {
        vec![("pressure", &trial.pressure)]
    }

    fn finish_step(&mut self, committed: &FluidState, trial: &mut FluidState) {
        for point in 0..self.modes.len() {
            let new = trial.displacement[0][point];
            trial.velocity[0][point] = self.derivative(new, &committed.displacement, point);
        }
        trial.displacement[1].copy_from_slice(&committed.displacement[0]);
        trial.velocity[1].copy_from_slice(&committed.velocity[0]);
        trial.dt = self.dt;
    }
}
