//! What a scene file may say: one type a table, ranges in the types.
//!
//! Every key is documented with its unit and default. A default is written into the resolved scene, so the
//! file in an output folder is complete and runs again as it is.

mod coupling;
mod file;
mod fluid;
mod formula;
mod geometry;
mod groups;
mod limit;
mod newton;
mod numbers;
mod output;
mod structure;
mod warnings;

use partita_coupling::StepSizes;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

pub use coupling::{
    Acceleration, Convergence, Coupling, Direction, Filter, NewtonPolicy, OnLimit, Predictor, QuasiNewton,
    Transfer,
};
pub use file::FileName;
pub use fluid::{
    Circle, Condition, Diagonals, Fluid, FluidMesh, FluidTimeScheme, GmshMesh, Initial, MeshMotion,
    MotionLaw, MotionMode, Outflow, PressurePin, RectangleMesh, Tangent,
};
pub use formula::{Formula, VectorFormula, VectorFunction};
pub use geometry::{
    Alignment, ArcPatch, CurvePatch, Degree, Geometry, RectanglePatch, SolidMesh, SplineFile,
};
pub use groups::Groups;
pub use limit::Limit;
pub use newton::{Check, Newton, Tolerance};
pub use numbers::plain;
pub use numbers::{
    Count, Fraction, Halvings, NonNegative, NotACount, OutOfRange, Parameter, PoissonRatio, Positive, Real,
    Relaxation, SpectralRadius,
};
pub use output::{Known, Line, Output, Probe};
pub use structure::{
    Component, Elastic, Material, Part, Plane, RayleighDamping, Structure, StructureTimeScheme,
};
pub use warnings::{Reason, Warnings};

/// A whole scene: a fluid, a structure, or both coupled.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Scene {
    /// One line that names the scene.
    pub title: String,
    /// Step size and number of steps.
    pub time: Time,
    /// The flow; leave it out for a structure alone.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub fluid: Option<Fluid>,
    /// The solid; leave it out for a flow alone.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub structure: Option<Structure>,
    /// How the two meet; needed when both are there.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub coupling: Option<Coupling>,
    /// What is written, and how often.
    #[serde(default)]
    pub output: Output,
    /// Which warnings are accepted, and why.
    #[serde(default, skip_serializing_if = "Warnings::is_empty")]
    pub warnings: Warnings,
}

impl Scene {
    /// Whether displacements come back from the structure, where there is one, to the fluid.
    #[must_use]
    pub fn moves_the_interface(&self) -> bool {
        let direction = self.coupling.as_ref().map(|coupling| coupling.direction).unwrap_or_default();
        self.structure.is_some() && direction == Direction::TwoWay
    }
}

/// `[time]`.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Time {
    /// Size of a time step \[s\].
    pub step: Positive,
    /// Number of time steps.
    pub steps: Count,
    /// Repeats a step that fails with half its size; leave it out to stop there.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub retry: Option<Retry>,
}

/// `[time.retry]`: a step that fails is given up and repeated in halves; the run returns to the scene's step size by
/// doubling, and meets every time of the scene's grid.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Retry {
    /// How often a step may be halved. Default: 3.
    pub halvings: Halvings,
}

impl Default for Retry {
    fn default() -> Self {
        Self { halvings: Halvings::new(3).expect("3 is in range") }
    }
}

impl Time {
    /// The sizes that the steps may have.
    #[must_use]
    pub fn sizes(&self) -> StepSizes {
        StepSizes::new(self.step.get(), self.retry.map_or(0, |retry| retry.halvings.get()))
    }
}

/// Where a scene makes one of several choices; `*` stands for any name.
///
/// At these places a bare word names a choice that takes its defaults, and an override replaces the choice in the
/// file instead of standing beside it.
pub(super) const CHOICES: [&str; 15] = [
    "fluid.mesh",
    "fluid.boundary.*",
    "fluid.initial",
    "fluid.newton.tolerance",
    "fluid.mesh_motion.law",
    "structure.geometry",
    "structure.material",
    "structure.time_scheme",
    "structure.newton.tolerance",
    "coupling.acceleration",
    "coupling.acceleration.*.filter",
    "coupling.convergence",
    "coupling.convergence.interface_residual",
    "coupling.newton",
    "output.probes.*",
];

/// Whether one of several choices is made at this path.
pub(super) fn is_choice(path: &[String]) -> bool {
    CHOICES.iter().any(|choice| {
        let mut names = path.iter();
        choice.split('.').all(|step| names.next().is_some_and(|name| step == "*" || step == name))
            && names.next().is_none()
    })
}
