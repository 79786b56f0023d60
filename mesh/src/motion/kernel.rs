//! Element matrices of mesh motion.

use super::MotionLaw;
use crate::simplex::MAX_VERTICES;

/// Stiffness of one simplex, row-major over its `D (D + 1)` dofs `a * D + i`, from the gradients of its shape
/// functions and its measure `J`; `scale` is `(J_0 / J)^chi`.
///
/// ```text
/// elastic    K_{ai,bj} = scale J [ lambda N_a,i N_b,j + mu N_a,j N_b,i + mu delta_ij N_a,k N_b,k ]
/// harmonic   K_{ai,bj} = scale J delta_ij N_a,k N_b,k
/// ```
pub(super) fn stiffness<const D: usize>(
    law: MotionLaw,
    gradients: &[[f64; D]; MAX_VERTICES],
    measure: f64,
    scale: f64,
    matrix: &mut [f64],
) {
    let (lambda, mu, laplace) = coefficients(law);
    let weight = scale * measure;
    let n = D * (D + 1);
    for a in 0..=D {
        for b in 0..=D {
            let (grad_a, grad_b) = (&gradients[a], &gradients[b]);
            let diagonal = laplace * (0..D).map(|k| grad_a[k] * grad_b[k]).sum::<f64>();
            for i in 0..D {
                let row = &mut matrix[(a * D + i) * n + b * D..][..D];
                for j in 0..D {
                    row[j] = weight * (lambda * grad_a[i] * grad_b[j] + mu * grad_a[j] * grad_b[i]);
                }
                row[i] += weight * diagonal;
            }
        }
    }
}

/// Lame's `lambda` and `mu` for a Young's modulus of 1, and the factor of `delta_ij N_a,k N_b,k`.
fn coefficients(law: MotionLaw) -> (f64, f64, f64) {
    match law {
        MotionLaw::Elastic { poisson_ratio: nu, .. } => {
            let mu = 0.5 / (1.0 + nu);
            (nu / ((1.0 + nu) * (1.0 - 2.0 * nu)), mu, mu)
        }
        MotionLaw::Harmonic { .. } => (0.0, 0.0, 1.0),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::simplex;

    const TRIANGLE: [[f64; 2]; 3] = [[0.1, 0.0], [1.2, 0.3], [0.4, 0.8]];

    fn triangle_stiffness(law: MotionLaw) -> [f64; 36] {
        let (gradients, measure) = simplex::gradients(&TRIANGLE).expect("a triangle with an area");
        let mut matrix = [0.0; 36];
        stiffness(law, &gradients, measure, 1.0, &mut matrix);
        matrix
    }

    fn energy(matrix: &[f64; 36], displacement: impl Fn([f64; 2]) -> [f64; 2]) -> f64 {
        let d: Vec<f64> = TRIANGLE.iter().flat_map(|&x| displacement(x)).collect();
        (0..6).map(|i| (0..6).map(|j| d[i] * matrix[6 * i + j] * d[j]).sum::<f64>()).sum()
    }

    /// `sigma : eps J` of uniaxial strain and of pure shear, computed by hand.
    #[test]
    fn elastic_energy_is_that_of_plane_strain() {
        let matrix = triangle_stiffness(MotionLaw::default());
        let area = simplex::measure(&TRIANGLE);
        let (lambda, mu) = (0.3 / (1.3 * 0.4), 0.5 / 1.3);
        let stretch = energy(&matrix, |[x, _]| [0.1 * x, 0.0]);
        approx::assert_relative_eq!(stretch, 0.01 * (lambda + 2.0 * mu) * area, max_relative = 1e-13);
        let shear = energy(&matrix, |[_, y]| [0.1 * y, 0.0]);
        approx::assert_relative_eq!(shear, 0.01 * mu * area, max_relative = 1e-13);
    }

    #[test]
    fn rigid_motion_costs_nothing() {
        let elastic = triangle_stiffness(MotionLaw::default());
        assert!(energy(&elastic, |[x, y]| [1.0 - 0.2 * y, 2.0 + 0.2 * x]).abs() < 1e-14);
        let harmonic = triangle_stiffness(MotionLaw::Harmonic { stiffening: 0.0 });
        assert!(energy(&harmonic, |_| [1.0, 2.0]).abs() < 1e-14);
        // A rotation is not free for the harmonic body: |grad d|^2 J = 2 * 0.2^2 J.
        let rotation = energy(&harmonic, |[x, y]| [-0.2 * y, 0.2 * x]);
        approx::assert_relative_eq!(rotation, 0.08 * simplex::measure(&TRIANGLE), max_relative = 1e-13);
    }
}
