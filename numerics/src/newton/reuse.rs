//! Factors that outlive the iterate they were made at.

use serde::{Deserialize, Serialize};

/// What the last factor of a problem is worth at its current iterate.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ReusableFactor {
    /// There is none, or it belongs to other equations, those of another step size, say.
    Missing,
    /// It belongs to the tangent of an earlier iterate, or of earlier data, and is an approximation here.
    Earlier,
    /// It belongs to the tangent here: the equations are linear and have not changed.
    Exact,
}

/// What a tangent depends on beside iterate and data: coefficients that go with the step size, say.
pub type Coefficients = [f64; 3];

/// A tangent whose factor is kept, as a checkpoint holds it: a factor of the same values has the same bits.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ReusableTangent {
    /// What it was assembled with.
    pub coefficients: Coefficients,
    /// Its values on the pattern of the field.
    pub values: Vec<f64>,
}

/// What a field remembers of its last factor.
///
/// Values of a tangent and its factor belong together: whoever assembles another tangent calls
/// [`forget`](Self::forget) first.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct FactorLog {
    coefficients: Option<Coefficients>,
    is_current: bool,
}

impl FactorLog {
    /// A tangent with these coefficients was factored.
    pub fn factored(&mut self, coefficients: Coefficients) {
        *self = Self { coefficients: Some(coefficients), is_current: true };
    }

    /// The factor is not to be used again.
    pub fn forget(&mut self) {
        *self = Self::default();
    }

    /// The tangent has changed with something other than the iterate, the mesh say.
    pub fn outdate(&mut self) {
        self.is_current = false;
    }

    /// What the factor is worth to a problem with these coefficients that is linear, or is not.
    #[must_use]
    pub fn worth(&self, coefficients: &Coefficients, is_linear: bool) -> ReusableFactor {
        let bits = |coefficients: &Coefficients| coefficients.map(f64::to_bits);
        match &self.coefficients {
            Some(then) if bits(then) != bits(coefficients) => ReusableFactor::Missing,
            Some(_) if is_linear && self.is_current => ReusableFactor::Exact,
            Some(_) => ReusableFactor::Earlier,
            None => ReusableFactor::Missing,
        }
    }

    /// The tangent with these values, where its factor is there.
    #[must_use]
    pub fn tangent(&self, values: &[f64]) -> Option<ReusableTangent> {
        self.coefficients.map(|coefficients| ReusableTangent { coefficients, values: values.to_vec() })
    }
}
