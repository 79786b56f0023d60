//! `[fluid.newton]` and `[structure.newton]`.

use serde::{Deserialize, Serialize};

use super::numbers::{Count, Positive};

/// How one field's nonlinear equations are solved.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Newton {
    /// When the residual is small enough. Default: `{ relative = 1e-10 }`.
    pub tolerance: Tolerance,
    /// `"before"` (default) or `"lagged"`.
    pub check: Check,
    /// Iterations after which a call that must converge is an error. Default: 50.
    pub max_iterations: Count,
}

impl Default for Newton {
    fn default() -> Self {
        Self {
            tolerance: Tolerance::Relative(Positive::new(1e-10).expect("1e-10 is positive")),
            check: Check::Before,
            max_iterations: Count::literal(50),
        }
    }
}

/// `tolerance` of a residual.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Tolerance {
    /// Part of the largest term of the equations.
    Relative(Positive),
    /// 2-norm of the residual [N in 3D, N/m in 2D].
    Absolute(Positive),
}

/// `check`: which residual decides that a call has converged.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Check {
    /// The residual before each solve: a call that enters converged costs no iteration.
    #[default]
    Before,
    /// Solve first, then judge the residual from before that solve: at least one iteration a call.
    Lagged,
}
