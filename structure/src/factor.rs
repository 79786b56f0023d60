//! The factor of the tangent.

use partita_numerics::{Factor, FactorError, Method, Pattern};

/// Factors symmetric tangents: by L L^T, and by L D L^T those that are not positive definite.
///
/// Both cost the same (to a few percent from 360 to 30k equations). L L^T is the rule because it is stable without
/// pivoting and because it notices when a tangent loses definiteness: past a buckling load or under strong compression.
pub(crate) struct TangentFactor {
    definite: Factor,
    /// Analysed when it is first needed.
    indefinite: Option<Factor>,
    is_definite: bool,
    indefinite_count: usize,
}

impl TangentFactor {
    pub(crate) fn new(pattern: &Pattern) -> Result<Self, FactorError> {
        let definite = Factor::new(Method::Llt, pattern)?;
        Ok(Self { definite, indefinite: None, is_definite: true, indefinite_count: 0 })
    }

    pub(crate) fn refactor(&mut self, pattern: &Pattern, values: &[f64]) -> Result<(), FactorError> {
        self.is_definite = match self.definite.refactor(values) {
            Ok(()) => true,
            Err(FactorError::NotPositiveDefinite { .. }) => false,
            Err(error) => return Err(error),
        };
        if !self.is_definite {
            self.indefinite_count += 1;
            let factor = match &mut self.indefinite {
                Some(factor) => factor,
                None => self.indefinite.insert(Factor::new(Method::Ldlt, pattern)?),
            };
            factor.refactor(values)?;
        }
        Ok(())
    }

    pub(crate) fn solve(&mut self, rhs: &mut [f64]) {
        match &mut self.indefinite {
            Some(factor) if !self.is_definite => factor.solve(rhs),
            _ => self.definite.solve(rhs),
        }
    }

    /// How many tangents were not positive definite so far.
    pub(crate) fn indefinite_count(&self) -> usize {
        self.indefinite_count
    }
}
