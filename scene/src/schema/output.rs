//! `[output]`: what a run writes, and how often.

use std::collections::BTreeMap;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::formula::{Formula, VectorFormula};
use super::groups::Groups;
use super::numbers::{Count, Parameter, Real};

/// `[output]`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Output {
    /// Steps between two files of fields; 0 writes none. Default: 1.
    pub fields_every: usize,
    /// Steps between two checkpoints; 0 writes none. Default: 10.
    pub checkpoint_every: usize,
    /// Cells drawn along each side of a spline element. Default: 2.
    pub spline_subdivisions: Count,
    /// Values written at every step, by name. Default: none.
    pub probes: BTreeMap<String, Probe>,
}

impl Default for Output {
    fn default() -> Self {
        Self {
            fields_every: 1,
            checkpoint_every: 10,
            spline_subdivisions: Count::literal(2),
            probes: BTreeMap::new(),
        }
    }
}

/// `output.probes.<name>`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Probe {
    /// Displacement \[m\] of the structure at these parameters of its patch, each from 0 to 1.
    StructureDisplacement([Parameter; 2]),
    /// Displacement \[m\] of the structure at this point \[m\], before it moves.
    StructurePoint([Real; 2]),
    /// Kinetic and strain energy of the structure \[J, in 2D J/m\].
    StructureEnergy,
    /// Force of the fluid on this boundary group, or on several together, without the parts of neighbouring groups at the nodes they share \[N, in 2D N/m\].
    FluidForce(Groups),
    /// Velocity \[m/s\] and pressure \[Pa\] at the mesh node nearest to this point \[m\], before it moves.
    FluidValue([Real; 2]),
    /// Smallest and largest velocity components \[m/s\] along a line, before it moves with the mesh.
    FluidExtremes(Line),
    /// Distance of the flow from a known one: root mean squares over the fluid \[m/s, Pa\].
    FluidError(Known),
    /// Volume of fluid a second that leaves through this boundary group, or several together \[m3/s, in 2D m2/s\].
    FluidFlowRate(Groups),
    /// Kinetic energy of the fluid \[J, in 2D J/m\].
    FluidEnergy,
    /// Change of the mesh's volume that no flow makes up for \[m3/s, in 2D m2/s\].
    VolumeDefect,
    /// The fluid's mesh: smallest cell as part of what it was at t = 0, worst shape (1 is equilateral); both 1 where nothing moves.
    MeshQuality,
    /// Work of the fluid on the structure in the step \[J, in 2D J/m\].
    InterfaceWork,
}

/// `output.probes.<name>.fluid_error`: an exact solution.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Known {
    /// Its velocity \[m/s\] in `x`, `y`, `t`.
    pub velocity: VectorFormula,
    /// Its pressure \[Pa\] in `x`, `y`, `t`.
    pub pressure: Formula,
}

/// `output.probes.<name>.fluid_extremes`: a straight line.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Line {
    /// One end \[m\].
    pub from: [Real; 2],
    /// The other end \[m\].
    pub to: [Real; 2],
}
