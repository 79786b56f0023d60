//! `[output]`: what a run writes, and how often.

use std::collections::BTreeMap;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

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
    /// Displacement \[m\] of the structure at these spline parameters, each from 0 to 1.
    StructureDisplacement([Parameter; 2]),
    /// Force of the fluid on this boundary group \[N in 3D, N/m in 2D\].
    FluidForce(String),
    /// Velocity \[m/s\] and pressure \[Pa\] at the mesh node nearest to this point \[m\], before it moves.
    FluidValue([Real; 2]),
}
