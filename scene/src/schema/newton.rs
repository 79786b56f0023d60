//! `[fluid.newton]` and `[structure.newton]`.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::numbers::{Count, Fraction, Positive};

/// How one field's nonlinear equations are solved.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Newton {
    /// When the residual is small enough. Default: `{ relative = 1e-10 }`. No bound lies below round-off: a residual that is
    /// round-off of its own terms counts as converged, and the record says `at_round_off`.
    pub tolerance: Tolerance,
    /// `"before"` (default) or `"lagged"`.
    pub check: Check,
    /// Iterations after which a call that must converge is an error. Default: 50.
    pub max_iterations: Count,
    /// Chord Newton: the last factored tangent serves on while every iteration brings the residual below this part of what
    /// it was. Default: none; every iteration factors its own.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub reuse_factor: Option<Fraction>,
}

impl Default for Newton {
    fn default() -> Self {
        Self {
            tolerance: Tolerance::Relative(Positive::new(1e-10).expect("1e-10 is positive")),
            check: Check::Before,
            max_iterations: Count::literal(50),
            reuse_factor: None,
        }
    }
}

/// `tolerance`: how small is small enough.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Tolerance {
    /// Part of the natural scale: for a field's residual the largest term of its equations, for the interface residual the
    /// interface displacement.
    Relative(Positive),
    /// In the unit of what is measured: for a residual of forces N, in two dimensions N/m; for the interface residual m.
    Absolute(Positive),
}

/// `check`: which residual decides that a call has converged.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Check {
    /// The residual before each solve: a call that enters converged costs no iteration.
    #[default]
    Before,
    /// Solve first, then judge the residual from before that solve: at least one iteration a call, unless nothing but
    /// round-off is left to solve for.
    Lagged,
}
