//! The flow in the tube.

use std::f64::consts::PI;

use serde::{Deserialize, Serialize};

use super::Tube;
use crate::models::Field;
use crate::participant::Step;
use crate::vector::{norm, ratio};

/// The flow at one time.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct FlowState {
    /// Velocity on the faces, inlet first \[m/s\].
    pub velocity: Vec<f64>,
    /// Pressure in the cells \[Pa\].
    pub pressure: Vec<f64>,
    /// Radial displacement of the wall in the cells \[m\].
    pub displacement: Vec<f64>,
}

impl FlowState {
    pub(super) fn at_rest(cells: usize) -> Self {
        Self { velocity: vec![0.0; cells + 1], pressure: vec![0.0; cells], displacement: vec![0.0; cells] }
    }

    /// Mean velocity of cell `i`.
    fn mean_velocity(&self, i: usize) -> f64 {
        0.5 * (self.velocity[i] + self.velocity[i + 1])
    }
}

/// The flow field: settings and workspace.
#[derive(Debug, Clone)]
pub struct Flow {
    tube: Tube,
    dt: f64,
    /// Areas of the faces \[m²\].
    area: Vec<f64>,
    /// Continuity residual of the cells \[m³/s\].
    continuity: Vec<f64>,
    /// Momentum residual of the faces behind the cells \[Pa\].
    momentum: Vec<f64>,
    /// Increment of the velocities.
    increment: Vec<f64>,
}

impl Flow {
    pub(super) fn new(tube: Tube) -> Self {
        let cells = tube.cells;
        Self {
            tube,
            dt: 1.0,
            area: vec![0.0; cells + 1],
            continuity: vec![0.0; cells],
            momentum: vec![0.0; cells],
            increment: vec![0.0; cells + 1],
        }
    }

    /// Length that the momentum of the face behind cell `i` stands for: half a cell at the outlet.
    fn momentum_length(&self, i: usize) -> f64 {
        if i + 1 == self.tube.cells { 0.5 * self.tube.dx() } else { self.tube.dx() }
    }

    /// `dA/dt` of cell `i`, written without the difference of two large areas.
    fn area_rate(&self, i: usize, committed: &FlowState, trial: &FlowState) -> f64 {
        let (new, old) = (trial.displacement[i], committed.displacement[i]);
        PI * (new - old) * (2.0 * self.tube.radius + new + old) / self.dt
    }

    /// Velocity behind the face that follows cell `i`: the mean of the next cell, at the outlet its own.
    fn next_velocity(&self, i: usize, state: &FlowState) -> f64 {
        if i + 1 == self.tube.cells { state.velocity[i + 1] } else { state.mean_velocity(i + 1) }
    }
}

impl Field for Flow {
    type State = FlowState;

    fn name(&self) -> &'static str {
        "flow"
    }

    fn begin_step(&mut self, step: &Step, _: &FlowState, trial: &mut FlowState) {
        self.dt = step.dt;
        trial.velocity[0] = self.tube.inflow_peak * (PI * step.time / self.tube.inflow_period).sin().powi(2);
    }

    fn impose(&mut self, input: &[f64], trial: &mut FlowState) -> Result<(), String> {
        if let Some(cell) = input.iter().position(|d| self.tube.radius + d <= 0.0) {
            let radius = self.tube.radius + input[cell];
            return Err(format!("the tube is closed at cell {cell}: its radius would be {radius:.3e} m"));
        }
        trial.displacement.copy_from_slice(input);
        let cells = self.tube.cells;
        let area = |i: usize| PI * (self.tube.radius + input[i]).powi(2);
        self.area[0] = area(0);
        self.area[cells] = area(cells - 1);
        for face in 1..cells {
            self.area[face] = 0.5 * (area(face - 1) + area(face));
        }
        Ok(())
    }

    fn residual(&mut self, committed: &FlowState, trial: &FlowState) -> f64 {
        let (rho, dx, cells) = (self.tube.fluid_density, self.tube.dx(), self.tube.cells);
        let mut continuity_terms = [0.0; 3];
        let mut momentum_terms = [0.0; 3];
        for i in 0..cells {
            let storage = dx * self.area_rate(i, committed, trial);
            let outflow = self.area[i + 1] * trial.velocity[i + 1];
            let inflow = self.area[i] * trial.velocity[i];
            self.continuity[i] = storage + outflow - inflow;
            add_squares(&mut continuity_terms, [storage, outflow, inflow]);

            let acceleration = (trial.velocity[i + 1] - committed.velocity[i + 1]) / self.dt;
            let inertia = rho * self.momentum_length(i) * acceleration;
            let head = |velocity: f64| 0.5 * rho * velocity * velocity;
            let convection = head(self.next_velocity(i, trial)) - head(trial.mean_velocity(i));
            let next_pressure = trial.pressure.get(i + 1).copied().unwrap_or(0.0);
            let pressure = next_pressure - trial.pressure[i];
            self.momentum[i] = inertia + convection + pressure;
            add_squares(&mut momentum_terms, [inertia, convection, pressure]);
        }
        let largest = |terms: &[f64]| terms.iter().copied().fold(0.0, f64::max).sqrt();
        let continuity = ratio(norm(&self.continuity), largest(&continuity_terms));
        let momentum = ratio(norm(&self.momentum), largest(&momentum_terms));
        if continuity.is_nan() || momentum.is_nan() { f64::NAN } else { continuity.max(momentum) }
    }

    /// With the areas given, continuity is a sweep from the inlet and momentum one from the outlet.
    fn solve_and_update(&mut self, _: &FlowState, trial: &mut FlowState) {
        let (rho, cells) = (self.tube.fluid_density, self.tube.cells);
        self.increment[0] = 0.0;
        for i in 0..cells {
            self.increment[i + 1] =
                (self.area[i] * self.increment[i] - self.continuity[i]) / self.area[i + 1];
        }
        let mut pressure_increment = 0.0;
        for i in (0..cells).rev() {
            let du = &self.increment;
            let mean = 0.5 * (du[i] + du[i + 1]);
            let next = if i + 1 == cells { du[i + 1] } else { 0.5 * (du[i + 1] + du[i + 2]) };
            let inertia = self.momentum_length(i) / self.dt * du[i + 1];
            let convection = self.next_velocity(i, trial) * next - trial.mean_velocity(i) * mean;
            pressure_increment += self.momentum[i] + rho * (inertia + convection);
            trial.pressure[i] += pressure_increment;
        }
        for (velocity, increment) in trial.velocity.iter_mut().zip(&self.increment) {
            *velocity += increment;
        }
    }

    fn output(&self, _: &FlowState, trial: &FlowState, output: &mut [f64]) {
        for ((force, p), d) in output.iter_mut().zip(&trial.pressure).zip(&trial.displacement) {
            *force = p * 2.0 * PI * (self.tube.radius + d) * self.tube.dx();
        }
    }

    fn parts<'a>(&self, trial: &'a FlowState) -> Vec<(&'static str, &'a [f64])> {
        vec![("velocity", &trial.velocity[1..]), ("pressure", &trial.pressure)]
    }

    fn finish_step(&mut self, _: &FlowState, _: &mut FlowState) {}
}

fn add_squares<const N: usize>(sums: &mut [f64; N], terms: [f64; N]) {
    for (sum, term) in sums.iter_mut().zip(terms) {
        *sum += term * term;
    }
}
