//! The discrete cosine transform between points and modes.

use std::f64::consts::PI;

use crate::vector::{add_scaled, dot};

/// The orthonormal modes `C[n][i] = sqrt((2 - delta_n0) / N) cos(n pi (i + 1/2) / N)`.
#[derive(Debug, Clone)]
pub(super) struct Modes {
    rows: Vec<Vec<f64>>,
}

impl Modes {
    pub(super) fn new(points: usize) -> Self {
        let scale = |mode: usize| if mode == 0 { 1.0 } else { 2.0_f64 };
        let entry = |mode: usize, point: usize| {
            let angle = (mode * (2 * point + 1)) as f64 * PI / (2 * points) as f64;
            (scale(mode) / points as f64).sqrt() * angle.cos()
        };
        Self { rows: (0..points).map(|n| (0..points).map(|i| entry(n, i)).collect()).collect() }
    }

    /// Number of points, and of modes.
    pub(super) fn len(&self) -> usize {
        self.rows.len()
    }

    /// Amplitudes of the modes from values at the points.
    pub(super) fn amplitudes(&self, values: &[f64], amplitudes: &mut [f64]) {
        for (amplitude, row) in amplitudes.iter_mut().zip(&self.rows) {
            *amplitude = dot(row, values);
        }
    }

    /// Values at the points from amplitudes of the modes.
    pub(super) fn values(&self, amplitudes: &[f64], values: &mut [f64]) {
        values.fill(0.0);
        for (amplitude, row) in amplitudes.iter().zip(&self.rows) {
            add_scaled(*amplitude, row, values);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn modes_are_orthonormal() {
        let modes = Modes::new(7);
        for n in 0..7 {
            for m in 0..7 {
                let expected = if n == m { 1.0 } else { 0.0 };
                assert!((dot(&modes.rows[n], &modes.rows[m]) - expected).abs() < 1e-14);
            }
        }
    }
}
