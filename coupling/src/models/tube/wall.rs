//! The wall of the tube.

use serde::{Deserialize, Serialize};

use super::Tube;
use crate::models::Field;
use crate::models::generalized_alpha::{Dof, GeneralizedAlpha};
use crate::participant::Step;
use crate::vector::{norm, ratio};

/// The wall at one time.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct WallState {
    /// Radial displacement in the cells \[m\].
    pub displacement: Vec<f64>,
    /// Radial velocity \[m/s\].
    pub velocity: Vec<f64>,
    /// Radial acceleration \[m/s²\].
    pub acceleration: Vec<f64>,
    /// Force of the flow on the cells \[N\].
    pub force: Vec<f64>,
}

impl WallState {
    pub(super) fn at_rest(cells: usize) -> Self {
        let zeros = vec![0.0; cells];
        Self {
            displacement: zeros.clone(),
            velocity: zeros.clone(),
            acceleration: zeros.clone(),
            force: zeros,
        }
    }

    fn dof(&self, i: usize) -> Dof {
        Dof {
            displacement: self.displacement[i],
            velocity: self.velocity[i],
            acceleration: self.acceleration[i],
        }
    }
}

/// The wall field: settings and workspace.
#[derive(Debug, Clone)]
pub struct Wall {
    tube: Tube,
    scheme: GeneralizedAlpha,
    dt: f64,
    /// Displacement at `n + 1 - alpha_f`.
    middle: Vec<f64>,
    residual: Vec<f64>,
    /// Diagonal of the tangent, eliminated in place.
    diagonal: Vec<f64>,
}

impl Wall {
    pub(super) fn new(tube: Tube, scheme: GeneralizedAlpha) -> Self {
        let zeros = vec![0.0; tube.cells];
        Self { tube, scheme, dt: 1.0, middle: zeros.clone(), residual: zeros.clone(), diagonal: zeros }
    }

    /// Axial stiffness between neighbouring cells, `2 pi r_0 T / dx` \[N/m\].
    fn axial_stiffness(&self) -> f64 {
        self.tube.wetted_area() * self.tube.tension / self.tube.dx().powi(2)
    }

    /// Row sum of the axial coupling of cell `i`: free at the inlet, held at half a cell behind the outlet.
    fn axial_weight(&self, i: usize) -> f64 {
        match i {
            0 => 1.0,
            _ if i + 1 == self.tube.cells => 3.0,
            _ => 2.0,
        }
    }
}

impl Field for Wall {
    type State = WallState;

    fn name(&self) -> &'static str {
        "wall"
    }

    fn begin_step(&mut self, step: &Step, _: &WallState, _: &mut WallState) {
        self.dt = step.dt;
    }

    fn impose(&mut self, input: &[f64], trial: &mut WallState) -> Result<(), String> {
        trial.force.copy_from_slice(input);
        Ok(())
    }

    /// `M a_{n+1-alpha_m} + f_int(d_{n+1-alpha_f}) - F_{n+1-alpha_f}`.
    fn residual(&mut self, committed: &WallState, trial: &WallState) -> f64 {
        let GeneralizedAlpha { alpha_m, alpha_f, .. } = self.scheme;
        let (mass, wetted, axial) = (self.tube.wall_mass(), self.tube.wetted_area(), self.axial_stiffness());
        let cells = self.tube.cells;
        for i in 0..cells {
            self.middle[i] = (1.0 - alpha_f) * trial.displacement[i] + alpha_f * committed.displacement[i];
        }
        let mut squares = [0.0; 3];
        for i in 0..cells {
            let d = self.middle[i];
            let new = self.scheme.acceleration(self.dt, trial.displacement[i], committed.dof(i));
            let inertia = mass * ((1.0 - alpha_m) * new + alpha_m * committed.acceleration[i]);
            let hoop = wetted
                * self.tube.hoop_stiffness()
                * (d + self.tube.hardening * d.powi(3) / self.tube.radius.powi(2));
            let left = if i > 0 { self.middle[i - 1] } else { 0.0 };
            let right = if i + 1 < cells { self.middle[i + 1] } else { 0.0 };
            let internal = hoop + axial * (self.axial_weight(i) * d - left - right);
            let load = (1.0 - alpha_f) * trial.force[i] + alpha_f * committed.force[i];
            self.residual[i] = inertia + internal - load;
            for (sum, term) in squares.iter_mut().zip([inertia, internal, load]) {
                *sum += term * term;
            }
        }
        ratio(norm(&self.residual), squares.into_iter().fold(0.0, f64::max).sqrt())
    }

    /// The tangent is tridiagonal and symmetric: elimination upwards, substitution downwards.
    fn solve_and_update(&mut self, _: &WallState, trial: &mut WallState) {
        let factor = 1.0 - self.scheme.alpha_f;
        let mass = self.tube.wall_mass() * self.scheme.mass_factor(self.dt);
        let off = -factor * self.axial_stiffness();
        let hoop = self.tube.wetted_area() * self.tube.hoop_stiffness();
        let cells = self.tube.cells;
        for i in 0..cells {
            let hardening = 3.0 * self.tube.hardening * (self.middle[i] / self.tube.radius).powi(2);
            let axial = self.axial_stiffness() * self.axial_weight(i);
            self.diagonal[i] = mass + factor * (hoop * (1.0 + hardening) + axial);
        }
        for i in (1..cells).rev() {
            let eliminated = off / self.diagonal[i];
            self.diagonal[i - 1] -= eliminated * off;
            self.residual[i - 1] -= eliminated * self.residual[i];
        }
        let mut increment = 0.0;
        for i in 0..cells {
            let coupled = if i > 0 { off * increment } else { 0.0 };
            increment = (-self.residual[i] - coupled) / self.diagonal[i];
            trial.displacement[i] += increment;
        }
    }

    fn output(&self, _: &WallState, trial: &WallState, output: &mut [f64]) {
        output.copy_from_slice(&trial.displacement);
    }

    fn parts<'a>(&self, trial: &'a WallState) -> Vec<(&'static str, &'a [f64])> {
        vec![("displacement", &trial.displacement)]
    }

    fn finish_step(&mut self, committed: &WallState, trial: &mut WallState) {
        for i in 0..self.tube.cells {
            let old = committed.dof(i);
            let acceleration = self.scheme.acceleration(self.dt, trial.displacement[i], old);
            trial.acceleration[i] = acceleration;
            trial.velocity[i] = self.scheme.velocity(self.dt, acceleration, old);
        }
    }
}
