//! The derivative of the element residual.

use partita_numerics::small::dot;

use super::element::Element;
use crate::settings::Tangent;

impl<const D: usize, const N: usize> Element<D, N> {
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
    #[inline]
    pub fn tangent(&self, matrix: &mut [f64]) {
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
    #[inline]
    fn block(&self, a: usize, b: usize, shared: &Shared<D, N>, mut block: Block) {
        let Self { flow, tau, measure, .. } = self;
        let (rho, mu) = (flow.density, flow.viscosity);
        let (from, by) = (&self.gradients[a], &self.gradients[b]);
        let mean = measure / N as f64;
        let mass = self.product * if a == b { 2.0 } else { 1.0 };
        let diffusion = measure * dot(from, by);
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
                let transposed = mu * measure * from[j] * by[i];
                let divergence = tau.continuity * measure * from[i] * by[j];
                // tau_M (du.grad N_a, r_M)
                let test = shared.newton * tau.momentum * shared.weighted_residual[b][i] * from[j];
                let tau_change = shared.slope[j] * shared.streamline_force[a][i]
                    + shared.continuity_slope[j] * shared.divergence * from[i];
                let direct = if i == j { diagonal } else { 0.0 };
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
struct Shared<const D: usize, const N: usize> {
    /// 1 where the convective velocity follows u, 0 where it is held.
    newton: f64,
    /// Derivatives of `tau_M` and `tau_C` by one node's velocity; zero where tau is held.
    slope: [f64; D],
    continuity_slope: [f64; D],
    /// `(N_a, c.grad N_b)`.
    advection: [[f64; N]; N],
    /// `(c.grad N_a, c.grad N_b)`.
    streamline: [[f64; N]; N],
    /// `grad N_a . sum_b c_b`.
    along: [f64; N],
    /// `(N_a, r_M)`.
    weighted_residual: [[f64; D]; N],
    /// `(c.grad N_a, r_M)` and `(grad N_a, r_M) / rho`: what `tau_M` multiplies.
    streamline_force: [[f64; D]; N],
    smoothing_force: [f64; N],
    /// `grad N_a L`.
    convected_test: [[f64; D]; N],
    /// Integral of div u.
    divergence: f64,
}

impl<const D: usize, const N: usize> Shared<D, N> {
    #[inline]
    fn new(element: &Element<D, N>) -> Self {
        let Element { gradients, fields, convective_sum, strong_sum, product, measure, .. } = element;
        let along: [f64; N] = std::array::from_fn(|a| dot(&gradients[a], convective_sum));
        // c.grad N_b at node a
        let pointwise: [[f64; N]; N] =
            std::array::from_fn(|a| std::array::from_fn(|b| dot(&fields.convective[a], &gradients[b])));
        let mut shared = Self {
            newton: f64::from(u8::from(element.flow.tangent != Tangent::Picard)),
            slope: [0.0; D],
            continuity_slope: [0.0; D],
            advection: [[0.0; N]; N],
            streamline: [[0.0; N]; N],
            along,
            weighted_residual: [[0.0; D]; N],
            streamline_force: [[0.0; D]; N],
            smoothing_force: [0.0; N],
            convected_test: [[0.0; D]; N],
            divergence: measure * element.divergence,
        };
        if element.flow.tangent == Tangent::Full {
            shared.slope = element.tau.momentum_slope.map(|x| x / N as f64);
            shared.continuity_slope = element.tau.continuity_slope.map(|x| x / N as f64);
        }
        let stress = element.streamline_stress();
        for a in 0..N {
            for b in 0..N {
                let products: f64 = (0..N).map(|d| pointwise[d][a] * pointwise[d][b]).sum();
                shared.advection[a][b] = product * (along[b] + pointwise[a][b]);
                shared.streamline[a][b] = product * (products + along[a] * along[b]);
            }
            for i in 0..D {
                shared.weighted_residual[a][i] = product * (strong_sum[i] + element.strong_residual[a][i]);
                shared.streamline_force[a][i] = dot(&stress[i], &gradients[a]);
                shared.convected_test[a][i] =
                    (0..D).map(|k| gradients[a][k] * element.velocity_gradient[k][i]).sum();
            }
            shared.smoothing_force[a] =
                measure / (N as f64 * element.flow.density) * dot(&gradients[a], strong_sum);
        }
        shared
    }
}

/// The (D + 1) x (D + 1) part of the element matrix that couples two nodes.
struct Block<'a> {
    matrix: &'a mut [f64],
    size: usize,
    row: usize,
    column: usize,
}

impl Block<'_> {
    #[inline]
    fn set(&mut self, i: usize, j: usize, value: f64) {
        self.matrix[(self.row + i) * self.size + self.column + j] = value;
    }
}
