//! `[coupling]`: how fluid and structure meet.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::limit::Limit;
use super::newton::Tolerance;
use super::numbers::{Count, Fraction, Positive, Relaxation};

/// `[coupling]`: Dirichlet-Neumann iterations, fluid first.
///
/// What meets is not said here: the fluid's boundary groups marked `"interface"` and the structure's `wetted` sides.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Coupling {
    /// `"two_way"` (default): the structure gives way to the fluid's load and moves the fluid, with iterations until both
    /// balance; or `"one_way"`: it gives way, and the fluid does not notice.
    #[serde(default)]
    pub direction: Direction,
    /// Coupling iterations a step may take. Default: 100.
    #[serde(default = "max_iterations")]
    pub max_iterations: Count,
    /// When a step reaches that limit: `"fail"` (default), or `"accept"` it and record that it did not converge.
    #[serde(default)]
    pub on_limit: OnLimit,
    /// Largest distance of a fluid interface node from the structure, as part of the interface's extent. Default: 1e-6.
    #[serde(default = "projection_tolerance")]
    pub projection_tolerance: Positive,
    /// How displacements and loads pass between meshes that do not match: `"interpolation"` or `"mortar"`.
    #[serde(default)]
    pub transfer: Transfer,
    /// First guess of a step's interface displacement: `"constant"` (default), `"linear"`, `"quadratic"`, `"cubic"`.
    #[serde(default)]
    pub predictor: Predictor,
    /// What makes the next interface displacement from the last ones; must be given where the coupling is two-way.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub acceleration: Option<Acceleration>,
    /// When a step is done. Default: `{ changes = 1e-5 }`.
    #[serde(default)]
    pub convergence: Convergence,
    /// How many Newton iterations a solver call may take. Default: `fixed`, both fields to convergence.
    #[serde(default)]
    pub newton: NewtonPolicy,
}

fn max_iterations() -> Count {
    Count::literal(100)
}

fn projection_tolerance() -> Positive {
    Positive::new(1e-6).expect("1e-6 is positive")
}

/// `coupling.direction`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Direction {
    /// Loads go to the structure, displacements to the fluid.
    #[default]
    TwoWay,
    /// Loads alone: each field is called once a step, to convergence, and the interface stands still for the fluid. Of
    /// `[coupling]` only `transfer` and `projection_tolerance` count.
    OneWay,
}

/// `coupling.transfer`: the operator H, `d_f = H d` for displacements of the structure at the fluid's nodes i and `F = H^T f`
/// for loads. Either keeps total force and virtual work.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Transfer {
    /// `"mortar"` where no edge of the fluid's interface is longer than 5 elements of the structure beside it, else
    /// `"interpolation"`.
    #[default]
    Automatic,
    /// `H_ia = R_a(x_i)`: the structure's shape functions at the fluid's node. The load is a trapezoidal rule: where the fluid's
    /// edges are not much shorter than the structure's elements, H^T f acts like point loads.
    Interpolation,
    /// `H_ia = (integral(psi_i R_a) - sum_e h_e/2 R_a(x_e)) / integral(N_i)`: equal displacements in the mean, against multipliers
    /// `psi_i` dual to the fluid's linear shape functions `N_i`. The load of a uniform pressure is the consistent one for any two
    /// resolutions. Ends and corners e, at a distance of `h_e`, are interpolated. See the theory page.
    Mortar,
}

/// `coupling.on_limit`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum OnLimit {
    /// The run ends with an error.
    #[default]
    Fail,
    /// The run goes on; the step's record says `converged: false`.
    Accept,
}

/// `coupling.predictor`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Predictor {
    /// The last step's displacement.
    #[default]
    Constant,
    /// On a line through the last two steps.
    Linear,
    /// On a parabola through the last three.
    Quadratic,
    /// On a cubic through the last four.
    Cubic,
}

/// `[coupling.acceleration.*]`.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Acceleration {
    /// x <- x + omega r with one omega.
    Constant {
        /// The factor omega.
        relaxation: Relaxation,
    },
    /// x <- x + omega r with Aitken's omega.
    Aitken {
        /// Factor of the first iteration. Default: 0.1.
        #[serde(default = "initial_relaxation")]
        initial_relaxation: Relaxation,
    },
    /// Least squares over the differences of this step and earlier ones.
    IqnIls(QuasiNewton),
    /// Inverse Jacobian updated from step to step, stored as a matrix: for small interfaces.
    IqnMvj(QuasiNewton),
    /// The same update from stored differences, without the matrix (Spenke, Hosters, Behr 2020).
    IqnImvls(QuasiNewton),
}

/// Options of the quasi-Newton accelerations.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct QuasiNewton {
    /// Factor of an iteration without any difference. Default: 0.1.
    pub initial_relaxation: Relaxation,
    /// Factor of what no difference tells of. Smaller than 1 where a light structure would not bear it whole; then judge a
    /// step by `changes_and_residual`. Default: 1.0.
    pub unseen_relaxation: Relaxation,
    /// Earlier steps whose differences are used, or `"unlimited"`. Default: 5.
    pub history_steps: Limit<0>,
    /// Relaxes the first iteration of every step, history or not. Default: false.
    pub relax_first_iteration: bool,
    /// Keeps the differences to the last iteration of a converged step too. Default: true.
    pub keep_last_differences: bool,
    /// Which nearly dependent differences are dropped. Default: `{ qr3 = 1e-2 }`.
    pub filter: Filter,
}

impl Default for QuasiNewton {
    fn default() -> Self {
        Self {
            initial_relaxation: initial_relaxation(),
            unseen_relaxation: Relaxation::new(1.0).expect("1 is a relaxation factor"),
            history_steps: Limit::AtMost(5),
            relax_first_iteration: false,
            keep_last_differences: true,
            filter: Filter::default(),
        }
    }
}

fn initial_relaxation() -> Relaxation {
    Relaxation::new(0.1).expect("0.1 is a relaxation factor")
}

/// `filter` of the quasi-Newton accelerations.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Filter {
    /// Every independent difference is used.
    None,
    /// Drops a column whose part orthogonal to the newer ones is below this part of all columns together.
    Qr1(Fraction),
    /// Like `qr3`, with a new factorization in every iteration.
    Qr2(Fraction),
    /// Drops a column whose part orthogonal to the newer ones is below this part of its own length.
    Qr3(Fraction),
}

impl Default for Filter {
    fn default() -> Self {
        Self::Qr3(Fraction::new(1e-2).expect("0.01 is a fraction"))
    }
}

/// `coupling.convergence`.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Convergence {
    /// Every field's relative change in one coupling iteration is below this, and every residual below its bound.
    Changes(Positive),
    /// The same, and so is the interface residual relative to the interface displacement: a small relaxation changes little.
    ChangesAndResidual(Positive),
    /// Every field enters its call with a residual below its bound (Spenke, Delaisse, Degroote, Hosters 2023).
    EntryResiduals,
    /// The interface residual, the change of the interface displacement in one coupling iteration, is below this bound:
    /// `absolute` in \[m\], Euclidean norm over the control points; `relative` to the norm of the interface displacement
    /// itself. And every field's residual is below its own bound.
    InterfaceResidual(Tolerance),
}

impl Default for Convergence {
    fn default() -> Self {
        Self::Changes(Positive::new(1e-5).expect("1e-5 is positive"))
    }
}

/// `coupling.newton`.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum NewtonPolicy {
    /// The same limits in every call.
    Fixed {
        /// Newton iterations of one fluid call, or `"unlimited"`: to convergence. Default: `"unlimited"`.
        #[serde(default = "to_convergence")]
        fluid: Limit<1>,
        /// Newton iterations of one structure call, or `"unlimited"`: to convergence. Default: `"unlimited"`.
        #[serde(default = "to_convergence")]
        structure: Limit<1>,
    },
    /// So many until the coupling criterion is met, then to convergence.
    UntilCoupled(Count),
    /// Until one more Newton iteration changes the call's result by less than this part.
    ConvergedInterfaceData(Fraction),
}

const fn to_convergence() -> Limit<1> {
    Limit::Unlimited
}

impl Default for NewtonPolicy {
    fn default() -> Self {
        Self::Fixed { fluid: Limit::Unlimited, structure: Limit::Unlimited }
    }
}
