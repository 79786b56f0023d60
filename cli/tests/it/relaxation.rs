//! Where constant relaxation of the real solvers stops converging, against the eigenvalue on paper.

use std::f64::consts::PI;

use partita::build;
use partita_numerics::time::GeneralizedAlpha;

use crate::linear_tank::tank;

/// How many modes of the bottom, and of the water.
const BENDING_MODES: usize = 6;
const WAVES: usize = 40;

const DENSITY: f64 = 1000.0;
/// Mass and bending stiffness of the bottom per depth.
const MASS: f64 = 2500.0 * 0.02;
const STIFFNESS: f64 = 5e7 * 0.02 * 0.02 * 0.02 / (12.0 * (1.0 - 0.3 * 0.3));

/// Mode j of a beam of length one that is clamped at both ends, and its wave number: cosh(k) cos(k) = 1.
struct Bending {
    wave_number: f64,
    slope: f64,
}

impl Bending {
    fn new(j: usize) -> Self {
        let mut k = (j as f64 + 1.5) * PI;
        for _ in 0..20 {
            k -= (k.cos() - 1.0 / k.cosh()) / (-k.sin() + k.tanh() / k.cosh());
        }
        Self { wave_number: k, slope: (k.cosh() - k.cos()) / (k.sinh() - k.sin()) }
    }

    /// Of mean square one.
    fn at(&self, x: f64) -> f64 {
        let y = self.wave_number * x;
        y.cosh() - y.cos() - self.slope * (y.sinh() - y.sin())
    }

    /// Amplitude of cos(n pi x) in this mode.
    fn wave(&self, n: usize) -> f64 {
        let points = 4000;
        let at = |i: usize| {
            let x = (i as f64 + 0.5) / points as f64;
            self.at(x) * (n as f64 * PI * x).cos()
        };
        let mean = (0..points).map(at).sum::<f64>() / points as f64;
        if n == 0 { mean } else { 2.0 * mean }
    }
}

/// The eigenvalue of Dirichlet-Neumann iterations farthest below zero,
///
/// ```text
/// lambda = eig(-c^2 (1 - alpha_f) [(1 - alpha_m)/(beta dt^2) M_s + (1 - alpha_f) K_s]^-1 M_a)
/// ```
///
/// in the modes of the clamped bottom, with the added mass of potential flow `p_n = rho/(n pi) tanh(n pi) a_n`.
fn smallest_eigenvalue(radius: f64, rate: f64, dt: f64) -> f64 {
    let scheme = GeneralizedAlpha::from_spectral_radius(radius).expect("a radius");
    let share = 1.0 - scheme.alpha_f;
    let inertia = (1.0 - scheme.alpha_m) / (scheme.beta * dt * dt) * MASS;
    let modes: Vec<Bending> = (0..BENDING_MODES).map(Bending::new).collect();
    let waves: Vec<Vec<f64>> = modes.iter().map(|mode| (0..WAVES).map(|n| mode.wave(n)).collect()).collect();
    let added_mass = |j: usize, k: usize| -> f64 {
        let wave = |n: usize| {
            let number = n as f64 * PI;
            let (depth, mean) = if n == 0 { (1.0, 1.0) } else { (number.tanh() / number, 0.5) };
            DENSITY * depth * mean * waves[j][n] * waves[k][n]
        };
        (0..WAVES).map(wave).sum()
    };
    let dynamic: Vec<f64> =
        modes.iter().map(|mode| inertia + share * STIFFNESS * mode.wave_number.powi(4)).collect();
    // Power iteration; all entries of the matrix are those of a symmetric one, scaled.
    let matrix: Vec<Vec<f64>> = (0..BENDING_MODES)
        .map(|j| (0..BENDING_MODES).map(|k| rate * rate * share * added_mass(j, k) / dynamic[j]).collect())
        .collect();
    let mut vector = vec![1.0; BENDING_MODES];
    let mut eigenvalue = 0.0;
    for _ in 0..200 {
        let product: Vec<f64> =
            matrix.iter().map(|row| row.iter().zip(&vector).map(|(a, x)| a * x).sum()).collect();
        eigenvalue = product.iter().fold(0.0_f64, |largest, x| largest.max(x.abs()));
        vector = product.iter().map(|x| x / eigenvalue).collect();
    }
    -eigenvalue
}

/// `|r^{k+1}| / |r^k|` at the end of the last of so many steps with one relaxation throughout.
fn growth(omega: f64, radius: f64, time_scheme: &str, steps: usize) -> f64 {
    let resolved = tank(&[
        &format!("coupling.acceleration.constant.relaxation={omega}"),
        &format!("structure.time_scheme.generalized_alpha.spectral_radius={radius}"),
        &format!("fluid.time_scheme={time_scheme}"),
        // So few that what grows slowly is not yet given up as diverging.
        "coupling.max_iterations=20",
    ]);
    let mut run = build::march(&resolved).expect("the scene builds");
    for _ in 0..steps {
        run.step(resolved.scene.time.step.get(), &mut ()).expect("a step, converged or not");
    }
    let residuals: Vec<f64> = run.history().iterations.iter().map(|iteration| iteration.residual).collect();
    residuals[residuals.len() - 1] / residuals[residuals.len() - 2]
}

/// Within 5 %: what is 5 % below the limit converges, what is 5 % above it does not. The growth is linear in omega near
/// the limit, |1 - omega (1 - lambda)|, which tells where it is observed.
#[test]
fn relaxation_of_the_real_solvers_diverges_where_the_added_mass_says() {
    let dt = 0.01;
    for (radius, time_scheme, steps, rate) in
        [(1.0, "bdf1", 1, 1.0 / dt), (0.0, "bdf1", 1, 1.0 / dt), (0.5, "bdf2", 2, 1.5 / dt)]
    {
        let lambda = smallest_eigenvalue(radius, rate, dt);
        let limit = 2.0 / (1.0 - lambda);
        let [below, above] = [0.95, 1.05].map(|factor| growth(factor * limit, radius, time_scheme, steps));
        let observed = 2.0 * 1.05 * limit / (1.0 + above);
        println!(
            "radius {radius}, {time_scheme}: lambda {lambda:.3}, limit {limit:.4}, observed {observed:.4}; \
             growth {below:.3} below and {above:.3} above"
        );
        assert!(below < 1.0 && above > 1.0, "growth {below} below the limit, {above} above");
        assert!((observed / limit - 1.0).abs() < 0.05, "limit {limit}, observed {observed}");
    }
}
