//! The stabilization parameters `tau_M` and `tau_C` of one element, and their derivatives.
#![allow(
    clippy::inline_always,
    reason = "vector code has to be part of the entry point of its instruction set"
)]

use partita_numerics::lanes::{Real, array};

use crate::flow::Flow;

/// `C_I` of `tau_M` unless the settings say otherwise: 36, the constant in common use.
///
/// For linear elements `C_I` bounds no inverse estimate, since the second derivatives it would control vanish.
/// It only sets `tau_M` where viscosity rules, `h^2 / (4 sqrt(C_I D) nu)` on a regular element of edge h. A
/// smaller constant smooths the pressure more, at the price of more mass moved between neighbouring elements by
/// `tau_M / rho (grad q_p, grad p)`. On a steady vortex (that of the convergence tests) the velocity error
/// varies by up to 5 % between 9 and 144; the pressure error grows by up to 10 % from 9 to 36 at a Reynolds number of 20,
/// and like `sqrt(C_I)` in Stokes flow.
pub const INVERSE_CONSTANT: f64 = 36.0;

/// `tau_M`, `tau_C` of one element and how they change with the convective velocity.
///
/// ```text
/// tau_M = (4/dt^2 + c.G c + C_I nu^2 G:G)^(-1/2)     [s]
/// tau_C = grad_div rho / (tau_M tr G)                [Pa s]
/// d tau_M / dc = -tau_M^3 G c,   d tau_C / dc = -(tau_C / tau_M) d tau_M / dc
/// ```
///
/// c is the convective velocity u - w at the centroid, G the [`metric`]; a steady flow has no 4/dt^2. `grad_div` is a factor, 1 in
/// the source.
///
/// Source: Y. Bazilevs et al., *Variational multiscale residual-based turbulence modeling for large eddy
/// simulation of incompressible flows*, CMAME 197 (2007), equations (63)-(64), with the metric of Pauli and
/// Behr.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stabilization<const D: usize, R = f64> {
    /// `tau_M` `[s]`.
    pub momentum: R,
    /// `tau_C` `[Pa s]`.
    pub continuity: R,
    /// `d tau_M / dc` `[s^2/m]`.
    pub momentum_slope: [R; D],
    /// `d tau_C / dc` `[Pa s^2/m]`.
    pub continuity_slope: [R; D],
}

impl<const D: usize, R: Real> Stabilization<D, R> {
    /// The parameters for the convective velocity `c` `[m/s]` and the metric `g` `[1/m^2]`.
    #[inline(always)]
    #[must_use]
    pub fn new(c: &[R; D], g: &[[R; D]; D], flow: &Flow<R>) -> Self {
        let nu = flow.viscosity / flow.density;
        let zero = flow.zero();
        let (mut convection, mut squares, mut trace) = (zero, zero, zero);
        let mut g_c = [zero; D];
        for i in 0..D {
            for j in 0..D {
                g_c[i] += g[i][j] * c[j];
                squares += g[i][j] * g[i][j];
            }
            convection += c[i] * g_c[i];
            trace += g[i][i];
        }
        let rate = flow.four_over_dt_squared + convection + flow.inverse_constant * nu * nu * squares;
        let momentum = rate.like(1.0) / rate.sqrt();
        let continuity = flow.grad_div * (flow.density / (momentum * trace));
        let cube = momentum * (momentum * momentum);
        let momentum_slope = array(
            #[inline(always)]
            |i| -cube * g_c[i],
        );
        let continuity_slope = array(
            #[inline(always)]
            |i| -continuity / momentum * momentum_slope[i],
        );
        Self { momentum, continuity, momentum_slope, continuity_slope }
    }
}

/// `G = 2 sum_a grad N_a (x) grad N_a`: the metric of the regular reference simplex of edge 2 `[1/m^2]`.
///
/// It is 4/h^2 times the identity on a regular simplex of edge h, in 2D and 3D, and does not depend on the
/// numbering of the nodes, as the metric of the usual unit reference simplex does.
///
/// Source: L. Pauli, M. Behr, *On stabilized space-time FEM for anisotropic meshes*, IJNMF 85 (2017).
#[inline(always)]
#[must_use]
pub fn metric<const D: usize, const N: usize, R: Real>(gradients: &[[R; D]; N]) -> [[R; D]; D] {
    let mut g = [[gradients[0][0].like(0.0); D]; D];
    for gradient in gradients {
        for i in 0..D {
            for j in 0..D {
                g[i][j] += gradient[i] * 2.0 * gradient[j];
            }
        }
    }
    g
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kernel::shape;
    use crate::settings::Tangent;
    use approx::assert_relative_eq;

    const FLOW: Flow = Flow {
        density: 3.0,
        viscosity: 0.6,
        inverse_constant: INVERSE_CONSTANT,
        grad_div: 1.0,
        rate: 10.0,
        four_over_dt_squared: 400.0,
        tangent: Tangent::Full,
    };

    /// An equilateral triangle of edge 0.2, turned by 0.4.
    fn equilateral() -> [[f64; 2]; 3] {
        [0.0, 1.0, 2.0].map(|k| {
            let (radius, angle) = (0.2 / 3.0_f64.sqrt(), 0.4 + k * std::f64::consts::TAU / 3.0);
            [radius * f64::cos(angle), radius * f64::sin(angle)]
        })
    }

    #[test]
    fn metric_of_a_regular_triangle_is_four_over_edge_squared() {
        let g = metric(&shape(&equilateral()).0);
        assert_relative_eq!(g[0][0], 100.0, max_relative = 1e-12);
        assert_relative_eq!(g[1][1], 100.0, max_relative = 1e-12);
        assert_relative_eq!(g[0][1], 0.0, epsilon = 1e-11);
    }

    #[test]
    fn metric_of_a_regular_tetrahedron_is_four_over_edge_squared() {
        // Every second corner of a cube with edge 1: edges of length sqrt(2).
        let corners = [[0.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 1.0], [1.0, 0.0, 1.0]];
        let g = metric(&shape(&corners).0);
        for i in 0..3 {
            for j in 0..3 {
                assert_relative_eq!(g[i][j], if i == j { 2.0 } else { 0.0 }, epsilon = 1e-13);
            }
        }
    }

    #[test]
    fn metric_does_not_know_the_numbering() {
        let [a, b, c] = [[0.1, 0.2], [0.9, 0.15], [0.3, 0.35]];
        let (g, turned) = (metric(&shape(&[a, b, c]).0), metric(&shape(&[c, a, b]).0));
        for i in 0..2 {
            for j in 0..2 {
                assert_relative_eq!(g[i][j], turned[i][j], max_relative = 1e-13);
            }
        }
    }

    #[test]
    fn each_limit_has_its_known_value() {
        let g = [[100.0, 0.0], [0.0, 100.0]]; // edge h = 0.2
        let none = Flow { viscosity: 0.0, four_over_dt_squared: 0.0, ..FLOW };
        let instationary = Flow { four_over_dt_squared: 400.0, ..none };
        assert_relative_eq!(Stabilization::new(&[0.0; 2], &g, &instationary).momentum, 0.05); // dt/2
        assert_relative_eq!(Stabilization::new(&[2.0, 0.0], &g, &none).momentum, 0.05); // h/(2|c|)
        let viscous = Flow { viscosity: 0.6, ..none };
        let expected = 0.2 * 0.2 / (24.0 * 2.0_f64.sqrt() * 0.2); // h^2/(24 sqrt(2) nu)
        let tau = Stabilization::new(&[0.0; 2], &g, &viscous);
        assert_relative_eq!(tau.momentum, expected, max_relative = 1e-14);
        assert_relative_eq!(tau.continuity, 3.0 / (expected * 200.0), max_relative = 1e-14);
    }

    #[test]
    fn grad_div_is_a_factor_of_the_continuity_term_alone() {
        let g = [[130.0, 40.0], [40.0, 90.0]];
        let whole = Stabilization::new(&[0.7, -1.1], &g, &FLOW);
        let part = Stabilization::new(&[0.7, -1.1], &g, &Flow { grad_div: 0.3, ..FLOW });
        assert_relative_eq!(part.continuity, 0.3 * whole.continuity, max_relative = 1e-15);
        assert_relative_eq!(part.continuity_slope[0], 0.3 * whole.continuity_slope[0], max_relative = 1e-15);
        assert!((part.momentum, part.momentum_slope) == (whole.momentum, whole.momentum_slope));
    }

    #[test]
    fn slopes_are_the_derivatives() {
        let g = [[130.0, 40.0], [40.0, 90.0]];
        let (c, step) = ([0.7, -1.1], 1e-6);
        let tau = Stabilization::new(&c, &g, &FLOW);
        for j in 0..2 {
            let shifted = |sign: f64| {
                let mut c = c;
                c[j] += sign * step;
                Stabilization::new(&c, &g, &FLOW)
            };
            let (plus, minus) = (shifted(1.0), shifted(-1.0));
            let momentum = (plus.momentum - minus.momentum) / (2.0 * step);
            let continuity = (plus.continuity - minus.continuity) / (2.0 * step);
            assert_relative_eq!(tau.momentum_slope[j], momentum, max_relative = 1e-7);
            assert_relative_eq!(tau.continuity_slope[j], continuity, max_relative = 1e-7);
        }
    }
}
