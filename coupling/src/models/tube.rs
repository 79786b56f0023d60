//! Incompressible flow through an elastic tube, in one dimension (after Degroote et al. 2008).
//!
//! The tube of length `L` has `N` cells. Area `A = pi (r_0 + d)^2` and pressure live in the cells, velocity on
//! the faces between them. The wall is a row of rings with inertia, hoop stiffness and axial tension.
//!
//! ```text
//! flow:  dA/dt + d(A u)/dx = 0,   rho (du/dt + d(u^2/2)/dx) + dp/dx = 0,   u(0, t) given, p(L) = 0
//! wall:  rho_w h d_tt + (E h / r_0^2) (d + hardening d^3 / r_0^2) - T d_xx = load per wetted area
//! ```
//!
//! Flow: BDF1. Wall: generalized-alpha. Interface: radial displacement `d` \[m\] in each cell, and its conjugate
//! force `p 2 pi (r_0 + d) dx` \[N\].

mod flow;
mod wall;

use std::f64::consts::PI;

use serde::{Deserialize, Serialize};

pub use flow::{Flow, FlowState};
pub use wall::{Wall, WallState};

use super::generalized_alpha::GeneralizedAlpha;
use super::{Model, check_not_negative, check_positive};
use crate::port::{Block, Quantity};
use crate::setup::SetupError;

/// The settings of the tube.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Tube {
    /// Length \[m\].
    pub length: f64,
    /// Inner radius at rest, `r_0` \[m\].
    pub radius: f64,
    /// Number of cells.
    pub cells: usize,
    /// Density of the fluid \[kg/m³\].
    pub fluid_density: f64,
    /// Peak of the inflow velocity, `u(0, t) = peak sin^2(pi t / period)` \[m/s\].
    pub inflow_peak: f64,
    /// Period of the inflow \[s\].
    pub inflow_period: f64,
    /// Density of the wall \[kg/m³\].
    pub wall_density: f64,
    /// Thickness of the wall \[m\].
    pub wall_thickness: f64,
    /// Young's modulus of the wall \[Pa\].
    pub youngs_modulus: f64,
    /// Cubic hardening of the hoop stiffness \[1\].
    pub hardening: f64,
    /// Axial tension of the wall \[N/m\].
    pub tension: f64,
    /// Spectral radius of the wall's generalized-alpha.
    pub spectral_radius: f64,
    /// Bound of both fields' relative residuals.
    pub residual_bound: f64,
}

impl Default for Tube {
    /// A soft tube, added-mass dominated at time steps of a millisecond.
    fn default() -> Self {
        Self {
            length: 0.05,
            radius: 0.005,
            cells: 40,
            fluid_density: 1000.0,
            inflow_peak: 0.5,
            inflow_period: 0.02,
            wall_density: 1200.0,
            wall_thickness: 0.001,
            youngs_modulus: 3e5,
            hardening: 100.0,
            tension: 5.0,
            spectral_radius: 0.5,
            residual_bound: 1e-10,
        }
    }
}

impl Tube {
    /// The two participants, flow first, both at rest.
    ///
    /// # Errors
    /// When a setting is out of its range.
    pub fn participants(&self) -> Result<(Model<Flow>, Model<Wall>), SetupError> {
        self.validate()?;
        let block = |quantity| Block::new("wall", quantity, 1, self.cells);
        let (displacement, force) = (block(Quantity::Displacement), block(Quantity::Force));
        let flow = Flow::new(*self);
        let wall = Wall::new(*self, GeneralizedAlpha::new(self.spectral_radius)?);
        let bound = self.residual_bound;
        Ok((
            Model::new(flow, FlowState::at_rest(self.cells), displacement.clone(), force.clone(), bound),
            Model::new(wall, WallState::at_rest(self.cells), force, displacement, bound),
        ))
    }

    fn validate(&self) -> Result<(), SetupError> {
        if self.cells < 2 {
            return Err(SetupError::setting("cells", self.cells, "take at least two"));
        }
        check_positive("length", self.length)?;
        check_positive("radius", self.radius)?;
        check_positive("fluid_density", self.fluid_density)?;
        check_positive("inflow_period", self.inflow_period)?;
        check_positive("wall_density", self.wall_density)?;
        check_positive("wall_thickness", self.wall_thickness)?;
        check_positive("residual_bound", self.residual_bound)?;
        check_not_negative("inflow_peak", self.inflow_peak)?;
        check_not_negative("youngs_modulus", self.youngs_modulus)?;
        check_not_negative("hardening", self.hardening)?;
        check_not_negative("tension", self.tension)
    }

    /// The Dirichlet-Neumann eigenvalues of the tube at rest, for steps of size `dt` \[s\], smallest first.
    ///
    /// Flow and wall share the discrete Laplacian with eigenvalues `mu_m = 4 sin^2((2m + 1) pi / (4N))`, so with
    /// the wetted area `S = 2 pi r_0 dx` of a cell and `c = 1/dt`
    ///
    /// ```text
    /// M_a = rho S^2 dx / (pi r_0^2 mu),   M_s = rho_w h S,   K_s = S (E h / r_0^2 + T mu / dx^2)
    /// lambda = -c^2 (1 - alpha_f) M_a / ((1 - alpha_m) / (beta dt^2) M_s + (1 - alpha_f) K_s)
    /// ```
    ///
    /// # Errors
    /// When a setting is out of its range.
    pub fn eigenvalues(&self, dt: f64) -> Result<Vec<f64>, SetupError> {
        self.validate()?;
        let scheme = GeneralizedAlpha::new(self.spectral_radius)?;
        let (dx, wetted) = (self.dx(), self.wetted_area());
        let eigenvalue = |mode: usize| {
            let mu = 4.0 * ((2 * mode + 1) as f64 * PI / (4 * self.cells) as f64).sin().powi(2);
            let added_mass = self.fluid_density * wetted.powi(2) * dx / (PI * self.radius.powi(2) * mu);
            let stiffness = wetted * (self.hoop_stiffness() + self.tension * mu / dx.powi(2));
            let dynamic = scheme.mass_factor(dt) * self.wall_mass() + (1.0 - scheme.alpha_f) * stiffness;
            -(1.0 - scheme.alpha_f) * added_mass / (dt.powi(2) * dynamic)
        };
        Ok((0..self.cells).map(eigenvalue).collect())
    }

    /// Length of a cell \[m\].
    fn dx(&self) -> f64 {
        self.length / self.cells as f64
    }

    /// Wetted area of a cell at rest \[m²\].
    fn wetted_area(&self) -> f64 {
        2.0 * PI * self.radius * self.dx()
    }

    /// Mass of the wall of a cell \[kg\].
    fn wall_mass(&self) -> f64 {
        self.wall_density * self.wall_thickness * self.wetted_area()
    }

    /// Hoop stiffness per wetted area \[Pa/m\].
    fn hoop_stiffness(&self) -> f64 {
        self.youngs_modulus * self.wall_thickness / self.radius.powi(2)
    }
}
