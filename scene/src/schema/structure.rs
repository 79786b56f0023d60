//! `[structure]`: what deforms, and how it is solved.

use std::collections::BTreeMap;
use std::fmt;

use partita_numerics::time::GeneralizedAlpha;
use partita_structure::TimeScheme;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::formula::VectorFormula;
use super::geometry::Geometry;
use super::newton::Newton;
use super::numbers::{Count, Fraction, NonNegative, PoissonRatio, Positive, SpectralRadius};

/// `[structure]`: a solid on a spline patch or a mesh.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Structure {
    /// Density \[kg/m3\].
    pub density: Positive,
    /// Force per volume \[N/m3\], numbers or expressions of `t`. Default: none.
    #[serde(default)]
    pub body_force: VectorFormula,
    /// Sides of the patch, or groups of the mesh, that do not move. Default: none.
    #[serde(default)]
    pub clamped: Vec<Part>,
    /// Components of the displacement, `"x"` and `"y"`, that stay zero on a side of the patch or a group of the mesh:
    /// `held = { right = ["x"] }` is a roller on a wall at x = const, or a plane of symmetry; its points move along the
    /// wall and never off it. Default: none.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub held: BTreeMap<String, Vec<Component>>,
    /// Sides of the patch, or groups of the mesh, that touch the fluid. Default: none.
    #[serde(default)]
    pub wetted: Vec<Part>,
    /// Where the structure is.
    pub geometry: Geometry,
    /// What it is made of.
    pub material: Material,
    /// How it moves in time. Default: `{ generalized_alpha = { spectral_radius = 0.5 } }`.
    #[serde(default)]
    pub time_scheme: StructureTimeScheme,
    /// Rayleigh damping. Default: none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rayleigh_damping: Option<RayleighDamping>,
    /// Shortens Newton increments that overshoot. Default: none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub line_search: Option<LineSearch>,
    /// How the nonlinear equations are solved.
    #[serde(default)]
    pub newton: Newton,
}

/// A part of the structure's boundary: a side of a patch (`left`, `right`, `bottom`, `top`: the start and the end of its
/// first and of its second parameter), or a group of a mesh. Sides of a patch that lie on each other, as those of a full ring,
/// are joined and no part of the boundary.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(transparent)]
pub struct Part(String);

/// A component of a vector.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Component {
    /// Along the x axis.
    X,
    /// Along the y axis.
    Y,
}

impl Component {
    /// 0 for x.
    #[must_use]
    pub const fn index(self) -> usize {
        match self {
            Self::X => 0,
            Self::Y => 1,
        }
    }

    /// Its name.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::X => "x",
            Self::Y => "y",
        }
    }
}

impl Part {
    /// The name.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.0
    }
}

impl fmt::Display for Part {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

/// `[structure.material.*]`.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Material {
    /// S = lambda tr(E) I + 2 mu E with the Green-Lagrange strain E: large displacements.
    SaintVenantKirchhoff(Elastic),
    /// S = mu (I - C^-1) + lambda ln J C^-1: large displacements and strains, in compression too.
    NeoHookean(Elastic),
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
        /// Spectral radius at infinite frequency: 1 keeps the energy, and the interface force oscillates from step to step; 0
        /// damps most. Default: 0.5.
        #[serde(default = "spectral_radius")]
        spectral_radius: SpectralRadius,
    },
    /// Newmark 1959; forces are balanced at the end of the step.
    Newmark {
        /// Weight of the new acceleration in the displacement: at least `gamma`/2. Default: 0.25.
        #[serde(default = "newmark_beta")]
        beta: Positive,
        /// Weight of the new acceleration in the velocity: at least 0.5, which is of second order; more damps, and is of
        /// first order. Default: 0.5.
        #[serde(default = "newmark_gamma")]
        gamma: Positive,
    },
    /// No inertia.
    QuasiStatic,
}

fn spectral_radius() -> SpectralRadius {
    SpectralRadius::new(TimeScheme::DEFAULT_SPECTRAL_RADIUS).expect("it is a spectral radius")
}

fn newmark_beta() -> Positive {
    Positive::new(GeneralizedAlpha::AVERAGE_ACCELERATION.beta).expect("it is positive")
}

fn newmark_gamma() -> Positive {
    Positive::new(GeneralizedAlpha::AVERAGE_ACCELERATION.gamma).expect("it is positive")
}

impl Default for StructureTimeScheme {
    fn default() -> Self {
        Self::GeneralizedAlpha { spectral_radius: spectral_radius() }
    }
}

/// `[structure.line_search]`: seeks the length of a Newton increment at which the residual does no more work along it.
///
/// For loads that turn or crush a solid within a few steps. An increment that already does little stays whole.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct LineSearch {
    /// Part of the work at the start that may remain. Default: 0.8.
    pub tolerance: Fraction,
    /// Residuals that may be evaluated for one increment. Default: 10.
    pub max_evaluations: Count,
}

impl Default for LineSearch {
    fn default() -> Self {
        let partita_structure::LineSearch { tolerance, max_evaluations } =
            partita_structure::LineSearch::default();
        Self {
            tolerance: Fraction::new(tolerance).expect("it is a fraction"),
            max_evaluations: Count::literal(max_evaluations),
        }
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
