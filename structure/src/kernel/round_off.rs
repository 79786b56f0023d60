//! What the rounding of a displacement does to the internal forces.

use super::{Element, Point};
use crate::material::Constitutive;
use crate::tensor::{self, Tensor, dot};

/// Adds to each node how much its internal force moves when every displacement is rounded, in units of the relative
/// rounding error:
///
/// ```text
/// force_a += factor sum over points of  w (lambda + 2 mu) |F|^2 g |grad N_a|,      g = sum_b |d_b| |grad N_b|
/// ```
///
/// g is the displacement gradient before anything in it cancels. Across a thin element `|grad N|` is large, and so is g
/// for a small strain: that is the round-off of slender structures, in the last bit of a displacement as much as in the
/// sum that makes the gradient. Linear elasticity has F = I.
///
/// `displacement` `[m]` and `force` `[N, in 2D N/m]` hold one entry a node.
pub fn add_rounding<const D: usize>(
    element: Element<D>,
    material: &dyn Constitutive<D>,
    factor: f64,
    displacement: &[[f64; D]],
    force: &mut [f64],
) {
    element.assert_fits(displacement);
    element.assert_fits(force);
    let modulus = factor * material.modulus();
    for point in element.points() {
        let stretch = if material.is_linear() { 1.0 } else { point.stretch(displacement) };
        let stress = modulus * stretch * stretch * point.gradient_size(displacement);
        for (force, gradient) in force.iter_mut().zip(point.gradients) {
            *force += point.weight * stress * length(gradient);
        }
    }
}

impl<const D: usize> Point<'_, D> {
    /// `sum_b |d_b| |grad N_b|`
    fn gradient_size(&self, displacement: &[[f64; D]]) -> f64 {
        displacement.iter().zip(self.gradients).map(|(d, gradient)| length(d) * length(gradient)).sum()
    }

    /// |F| of F = I + grad d, 1 for a rotation and no less than that.
    fn stretch(&self, displacement: &[[f64; D]]) -> f64 {
        let gradient = self.gradient(displacement);
        let f: Tensor<D> = tensor::build(|i, j| gradient[i][j] + if i == j { 1.0 } else { 0.0 });
        (tensor::contract(&f, &f) / D as f64).sqrt().max(1.0)
    }
}

fn length<const D: usize>(vector: &[f64; D]) -> f64 {
    dot(vector, vector).sqrt()
}
