//! Whether a factorization can be trusted.

use super::FactorError;
use crate::Pattern;

/// The largest error with which a known solution may come back.
///
/// Regular matrices of flow and elasticity stay below 1e-5, even nearly incompressible ones; where a pressure
/// or a rigid motion is left undetermined, hardly a digit is right (above 1e-2).
const TRUST: f64 = 1e-3;

/// A factor that returns a known solution with a smaller error than this is good enough, whatever it went through.
pub(super) const SOUND: f64 = 1e-8;

/// Where the solution is less accurate than that, two backward errors tell an ill-conditioned matrix, for which nobody can
/// do better, from pivots that were too small.
///
/// A factor is that of a matrix A + E. Its solution leaves a residual of the size of E, and a step of iterative refinement
/// turns a residual r into E (A + E)^-1 r: a small E leaves round-off, whatever the condition number, and a large one does
/// not (Skeel 1980; Arioli, Demmel, Duff 1989). So this bound is one on the backward error **after** such a step. All
/// tangents of flow stay below 5e-16, from faer's LU a few come to 2e-14; rows with some hundred entries need the room.
const REFINED: f64 = 1e-14;

/// Nobody refines the solutions themselves, so that theirs has a bound, too, see [`REFINED`]: the square root of round-off
/// slows down no Newton loop. A tighter bound would ask for the impossible: elimination mixes the rows, so that a row of
/// small entries takes over the round-off of large ones. On elements stretched to 1:1000 the error comes to 7e-10 here, and
/// to 1.3e-8 after faer's LU with partial pivoting.
const UNREFINED: f64 = 1.5e-8;

/// A system with a known solution, solved after each factorization.
///
/// ```text
/// x_j = s_j / c_j,  c_j = max_i |A_ij|,  0.5 <= s_j < 1.5,   error = max_j c_j |x_j - (A^-1 A x)_j|
/// ```
///
/// The column scales make the error independent of the units of the unknowns. Small pivots alone would not
/// tell: in a singular matrix of many equations the lost pivot ends anywhere between 1e-17 and 1e-11 of its
/// diagonal entry.
pub(super) struct Trial {
    column_scales: Vec<f64>,
    known: Vec<f64>,
    solution: Vec<f64>,
    /// A (known - solution), and |A| |known|.
    residual: Vec<f64>,
    sizes: Vec<f64>,
}

impl Trial {
    pub(super) fn new(size: usize) -> Self {
        let zeros = vec![0.0; size];
        Self {
            column_scales: zeros.clone(),
            known: zeros.clone(),
            solution: zeros.clone(),
            residual: zeros.clone(),
            sizes: zeros,
        }
    }

    /// Looks at the values before they are factored: not finite, or a column of zeros?
    pub(super) fn inspect(&mut self, pattern: &Pattern, values: &[f64]) -> Result<(), FactorError> {
        let columns = pattern.col_ptr().windows(2).map(|range| range[0]..range[1]);
        for ((equation, entries), scale) in columns.enumerate().zip(&mut self.column_scales) {
            let column = &values[entries.clone()];
            if let Some(k) = column.iter().position(|value| !value.is_finite()) {
                let row = pattern.row_idx()[entries.start + k];
                return Err(FactorError::NotFinite { row, column: equation });
            }
            *scale = column.iter().fold(0.0, |largest, value| value.abs().max(largest));
            if *scale == 0.0 {
                return Err(FactorError::Singular { equation: Some(equation) });
            }
        }
        Ok(())
    }

    /// The error with which `solve` returns the known solution, in columns scaled to one. It may factor the matrix, too.
    pub(super) fn error(
        &mut self,
        pattern: &Pattern,
        values: &[f64],
        solve: impl FnOnce(&mut [f64]) -> Result<(), FactorError>,
    ) -> Result<f64, FactorError> {
        for (j, (known, scale)) in self.known.iter_mut().zip(&self.column_scales).enumerate() {
            *known = varied(j) / scale;
        }
        pattern.multiply(values, &self.known, &mut self.solution);
        solve(&mut self.solution)?;
        let solutions = self.known.iter().zip(&self.solution);
        let errors =
            solutions.zip(&self.column_scales).map(|((x, solved), scale)| scale * (x - solved).abs());
        Ok(largest(errors))
    }

    /// Whether the backward errors of the system that [`error`](Self::error) solved are those of a good factor.
    pub(super) fn is_stable(
        &mut self,
        pattern: &Pattern,
        values: &[f64],
        solve: impl FnOnce(&mut [f64]),
    ) -> bool {
        if self.backward_error(pattern, values) >= UNREFINED {
            return false;
        }
        solve(&mut self.residual);
        self.solution.iter_mut().zip(&self.residual).for_each(|(x, correction)| *x += correction);
        self.backward_error(pattern, values) < REFINED
    }

    /// max `|A (known - solution)|_i / (|A| |known|)_i`. Leaves A (known - solution) in `residual`; the right-hand side would
    /// bring a rounding error of its own.
    fn backward_error(&mut self, pattern: &Pattern, values: &[f64]) -> f64 {
        self.residual.fill(0.0);
        self.sizes.fill(0.0);
        for (column, (known, solved)) in self.known.iter().zip(&self.solution).enumerate() {
            for slot in pattern.col_ptr()[column]..pattern.col_ptr()[column + 1] {
                let row = pattern.row_idx()[slot];
                self.residual[row] += values[slot] * (known - solved);
                self.sizes[row] += (values[slot] * known).abs();
            }
        }
        let rows = self.residual.iter().zip(&self.sizes).filter(|(_, size)| **size > 0.0);
        largest(rows.map(|(residual, size)| residual.abs() / size))
    }
}

/// `max` alone would drop what is not a number.
fn largest(errors: impl Iterator<Item = f64>) -> f64 {
    errors.fold(0.0, |largest, error| if error > largest || error.is_nan() { error } else { largest })
}

/// Numbers between 0.5 and 1.5 without a pattern that a null vector could share.
fn varied(j: usize) -> f64 {
    const GOLDEN_RATIO: f64 = 0.618_033_988_749_894_9;
    0.5 + (j as f64 * GOLDEN_RATIO).fract()
}

/// Turns the error of a trial into a verdict.
pub(super) fn judge(error: f64) -> Result<(), FactorError> {
    if !error.is_finite() {
        Err(FactorError::Singular { equation: None })
    } else if error > TRUST {
        Err(FactorError::Inaccurate { error })
    } else {
        Ok(())
    }
}
