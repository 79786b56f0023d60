//! The compressible neo-Hookean solid.
//!
//! ```text
//! W = mu/2 (tr C - 3) - mu ln J + lambda/2 (ln J)^2        C = F^T F,  J = det F
//! S = mu (I - C^-1) + lambda ln J C^-1
//! P = F S = F^-T (2 mu E + lambda ln J I)                   E = (C - I)/2
//! ```
//!
//! Source: J. Bonet, R. D. Wood, *Nonlinear Continuum Mechanics for Finite Element Analysis*, 2nd edition (2008),
//! section 6.4.3. The last form of P is the one that is evaluated: it takes no difference of two numbers near one, so
//! that small strains keep all their digits.
//!
//! In plane stress the stretch out of the plane follows from `S_33 = 0` at each point: with `z = ln C_33` and the area
//! ratio j of the plane, `J = j e^(z/2)`,
//!
//! ```text
//! g(z) = mu (e^z - 1) + lambda (ln j + z/2) = 0
//! ```
//!
//! by Newton's method; its derivative `dz/d(ln j) = -lambda/(mu e^z + lambda/2)` condenses the tangent.

use super::{Response, ResponseError, green_lagrange};
use crate::tensor::{self, Tensor};
use partita_numerics::small;

/// Newton's method for z needs about as many iterations as z has units: so many stand for ratios of e^100.
const MAX_ITERATIONS: usize = 100;

/// The two constants of the solid, and whether a sheet is free to stretch out of its plane.
#[derive(Debug, Clone, Copy)]
pub(super) struct NeoHookean {
    pub(super) lambda: f64,
    pub(super) mu: f64,
    pub(super) is_sheet: bool,
}

/// The change of volume at a deformation.
#[derive(Debug, Clone, Copy)]
struct Volume {
    /// j - 1 of the directions that are modelled.
    growth: f64,
    /// `ln C_33`; 0 unless the solid is a sheet.
    out_of_plane: f64,
    /// lambda ln J
    pressure: f64,
    /// d(lambda ln J)/d(ln j)
    stiffness: f64,
}

impl NeoHookean {
    /// P at a displacement gradient.
    #[inline]
    pub(super) fn stress<const D: usize>(&self, gradient: &Tensor<D>) -> Result<Tensor<D>, ResponseError> {
        let volume = self.volume(gradient)?;
        Ok(self.pulled(&inverse(gradient)?, gradient, &volume))
    }

    /// P and
    ///
    /// ```text
    /// A_iJkL = mu delta_ik delta_JL + (mu - lambda ln J) F^-1_Jk F^-1_Li + lambda* F^-1_Ji F^-1_Lk
    /// ```
    ///
    /// with `lambda* = d(lambda ln J)/d(ln j)`.
    #[inline]
    pub(super) fn response<const D: usize>(
        &self,
        gradient: &Tensor<D>,
    ) -> Result<Response<D>, ResponseError> {
        let volume = self.volume(gradient)?;
        let inverse = inverse(gradient)?;
        let turn = self.mu - volume.pressure;
        let mut tangent = [[[[0.0; D]; D]; D]; D];
        for j in 0..D {
            for l in 0..D {
                let block = &mut tangent[j][l];
                for i in 0..D {
                    for k in 0..D {
                        block[i][k] = turn * inverse[j][k] * inverse[l][i]
                            + volume.stiffness * inverse[j][i] * inverse[l][k];
                    }
                }
            }
            (0..D).for_each(|i| tangent[j][j][i][i] += self.mu);
        }
        Ok(Response { stress: self.pulled(&inverse, gradient, &volume), tangent })
    }

    /// W; infinite where the solid is crushed, as W grows without bound on the way there.
    pub(super) fn energy<const D: usize>(&self, gradient: &Tensor<D>) -> f64 {
        let Ok(volume) = self.volume(gradient) else { return f64::INFINITY };
        let Volume { growth, out_of_plane, pressure, .. } = volume;
        // mu (tr E + (C_33 - 1)/2 - ln J): what is of first order is taken out of both parts by hand.
        let squares = 0.5 * tensor::contract(gradient, gradient) - higher_terms(gradient);
        let in_plane = squares + minus_ln_1p(growth);
        let thickness = 0.5 * minus_ln_1p(out_of_plane.exp_m1());
        let ln_j = growth.ln_1p() + 0.5 * out_of_plane;
        self.mu * (in_plane + thickness) + 0.5 * pressure * ln_j
    }

    /// F^-T (2 mu E + lambda ln J I)
    #[inline]
    fn pulled<const D: usize>(
        &self,
        inverse: &Tensor<D>,
        gradient: &Tensor<D>,
        volume: &Volume,
    ) -> Tensor<D> {
        let mut pulled = green_lagrange(gradient).map(|row| row.map(|e| 2.0 * self.mu * e));
        (0..D).for_each(|i| pulled[i][i] += volume.pressure);
        small::transpose_multiply(inverse, &pulled)
    }

    #[inline]
    fn volume<const D: usize>(&self, gradient: &Tensor<D>) -> Result<Volume, ResponseError> {
        let growth = tensor::trace(gradient) + higher_terms(gradient);
        if !(growth > -1.0 && growth.is_finite()) {
            return Err(ResponseError::Crushed { volume_ratio: 1.0 + growth });
        }
        let ln_j = growth.ln_1p();
        let (lambda, mu) = (self.lambda, self.mu);
        if !self.is_sheet {
            return Ok(Volume { growth, out_of_plane: 0.0, pressure: lambda * ln_j, stiffness: lambda });
        }
        let z = self.out_of_plane(ln_j).ok_or(ResponseError::NoPlaneStress { area_ratio: 1.0 + growth })?;
        let thickness = mu * z.exp();
        let stiffness = lambda * thickness / (thickness + 0.5 * lambda);
        Ok(Volume { growth, out_of_plane: z, pressure: lambda * (ln_j + 0.5 * z), stiffness })
    }

    /// The root z of g on the branch where g rises, which is the one through the undeformed state.
    ///
    /// As g is convex, Newton's method comes down to it from the right after the first step; where it has no root
    /// (possible for a negative Poisson's ratio) the slope turns negative.
    fn out_of_plane(&self, ln_j: f64) -> Option<f64> {
        let mut z = 0.0_f64;
        for _ in 0..MAX_ITERATIONS {
            let slope = self.mu * z.exp() + 0.5 * self.lambda;
            if !(slope > 0.0 && slope.is_finite()) {
                return None;
            }
            let step = (self.mu * z.exp_m1() + self.lambda * (ln_j + 0.5 * z)) / slope;
            z -= step;
            if step.abs() <= 4.0 * f64::EPSILON * z.abs() {
                return Some(z);
            }
        }
        None
    }
}

/// F^-1
#[inline]
fn inverse<const D: usize>(gradient: &Tensor<D>) -> Result<Tensor<D>, ResponseError> {
    let f = super::deformation_gradient(gradient);
    let volume_ratio = 0.0;
    small::inverse(&f).map(|(inverse, _)| inverse).ok_or(ResponseError::Crushed { volume_ratio })
}

/// det(I + H) - 1 - tr H: the second and third invariants of H.
#[inline]
fn higher_terms<const D: usize>(h: &Tensor<D>) -> f64 {
    let minor = |i: usize, j: usize| h[i][i] * h[j][j] - h[i][j] * h[j][i];
    match D {
        2 => minor(0, 1),
        3 => minor(0, 1) + minor(1, 2) + minor(0, 2) + small::determinant(h),
        _ => 0.0,
    }
}

/// x - ln(1 + x), to all digits also for small x.
fn minus_ln_1p(x: f64) -> f64 {
    if x.abs() > 0.01 {
        return x - x.ln_1p();
    }
    // x^2/2 - x^3/3 + ...; the term left out is below 1e-17 of the first.
    let mut sum = 0.0;
    for k in (2..=9).rev() {
        sum = 1.0 / f64::from(k) - x * sum;
    }
    x * x * sum
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    const SOLID: NeoHookean = NeoHookean { lambda: 3.0, mu: 2.0, is_sheet: false };

    #[test]
    fn the_stress_is_that_of_the_closed_forms_of_simple_shear_and_uniaxial_strain() {
        // F = I + k e1 e2: J = 1, P = mu (F - F^-T).
        let k = 0.7;
        let p = SOLID.stress(&[[0.0, k, 0.0], [0.0; 3], [0.0; 3]]).unwrap();
        let expected = [[0.0, 2.0 * k, 0.0], [2.0 * k, 0.0, 0.0], [0.0; 3]];
        for (found, expected) in p.as_flattened().iter().zip(expected.as_flattened()) {
            assert_relative_eq!(found, expected, epsilon = 1e-15);
        }
        for stretch in [0.3_f64, 0.9, 1.8] {
            let p = SOLID.stress(&[[stretch - 1.0, 0.0], [0.0, 0.0]]).unwrap();
            let ln = stretch.ln();
            let along = 2.0 * (stretch - 1.0 / stretch) + 3.0 * ln / stretch;
            assert_relative_eq!(p[0][0], along, max_relative = 1e-13);
            assert_relative_eq!(p[1][1], 3.0 * ln, max_relative = 1e-13);
        }
    }

    #[test]
    fn a_sheet_of_an_almost_incompressible_solid_keeps_its_volume() {
        // lambda -> inf: C_33 = 1/j^2, and uniaxial tension has P = mu (s - 1/s^2) at the stretch s.
        let sheet = NeoHookean { lambda: 1e9, mu: 2.0, is_sheet: true };
        let s: f64 = 1.5;
        let across = s.powf(-0.5);
        let p = sheet.stress(&[[s - 1.0, 0.0], [0.0, across - 1.0]]).unwrap();
        assert_relative_eq!(p[0][0], 2.0 * (s - 1.0 / (s * s)), max_relative = 1e-6);
        assert!(p[1][1].abs() < 1e-6, "{}", p[1][1]);
    }

    #[test]
    fn the_stretch_out_of_the_plane_is_found_for_ratios_of_any_size() {
        for lambda in [-0.5, 0.0, 3.0, 1e3] {
            let sheet = NeoHookean { lambda, mu: 2.0, is_sheet: true };
            for ln_j in [-1.0, -1e-9, 0.0, 0.4, 10.0_f64] {
                let z = sheet.out_of_plane(ln_j).unwrap();
                let (rise, fall): (f64, f64) = (2.0 * z.exp_m1(), lambda * (ln_j + 0.5 * z));
                let scale = rise.abs() + (lambda * ln_j).abs() + lambda.abs() * z.abs();
                assert!((rise + fall).abs() <= 1e-13 * scale, "lambda {lambda}, ln j {ln_j}: z = {z}");
            }
        }
        // Pressed hard, a sheet of negative Poisson's ratio cannot free itself of stress.
        let auxetic = NeoHookean { lambda: -0.5, mu: 2.0, is_sheet: true };
        assert_eq!(auxetic.out_of_plane(-20.0), None);
    }

    #[test]
    fn small_strains_keep_their_digits() {
        // W = mu eps^2 + lambda/2 eps^2 and P = (lambda + 2 mu) eps for a strain eps along x, up to the next order.
        let eps = 1e-9;
        let gradient = [[eps, 0.0], [0.0, 0.0]];
        assert_relative_eq!(SOLID.energy(&gradient), 3.5 * eps * eps, max_relative = 1e-8);
        assert_relative_eq!(SOLID.stress(&gradient).unwrap()[0][0], 7.0 * eps, max_relative = 1e-8);
        for x in [0.0099, -0.0099, 0.3, -0.5] {
            assert_relative_eq!(minus_ln_1p(x), x - f64::ln_1p(x), max_relative = 1e-11);
        }
    }

    #[test]
    fn a_crushed_solid_is_refused_with_its_volume_ratio() {
        for gradient in [[[-1.0, 0.0], [0.0, 0.0]], [[-1.5, 0.0], [0.0, 0.0]], [[f64::NAN; 2]; 2]] {
            assert!(matches!(SOLID.stress(&gradient), Err(ResponseError::Crushed { .. })));
            assert!(matches!(SOLID.response(&gradient), Err(ResponseError::Crushed { .. })));
            assert_eq!(SOLID.energy(&gradient).to_bits(), f64::INFINITY.to_bits());
        }
        let Err(ResponseError::Crushed { volume_ratio }) = SOLID.stress(&[[-1.5, 0.0], [0.0, 0.0]]) else {
            panic!("turned inside out")
        };
        assert_relative_eq!(volume_ratio, -0.5);
    }
}
