//! The first natural vibration of a structure, by inverse iteration.

use crate::factor::TangentFactor;
use crate::solver::StructureSolver;

/// A natural vibration of the undeformed structure without damping and without fluid: `K phi = omega^2 M phi`.
#[derive(Debug, Clone, PartialEq)]
pub struct Mode {
    /// `phi` on all dofs, `node * D + c`, zero where the structure is held.
    pub shape: Vec<f64>,
    /// `phi . M phi` `[kg, in 2D kg/m]`; zero where the structure has no inertia.
    pub mass: f64,
    /// `phi . K phi` `[N/m, in 2D N/m^2]`.
    pub stiffness: f64,
}

impl Mode {
    /// `2 pi / omega` `[s]`; `None` without inertia.
    #[must_use]
    pub fn period(&self) -> Option<f64> {
        (self.mass > 0.0).then(|| std::f64::consts::TAU * (self.mass / self.stiffness).sqrt())
    }
}

/// Iterations after which the mode is taken as it is: an estimate needs few digits.
const MOST_ITERATIONS: usize = 100;
/// Relative change of the Rayleigh quotient at which it is found.
const TOLERANCE: f64 = 1e-6;
/// Stiffness of a rigid motion beside that of the start: round-off.
const RIGID: f64 = 1e-12;

impl<const D: usize> StructureSolver<D> {
    /// The vibration of the lowest frequency, found by inverse iteration from a start without symmetry:
    ///
    /// ```text
    /// phi <- K^-1 M phi,   omega^2 = (phi . K phi) / (phi . M phi)
    /// ```
    ///
    /// Without inertia the mass matrix is replaced by the identity: the softest direction, whose `mass` is then zero. `None`
    /// where the structure is not held, so that `K` is singular.
    ///
    /// Source: K. J. Bathe, *Finite element procedures* (1996), section 11.2.1.
    #[must_use]
    pub fn first_mode(&self) -> Option<Mode> {
        let pattern = self.assembly.pattern();
        let stiffness = self.assembly.linear_stiffness(1.0);
        let mass = self.assembly.mass();
        let mut factor = TangentFactor::new(pattern).ok()?;
        factor.refactor(pattern, &stiffness).ok()?;
        if factor.indefinite_count() > 0 {
            return None;
        }
        let size = pattern.size();
        let weigh = |x: &[f64], y: &mut Vec<f64>| {
            if mass.is_empty() { y.copy_from_slice(x) } else { pattern.multiply(mass, x, y) }
        };
        let mut phi: Vec<f64> = (0..size).map(|i| 1.0 + (i as f64).sin()).collect();
        let (mut image, mut force) = (vec![0.0; size], vec![0.0; size]);
        pattern.multiply(&stiffness, &phi, &mut force);
        weigh(&phi, &mut image);
        let start = dot(&phi, &force) / dot(&phi, &image);
        let mut last = f64::INFINITY;
        for _ in 0..MOST_ITERATIONS {
            phi.copy_from_slice(&image);
            factor.solve(&mut phi);
            let length = phi.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
            for x in &mut phi {
                *x /= length;
            }
            pattern.multiply(&stiffness, &phi, &mut force);
            weigh(&phi, &mut image);
            let quotient = dot(&phi, &force) / dot(&phi, &image);
            if !quotient.is_finite() || quotient < RIGID * start {
                return None;
            }
            if (quotient - last).abs() < TOLERANCE * quotient {
                break;
            }
            last = quotient;
        }
        let mut shape = vec![0.0; self.assembly.dofs().total()];
        self.assembly.dofs().add_scaled(1.0, &phi, &mut shape);
        let mass = if self.has_inertia() { dot(&phi, &image) } else { 0.0 };
        Some(Mode { shape, mass, stiffness: dot(&phi, &force) })
    }

    /// What a step of size `dt` `[s]` sets against a force along a mode `[N/m, in 2D N/m^2]`:
    ///
    /// ```text
    /// (1 - alpha_m)/(beta dt^2) phi . M phi + (1 - alpha_f) phi . K phi
    /// ```
    ///
    /// and the weight `1 - alpha_f` of the new force in the balance of forces.
    #[must_use]
    pub fn resistance(&self, mode: &Mode, dt: f64) -> (f64, f64) {
        let step = self.step_of(dt);
        let weights = step.tangent_weights();
        (weights.mass * mode.mass + weights.stiffness * mode.stiffness, 1.0 - step.alpha_f())
    }
}

fn dot(x: &[f64], y: &[f64]) -> f64 {
    x.iter().zip(y).map(|(x, y)| x * y).sum()
}
