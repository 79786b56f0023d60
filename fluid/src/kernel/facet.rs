//! What a boundary facet adds to the rows of the element behind it.
//!
//! A facet is named by the local node opposite to it. Its area vector S (outward normal times area) follows
//! from that node's shape function: `S = -D V grad N_opposite`.

use partita_numerics::small::dot;

use super::element::Element;
use super::terms::{Term, Terms};
use crate::flow::Tangent;

/// A facet of an element, its additions to the residual and, where wanted, to the tangent (row-major,
/// N (D + 1) square).
pub struct Facet<'a, const D: usize, const N: usize> {
    /// The element behind the facet.
    pub element: &'a Element<D, N>,
    /// Its local node that is not on the facet.
    pub opposite: usize,
    /// Where residual contributions go.
    pub terms: &'a mut Terms<D, N>,
    /// Where the derivatives go.
    pub tangent: Option<&'a mut [f64]>,
}

impl<const D: usize, const N: usize> Facet<'_, D, N> {
    /// `- <q_u, h>` for nodal values of the traction h `[Pa]`, interpolated linearly.
    pub fn traction(&mut self, traction: &[[f64; D]; D]) {
        let area = self.area_vector().iter().map(|s| s * s).sum::<f64>().sqrt();
        let product = area / (D * (D + 1)) as f64;
        let nodes = self.nodes();
        for i in 0..D {
            let sum: f64 = traction.iter().map(|h| h[i]).sum();
            for (a, h) in nodes.iter().zip(traction) {
                self.terms.momentum[*a][i][Term::Boundary as usize] -= product * (sum + h[i]);
            }
        }
    }

    /// `- <q_u, mu (grad u)^T n>`: with it the natural condition of the symmetric stress is
    /// -p n + mu (grad u) n = 0, which Poiseuille flow satisfies.
    ///
    /// Source: J. Heywood, R. Rannacher, S. Turek, *Artificial boundaries and flux and pressure conditions
    /// for the incompressible Navier-Stokes equations*, IJNMF 22 (1996).
    pub fn do_nothing(&mut self) {
        let share = self.element.flow.viscosity / D as f64;
        let area_vector = self.area_vector();
        let nodes = self.nodes();
        for i in 0..D {
            let transposed: f64 = (0..D).map(|j| self.element.velocity_gradient[j][i] * area_vector[j]).sum();
            for a in nodes {
                self.terms.momentum[a][i][Term::Boundary as usize] -= share * transposed;
                for b in 0..N {
                    for j in 0..D {
                        let change = self.element.gradients[b][i] * area_vector[j];
                        self.add_to_tangent((a, i), (b, j), -share * change);
                    }
                }
            }
        }
    }

    /// `- 1/2 rho <q_u, min(c.n, 0) u>`: takes out the energy that the convective form lets in where the
    /// flow returns through an outflow boundary, and nothing where it leaves.
    ///
    /// The derivative holds c where the tangent is Picard's. Points: the rule of D points on the facet, exact
    /// for degree 2.
    ///
    /// Source: M. Esmaily Moghadam et al., *A comparison of outlet boundary treatments for prevention of
    /// backflow divergence*, Comput. Mech. 48 (2011), with beta = 1/2.
    pub fn backflow(&mut self) {
        let half = 0.5 * self.element.flow.density / D as f64;
        let area_vector = self.area_vector();
        let nodes = self.nodes();
        let follows = self.element.flow.tangent != Tangent::Picard;
        for near in 0..D {
            let weights = quadrature_point::<D>(near);
            let at = |values: &[[f64; D]; N]| -> [f64; D] {
                std::array::from_fn(|i| (0..D).map(|k| weights[k] * values[nodes[k]][i]).sum())
            };
            let flux = dot(&at(&self.element.fields.convective), &area_vector);
            if flux >= 0.0 {
                continue;
            }
            let velocity = at(&self.element.fields.velocity);
            for (a, weight_a) in nodes.into_iter().zip(weights) {
                for i in 0..D {
                    self.terms.momentum[a][i][Term::Boundary as usize] -=
                        half * weight_a * flux * velocity[i];
                    for (b, weight_b) in nodes.into_iter().zip(weights) {
                        let factor = -half * weight_a * weight_b;
                        self.add_to_tangent((a, i), (b, i), factor * flux);
                        if follows {
                            for j in 0..D {
                                self.add_to_tangent((a, i), (b, j), factor * velocity[i] * area_vector[j]);
                            }
                        }
                    }
                }
            }
        }
    }

    /// Outward normal times area.
    fn area_vector(&self) -> [f64; D] {
        let element = self.element;
        element.gradients[self.opposite].map(|g| -(D as f64) * element.measure * g)
    }

    /// Local nodes on the facet, in ascending order.
    fn nodes(&self) -> [usize; D] {
        std::array::from_fn(|k| if k < self.opposite { k } else { k + 1 })
    }

    fn add_to_tangent(&mut self, (a, i): (usize, usize), (b, j): (usize, usize), value: f64) {
        if let Some(tangent) = &mut self.tangent {
            let (row, column) = (a * (D + 1) + i, b * (D + 1) + j);
            tangent[row * N * (D + 1) + column] += value;
        }
    }
}

/// Barycentric coordinates of the quadrature point of a facet's node `near`: D points of equal weight on a
/// simplex with D vertices, exact for degree 2.
fn quadrature_point<const D: usize>(near: usize) -> [f64; D] {
    let far = (1.0 - 1.0 / ((D + 1) as f64).sqrt()) / D as f64;
    let mut coordinates = [far; D];
    coordinates[near] = 1.0 - (D - 1) as f64 * far;
    coordinates
}
