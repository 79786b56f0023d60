//! The derivative of the element residual.
#![allow(
    clippy::inline_always,
    reason = "vector code has to be part of the entry point of its instruction set"
)]

use partita_numerics::lanes::{Real, sum};
use partita_numerics::small::dot;

use super::element::Element;
use crate::flow::Tangent;

impl<const D: usize, const N: usize, R: Real> Element<D, N, R> {
    /// The derivative of [`residual`](Element::residual) with respect to the nodal velocities and pressures,
    /// or of its form with tau, or the convective velocity, held: see [`Tangent`].
    ///
    /// With `du` a change of velocity, the change of the convective velocity is `du` too, and
    ///
    /// ```text
    /// d r_M = rho (c_0 du + (grad du) c + L du) + grad dp
    /// ```
    ///
    /// # Panics
    ///
    /// If `matrix` does not have (N (D + 1))^2 entries.
    #[inline(always)]
    pub fn tangent(&self, matrix: &mut [R]) {
        let size = N * (D + 1);
        assert_eq!(matrix.len(), size * size, "element matrix has the wrong length");
        let shared = Shared::new(self);
        for a in 0..N {
            for b in 0..N {
                let block = Block { matrix: &mut *matrix, size, row: a * (D + 1), column: b * (D + 1) };
                self.block(a, b, &shared, block);
            }
        }
    }

    /// The rows of node `a`, columns of node `b`.
    #[inline(always)]
    fn block(&self, a: usize, b: usize, shared: &Shared<D, N, R>, mut block: Block<R>) {
        let Self { flow, tau, measure, .. } = self;
        let (rho, mu, zero) = (flow.density, flow.viscosity, flow.zero());
        let (from, by) = (&self.gradients[a], &self.gradients[b]);
        let mean = *measure / N as f64;
        let mass = self.product * if a == b { 2.0 } else { 1.0 };
        let diffusion = *measure * dot(from, by);
        let (advect, test_advect) = (shared.advection[a][b], shared.advection[b][a]);

        // (N_a, rho (c_0 du + (grad du) c)) + (mu grad du) grad N_a + tau_M (c.grad N_a, the same)
        let diagonal = rho * (flow.rate * mass + advect)
            + mu * diffusion
            + tau.momentum * rho * (flow.rate * test_advect + shared.streamline[a][b]);
        // (N_a + tau_M c.grad N_a, rho L du)
        let reaction = shared.newton * rho * (mass + tau.momentum * test_advect);
        let by_pressure = tau.momentum * mean * shared.along[a];
        let smoothing = tau.momentum * mean;
        for i in 0..D {
            for j in 0..D {
                let transposed = mu * *measure * from[j] * by[i];
                let divergence = tau.continuity * *measure * from[i] * by[j];
                // tau_M (du.grad N_a, r_M)
                let test = shared.newton * tau.momentum * shared.weighted_residual[b][i] * from[j];
                let tau_change = shared.slope[j] * shared.streamline_force[a][i]
                    + shared.continuity_slope[j] * shared.divergence * from[i];
                let direct = if i == j { diagonal } else { zero };
                let coupling = reaction * self.velocity_gradient[i][j];
                block.set(i, j, direct + coupling + transposed + divergence + test + tau_change);
            }
            block.set(i, D, by_pressure * by[i] - mean * from[i]);
        }
        for j in 0..D {
            // grad N_a . (c_0 du + (grad du) c + L du)
            let residual_change =
                from[j] * (flow.rate + shared.along[b]) + shared.newton * shared.convected_test[a][j];
            let tau_change = shared.slope[j] * shared.smoothing_force[a];
            block.set(D, j, mean * by[j] + smoothing * residual_change + tau_change);
        }
        block.set(D, D, tau.momentum / rho * diffusion);
    }
}

/// What more than one block needs.
struct Shared<const D: usize, const N: usize, R> {
    /// 1 where the convective velocity follows u, 0 where it is held.
    newton: R,
    /// Derivatives of `tau_M` and `tau_C` by one node's velocity; zero where tau is held.
    slope: [R; D],
    continuity_slope: [R; D],
    /// `(N_a, c.grad N_b)`.
    advection: [[R; N]; N],
    /// `(c.grad N_a, c.grad N_b)`.
    streamline: [[R; N]; N],
    /// `grad N_a . sum_b c_b`.
    along: [R; N],
    /// `(N_a, r_M)`.
    weighted_residual: [[R; D]; N],
    /// `(c.grad N_a, r_M)` and `(grad N_a, r_M) / rho`: what `tau_M` multiplies.
    streamline_force: [[R; D]; N],
    smoothing_force: [R; N],
    /// `grad N_a L`.
    convected_test: [[R; D]; N],
    /// Integral of div u.
    divergence: R,
}

impl<const D: usize, const N: usize, R: Real> Shared<D, N, R> {
    #[inline(always)]
    fn new(element: &Element<D, N, R>) -> Self {
        let Element { gradients, fields, convective_sum, strong_sum, product, measure, .. } = *element;
        let zero = element.flow.zero();
        let (mut along, mut pointwise) = ([zero; N], [[zero; N]; N]);
        for a in 0..N {
            along[a] = dot(&gradients[a], &convective_sum);
            for b in 0..N {
                // c.grad N_b at node a
                pointwise[a][b] = dot(&fields.convective[a], &gradients[b]);
            }
        }
        let mut shared = Self {
            newton: zero.like(f64::from(u8::from(element.flow.tangent != Tangent::Picard))),
            slope: [zero; D],
            continuity_slope: [zero; D],
            advection: [[zero; N]; N],
            streamline: [[zero; N]; N],
            along,
            weighted_residual: [[zero; D]; N],
            streamline_force: [[zero; D]; N],
            smoothing_force: [zero; N],
            convected_test: [[zero; D]; N],
            divergence: measure * element.divergence,
        };
        if element.flow.tangent == Tangent::Full {
            for i in 0..D {
                shared.slope[i] = element.tau.momentum_slope[i] / N as f64;
                shared.continuity_slope[i] = element.tau.continuity_slope[i] / N as f64;
            }
        }
        let stress = element.streamline_stress();
        for a in 0..N {
            for b in 0..N {
                let products = sum::<N, R>(
                    #[inline(always)]
                    |d| pointwise[d][a] * pointwise[d][b],
                );
                shared.advection[a][b] = product * (along[b] + pointwise[a][b]);
                shared.streamline[a][b] = product * (products + along[a] * along[b]);
            }
            for i in 0..D {
                shared.weighted_residual[a][i] = product * (strong_sum[i] + element.strong_residual[a][i]);
                shared.streamline_force[a][i] = dot(&stress[i], &gradients[a]);
                shared.convected_test[a][i] = sum::<D, R>(
                    #[inline(always)]
                    |k| gradients[a][k] * element.velocity_gradient[k][i],
                );
            }
            shared.smoothing_force[a] =
                measure / (element.flow.density * N as f64) * dot(&gradients[a], &strong_sum);
        }
        shared
    }
}

/// The (D + 1) x (D + 1) part of the element matrix that couples two nodes.
struct Block<'a, R> {
    matrix: &'a mut [R],
    size: usize,
    row: usize,
    column: usize,
}

impl<R> Block<'_, R> {
    #[inline(always)]
    fn set(&mut self, i: usize, j: usize, value: R) {
        self.matrix[(self.row + i) * self.size + self.column + j] = value;
    }
}
