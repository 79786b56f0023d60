//! What any material has to offer.

use std::fmt;
use std::sync::Arc;

use super::{Material, Response, ResponseError};
use crate::tensor::{self, Tensor};

/// A hyperelastic law in D dimensions: stress, its derivative and the stored energy as functions of the displacement gradient
/// `H = grad d`, `H_iJ = d d_i / d X_J`, with `F = I + H`.
///
/// [`Material`] has the usual ones. A law of one's own is given to a structure by [`AnyMaterial::custom`]; one for solids in
/// space also serves in the plane, see [`PlaneStrain`](crate::PlaneStrain) and [`PlaneStress`](crate::PlaneStress).
/// [`check_material`](crate::conformance::check_material) tells whether its parts agree. The density is no part of it.
pub trait Constitutive<const D: usize>: fmt::Debug + Send + Sync {
    /// Its name, for messages.
    fn name(&self) -> &str;

    /// First Piola-Kirchhoff stress `P` `[Pa]` and its derivative `A_iJkL = dP_iJ/dF_kL` `[Pa]`.
    ///
    /// # Errors
    /// If the law has no stress for this deformation.
    fn response(&self, gradient: &[[f64; D]; D]) -> Result<Response<D>, ResponseError>;

    /// The stress alone; the same bits as that of [`response`](Self::response).
    ///
    /// # Errors
    /// As [`response`](Self::response).
    fn stress(&self, gradient: &[[f64; D]; D]) -> Result<[[f64; D]; D], ResponseError> {
        Ok(self.response(gradient)?.stress)
    }

    /// Stored energy per reference volume `W` `[J/m^3]`, `P = dW/dF`.
    fn energy(&self, gradient: &[[f64; D]; D]) -> f64;

    /// Whether the stress is linear in the displacement gradient.
    fn is_linear(&self) -> bool {
        false
    }

    /// Its stiffest answer to a small strain `[Pa]`, from which the size of round-off is estimated: the largest entry of
    /// the tangent at rest.
    fn modulus(&self) -> f64 {
        let at_rest = self.response(&[[0.0; D]; D]).map(|response| response.tangent);
        let entries = at_rest.iter().flatten().flatten().flatten().flatten();
        entries.fold(0.0, |largest: f64, entry| largest.max(entry.abs()))
    }
}

impl<const D: usize> Constitutive<D> for Material {
    fn name(&self) -> &str {
        match self.law() {
            super::Law::LinearElastic => "linear elastic",
            super::Law::StVenantKirchhoff => "St. Venant-Kirchhoff",
            super::Law::NeoHookean => "neo-Hookean",
        }
    }

    #[inline]
    fn response(&self, gradient: &[[f64; D]; D]) -> Result<Response<D>, ResponseError> {
        Self::response(self, gradient)
    }

    #[inline]
    fn stress(&self, gradient: &[[f64; D]; D]) -> Result<[[f64; D]; D], ResponseError> {
        Self::stress(self, gradient)
    }

    #[inline]
    fn energy(&self, gradient: &[[f64; D]; D]) -> f64 {
        Self::energy(self, gradient)
    }

    fn is_linear(&self) -> bool {
        Self::is_linear(self)
    }

    fn modulus(&self) -> f64 {
        self.wave_modulus()
    }
}

/// The material of a structure: one of the usual isotropic ones, called directly, or anybody else's.
#[derive(Debug, Clone)]
pub enum AnyMaterial<const D: usize> {
    /// An isotropic law of this crate.
    Isotropic(Material),
    /// Any other law.
    Custom(Arc<dyn Constitutive<D>>),
}

impl<const D: usize> AnyMaterial<D> {
    /// A law of one's own.
    #[must_use]
    pub fn custom(law: impl Constitutive<D> + 'static) -> Self {
        Self::Custom(Arc::new(law))
    }

    /// The law, whichever it is.
    #[must_use]
    pub fn law(&self) -> &dyn Constitutive<D> {
        match self {
            Self::Isotropic(material) => material,
            Self::Custom(law) => law.as_ref(),
        }
    }

    /// Whether the stress is linear in the displacement.
    #[must_use]
    pub fn is_linear(&self) -> bool {
        self.law().is_linear()
    }

    /// The linear law with the same tangent at rest, used for stiffness-proportional damping.
    ///
    /// # Errors
    /// If the law has no stress at rest.
    pub(crate) fn linearized(&self) -> Result<Self, ResponseError> {
        Ok(match self {
            Self::Isotropic(material) => Self::Isotropic(material.linearized()),
            Self::Custom(law) => Self::custom(Linearized { tangent: law.response(&[[0.0; D]; D])?.tangent }),
        })
    }
}

impl<const D: usize> From<Material> for AnyMaterial<D> {
    fn from(material: Material) -> Self {
        Self::Isotropic(material)
    }
}

/// `P_iJ = A_iJkL H_kL` with a constant tangent, stored as in [`Response`].
#[derive(Debug, Clone)]
struct Linearized<const D: usize> {
    tangent: [[Tensor<D>; D]; D],
}

impl<const D: usize> Constitutive<D> for Linearized<D> {
    fn name(&self) -> &'static str {
        "linearized"
    }

    fn response(&self, gradient: &Tensor<D>) -> Result<Response<D>, ResponseError> {
        let sum = |i: usize, j: usize| {
            (0..D).map(|l| (0..D).map(|k| self.tangent[j][l][i][k] * gradient[k][l]).sum::<f64>()).sum()
        };
        Ok(Response { stress: tensor::build(sum), tangent: self.tangent })
    }

    fn energy(&self, gradient: &Tensor<D>) -> f64 {
        self.stress(gradient).map_or(f64::NAN, |stress| 0.5 * tensor::contract(&stress, gradient))
    }

    fn is_linear(&self) -> bool {
        true
    }
}

impl<const D: usize> Response<D> {
    /// `P = F S` and `A_iJkL = delta_ik S_JL + F_iM C_MJNL F_kN` from the second Piola-Kirchhoff stress `S` `[Pa]`, symmetric,
    /// and `stiffness(M, J, N, L)`, its derivative `C_MJNL = dS_MJ/dE_NL` `[Pa]` by the Green-Lagrange strain
    /// `E = (F^T F - I)/2` (see [`green_lagrange`](crate::material::green_lagrange)).
    #[must_use]
    pub fn from_second_stress(
        gradient: &[[f64; D]; D],
        stress: &[[f64; D]; D],
        stiffness: impl Fn(usize, usize, usize, usize) -> f64,
    ) -> Self {
        let f = super::deformation_gradient(gradient);
        let mut tangent = [[[[0.0; D]; D]; D]; D];
        for j in 0..D {
            for l in 0..D {
                let inner: Tensor<D> = tensor::build(|m, n| stiffness(m, j, n, l));
                let block = tensor::multiply_transposed(&tensor::multiply(&f, &inner), &f);
                tangent[j][l] = tensor::build(|i, k| block[i][k] + if i == k { stress[j][l] } else { 0.0 });
            }
        }
        Self { stress: tensor::multiply(&f, stress), tangent }
    }
}
