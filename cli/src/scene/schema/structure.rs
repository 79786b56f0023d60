//! `[structure]`: what deforms, and how it is solved.

use std::fmt;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::fluid::origin;
use super::formula::VectorFormula;
use super::newton::Newton;
use super::numbers::{Count, NonNegative, PoissonRatio, Positive, Real, SpectralRadius};

/// `[structure]`: a solid on a spline patch.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Structure {
    /// Density \[kg/m3\].
    pub density: Positive,
    /// Force per volume \[N/m3\], numbers or expressions of `t`. Default: none.
    #[serde(default)]
    pub body_force: VectorFormula,
    /// Sides that do not move. Default: none.
    #[serde(default)]
    pub clamped: Vec<Side>,
    /// Sides that touch the fluid. Default: none.
    #[serde(default)]
    pub wetted: Vec<Side>,
    /// Where the structure is.
    pub geometry: Geometry,
    /// What it is made of.
    pub material: Material,
    /// How it moves in time. Default: `generalized_alpha` with spectral radius 1.
    #[serde(default)]
    pub time_scheme: StructureTimeScheme,
    /// Rayleigh damping. Default: none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rayleigh_damping: Option<RayleighDamping>,
    /// How the nonlinear equations are solved.
    #[serde(default)]
    pub newton: Newton,
}

/// A side of a patch with two parameters.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Side {
    /// Start of the first parameter.
    Left,
    /// End of the first parameter.
    Right,
    /// Start of the second parameter.
    Bottom,
    /// End of the second parameter.
    Top,
}

impl fmt::Display for Side {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Left => "left",
            Self::Right => "right",
            Self::Bottom => "bottom",
            Self::Top => "top",
        })
    }
}

/// `[structure.geometry.*]`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Geometry {
    /// A rectangle along the axes.
    Rectangle(RectanglePatch),
}

/// `[structure.geometry.rectangle]`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct RectanglePatch {
    /// Lower left corner \[m\]. Default: `[0, 0]`.
    #[serde(default = "origin")]
    pub origin: [Real; 2],
    /// Width and height \[m\].
    pub size: [Positive; 2],
    /// Spline elements along each side.
    pub elements: [Count; 2],
    /// Spline degree along each side, each from 1 to 9. Default: `[2, 2]`.
    #[serde(default)]
    pub degree: [Degree; 2],
}

/// The degree of a spline, 1 to 9.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(try_from = "i64", into = "usize")]
pub struct Degree(usize);

impl Degree {
    /// The plain number.
    #[must_use]
    pub const fn get(self) -> usize {
        self.0
    }
}

impl Default for Degree {
    fn default() -> Self {
        Self(2)
    }
}

impl TryFrom<i64> for Degree {
    type Error = String;
    fn try_from(value: i64) -> Result<Self, String> {
        usize::try_from(value)
            .ok()
            .filter(|degree| (1..=9).contains(degree))
            .map(Self)
            .ok_or_else(|| format!("{value} is not a spline degree, from 1 to 9"))
    }
}

impl From<Degree> for usize {
    fn from(degree: Degree) -> Self {
        degree.0
    }
}

/// `[structure.material.*]`.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Material {
    /// S = lambda tr(E) I + 2 mu E with the Green-Lagrange strain E: large displacements.
    SaintVenantKirchhoff(Elastic),
    /// Hooke's law with the small strain: small displacements.
    LinearElastic(Elastic),
}

/// Constants of an isotropic elastic material.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Elastic {
    /// Young's modulus \[Pa\].
    pub young_modulus: Positive,
    /// Poisson ratio; towards 0.5 the material becomes incompressible and these elements lock.
    pub poisson_ratio: PoissonRatio,
    /// `"strain"` (default): thick in z; `"stress"`: thin in z.
    #[serde(default)]
    pub plane: Plane,
}

/// `plane`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Plane {
    /// Plane strain.
    #[default]
    Strain,
    /// Plane stress.
    Stress,
}

/// `structure.time_scheme`.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum StructureTimeScheme {
    /// Chung and Hulbert 1993.
    GeneralizedAlpha {
        /// Spectral radius at infinite frequency: 1 keeps the energy, 0 damps most. Default: 1.
        #[serde(default = "spectral_radius")]
        spectral_radius: SpectralRadius,
    },
    /// No inertia.
    QuasiStatic,
}

fn spectral_radius() -> SpectralRadius {
    SpectralRadius::new(1.0).expect("1 is a spectral radius")
}

impl Default for StructureTimeScheme {
    fn default() -> Self {
        Self::GeneralizedAlpha { spectral_radius: spectral_radius() }
    }
}

/// `[structure.rayleigh_damping]`: damping matrix `mass * M + stiffness * K`.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct RayleighDamping {
    /// Factor of the mass matrix \[1/s\].
    pub mass: NonNegative,
    /// Factor of the stiffness matrix \[s\].
    pub stiffness: NonNegative,
}
