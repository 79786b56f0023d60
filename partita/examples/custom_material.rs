//! A material of one's own: Fung's exponential law, `W = c/2 (e^Q - 1)` with `Q = a (tr E)^2 + b E:E`, in plane strain.

mod tank;

use partita::Run;
use partita::structure::material::green_lagrange;
use partita::structure::{AnyMaterial, Constitutive, PlaneStrain, Response, ResponseError};

/// The stiffness c `[Pa]` and the numbers a and b.
#[derive(Debug, Clone, Copy)]
struct Fung(f64, f64, f64);

impl Constitutive<3> for Fung {
    fn name(&self) -> &'static str {
        "Fung"
    }
    fn response(&self, gradient: &[[f64; 3]; 3]) -> Result<Response<3>, ResponseError> {
        let (Self(_, a, b), e, delta) = (*self, green_lagrange(gradient), |i, j| f64::from(u8::from(i == j)));
        let trace = e[0][0] + e[1][1] + e[2][2];
        // S = c/2 e^Q q and dS/dE = c/2 e^Q (q q + dq/dE) with q = dQ/dE.
        let factor = self.energy(gradient) + 0.5 * self.0;
        let q = [0, 1, 2].map(|i| [0, 1, 2].map(|j| 2.0 * a * trace * delta(i, j) + 2.0 * b * e[i][j]));
        Ok(Response::from_second_stress(gradient, &q.map(|row| row.map(|q| factor * q)), |i, j, k, l| {
            let (isotropic, shear) =
                (delta(i, j) * delta(k, l), delta(i, k) * delta(j, l) + delta(i, l) * delta(j, k));
            factor * (q[i][j] * q[k][l] + 2.0 * a * isotropic + b * shear)
        }))
    }
    fn energy(&self, gradient: &[[f64; 3]; 3]) -> f64 {
        let (Self(c, a, b), e) = (*self, green_lagrange(gradient));
        let trace = e[0][0] + e[1][1] + e[2][2];
        0.5 * c * (a * trace * trace + b * e.as_flattened().iter().map(|e| e * e).sum::<f64>()).exp_m1()
    }
}

pub(crate) fn build() -> Result<Run, Box<dyn std::error::Error>> {
    let tissue = AnyMaterial::custom(PlaneStrain(Fung(1e5, 10.0, 15.0)));
    Ok(Run::couple(tank::fluid()?, tank::structure(tissue)?)?.with_steps(8, 0.01))
}

pub(crate) fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut run = build()?;
    while run.step()? {}
    println!("strain energy {:.6} J/m", run.structure().expect("it has one").strain_energy());
    Ok(())
}
