//! A tank of width `L` and depth `H` with an elastic bottom: linear, with the added mass of potential flow.
//!
//! Pressure vanishes at the top, the side walls slip. Everything splits into the modes `cos(n pi x / L)`:
//!
//! ```text
//! fluid:   p_n = m_n a_n,   m_n = rho L / (n pi) tanh(n pi H / L),   m_0 = rho H
//! bottom:  rho_s h d_tt + (k + D (n pi / L)^4) d = load per width
//! ```
//!
//! with the acceleration `a` of the bottom, positive into the fluid. On `N` equally spaced points the modes are
//! the discrete cosine transform, exactly. Fluid: the interface velocity and acceleration are BDF derivatives
//! of the displacement. Bottom: generalized-alpha. Interface: displacement \[m\] and force \[N/m\] at the points,
//! positive upwards; the fluid weighs `rho g H` per width beside its added mass.

mod bottom;
mod fluid;
mod modes;

use serde::{Deserialize, Serialize};

pub use bottom::{Bottom, BottomState};
pub use fluid::{Fluid, FluidState};

use super::generalized_alpha::GeneralizedAlpha;
use super::{Model, check_not_negative, check_positive};
use crate::port::{Block, Quantity};
use crate::setup::SetupError;
use modes::Modes;

/// Order of the fluid's time derivatives.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum BdfOrder {
    /// BDF1.
    #[default]
    One,
    /// BDF2; the first step is BDF1.
    Two,
}

/// The settings of the tank.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Tank {
    /// Width `L` \[m\].
    pub width: f64,
    /// Depth `H` \[m\].
    pub depth: f64,
    /// Density of the fluid \[kg/m³\].
    pub fluid_density: f64,
    /// Gravity `g` \[m/s²\].
    pub gravity: f64,
    /// Order of the fluid's time derivatives.
    pub bdf: BdfOrder,
    /// Mass of the bottom per width, `rho_s h` \[kg/m²\].
    pub bottom_mass: f64,
    /// Bending stiffness of the bottom, `D` \[N m\].
    pub bending_stiffness: f64,
    /// Stiffness of its bedding, `k` \[Pa/m\].
    pub bedding: f64,
    /// Dead load on the left half of the bottom \[Pa\]; it sets all modes in motion.
    pub ballast: f64,
    /// Spectral radius of the bottom's generalized-alpha.
    pub spectral_radius: f64,
    /// Bound of both fields' relative residuals.
    pub residual_bound: f64,
}

impl Default for Tank {
    /// A metre of water over a thin, softly bedded plate: the added mass is twenty times the plate's own.
    fn default() -> Self {
        Self {
            width: 1.0,
            depth: 1.0,
            fluid_density: 1000.0,
            gravity: 9.81,
            bdf: BdfOrder::One,
            bottom_mass: 50.0,
            bending_stiffness: 50.0,
            bedding: 2e5,
            ballast: 1000.0,
            spectral_radius: 0.5,
            residual_bound: 1e-10,
        }
    }
}

impl Tank {
    /// The fluid at rest, with `points` interface points in the middles of equal intervals.
    ///
    /// # Errors
    /// When a setting is out of its range.
    pub fn fluid(&self, points: usize) -> Result<Model<Fluid>, SetupError> {
        self.validate(points)?;
        let block = |quantity| Block::new("bottom", quantity, 1, points);
        let added_mass = (0..points).map(|mode| self.added_mass(mode)).collect();
        let fluid = Fluid::new(*self, Modes::new(points), added_mass);
        let (input, output) = (block(Quantity::Displacement), block(Quantity::Force));
        Ok(Model::new(fluid, FluidState::at_rest(points), input, output, self.residual_bound))
    }

    /// The bottom at rest, with `points` interface points in the middles of equal intervals.
    ///
    /// # Errors
    /// When a setting is out of its range.
    pub fn bottom(&self, points: usize) -> Result<Model<Bottom>, SetupError> {
        self.validate(points)?;
        let block = |quantity| Block::new("bottom", quantity, 1, points);
        let stiffness = (0..points).map(|mode| self.stiffness(mode)).collect();
        let scheme = GeneralizedAlpha::new(self.spectral_radius)?;
        let bottom = Bottom::new(*self, scheme, Modes::new(points), stiffness);
        let (input, output) = (block(Quantity::Force), block(Quantity::Displacement));
        Ok(Model::new(bottom, BottomState::at_rest(points), input, output, self.residual_bound))
    }

    fn validate(&self, points: usize) -> Result<(), SetupError> {
        if points == 0 {
            return Err(SetupError::setting("points", points, "take at least one"));
        }
        check_positive("width", self.width)?;
        check_positive("depth", self.depth)?;
        check_positive("fluid_density", self.fluid_density)?;
        check_positive("bottom_mass", self.bottom_mass)?;
        check_positive("residual_bound", self.residual_bound)?;
        check_not_negative("bending_stiffness", self.bending_stiffness)?;
        check_not_negative("bedding", self.bedding)
    }

    fn wave_number(&self, mode: usize) -> f64 {
        mode as f64 * std::f64::consts::PI / self.width
    }

    /// Added mass of mode `n` per width, `m_n` \[kg/m²\].
    #[must_use]
    pub fn added_mass(&self, mode: usize) -> f64 {
        if mode == 0 {
            return self.fluid_density * self.depth;
        }
        let wave_number = self.wave_number(mode);
        self.fluid_density / wave_number * (wave_number * self.depth).tanh()
    }

    /// Stiffness of mode `n` per width \[Pa/m\].
    #[must_use]
    pub fn stiffness(&self, mode: usize) -> f64 {
        self.bedding + self.bending_stiffness * self.wave_number(mode).powi(4)
    }

    /// The Dirichlet-Neumann eigenvalues of the first `modes` modes for steps of size `dt` \[s\].
    ///
    /// `lambda_n = -c^2 (1 - alpha_f) m_n / ((1 - alpha_m) / (beta dt^2) rho_s h + (1 - alpha_f) k_n)`, with
    /// `c = 1/dt` for BDF1 and in the first step, `1.5/dt` for later steps of BDF2.
    ///
    /// # Errors
    /// When a setting is out of its range.
    pub fn eigenvalues(&self, dt: f64, first_step: bool, modes: usize) -> Result<Vec<f64>, SetupError> {
        self.validate(modes)?;
        let scheme = GeneralizedAlpha::new(self.spectral_radius)?;
        let leading = if self.bdf == BdfOrder::Two && !first_step { 1.5 } else { 1.0 };
        let eigenvalue = |mode: usize| {
            let share = 1.0 - scheme.alpha_f;
            let dynamic = scheme.mass_factor(dt) * self.bottom_mass + share * self.stiffness(mode);
            -(leading / dt).powi(2) * share * self.added_mass(mode) / dynamic
        };
        Ok((0..modes).map(eigenvalue).collect())
    }
}
