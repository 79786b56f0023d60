//! One element at one iterate: what residual and tangent share, and the residual.

use partita_numerics::small::{dot, inverse, trace};

use super::terms::{Term, Terms};
use crate::settings::Tangent;
use crate::stabilization::{Stabilization, metric};

/// What all elements of a step share.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Flow {
    /// rho `[kg/m^3]`.
    pub density: f64,
    /// mu `[Pa s]`.
    pub viscosity: f64,
    /// `C_I` of `tau_M`.
    pub inverse_constant: f64,
    /// Factor of `tau_C`.
    pub grad_div: f64,
    /// `c_0` of the time derivative `D_t u = c_0 u + history` `[1/s]`; zero for a steady flow.
    pub rate: f64,
    /// `4/dt^2` of `tau_M` `[1/s^2]`; zero for a steady flow.
    pub four_over_dt_squared: f64,
    /// Which derivative the tangent is.
    pub tangent: Tangent,
}

/// Nodal values of one element.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Fields<const D: usize, const N: usize> {
    /// Where the nodes are now `[m]`.
    pub points: [[f64; D]; N],
    /// u `[m/s]`.
    pub velocity: [[f64; D]; N],
    /// p `[Pa]`.
    pub pressure: [f64; N],
    /// c = u - w `[m/s]`.
    pub convective: [[f64; D]; N],
    /// `c_1 u^n + c_2 u^{n-1}` `[m/s^2]`.
    pub history: [[f64; D]; N],
    /// b `[m/s^2]`.
    pub body_force: [[f64; D]; N],
}

/// Shape-function gradients `[1/m]` and measure `[m^D]` of a simplex.
///
/// With the edges `x_a - x_0` as rows of A, `grad N_a` is column `a - 1` of `A^-1`, and `V = det A / D!`.
///
/// # Panics
///
/// If the simplex is flat; a solver looks at the measures when it moves the mesh.
#[inline]
#[must_use]
pub fn shape<const D: usize, const N: usize>(points: &[[f64; D]; N]) -> ([[f64; D]; N], f64) {
    let edges = std::array::from_fn(|a| std::array::from_fn(|i| points[a + 1][i] - points[0][i]));
    let (inverse, determinant) = inverse::<D>(&edges).expect("an element that is not flat");
    let mut gradients = [[0.0; D]; N];
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
pub struct Element<const D: usize, const N: usize> {
    pub(super) flow: Flow,
    pub(super) fields: Fields<D, N>,
    /// `grad N_a`.
    pub(super) gradients: [[f64; D]; N],
    /// V.
    pub(super) measure: f64,
    /// V / (N (N + 1)): the factor of the integral of a product.
    pub(super) product: f64,
    /// `L_ij = du_i/dx_j`.
    pub(super) velocity_gradient: [[f64; D]; D],
    /// div u.
    pub(super) divergence: f64,
    /// grad p.
    pub(super) pressure_gradient: [f64; D],
    /// `D_t u` at the nodes.
    pub(super) acceleration: [[f64; D]; N],
    /// L c at the nodes.
    pub(super) convection: [[f64; D]; N],
    /// `r_M` at the nodes.
    pub(super) strong_residual: [[f64; D]; N],
    /// Sums over the nodes of c and of `r_M`.
    pub(super) convective_sum: [f64; D],
    pub(super) strong_sum: [f64; D],
    /// tau.
    pub(super) tau: Stabilization<D>,
    /// sqrt(tr G / 2), about 1/h.
    steepness: f64,
}

impl<const D: usize, const N: usize> Element<D, N> {
    /// Geometry, gradients, strong residual and tau from nodal values.
    #[inline]
    #[must_use]
    pub fn new(fields: &Fields<D, N>, flow: &Flow) -> Self {
        let (gradients, measure) = shape(&fields.points);
        let g = metric(&gradients);
        let convective_sum = sum(&fields.convective);
        let mut velocity_gradient = [[0.0; D]; D];
        let mut pressure_gradient = [0.0; D];
        for a in 0..N {
            for j in 0..D {
                pressure_gradient[j] += fields.pressure[a] * gradients[a][j];
                for i in 0..D {
                    velocity_gradient[i][j] += fields.velocity[a][i] * gradients[a][j];
                }
            }
        }
        let mut acceleration = fields.history;
        let mut convection = [[0.0; D]; N];
        let mut strong_residual = [pressure_gradient; N];
        for a in 0..N {
            for i in 0..D {
                acceleration[a][i] += flow.rate * fields.velocity[a][i];
                convection[a][i] = dot(&velocity_gradient[i], &fields.convective[a]);
                strong_residual[a][i] +=
                    flow.density * (acceleration[a][i] + convection[a][i] - fields.body_force[a][i]);
            }
        }
        Self {
            flow: *flow,
            fields: *fields,
            tau: Stabilization::new(&convective_sum.map(|c| c / N as f64), &g, flow),
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
    pub fn with_stabilization(fields: &Fields<D, N>, flow: &Flow, tau: Stabilization<D>) -> Self {
        Self { tau, ..Self::new(fields, flow) }
    }

    /// V `[m^D]`.
    #[must_use]
    pub fn measure(&self) -> f64 {
        self.measure
    }

    /// `tau_M` and `tau_C`.
    #[must_use]
    pub fn stabilization(&self) -> &Stabilization<D> {
        &self.tau
    }

    /// The residual by terms, as in the equations of [`kernel`](crate::kernel).
    #[inline]
    #[must_use]
    pub fn residual(&self) -> Terms<D, N> {
        let mut terms = Terms::ZERO;
        self.momentum_rows(&mut terms);
        self.continuity_rows(&mut terms);
        self.measure_terms(&mut terms);
        terms
    }

    #[inline]
    fn momentum_rows(&self, terms: &mut Terms<D, N>) {
        let Self { flow, fields, tau, measure, .. } = self;
        let (accelerations, convections) = (sum(&self.acceleration), sum(&self.convection));
        let body_forces = sum(&fields.body_force);
        let mass = flow.density * self.product;
        let viscous = flow.viscosity * measure;
        let pressure = measure * fields.pressure.iter().sum::<f64>() / N as f64;
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

    #[inline]
    fn continuity_rows(&self, terms: &mut Terms<D, N>) {
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
    #[inline]
    pub(super) fn streamline_stress(&self) -> [[f64; D]; D] {
        let mut stress = [[0.0; D]; D];
        for i in 0..D {
            for j in 0..D {
                let pointwise: f64 =
                    (0..N).map(|a| self.strong_residual[a][i] * self.fields.convective[a][j]).sum();
                stress[i][j] = self.product * (pointwise + self.strong_sum[i] * self.convective_sum[j]);
            }
        }
        stress
    }

    /// Sizes of the terms with every factor at its largest absolute value: no cancellation.
    #[inline]
    fn measure_terms(&self, terms: &mut Terms<D, N>) {
        let Self { flow, fields, steepness, .. } = self;
        let velocity = largest(&fields.velocity);
        let acceleration = flow.rate * velocity + largest(&fields.history);
        let forces = flow.density
            * (acceleration
                + largest(&fields.convective) * steepness * velocity
                + largest(&fields.body_force))
            + steepness * fields.pressure.iter().fold(0.0, |size: f64, p| size.max(p.abs()));
        let stresses = (flow.viscosity + self.tau.continuity) * velocity * steepness * steepness;
        terms.momentum_size = self.measure * (forces + stresses);
        terms.continuity_size =
            self.measure * steepness * (velocity + self.tau.momentum / flow.density * forces);
    }
}

/// L + L^T.
#[inline]
fn symmetric<const D: usize>(l: &[[f64; D]; D]) -> [[f64; D]; D] {
    std::array::from_fn(|i| std::array::from_fn(|j| l[i][j] + l[j][i]))
}

#[inline]
pub(super) fn sum<const D: usize, const N: usize>(nodal: &[[f64; D]; N]) -> [f64; D] {
    let mut sum = [0.0; D];
    for value in nodal {
        for i in 0..D {
            sum[i] += value[i];
        }
    }
    sum
}

#[inline]
fn largest<const D: usize, const N: usize>(nodal: &[[f64; D]; N]) -> f64 {
    nodal.as_flattened().iter().fold(0.0, |largest, x| largest.max(x.abs()))
}
