//! A check that the parts of a material agree with each other, for everybody who writes one.

use thiserror::Error;

use crate::material::Constitutive;
use crate::tensor::{self, Tensor};

/// What a material gets wrong.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("material `{material}`: {what}")]
pub struct Violation {
    /// Name of the material.
    pub material: String,
    /// What was expected and what happened.
    pub what: String,
}

/// Deformations at which a material is looked at.
const SAMPLES: usize = 4;
/// Relative agreement of a derivative with its central difference.
const DERIVATIVE: f64 = 1e-6;
/// Relative agreement of what should be the same number.
const EXACT: f64 = 1e-10;

/// Checks a material at rest and at a few displacement gradients with entries up to `size`.
///
/// * No stress at rest.
/// * `P = dW/dF` and `A = dP/dF`, against central differences; the stress alone is that of the response.
/// * `A_iJkL = A_kLiJ`.
/// * Objectivity: `P(Q F) = Q P(F)` and `W(Q F) = W(F)` for a rotation Q, unless the law is linear; a linear one has a
///   stress proportional to the gradient.
///
/// # Errors
/// The first violation. A material that has no stress at one of the gradients violates the contract, too: choose a
/// smaller `size`.
///
/// ```
/// use partita_structure::conformance::check_material;
/// use partita_structure::{Constitutive, Law, Material, Plane};
///
/// let rubber = Material::new(Law::NeoHookean, 1e6, 0.45, Plane::Stress)?;
/// check_material::<2>(&rubber, 0.2)?;
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn check_material<const D: usize>(law: &dyn Constitutive<D>, size: f64) -> Result<(), Violation> {
    let check = Check { law, step: 1e-5 * size };
    let rest = check.stress(&[[0.0; D]; D])?;
    check.expect(norm(&rest) <= EXACT * size * law.modulus(), || {
        format!("the stress at rest is {rest:?} Pa")
    })?;
    for sample in 0..SAMPLES {
        let gradient = scattered(sample, size);
        check.derivatives(&gradient)?;
        check.symmetry(&gradient)?;
        if law.is_linear() {
            check.linearity(&gradient)?;
        } else {
            check.objectivity(&gradient)?;
        }
    }
    Ok(())
}

/// Numbers up to `size` without structure, the same in every run.
fn scattered<const D: usize>(sample: usize, size: f64) -> Tensor<D> {
    tensor::build(|i, j| size * (1.0 + 5.3 * sample as f64 + 2.1 * i as f64 - 1.7 * j as f64).sin())
}

struct Check<'a, const D: usize> {
    law: &'a dyn Constitutive<D>,
    /// Half the width of the central differences.
    step: f64,
}

impl<const D: usize> Check<'_, D> {
    fn expect(&self, holds: bool, what: impl FnOnce() -> String) -> Result<(), Violation> {
        if holds { Ok(()) } else { Err(self.violation(what())) }
    }

    fn violation(&self, what: String) -> Violation {
        Violation { material: self.law.name().to_owned(), what }
    }

    fn stress(&self, gradient: &Tensor<D>) -> Result<Tensor<D>, Violation> {
        self.law
            .stress(gradient)
            .map_err(|error| self.violation(format!("no stress at grad d = {gradient:?}: {error}")))
    }

    fn derivatives(&self, gradient: &Tensor<D>) -> Result<(), Violation> {
        let response = self.law.response(gradient).map_err(|error| self.violation(error.to_string()))?;
        let (stress, scale) = (self.stress(gradient)?, self.law.modulus());
        let same = norm(&difference(&stress, &response.stress)) <= EXACT * norm(&stress);
        self.expect(same, || format!("the stress alone, {stress:?} Pa, is not that of the response"))?;
        for k in 0..D {
            for l in 0..D {
                let at = |step: f64| {
                    let mut moved = *gradient;
                    moved[k][l] += step;
                    moved
                };
                let (ahead, behind) = (at(self.step), at(-self.step));
                let slope = (self.law.energy(&ahead) - self.law.energy(&behind)) / (2.0 * self.step);
                self.expect(close(slope, stress[k][l], DERIVATIVE, norm(&stress)), || {
                    format!(
                        "P_{k}{l} = {:e} Pa, but the energy has the derivative {slope:e} Pa",
                        stress[k][l]
                    )
                })?;
                let change = difference(&self.stress(&ahead)?, &self.stress(&behind)?);
                for i in 0..D {
                    for j in 0..D {
                        let (found, slope) = (response.tangent[j][l][i][k], change[i][j] / (2.0 * self.step));
                        self.expect(close(found, slope, DERIVATIVE, scale), || {
                            format!("A_{i}{j}{k}{l} = {found:e} Pa, but the stress has the derivative {slope:e} Pa")
                        })?;
                    }
                }
            }
        }
        Ok(())
    }

    fn symmetry(&self, gradient: &Tensor<D>) -> Result<(), Violation> {
        let response = self.law.response(gradient).map_err(|error| self.violation(error.to_string()))?;
        let a = |i: usize, j: usize, k: usize, l: usize| response.tangent[j][l][i][k];
        for index in 0..D.pow(4) {
            let [i, j, k, l] = [index % D, index / D % D, index / D.pow(2) % D, index / D.pow(3)];
            let (one, other) = (a(i, j, k, l), a(k, l, i, j));
            self.expect(close(one, other, EXACT, self.law.modulus()), || {
                format!("A_{i}{j}{k}{l} = {one:e} Pa, but A_{k}{l}{i}{j} = {other:e} Pa")
            })?;
        }
        Ok(())
    }

    fn objectivity(&self, gradient: &Tensor<D>) -> Result<(), Violation> {
        let mut turn: Tensor<D> = tensor::identity();
        if D > 1 {
            let (sin, cos) = 0.7_f64.sin_cos();
            [turn[0][0], turn[0][1], turn[1][0], turn[1][1]] = [cos, -sin, sin, cos];
        }
        let one: Tensor<D> = tensor::identity();
        let f = tensor::multiply(&turn, &tensor::build(|i, j| one[i][j] + gradient[i][j]));
        let turned = difference(&f, &one);
        let (found, expected) = (self.stress(&turned)?, tensor::multiply(&turn, &self.stress(gradient)?));
        // A strain of a turned body is the difference of numbers near one.
        let rounding = EXACT * (norm(&expected) + self.law.modulus());
        self.expect(norm(&difference(&found, &expected)) <= rounding, || {
            format!("turning the body does not turn its stress: {found:?} Pa in place of {expected:?} Pa")
        })?;
        let (turned, energy) = (self.law.energy(&turned), self.law.energy(gradient));
        self.expect(close(turned, energy, EXACT, self.law.modulus()), || {
            format!("turning the body changes its energy from {energy:e} to {turned:e} J/m^3")
        })
    }

    fn linearity(&self, gradient: &Tensor<D>) -> Result<(), Violation> {
        let stress = self.stress(gradient)?;
        let double = self.stress(&gradient.map(|row| row.map(|h| 2.0 * h)))?;
        let twice = stress.map(|row| row.map(|p| 2.0 * p));
        self.expect(norm(&difference(&double, &twice)) <= EXACT * norm(&twice), || {
            "it calls itself linear, but twice the strain is not twice the stress".to_owned()
        })
    }
}

fn difference<const D: usize>(a: &Tensor<D>, b: &Tensor<D>) -> Tensor<D> {
    tensor::build(|i, j| a[i][j] - b[i][j])
}

fn norm<const D: usize>(a: &Tensor<D>) -> f64 {
    tensor::contract(a, a).sqrt()
}

fn close(a: f64, b: f64, tolerance: f64, scale: f64) -> bool {
    (a - b).abs() <= tolerance * scale.max(a.abs()).max(b.abs())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::material::{Law, Material, Plane, Response, ResponseError};

    #[test]
    fn the_usual_materials_conform() {
        for law in [Law::LinearElastic, Law::StVenantKirchhoff, Law::NeoHookean] {
            for plane in [Plane::Strain, Plane::Stress] {
                let material = Material::new(law, 3e5, 0.35, plane).unwrap();
                check_material::<2>(&material, 0.2).unwrap();
            }
            let material = Material::new(law, 3e5, 0.35, Plane::Strain).unwrap();
            check_material::<1>(&material, 0.2).unwrap();
            check_material::<3>(&material, 0.1).unwrap();
        }
    }

    /// St. Venant-Kirchhoff with one fault.
    #[derive(Debug)]
    struct Faulty(&'static str, Material);

    impl Constitutive<2> for Faulty {
        fn name(&self) -> &str {
            self.0
        }
        fn response(&self, gradient: &Tensor<2>) -> Result<Response<2>, ResponseError> {
            let mut response = self.1.response(gradient)?;
            match self.0 {
                "tangent" => response.tangent[0][0][1][1] *= 1.001,
                "rest" => response.stress[0][0] += 1.0,
                "objectivity" => {
                    for (stress, h) in
                        response.stress.as_flattened_mut().iter_mut().zip(gradient.as_flattened())
                    {
                        *stress += h;
                    }
                    (0..2).for_each(|j| (0..2).for_each(|i| response.tangent[j][j][i][i] += 1.0));
                }
                _ => {}
            }
            Ok(response)
        }
        fn energy(&self, gradient: &Tensor<2>) -> f64 {
            let more = if self.0 == "objectivity" { 0.5 * tensor::contract(gradient, gradient) } else { 0.0 };
            let factor = if self.0 == "energy" { 1.01 } else { 1.0 };
            factor * self.1.energy(gradient) + more
        }
        fn is_linear(&self) -> bool {
            self.0 == "linear"
        }
    }

    #[test]
    fn every_fault_is_noticed() {
        let sound = Material::new(Law::StVenantKirchhoff, 7.0, 0.3, Plane::Strain).unwrap();
        check_material(&Faulty("sound", sound), 0.2).unwrap();
        let faults = [
            ("tangent", "but the stress has the derivative"),
            ("rest", "the stress at rest is"),
            ("objectivity", "turning the body"),
            ("energy", "but the energy has the derivative"),
            ("linear", "it calls itself linear"),
        ];
        for (fault, expected) in faults {
            let found = check_material(&Faulty(fault, sound), 0.2).unwrap_err().to_string();
            assert!(found.contains(fault) && found.contains(expected), "{found}");
        }
    }
}
