//! Isotropic elastic laws: stress, tangent and stored energy from the displacement gradient.

mod constitutive;
mod neo_hookean;
mod plane;

use serde::{Deserialize, Serialize};

use crate::tensor::{self, Tensor};
pub use constitutive::{AnyMaterial, Constitutive};
use neo_hookean::NeoHookean;
pub use plane::{PlaneStrain, PlaneStress};

/// The relation between deformation and stress.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Law {
    /// Hooke's law on the small strain: sigma = lambda tr(eps) I + 2 mu eps, eps = sym(grad d).
    LinearElastic,
    /// Hooke's law on the Green-Lagrange strain: S = lambda tr(E) I + 2 mu E, E = (F^T F - I)/2.
    StVenantKirchhoff,
    /// The compressible neo-Hookean solid: S = mu (I - C^-1) + lambda ln J C^-1, C = F^T F, J = det F > 0
    /// (Bonet and Wood 2008, section 6.4.3). Unlike the other laws it resists being crushed: its energy grows without
    /// bound as J -> 0.
    NeoHookean,
}

/// What a plane model assumes about the direction it leaves out.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Plane {
    /// No strain out of the plane: a slice of a long body.
    #[default]
    Strain,
    /// No stress out of the plane: a thin sheet.
    Stress,
}

/// A parameter of a material that no solid can have.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error, miette::Diagnostic)]
pub enum MaterialError {
    /// Young's modulus is not a positive number.
    #[error("Young's modulus is {value} Pa")]
    #[diagnostic(help("it must be positive and finite"))]
    YoungModulus {
        /// The value given `[Pa]`.
        value: f64,
    },
    /// Poisson's ratio is outside the range in which the elastic energy is positive.
    #[error("Poisson's ratio is {value}")]
    #[diagnostic(help(
        "it must be above -1 and below 0.5; at 0.5 the solid is \
         incompressible, which this displacement formulation can only approach (0.499)"
    ))]
    PoissonRatio {
        /// The value given.
        value: f64,
    },
}

/// A deformation that a material has no stress for.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum ResponseError {
    /// A neo-Hookean solid is flattened or turned inside out.
    #[error("the volume ratio det F is {volume_ratio:.3e}, which is not positive")]
    Crushed {
        /// J = det F, NaN where the displacement is no number.
        volume_ratio: f64,
    },
    /// No stretch out of the plane makes the stress there vanish: possible for a negative Poisson's ratio.
    #[error("no thickness frees the sheet of stress out of its plane at the area ratio {area_ratio:.3e}")]
    NoPlaneStress {
        /// det F in the plane.
        area_ratio: f64,
    },
    /// A law from outside this crate has no stress.
    #[error("{what}")]
    Undefined {
        /// What about the deformation is beyond it.
        what: &'static str,
    },
}

/// An isotropic elastic material.
///
/// Plane stress replaces lambda by 2 lambda mu/(lambda + 2 mu) in the two laws that are linear between a strain and its
/// stress, so that `S_33 = 0` is solved for `E_33` once and for all. The neo-Hookean law solves it at each point.
///
/// ```
/// use partita_structure::{Law, Material, Plane};
/// let steel = Material::new(Law::StVenantKirchhoff, 210e9, 0.3, Plane::Strain)?;
/// assert!((steel.mu() - 210e9 / 2.6).abs() < 1.0);
/// assert!(Material::new(Law::StVenantKirchhoff, 210e9, 0.5, Plane::Strain).is_err());
/// # Ok::<(), partita_structure::MaterialError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Material {
    law: Law,
    plane: Plane,
    young_modulus: f64,
    poisson_ratio: f64,
    lambda: f64,
    /// lambda of the solid, whatever the plane.
    solid_lambda: f64,
    mu: f64,
}

/// What a material answers to a displacement gradient.
#[derive(Debug, Clone, Copy)]
pub struct Response<const D: usize> {
    /// First Piola-Kirchhoff stress P `[Pa]`.
    pub stress: [[f64; D]; D],
    /// Its derivative `A_iJkL = dP_iJ / d(grad d)_kL` `[Pa]`, symmetric as `A_iJkL = A_kLiJ`, stored as
    /// `tangent[J][L][i][k]`: a block of components for each pair of reference directions, as the kernel contracts it.
    pub tangent: [[[[f64; D]; D]; D]; D],
}

impl Material {
    /// A material from Young's modulus `[Pa]` and Poisson's ratio; `plane` has no effect in three dimensions.
    ///
    /// # Errors
    /// A modulus that is not positive, or a ratio outside (-1, 0.5).
    pub fn new(
        law: Law,
        young_modulus: f64,
        poisson_ratio: f64,
        plane: Plane,
    ) -> Result<Self, MaterialError> {
        if !(young_modulus > 0.0 && young_modulus.is_finite()) {
            return Err(MaterialError::YoungModulus { value: young_modulus });
        }
        if !(poisson_ratio > -1.0 && poisson_ratio < 0.5) {
            return Err(MaterialError::PoissonRatio { value: poisson_ratio });
        }
        let (e, nu) = (young_modulus, poisson_ratio);
        let mu = e / (2.0 * (1.0 + nu));
        let solid_lambda = e * nu / ((1.0 + nu) * (1.0 - 2.0 * nu));
        let lambda = match plane {
            Plane::Strain => solid_lambda,
            Plane::Stress => e * nu / (1.0 - nu * nu),
        };
        Ok(Self { law, plane, young_modulus, poisson_ratio, lambda, solid_lambda, mu })
    }

    /// The relation between deformation and stress.
    #[must_use]
    pub fn law(&self) -> Law {
        self.law
    }

    /// The assumption about the direction that a plane model leaves out.
    #[must_use]
    pub fn plane(&self) -> Plane {
        self.plane
    }

    /// Young's modulus `[Pa]`.
    #[must_use]
    pub fn young_modulus(&self) -> f64 {
        self.young_modulus
    }

    /// Poisson's ratio.
    #[must_use]
    pub fn poisson_ratio(&self) -> f64 {
        self.poisson_ratio
    }

    /// First Lamé constant `[Pa]`; in plane stress the reduced one, which holds for small strains.
    #[must_use]
    pub fn lambda(&self) -> f64 {
        self.lambda
    }

    /// Shear modulus `[Pa]`.
    #[must_use]
    pub fn mu(&self) -> f64 {
        self.mu
    }

    /// lambda + 2 mu `[Pa]`: the stiffest answer to a small strain.
    #[must_use]
    pub fn wave_modulus(&self) -> f64 {
        self.lambda + 2.0 * self.mu
    }

    /// Whether stress is linear in the displacement.
    #[must_use]
    pub fn is_linear(&self) -> bool {
        self.law == Law::LinearElastic
    }

    /// The same constants under Hooke's law on the small strain: the tangent of every law in the reference
    /// configuration, used for stiffness-proportional damping.
    #[must_use]
    pub fn linearized(&self) -> Self {
        Self { law: Law::LinearElastic, ..*self }
    }

    /// Stress and tangent at the displacement gradient `gradient[i][J] = d d_i / d X_J`.
    ///
    /// ```text
    /// linear elastic         P = sigma   A_iJkL = lambda delta_iJ delta_kL + mu (delta_iL delta_kJ + delta_ik delta_JL)
    /// St. Venant-Kirchhoff   P = F S     A_iJkL = delta_ik S_JL + lambda F_iJ F_kL + mu (F_iL F_kJ + (F F^T)_ik delta_JL)
    /// neo-Hookean            P = F S     A_iJkL = mu delta_ik delta_JL + (mu - lambda ln J) F^-1_Jk F^-1_Li
    ///                                             + lambda F^-1_Ji F^-1_Lk
    /// ```
    ///
    /// # Errors
    /// When the law is neo-Hookean and J is not positive, or a sheet cannot free itself of stress out of its plane.
    #[inline]
    pub fn response<const D: usize>(&self, gradient: &Tensor<D>) -> Result<Response<D>, ResponseError> {
        Ok(match self.law {
            Law::LinearElastic => {
                let (one, zero) = (tensor::identity(), [[0.0; D]; D]);
                let stress = self.hooke(&small_strain(gradient));
                Response { stress, tangent: self.tangent(&one, &one, &zero) }
            }
            Law::StVenantKirchhoff => {
                let f = deformation_gradient(gradient);
                let s = self.hooke(&green_lagrange(gradient));
                let left_cauchy_green = tensor::multiply_transposed(&f, &f);
                Response {
                    stress: tensor::multiply(&f, &s),
                    tangent: self.tangent(&f, &left_cauchy_green, &s),
                }
            }
            Law::NeoHookean => self.neo_hookean().response(gradient)?,
        })
    }

    /// First Piola-Kirchhoff stress P `[Pa]` alone.
    ///
    /// # Errors
    /// As [`response`](Self::response).
    #[inline]
    pub fn stress<const D: usize>(&self, gradient: &Tensor<D>) -> Result<Tensor<D>, ResponseError> {
        Ok(match self.law {
            Law::LinearElastic => self.hooke(&small_strain(gradient)),
            Law::StVenantKirchhoff => {
                tensor::multiply(&deformation_gradient(gradient), &self.hooke(&green_lagrange(gradient)))
            }
            Law::NeoHookean => self.neo_hookean().stress(gradient)?,
        })
    }

    /// Stored energy per reference volume `[J/m^3]`: W = lambda/2 tr(E)^2 + mu E:E, and for the neo-Hookean solid
    /// W = mu/2 (tr C - 3) - mu ln J + lambda/2 (ln J)^2, which is infinite where it is crushed.
    #[must_use]
    pub fn energy<const D: usize>(&self, gradient: &Tensor<D>) -> f64 {
        let strain = match self.law {
            Law::LinearElastic => small_strain(gradient),
            Law::StVenantKirchhoff => green_lagrange(gradient),
            Law::NeoHookean => return self.neo_hookean().energy(gradient),
        };
        0.5 * self.lambda * tensor::trace(&strain).powi(2) + self.mu * tensor::contract(&strain, &strain)
    }

    fn neo_hookean(&self) -> NeoHookean {
        NeoHookean { lambda: self.solid_lambda, mu: self.mu, is_sheet: self.plane == Plane::Stress }
    }

    /// `A_iJkL = delta_ik S_JL + lambda F_iJ F_kL + mu (F_iL F_kJ + B_ik delta_JL)`
    #[inline]
    fn tangent<const D: usize>(&self, f: &Tensor<D>, b: &Tensor<D>, s: &Tensor<D>) -> [[Tensor<D>; D]; D] {
        let (lambda, mu) = (self.lambda, self.mu);
        let mut tangent = [[[[0.0; D]; D]; D]; D];
        for j in 0..D {
            for l in 0..D {
                let block = &mut tangent[j][l];
                for i in 0..D {
                    for k in 0..D {
                        block[i][k] = lambda * f[i][j] * f[k][l] + mu * f[i][l] * f[k][j];
                    }
                    block[i][i] += s[j][l];
                }
            }
            tensor::add_scaled(mu, b, &mut tangent[j][j]);
        }
        tangent
    }

    /// lambda tr(E) I + 2 mu E
    #[inline]
    fn hooke<const D: usize>(&self, strain: &Tensor<D>) -> Tensor<D> {
        let pressure = self.lambda * tensor::trace(strain);
        tensor::build(|i, j| 2.0 * self.mu * strain[i][j] + if i == j { pressure } else { 0.0 })
    }
}

/// F = I + grad d
#[inline]
pub(crate) fn deformation_gradient<const D: usize>(gradient: &Tensor<D>) -> Tensor<D> {
    tensor::build(|i, j| gradient[i][j] + if i == j { 1.0 } else { 0.0 })
}

/// eps = (grad d + grad d^T)/2
#[inline]
fn small_strain<const D: usize>(gradient: &Tensor<D>) -> Tensor<D> {
    tensor::build(|i, j| 0.5 * (gradient[i][j] + gradient[j][i]))
}

/// E = (grad d + grad d^T + grad d^T grad d)/2: as (F^T F - I)/2, but small strains keep all their digits.
#[inline]
#[must_use]
pub fn green_lagrange<const D: usize>(gradient: &[[f64; D]; D]) -> [[f64; D]; D] {
    tensor::build(|i, j| {
        let product: f64 = (0..D).map(|k| gradient[k][i] * gradient[k][j]).sum();
        0.5 * (gradient[i][j] + gradient[j][i] + product)
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    const LAWS: [Law; 3] = [Law::LinearElastic, Law::StVenantKirchhoff, Law::NeoHookean];
    const PLANES: [Plane; 2] = [Plane::Strain, Plane::Stress];

    fn materials() -> impl Iterator<Item = Material> {
        LAWS.into_iter().flat_map(|law| PLANES.map(|plane| Material::new(law, 7.0, 0.3, plane).unwrap()))
    }

    fn some_gradient<const D: usize>() -> Tensor<D> {
        tensor::build(|i, j| {
            let (i, j) = (i as f64, j as f64);
            0.3 * (1.0 + 2.0 * i - 1.7 * j + 0.6 * i * j).sin()
        })
    }

    /// W at the gradient plus `step` in the direction of entry (k, l), and the like for P.
    fn moved<const D: usize>(gradient: &Tensor<D>, k: usize, l: usize, step: f64) -> Tensor<D> {
        let mut moved = *gradient;
        moved[k][l] += step;
        moved
    }

    fn stress_derives_from_energy<const D: usize>() {
        let gradient = some_gradient::<D>();
        for material in materials() {
            let stress = material.response(&gradient).unwrap().stress;
            assert_eq!(stress, material.stress(&gradient).unwrap());
            for k in 0..D {
                for l in 0..D {
                    let energy = |step| material.energy(&moved(&gradient, k, l, step));
                    let slope = (energy(1e-5) - energy(-1e-5)) / 2e-5;
                    assert_relative_eq!(stress[k][l], slope, epsilon = 1e-8, max_relative = 1e-8);
                }
            }
        }
    }

    fn tangent_derives_from_stress<const D: usize>() {
        let gradient = some_gradient::<D>();
        for material in materials() {
            let r = material.response(&gradient).unwrap();
            for k in 0..D {
                for l in 0..D {
                    let stress = |step| material.stress(&moved(&gradient, k, l, step)).unwrap();
                    let (ahead, behind) = (stress(1e-5), stress(-1e-5));
                    for i in 0..D {
                        for j in 0..D {
                            let tangent = r.tangent[j][l][i][k];
                            let slope = (ahead[i][j] - behind[i][j]) / 2e-5;
                            assert_relative_eq!(tangent, slope, epsilon = 1e-8, max_relative = 1e-8);
                        }
                    }
                }
            }
        }
    }

    #[test]
    fn stress_is_derivative_of_energy_in_every_dimension() {
        stress_derives_from_energy::<1>();
        stress_derives_from_energy::<2>();
        stress_derives_from_energy::<3>();
    }

    #[test]
    fn tangent_is_derivative_of_stress_in_every_dimension() {
        tangent_derives_from_stress::<1>();
        tangent_derives_from_stress::<2>();
        tangent_derives_from_stress::<3>();
    }

    #[test]
    fn plane_laws_are_slices_of_the_solid() {
        let plane: Tensor<2> = some_gradient();
        for law in LAWS {
            let solid = Material::new(law, 7.0, 0.3, Plane::Strain).unwrap();
            let in_space = |out_of_plane: f64| {
                let mut gradient = [[0.0; 3]; 3];
                for i in 0..2 {
                    gradient[i][..2].copy_from_slice(&plane[i]);
                }
                gradient[2][2] = out_of_plane;
                solid.stress(&gradient).unwrap()
            };
            let strain_state = in_space(0.0);
            // Plane stress: the stretch out of the plane at which P_33 vanishes, by bisection.
            let (mut low, mut high) = (-0.9, 0.9);
            while high - low > 1e-15 {
                let middle = 0.5 * (low + high);
                if in_space(middle)[2][2] > 0.0 { high = middle } else { low = middle }
            }
            let stress_state = in_space(low);
            let sheet = Material::new(law, 7.0, 0.3, Plane::Stress).unwrap();
            let (strained, stressed) = (solid.stress(&plane).unwrap(), sheet.stress(&plane).unwrap());
            for i in 0..2 {
                for j in 0..2 {
                    assert_relative_eq!(strained[i][j], strain_state[i][j], epsilon = 1e-13);
                    assert_relative_eq!(stressed[i][j], stress_state[i][j], epsilon = 1e-12);
                }
            }
        }
    }

    #[test]
    fn every_law_is_hookes_law_for_small_strains() {
        let gradient: Tensor<2> = some_gradient().map(|row| row.map(|h| 1e-7 * h));
        for material in materials() {
            let (found, hooke) =
                (material.response(&gradient).unwrap(), material.linearized().response(&gradient).unwrap());
            for i in 0..2 {
                for j in 0..2 {
                    assert_relative_eq!(found.stress[i][j], hooke.stress[i][j], epsilon = 3e-13);
                    for (a, b) in
                        found.tangent[i][j].as_flattened().iter().zip(hooke.tangent[i][j].as_flattened())
                    {
                        assert_relative_eq!(a, b, epsilon = 1e-5);
                    }
                }
            }
            let energy = material.energy(&gradient) / material.linearized().energy(&gradient);
            assert_relative_eq!(energy, 1.0, epsilon = 1e-6);
        }
    }

    #[test]
    fn turning_the_body_turns_the_stress_of_the_nonlinear_laws() {
        let (sin, cos) = 1.9_f64.sin_cos();
        let turn = [[cos, -sin, 0.0], [sin, cos, 0.0], [0.0, 0.0, 1.0]];
        let gradient: Tensor<3> = some_gradient();
        for law in [Law::StVenantKirchhoff, Law::NeoHookean] {
            let material = Material::new(law, 7.0, 0.3, Plane::Strain).unwrap();
            let f = tensor::multiply(&turn, &deformation_gradient(&gradient));
            let turned: Tensor<3> = tensor::build(|i, j| f[i][j] - if i == j { 1.0 } else { 0.0 });
            let expected = tensor::multiply(&turn, &material.stress(&gradient).unwrap());
            let found = material.stress(&turned).unwrap();
            for (found, expected) in found.as_flattened().iter().zip(expected.as_flattened()) {
                assert_relative_eq!(found, expected, epsilon = 1e-13);
            }
            assert_relative_eq!(material.energy(&turned), material.energy(&gradient), max_relative = 1e-13);
        }
    }

    #[test]
    fn uniaxial_stress_is_young_modulus_times_stretch() {
        let material = Material::new(Law::LinearElastic, 5.0, 0.25, Plane::Stress).unwrap();
        let stress = material.stress(&[[1e-3, 0.0], [0.0, -0.25e-3]]).unwrap();
        assert_relative_eq!(stress[0][0], 5e-3, max_relative = 1e-14);
        assert!(stress[1][1].abs() < 1e-17);
    }

    #[test]
    fn impossible_constants_are_refused() {
        let new = |e, nu| Material::new(Law::StVenantKirchhoff, e, nu, Plane::Strain);
        for bad in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            assert!(matches!(new(bad, 0.3), Err(MaterialError::YoungModulus { .. })), "{bad}");
        }
        for bad in [-1.0, 0.5, 0.6, f64::NAN] {
            assert!(matches!(new(1.0, bad), Err(MaterialError::PoissonRatio { .. })), "{bad}");
        }
        assert!(new(1.0, -0.5).is_ok() && new(1.0, 0.0).is_ok() && new(1.0, 0.499).is_ok());
    }
}
