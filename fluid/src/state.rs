//! The committed state of a fluid: plain data.

use partita_numerics::field::StateMismatch;
use serde::{Deserialize, Serialize};

/// All that a fluid remembers between time steps. A solver that restores it continues bit for bit.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct FluidState {
    /// `t_n` `[s]`.
    pub time: f64,
    /// `t_n - t_{n-1}` `[s]`; nothing before the first step.
    pub last_dt: Option<f64>,
    /// u `[m/s]` and p `[Pa]` at `t_n`, `node * (D + 1) + c`.
    pub values: Vec<f64>,
    /// The same at `t_{n-1}`.
    pub previous_values: Vec<f64>,
    /// Displacement of the mesh from its reference at `t_n` `[m]`, `node * D + c`.
    pub displacement: Vec<f64>,
    /// The same at `t_{n-1}`.
    pub previous_displacement: Vec<f64>,
}

impl FluidState {
    /// On the reference mesh at t = 0.
    pub(crate) fn start(values: Vec<f64>, displacements: usize) -> Self {
        Self {
            time: 0.0,
            last_dt: None,
            previous_values: values.clone(),
            values,
            displacement: vec![0.0; displacements],
            previous_displacement: vec![0.0; displacements],
        }
    }

    /// A step of `dt` to `time` ends here.
    pub(crate) fn advance(&mut self, time: f64, dt: f64, values: &[f64], displacement: &[f64]) {
        self.time = time;
        self.last_dt = Some(dt);
        std::mem::swap(&mut self.previous_values, &mut self.values);
        self.values.copy_from_slice(values);
        std::mem::swap(&mut self.previous_displacement, &mut self.displacement);
        self.displacement.copy_from_slice(displacement);
    }

    /// Whether `other` is a state of the same mesh.
    pub(crate) fn check_fits(&self, other: &Self) -> Result<(), StateMismatch> {
        let check =
            |what, found: &[f64], expected: &[f64]| StateMismatch::check(what, found.len(), expected.len());
        check("values", &other.values, &self.values)?;
        check("previous values", &other.previous_values, &self.previous_values)?;
        check("mesh displacements", &other.displacement, &self.displacement)?;
        check("previous mesh displacements", &other.previous_displacement, &self.previous_displacement)
    }
}
