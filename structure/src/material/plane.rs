//! Laws of solids in space, in the plane.

use super::{Constitutive, Response, ResponseError};
use crate::tensor::{self, Tensor};

/// A law in space at no strain out of the plane: a slice of a long body.
#[derive(Debug, Clone)]
pub struct PlaneStrain<M>(pub M);

/// A law in space at no stress out of the plane: a thin sheet. The stretch out of the plane, at which `P_33` vanishes, is found
/// by Newton's method at each point, and the tangent is condensed:
///
/// ```text
/// A*_iJkL = A_iJkL - A_iJ33 A_33kL / A_3333
/// ```
#[derive(Debug, Clone)]
pub struct PlaneStress<M>(pub M);

/// The gradient in space of a plane one, with `h = F_33 - 1`.
fn in_space(gradient: &Tensor<2>, h: f64) -> Tensor<3> {
    let [[a, b], [c, d]] = *gradient;
    [[a, b, 0.0], [c, d, 0.0], [0.0, 0.0, h]]
}

/// The part in the plane.
fn in_plane(response: &Response<3>) -> Response<2> {
    let tangent = [0, 1].map(|j| [0, 1].map(|l| tensor::build(|i, k| response.tangent[j][l][i][k])));
    Response { stress: tensor::build(|i, j| response.stress[i][j]), tangent }
}

impl<M: Constitutive<3>> Constitutive<2> for PlaneStrain<M> {
    fn name(&self) -> &str {
        self.0.name()
    }

    fn response(&self, gradient: &Tensor<2>) -> Result<Response<2>, ResponseError> {
        Ok(in_plane(&self.0.response(&in_space(gradient, 0.0))?))
    }

    fn energy(&self, gradient: &Tensor<2>) -> f64 {
        self.0.energy(&in_space(gradient, 0.0))
    }

    fn is_linear(&self) -> bool {
        self.0.is_linear()
    }
}

/// Newton iterations for the stretch out of the plane.
const MAX_ITERATIONS: usize = 50;

impl<M: Constitutive<3>> PlaneStress<M> {
    /// The gradient in space and the response there.
    fn free(&self, gradient: &Tensor<2>) -> Result<(Tensor<3>, Response<3>), ResponseError> {
        let mut h = 0.0;
        for _ in 0..MAX_ITERATIONS {
            let space = in_space(gradient, h);
            let response = self.0.response(&space)?;
            let change = -response.stress[2][2] / response.tangent[2][2][2][2];
            if change.abs() <= 4.0 * f64::EPSILON * (1.0 + h).abs() {
                return Ok((space, response));
            }
            // A sheet of no thickness has no stress: at most half of it goes in one iteration.
            h = (h + change).max(0.5 * (1.0 + h) - 1.0);
        }
        let [[a, b], [c, d]] = *gradient;
        Err(ResponseError::NoPlaneStress { area_ratio: (1.0 + a) * (1.0 + d) - b * c })
    }
}

impl<M: Constitutive<3>> Constitutive<2> for PlaneStress<M> {
    fn name(&self) -> &str {
        self.0.name()
    }

    fn response(&self, gradient: &Tensor<2>) -> Result<Response<2>, ResponseError> {
        let (_, space) = self.free(gradient)?;
        let mut plane = in_plane(&space);
        let a = |i: usize, j: usize, k: usize, l: usize| space.tangent[j][l][i][k];
        for j in 0..2 {
            for l in 0..2 {
                let condensed: Tensor<2> =
                    tensor::build(|i, k| a(i, j, 2, 2) * a(2, 2, k, l) / a(2, 2, 2, 2));
                tensor::add_scaled(-1.0, &condensed, &mut plane.tangent[j][l]);
            }
        }
        Ok(plane)
    }

    fn energy(&self, gradient: &Tensor<2>) -> f64 {
        self.free(gradient).map_or(f64::INFINITY, |(space, _)| self.0.energy(&space))
    }

    fn is_linear(&self) -> bool {
        self.0.is_linear()
    }
}

#[cfg(test)]
mod tests {
    use approx::assert_relative_eq;

    use super::*;
    use crate::material::{Law, Material, Plane};

    #[test]
    fn slices_and_sheets_of_the_usual_laws_are_the_plane_ones() {
        let gradient = [[0.12, -0.2], [0.15, -0.07]];
        for law in [Law::LinearElastic, Law::StVenantKirchhoff, Law::NeoHookean] {
            let solid = Material::new(law, 7.0, 0.3, Plane::Strain).unwrap();
            let sheet = Material::new(law, 7.0, 0.3, Plane::Stress).unwrap();
            let pairs: [(&dyn Constitutive<2>, &dyn Constitutive<2>); 2] =
                [(&PlaneStrain(solid), &solid), (&PlaneStress(solid), &sheet)];
            for (ours, known) in pairs {
                let [found, expected] = [ours, known].map(|law| law.response(&gradient).unwrap());
                let flat = |r: &Response<2>| -> Vec<f64> {
                    let tangent = r.tangent.as_flattened().as_flattened().as_flattened();
                    [r.stress.as_flattened(), tangent].concat()
                };
                for (found, expected) in flat(&found).iter().zip(flat(&expected)) {
                    assert_relative_eq!(*found, expected, epsilon = 1e-12);
                }
                assert_relative_eq!(ours.energy(&gradient), known.energy(&gradient), max_relative = 1e-12);
            }
        }
    }
}
