//! One element at one iterate: what residual and tangent share, and the residual.
//!
//! All is written for any [`Real`]: one element, or one a lane.
#![allow(
    clippy::inline_always,
    reason = "vector code has to be part of the entry point of its instruction set"
)]

use partita_numerics::lanes::{self, Real};
use partita_numerics::small::{dot, inverse, trace};

use super::terms::{TERMS, Term, Terms};
use crate::flow::Flow;
use crate::stabilization::{Stabilization, metric};

/// Nodal values of one element.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Fields<const D: usize, const N: usize, R = f64> {
    /// Where the nodes are now `[m]`.
    pub points: [[R; D]; N],
    /// u `[m/s]`.
    pub velocity: [[R; D]; N],
    /// p `[Pa]`.
    pub pressure: [R; N],
    /// c = u - w `[m/s]`.
    pub convective: [[R; D]; N],
    /// `c_1 u^n + c_2 u^{n-1}` `[m/s^2]`.
    pub history: [[R; D]; N],
    /// b `[m/s^2]`.
    pub body_force: [[R; D]; N],
}

/// Shape-function gradients `[1/m]` and measure `[m^D]` of a simplex.
///
/// With the edges `x_a - x_0` as rows of A, `grad N_a` is column `a - 1` of `A^-1`, and `V = det A / D!`.
///
/// # Panics
///
/// If the simplex is flat; a solver looks at the measures when it moves the mesh.
#[inline(always)]
#[must_use]
pub fn shape<const D: usize, const N: usize, R: Real>(points: &[[R; D]; N]) -> ([[R; D]; N], R) {
    let zero = points[0][0].like(0.0);
    let mut edges = [[zero; D]; D];
    for a in 0..D {
        for i in 0..D {
            edges[a][i] = points[a + 1][i] - points[0][i];
        }
    }
    let (inverse, determinant) = inverse(&edges).expect("an element that is not flat");
    let mut gradients = [[zero; D]; N];
    for a in 0..D {
        for i in 0..D {
            gradients[a + 1][i] = inverse[i][a];
            gradients[0][i] -= inverse[i][a];
        }
    }
    (gradients, determinant / (2..=D).product::<usize>() as f64)
}

/// One element at one iterate.
#[derive(Debug, Clone, Copy)]
pub struct Element<const D: usize, const N: usize, R = f64> {
    pub(super) flow: Flow<R>,
    pub(super) fields: Fields<D, N, R>,
    /// `grad N_a`.
    pub(super) gradients: [[R; D]; N],
    /// V.
    pub(super) measure: R,
    /// V / (N (N + 1)): the factor of the integral of a product.
    pub(super) product: R,
    /// `L_ij = du_i/dx_j`.
    pub(super) velocity_gradient: [[R; D]; D],
    /// div u.
    pub(super) divergence: R,
    /// grad p.
    pub(super) pressure_gradient: [R; D],
    /// `D_t u` at the nodes.
    pub(super) acceleration: [[R; D]; N],
    /// L c at the nodes.
    pub(super) convection: [[R; D]; N],
    /// `r_M` at the nodes.
    pub(super) strong_residual: [[R; D]; N],
    /// Sums over the nodes of c and of `r_M`.
    pub(super) convective_sum: [R; D],
    pub(super) strong_sum: [R; D],
    /// tau.
    pub(super) tau: Stabilization<D, R>,
    /// sqrt(tr G / 2), about 1/h.
    steepness: R,
}

impl<const D: usize, const N: usize, R: Real> Element<D, N, R> {
    /// Geometry, gradients, strong residual and tau from nodal values.
    #[inline(always)]
    #[must_use]
    pub fn new(fields: &Fields<D, N, R>, flow: &Flow<R>) -> Self {
        let zero = flow.zero();
        let (gradients, measure) = shape(&fields.points);
        let g = metric(&gradients);
        let convective_sum = sum(&fields.convective);
        let mut velocity_gradient = [[zero; D]; D];
        let mut pressure_gradient = [zero; D];
        for a in 0..N {
            for j in 0..D {
                pressure_gradient[j] += fields.pressure[a] * gradients[a][j];
                for i in 0..D {
                    velocity_gradient[i][j] += fields.velocity[a][i] * gradients[a][j];
                }
            }
        }
        let mut acceleration = fields.history;
        let mut convection = [[zero; D]; N];
        let mut strong_residual = [pressure_gradient; N];
        for a in 0..N {
            for i in 0..D {
                acceleration[a][i] += flow.rate * fields.velocity[a][i];
                convection[a][i] = dot(&velocity_gradient[i], &fields.convective[a]);
                strong_residual[a][i] +=
                    flow.density * (acceleration[a][i] + convection[a][i] - fields.body_force[a][i]);
            }
        }
        let centroid = lanes::array(
            #[inline(always)]
            |i| convective_sum[i] / N as f64,
        );
        Self {
            flow: *flow,
            fields: *fields,
            tau: Stabilization::new(&centroid, &g, flow),
            steepness: (trace(&g) / 2.0).sqrt(),
            gradients,
            measure,
            product: measure / (N * (N + 1)) as f64,
            velocity_gradient,
            divergence: trace(&velocity_gradient),
            pressure_gradient,
            acceleration,
            convection,
            strong_sum: sum(&strong_residual),
            strong_residual,
            convective_sum,
        }
    }

    /// The same with tau held at other values than those of `fields`.
    #[must_use]
    pub fn with_stabilization(fields: &Fields<D, N, R>, flow: &Flow<R>, tau: Stabilization<D, R>) -> Self {
        Self { tau, ..Self::new(fields, flow) }
    }

    /// V `[m^D]`.
    #[must_use]
    pub fn measure(&self) -> R {
        self.measure
    }

    /// `tau_M` and `tau_C`.
    #[must_use]
    pub fn stabilization(&self) -> &Stabilization<D, R> {
        &self.tau
    }

    /// The residual by terms, as in the equations of [`kernel`](crate::kernel).
    #[inline(always)]
    #[must_use]
    pub fn residual(&self) -> Terms<D, N, R> {
        let zero = self.flow.zero();
        let mut terms = Terms {
            momentum: [[[zero; TERMS]; D]; N],
            continuity: [[zero; TERMS]; N],
            momentum_size: zero,
            continuity_size: zero,
        };
        self.momentum_rows(&mut terms);
        self.continuity_rows(&mut terms);
        self.measure_terms(&mut terms);
        terms
    }

    #[inline(always)]
    fn momentum_rows(&self, terms: &mut Terms<D, N, R>) {
        let Self { flow, fields, tau, measure, product, .. } = *self;
        let (accelerations, convections) = (sum(&self.acceleration), sum(&self.convection));
        let body_forces = sum(&fields.body_force);
        let mass = flow.density * product;
        let viscous = flow.viscosity * measure;
        let pressure = measure
            * lanes::sum::<N, R>(
                #[inline(always)]
                |a| fields.pressure[a],
            )
            / N as f64;
        let incompressible = tau.continuity * measure * self.divergence;
        let strain = symmetric(&self.velocity_gradient);
        let streamline = self.streamline_stress();
        for (a, gradient) in self.gradients.iter().enumerate() {
            for i in 0..D {
                let row = &mut terms.momentum[a][i];
                row[Term::Rate as usize] = mass * (self.acceleration[a][i] + accelerations[i]);
                row[Term::Convection as usize] = mass * (self.convection[a][i] + convections[i]);
                row[Term::BodyForce as usize] = -mass * (fields.body_force[a][i] + body_forces[i]);
                row[Term::Pressure as usize] = -pressure * gradient[i];
                row[Term::Viscosity as usize] = viscous * dot(&strain[i], gradient);
                row[Term::Streamline as usize] = tau.momentum * dot(&streamline[i], gradient);
                row[Term::Divergence as usize] = incompressible * gradient[i];
            }
        }
    }

    #[inline(always)]
    fn continuity_rows(&self, terms: &mut Terms<D, N, R>) {
        let mean = self.measure / N as f64;
        let smoothing = self.tau.momentum * mean;
        let pressure = smoothing * N as f64 / self.flow.density;
        let (accelerations, convections) = (sum(&self.acceleration), sum(&self.convection));
        let body_forces = sum(&self.fields.body_force);
        for (row, gradient) in terms.continuity.iter_mut().zip(&self.gradients) {
            row[Term::Rate as usize] = smoothing * dot(gradient, &accelerations);
            row[Term::Convection as usize] = smoothing * dot(gradient, &convections);
            row[Term::BodyForce as usize] = -smoothing * dot(gradient, &body_forces);
            row[Term::Pressure as usize] = pressure * dot(gradient, &self.pressure_gradient);
            row[Term::Divergence as usize] = mean * self.divergence;
        }
    }

    /// `(r_M, c)` as a tensor: the integral of `r_i c_j`.
    #[inline(always)]
    pub(super) fn streamline_stress(&self) -> [[R; D]; D] {
        let mut stress = [[self.flow.zero(); D]; D];
        for i in 0..D {
            for j in 0..D {
                let pointwise = lanes::sum::<N, R>(
                    #[inline(always)]
                    |a| self.strong_residual[a][i] * self.fields.convective[a][j],
                );
                stress[i][j] = self.product * (pointwise + self.strong_sum[i] * self.convective_sum[j]);
            }
        }
        stress
    }

    /// Sizes of the terms with every factor at its largest absolute value: no cancellation.
    #[inline(always)]
    fn measure_terms(&self, terms: &mut Terms<D, N, R>) {
        let Self { flow, fields, steepness, .. } = *self;
        let velocity = largest(&fields.velocity);
        let acceleration = flow.rate * velocity + largest(&fields.history);
        let forces = flow.density
            * (acceleration
                + largest(&fields.convective) * steepness * velocity
                + largest(&fields.body_force))
            + steepness * largest(&[fields.pressure]);
        let stresses = (flow.viscosity + self.tau.continuity) * velocity * steepness * steepness;
        terms.momentum_size = self.measure * (forces + stresses);
        terms.continuity_size =
            self.measure * steepness * (velocity + self.tau.momentum / flow.density * forces);
    }
}

/// L + L^T.
#[inline(always)]
fn symmetric<const D: usize, R: Real>(l: &[[R; D]; D]) -> [[R; D]; D] {
    let mut sum = *l;
    for i in 0..D {
        for j in 0..D {
            sum[i][j] = l[i][j] + l[j][i];
        }
    }
    sum
}

#[inline(always)]
pub(super) fn sum<const D: usize, const N: usize, R: Real>(nodal: &[[R; D]; N]) -> [R; D] {
    let mut sum = [nodal[0][0].like(0.0); D];
    for a in 0..N {
        for i in 0..D {
            sum[i] += nodal[a][i];
        }
    }
    sum
}

#[inline(always)]
fn largest<const D: usize, const N: usize, R: Real>(nodal: &[[R; D]; N]) -> R {
    let mut largest = nodal[0][0].like(0.0);
    for value in nodal.as_flattened() {
        largest = largest.max(value.abs());
    }
    largest
}
