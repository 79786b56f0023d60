//! The element: sums over quadrature points of the reference configuration, in the words of the weak form
//!
//! ```text
//! (q, rho a) + (grad q, P(grad d)) = (q, b)        for every test function q
//! ```
//!
//! with the first Piola-Kirchhoff stress P = F S (Total Lagrangian). The functions know neither the mesh nor the
//! time integration; nodal fields are slices with one `[f64; D]` a node, results are *added* to the slices given. A
//! field of another length is a panic; a deformation that the material has no stress for is a [`PointError`].

mod round_off;

use partita_numerics::small;

pub use round_off::add_rounding;

use crate::material::{Constitutive, ResponseError};
use crate::tensor::{self, Tensor};

/// One element as quadrature sees it; it lives in the reference configuration and never changes.
#[derive(Debug, Clone, Copy)]
pub struct Element<'a, const D: usize> {
    /// Quadrature weight times volume of each point `[m^D]`.
    pub weights: &'a [f64],
    /// `N_a` at each point; nodes run fastest.
    pub values: &'a [f64],
    /// `grad N_a` at each point `[1/m]`; nodes run fastest.
    pub gradients: &'a [[f64; D]],
}

/// One quadrature point.
#[derive(Debug, Clone, Copy)]
struct Point<'a, const D: usize> {
    weight: f64,
    values: &'a [f64],
    gradients: &'a [[f64; D]],
}

/// A quadrature point at which the material has no stress.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[error("quadrature point {point}: {source}")]
pub struct PointError {
    /// Its number within the element.
    pub point: usize,
    /// Why.
    pub source: ResponseError,
}

/// Room for the blocks of one tangent; belongs to the caller, so that the kernel allocates nothing.
///
/// The block of nodes (a, b), a <= b, has the index b (b + 1)/2 + a: the upper triangle, column by column.
#[derive(Debug, Clone, Default)]
pub struct Blocks<const D: usize> {
    blocks: Vec<[[f64; D]; D]>,
}

impl<const D: usize> Blocks<D> {
    /// Room for elements of `nodes` nodes.
    #[must_use]
    pub fn new(nodes: usize) -> Self {
        Self { blocks: vec![[[0.0; D]; D]; nodes * (nodes + 1) / 2] }
    }

    /// Writes the whole tangent, row-major over the dofs `a * D + i`; exactly symmetric, for each pair of entries comes
    /// from one number.
    fn expand(&self, nodes: usize, tangent: &mut [f64]) {
        let row = nodes * D;
        let mut blocks = self.blocks.iter();
        for b in 0..nodes {
            for (a, block) in (0..=b).zip(&mut blocks) {
                for i in 0..D {
                    for k in if a == b { i..D } else { 0..D } {
                        tangent[(a * D + i) * row + b * D + k] = block[i][k];
                        tangent[(b * D + k) * row + a * D + i] = block[i][k];
                    }
                }
            }
        }
    }
}

impl<'a, const D: usize> Element<'a, D> {
    /// Number of nodes.
    #[must_use]
    pub fn nodes(&self) -> usize {
        self.values.len() / self.weights.len()
    }

    /// Refuses a nodal field that does not belong to the element.
    fn assert_fits<T>(&self, field: &[T]) {
        assert_eq!(field.len(), self.nodes(), "a nodal field has one entry a node");
    }

    fn points(self) -> impl Iterator<Item = Point<'a, D>> {
        let nodes = self.nodes();
        let shapes = self.values.chunks_exact(nodes).zip(self.gradients.chunks_exact(nodes));
        self.weights.iter().zip(shapes).map(|(&weight, (values, gradients))| Point {
            weight,
            values,
            gradients,
        })
    }
}

impl<const D: usize> Point<'_, D> {
    /// `sum_a N_a q_a`
    #[inline]
    fn value(&self, field: &[[f64; D]]) -> [f64; D] {
        let mut value = [0.0; D];
        for (q, n) in field.iter().zip(self.values) {
            for i in 0..D {
                value[i] += n * q[i];
            }
        }
        value
    }

    /// `sum_a q_a (x) grad N_a`
    #[inline]
    fn gradient(&self, field: &[[f64; D]]) -> Tensor<D> {
        let mut gradient = [[0.0; D]; D];
        for (q, g) in field.iter().zip(self.gradients) {
            for i in 0..D {
                for j in 0..D {
                    gradient[i][j] += q[i] * g[j];
                }
            }
        }
        gradient
    }

    /// `force_a += N_a q`
    #[inline]
    fn add_value(&self, q: [f64; D], force: &mut [[f64; D]]) {
        for (f, n) in force.iter_mut().zip(self.values) {
            for i in 0..D {
                f[i] += n * q[i];
            }
        }
    }

    /// `force_a += w P grad N_a`
    #[inline]
    fn add_stress(&self, stress: &Tensor<D>, force: &mut [[f64; D]]) {
        let weighted = tensor::build(|i, j| self.weight * stress[i][j]);
        for (f, g) in force.iter_mut().zip(self.gradients) {
            let pull = tensor::apply(&weighted, g);
            for i in 0..D {
                f[i] += pull[i];
            }
        }
    }
}

/// Internal forces: `force_a += (grad N_a, P(grad d))`.
///
/// `displacement` `[m]` and `force` `[N, in 2D N/m]` hold one entry a node.
///
/// # Errors
/// When the material has no stress at a quadrature point; `force` is then incomplete.
pub fn add_internal_force<const D: usize>(
    element: Element<D>,
    material: &(impl Constitutive<D> + ?Sized),
    displacement: &[[f64; D]],
    force: &mut [[f64; D]],
) -> Result<(), PointError> {
    element.assert_fits(displacement);
    element.assert_fits(force);
    for (number, point) in element.points().enumerate() {
        let stress = material.stress(&point.gradient(displacement)).map_err(at(number))?;
        point.add_stress(&stress, force);
    }
    Ok(())
}

fn at(point: usize) -> impl Fn(ResponseError) -> PointError {
    move |source| PointError { point, source }
}

/// Internal forces, and their derivative by the displacement: with A = dP/d(grad d) of [`crate::Response`],
///
/// ```text
/// force_a      += (grad N_a, P)
/// tangent_ai,bk = scale (grad N_a, A_i.k. grad N_b)
/// ```
///
/// `tangent` is overwritten, row-major over the local dofs `a * D + i`, exactly symmetric; `scale` is the share of the
/// unknown in the displacement given (`1 - alpha_f` in generalized-alpha).
///
/// # Errors
/// When the material has no stress at a quadrature point; `force` and `tangent` are then incomplete.
pub fn add_internal_force_and_tangent<const D: usize>(
    element: Element<D>,
    material: &(impl Constitutive<D> + ?Sized),
    displacement: &[[f64; D]],
    scale: f64,
    force: &mut [[f64; D]],
    tangent: &mut [f64],
    blocks: &mut Blocks<D>,
) -> Result<(), PointError> {
    element.assert_fits(displacement);
    element.assert_fits(force);
    blocks.blocks.fill([[0.0; D]; D]);
    for (number, point) in element.points().enumerate() {
        let response = material.response(&point.gradient(displacement)).map_err(at(number))?;
        point.add_stress(&response.stress, force);

        let weight = scale * point.weight;
        let mut column = blocks.blocks.as_mut_slice();
        for (b, gradient_b) in point.gradients.iter().enumerate() {
            // stress_b[J][i][k]: change of w P_iJ when node b moves along k.
            let mut stress_b = [[[0.0; D]; D]; D];
            for j in 0..D {
                for l in 0..D {
                    tensor::add_scaled(weight * gradient_b[l], &response.tangent[j][l], &mut stress_b[j]);
                }
            }
            let (upper, rest) = column.split_at_mut(b + 1);
            for (block, gradient_a) in upper.iter_mut().zip(point.gradients) {
                for j in 0..D {
                    tensor::add_scaled(gradient_a[j], &stress_b[j], block);
                }
            }
            column = rest;
        }
    }
    blocks.expand(element.nodes(), tangent);
    Ok(())
}

/// Inertia: `force_a += (N_a, rho a)`.
pub fn add_inertia<const D: usize>(
    element: Element<D>,
    density: f64,
    acceleration: &[[f64; D]],
    force: &mut [[f64; D]],
) {
    element.assert_fits(acceleration);
    element.assert_fits(force);
    for point in element.points() {
        let a = point.value(acceleration);
        point.add_value(a.map(|a| point.weight * density * a), force);
    }
}

/// Consistent mass: `mass_ai,bk += (N_a, rho N_b) delta_ik`, row-major over the local dofs.
pub fn add_mass<const D: usize>(element: Element<D>, density: f64, mass: &mut [f64]) {
    let row = element.nodes() * D;
    for point in element.points() {
        for (a, n_a) in point.values.iter().enumerate() {
            for (b, n_b) in point.values.iter().enumerate() {
                let entry = point.weight * density * (n_a * n_b);
                for i in 0..D {
                    mass[(a * D + i) * row + b * D + i] += entry;
                }
            }
        }
    }
}

/// Body force: `force_a += (N_a, b)` with b `[N/m^3]` given at each quadrature point.
pub fn add_body_force<const D: usize>(
    element: Element<D>,
    body_force: impl Iterator<Item = [f64; D]>,
    force: &mut [[f64; D]],
) {
    element.assert_fits(force);
    for (point, b) in element.points().zip(body_force) {
        point.add_value(b.map(|b| point.weight * b), force);
    }
}

/// Share of each node in the volume: `volume_a += (N_a, 1)` `[m^D]`. A constant body force b loads node a with
/// b times its share.
pub fn add_volume<const D: usize>(element: Element<D>, volume: &mut [f64]) {
    element.assert_fits(volume);
    for point in element.points() {
        for (v, n) in volume.iter_mut().zip(point.values) {
            *v += point.weight * n;
        }
    }
}

/// The smallest det F = det(I + grad d) at the quadrature points, and the number of its point; one that is not a number
/// counts as the smallest.
#[must_use]
pub fn smallest_determinant<const D: usize>(element: Element<D>, displacement: &[[f64; D]]) -> (f64, usize) {
    element.assert_fits(displacement);
    let mut smallest = (f64::INFINITY, 0);
    for (index, point) in element.points().enumerate() {
        let gradient = point.gradient(displacement);
        let f: Tensor<D> = tensor::build(|i, j| gradient[i][j] + if i == j { 1.0 } else { 0.0 });
        let determinant = small::determinant(&f);
        if determinant.is_nan() {
            return (determinant, index);
        }
        if determinant < smallest.0 {
            smallest = (determinant, index);
        }
    }
    smallest
}

/// Strain energy (W(grad d), 1) `[J, in 2D J/m]`.
#[must_use]
pub fn strain_energy<const D: usize>(
    element: Element<D>,
    material: &dyn Constitutive<D>,
    displacement: &[[f64; D]],
) -> f64 {
    element.assert_fits(displacement);
    element.points().map(|point| point.weight * material.energy(&point.gradient(displacement))).sum()
}

/// Kinetic energy (rho v, v)/2 `[J, in 2D J/m]`.
#[must_use]
pub fn kinetic_energy<const D: usize>(element: Element<D>, density: f64, velocity: &[[f64; D]]) -> f64 {
    element.assert_fits(velocity);
    element
        .points()
        .map(|point| {
            let v = point.value(velocity);
            0.5 * density * point.weight * tensor::dot(&v, &v)
        })
        .sum()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::material::{Law, Material, Plane};
    use approx::assert_relative_eq;

    /// A triangle of three nodes, (0,0), (2,0), (0,1), integrated by its three edge midpoints.
    struct Triangle {
        weights: [f64; 3],
        values: [f64; 9],
        gradients: [[f64; 2]; 9],
    }

    impl Triangle {
        fn new() -> Self {
            let gradient = [[-0.5, -1.0], [0.5, 0.0], [0.0, 1.0]];
            Self {
                weights: [1.0 / 3.0; 3],
                values: [0.5, 0.5, 0.0, 0.0, 0.5, 0.5, 0.5, 0.0, 0.5],
                gradients: std::array::from_fn(|entry| gradient[entry % 3]),
            }
        }

        fn element(&self) -> Element<'_, 2> {
            Element { weights: &self.weights, values: &self.values, gradients: &self.gradients }
        }
    }

    const NODES: [[f64; 2]; 3] = [[0.0, 0.0], [2.0, 0.0], [0.0, 1.0]];

    fn soft() -> Material {
        Material::new(Law::StVenantKirchhoff, 3.0, 0.2, Plane::Strain).unwrap()
    }

    #[test]
    fn tangent_is_derivative_of_internal_force() {
        let triangle = Triangle::new();
        let d = [[0.1, -0.2], [0.3, 0.4], [-0.25, 0.15]];
        let (mut force, mut tangent) = ([[0.0; 2]; 3], [0.0; 36]);
        let mut blocks = Blocks::new(3);
        add_internal_force_and_tangent(
            triangle.element(),
            &soft(),
            &d,
            0.5,
            &mut force,
            &mut tangent,
            &mut blocks,
        )
        .unwrap();
        for column in 0..6 {
            let force_at = |step: f64| {
                let (mut moved, mut force) = (d, [[0.0; 2]; 3]);
                moved[column / 2][column % 2] += step;
                add_internal_force(triangle.element(), &soft(), &moved, &mut force).unwrap();
                force
            };
            let (ahead, behind) = (force_at(1e-5), force_at(-1e-5));
            for row in 0..6 {
                let slope = (ahead[row / 2][row % 2] - behind[row / 2][row % 2]) / 2e-5;
                assert_relative_eq!(tangent[row * 6 + column], 0.5 * slope, epsilon = 1e-9);
                assert_eq!(tangent[row * 6 + column].to_bits(), tangent[column * 6 + row].to_bits());
            }
        }
    }

    #[test]
    fn both_paths_to_the_internal_force_agree_to_the_bit() {
        let triangle = Triangle::new();
        let d = [[0.1, -0.2], [0.3, 0.4], [-0.25, 0.15]];
        let (mut alone, mut together) = ([[0.0; 2]; 3], [[0.0; 2]; 3]);
        add_internal_force(triangle.element(), &soft(), &d, &mut alone).unwrap();
        let mut blocks = Blocks::new(3);
        add_internal_force_and_tangent(
            triangle.element(),
            &soft(),
            &d,
            1.0,
            &mut together,
            &mut [0.0; 36],
            &mut blocks,
        )
        .unwrap();
        assert_eq!(alone, together);
    }

    #[test]
    fn mass_matches_inertia_and_the_textbook_triangle() {
        let triangle = Triangle::new();
        let mut mass = [0.0; 36];
        add_mass(triangle.element(), 12.0, &mut mass);
        // rho area / 12 (1 + delta_ab)
        assert_relative_eq!(mass[0], 2.0, max_relative = 1e-14);
        assert_relative_eq!(mass[2], 1.0, max_relative = 1e-14);
        assert_eq!(mass[1].to_bits(), 0);
        let a = [[0.3, 0.7], [-1.1, 0.2], [0.5, -0.9]];
        let mut force = [[0.0; 2]; 3];
        add_inertia(triangle.element(), 12.0, &a, &mut force);
        for row in 0..6 {
            let product: f64 = (0..6).map(|column| mass[row * 6 + column] * a[column / 2][column % 2]).sum();
            assert_relative_eq!(force[row / 2][row % 2], product, epsilon = 1e-14);
        }
    }

    #[test]
    fn energies_of_uniform_motions_are_closed_forms() {
        let triangle = Triangle::new();
        let kinetic = kinetic_energy(triangle.element(), 12.0, &[[3.0, 4.0]; 3]);
        assert_relative_eq!(kinetic, 0.5 * 12.0 * 25.0, max_relative = 1e-14);
        let stretch = NODES.map(|[x, _]| [0.1 * x, 0.0]);
        let e: f64 = 0.5 * (1.1 * 1.1 - 1.0);
        let expected = (0.5 * soft().lambda() + soft().mu()) * e * e;
        assert_relative_eq!(
            strain_energy(triangle.element(), &soft(), &stretch),
            expected,
            max_relative = 1e-14
        );
    }

    #[test]
    fn volume_shares_sum_to_the_volume() {
        let mut volume = [0.0; 3];
        add_volume(Triangle::new().element(), &mut volume);
        for share in volume {
            assert_relative_eq!(share, 1.0 / 3.0, max_relative = 1e-14);
        }
    }
}
