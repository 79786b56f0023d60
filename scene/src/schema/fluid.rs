//! `[fluid]`: what flows, where, and how it is solved.

use std::collections::BTreeMap;

use partita_fluid::stabilization::INVERSE_CONSTANT;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::file::FileName;
use super::formula::VectorFormula;
use super::groups::Groups;
use super::newton::Newton;
use super::numbers::{Count, NonNegative, PoissonRatio, Positive, Real};

/// `[fluid]`: incompressible Newtonian flow.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Fluid {
    /// Density \[kg/m3\].
    pub density: Positive,
    /// Dynamic viscosity \[Pa s\].
    pub viscosity: Positive,
    /// Force per mass \[m/s2\], numbers or expressions of `x`, `y`, `t`. Default: none.
    #[serde(default)]
    pub body_force: VectorFormula,
    /// Time derivative: `"bdf1"` (default), `"bdf2"` or `"steady"`.
    #[serde(default)]
    pub time_scheme: FluidTimeScheme,
    /// Whether the fluid carries its momentum with it. Without, the equations are those of Stokes, linear: one linear solve
    /// a call, and one factorization a run where neither mesh nor step size changes. Default: true.
    #[serde(default = "on")]
    pub convection: bool,
    /// Matrix of the Newton iteration: `"full"` (default), `"frozen_tau"` or `"picard"`.
    #[serde(default)]
    pub tangent: Tangent,
    /// Constant of the viscous part of the stabilization time. Default: 36.
    #[serde(default = "inverse_constant")]
    pub inverse_constant: Positive,
    /// Factor of the stabilization of continuity (grad-div), which damps coarse meshes under small steps. Default: 1.
    #[serde(default = "grad_div")]
    pub grad_div: NonNegative,
    /// Holds the pressure of one node where no boundary does. The fluid is then enclosed: walls may move, and fluid may be
    /// driven in and out, as long as the net flux through the whole boundary stays zero to round-off. Default: none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub pressure_pin: Option<PressurePin>,
    /// Where the fluid is.
    pub mesh: FluidMesh,
    /// One condition for every boundary group of the mesh.
    ///
    /// At a node between two groups one condition holds: `interface` before `wall_motion`, then `no_slip`, `velocity`,
    /// `slip`; of two alike that of the group whose name comes first in the alphabet. So a uniform inflow loses the flow
    /// of half an edge at each no-slip wall beside it (`check` prints by how much), while a profile that is zero at the
    /// walls loses nothing. `traction`, `do_nothing` and `stress_free` act on the edges of their group, up to its last
    /// nodes, where the velocity is that of the neighbour.
    #[serde(default)]
    #[schemars(required)]
    pub boundary: BTreeMap<String, Condition>,
    /// State at t = 0: `"rest"` (default) or `{ velocity = [..] }`.
    #[serde(default)]
    pub initial: Initial,
    /// How the nonlinear equations are solved.
    #[serde(default)]
    pub newton: Newton,
    /// How the mesh follows its boundary.
    #[serde(default)]
    pub mesh_motion: MeshMotion,
}

const fn on() -> bool {
    true
}

fn inverse_constant() -> Positive {
    Positive::new(INVERSE_CONSTANT).expect("it is positive")
}

fn grad_div() -> NonNegative {
    NonNegative::new(1.0).expect("1 is not negative")
}

/// `fluid.time_scheme`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum FluidTimeScheme {
    /// Backward differences of first order (backward Euler).
    #[default]
    Bdf1,
    /// Backward differences of second order; the first step is `bdf1`.
    Bdf2,
    /// No time derivative.
    Steady,
}

/// `fluid.tangent`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Tangent {
    /// The whole derivative of the residual: quadratic convergence.
    #[default]
    Full,
    /// Without the derivatives of the stabilization parameters.
    FrozenTau,
    /// Without the derivative of the advecting velocity: linear convergence.
    Picard,
}

/// `[fluid.pressure_pin]`: the pressure of one node.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PressurePin {
    /// The node nearest to this point \[m\] is held.
    pub point: [Real; 2],
    /// Its pressure \[Pa\].
    pub value: Real,
}

/// `[fluid.mesh.*]`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum FluidMesh {
    /// Triangles in a rectangle; boundary groups `left`, `right`, `bottom`, `top`.
    Rectangle(RectangleMesh),
    /// Triangles from a file of gmsh; its physical curves are the boundary groups.
    Gmsh(GmshMesh),
}

/// `[fluid.mesh.gmsh]`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct GmshMesh {
    /// File of format 2.0 to 2.2 or 4.1, text or binary, relative to the scene's folder.
    pub file: FileName,
    /// Names of the physical surfaces that the fluid fills, one or a list; must be given where the file has several. Curves
    /// between them and the rest of the file are boundary groups, those elsewhere are left out. Default: the whole mesh.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub surfaces: Option<Groups>,
    /// Factor on the file's coordinates: 0.001 for a mesh in millimetres. Default: 1.
    #[serde(default = "one")]
    pub scale: Positive,
    /// How often every triangle is cut into four. Default: 0.
    #[serde(default)]
    pub refine: usize,
    /// The circle on which a curved boundary group lies, by its name: new nodes are put on it. Default: none.
    #[serde(default)]
    pub circles: BTreeMap<String, Circle>,
}

/// `fluid.mesh.gmsh.circles.<group>`.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Circle {
    /// Its centre \[m\].
    pub center: [Real; 2],
    /// Its radius \[m\].
    pub radius: Positive,
}

pub(super) fn one() -> Positive {
    Positive::new(1.0).expect("1 is positive")
}

/// `[fluid.mesh.rectangle]`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct RectangleMesh {
    /// Lower left corner \[m\]. Default: `[0, 0]`.
    #[serde(default = "origin")]
    pub origin: [Real; 2],
    /// Width and height \[m\].
    pub size: [Positive; 2],
    /// Squares along each side.
    pub divisions: [Count; 2],
    /// How a square is cut: `"crossed"` (default, four triangles), `"right"`, `"left"` or `"alternating"` (two).
    #[serde(default)]
    pub diagonals: Diagonals,
}

pub(super) fn origin() -> [Real; 2] {
    [Real::new(0.0).expect("0 is finite"); 2]
}

/// `fluid.mesh.rectangle.diagonals`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Diagonals {
    /// Both diagonals: four triangles a square.
    #[default]
    Crossed,
    /// From lower left to upper right: two triangles.
    Right,
    /// From lower right to upper left: two triangles.
    Left,
    /// `right` and `left` in turn.
    Alternating,
}

/// `fluid.boundary.<group>`: what holds on one boundary group.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Condition {
    /// The fluid sticks to the wall; where the mesh moves, to the moving wall.
    NoSlip,
    /// No flow through the wall, no friction along it.
    Slip,
    /// Coupled to the structure's wetted sides.
    Interface,
    /// Given velocity \[m/s\] in `x`, `y`, `t`.
    Velocity(VectorFormula),
    /// A wall that moves with this displacement \[m\] in `x`, `y`, `t`, the fluid sticking to it. In an enclosed fluid it must
    /// keep the area, as one that shifts or turns does.
    WallMotion(VectorFormula),
    /// Given traction \[Pa\] in `x`, `y`, `t`.
    Traction(VectorFormula),
    /// Outflow with -p n + mu grad u n = 0.
    DoNothing(Outflow),
    /// Outflow with zero stress.
    StressFree(Outflow),
}

/// Options of the outflow conditions.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Outflow {
    /// Damps fluid that enters through the outflow. Default: false.
    pub backflow_stabilization: bool,
}

/// `fluid.initial`.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Initial {
    /// Velocity and pressure zero.
    #[default]
    Rest,
    /// Velocity \[m/s\] in `x`, `y`; pressure zero.
    Velocity(VectorFormula),
}

/// `[fluid.mesh_motion]`.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct MeshMotion {
    /// Equation the mesh displacement solves. Default: `elastic`.
    pub law: MotionLaw,
    /// Displacement `"reference"` (default) from the first mesh, or `"incremental"` from the last one.
    pub mode: MotionMode,
    /// Boundary groups along which nodes may slide. Default: none; they stay fixed.
    pub slide: Vec<String>,
}

/// `fluid.mesh_motion.law`.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum MotionLaw {
    /// Linear elasticity.
    Elastic {
        /// Poisson ratio of the mesh. Default: 0.3.
        #[serde(default = "mesh_poisson_ratio")]
        poisson_ratio: PoissonRatio,
        /// Exponent chi of the element stiffness (J0/J)^chi. Default: 1.
        #[serde(default = "stiffening")]
        stiffening: NonNegative,
    },
    /// A Laplace equation for each component.
    Harmonic {
        /// Exponent chi of the element stiffness (J0/J)^chi. Default: 1.
        #[serde(default = "stiffening")]
        stiffening: NonNegative,
    },
}

fn mesh_poisson_ratio() -> PoissonRatio {
    PoissonRatio::new(0.3).expect("0.3 is a Poisson ratio")
}

fn stiffening() -> NonNegative {
    NonNegative::new(1.0).expect("1 is not negative")
}

impl Default for MotionLaw {
    fn default() -> Self {
        Self::Elastic { poisson_ratio: mesh_poisson_ratio(), stiffening: stiffening() }
    }
}

/// `fluid.mesh_motion.mode`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum MotionMode {
    /// From the mesh at t = 0: the matrix is factored once a run.
    #[default]
    Reference,
    /// From the mesh of the last step: factored once a step.
    Incremental,
}
