//! What round-off leaves of a residual is known before the loop stands still there.

use partita_iga::{Side, build};
use partita_mesh::generate::{SolidRectangle, solid_rectangle};
use partita_numerics::newton::{self, Bound, Limit, Problem, Verdict};
use partita_structure::{BodyForce, Boundary, Material, Rayleigh, Space, StructureSettings, StructureSolver};

use crate::common::{KINDS, bare, dynamic, linear, neo_hookean, on_mesh, quasi_static, solver, svk};

/// A strip of 1 m, clamped at one end or both, that its own weight bends by about `reach` m.
struct Strip {
    material: Material,
    height: f64,
    reach: f64,
    both_ends: bool,
    settings: StructureSettings,
}

impl Strip {
    fn new(material: Material, height: f64) -> Self {
        Self { material, height, reach: 0.05, both_ends: true, settings: quasi_static() }
    }

    fn body_force(&self) -> BodyForce<2> {
        let bending = self.material.young_modulus() * self.height.powi(3) / 12.0;
        let stretching = self.material.young_modulus() * self.height * self.reach.powi(2);
        let factor = if self.both_ends { 384.0 } else { 8.0 };
        let membrane = if self.both_ends && !self.material.is_linear() { stretching } else { 0.0 };
        BodyForce::Constant([0.0, -factor * (bending + membrane) * self.reach / self.height])
    }

    fn patch(self, degree: [usize; 2], elements: [usize; 2]) -> StructureSolver<2> {
        let mut model = bare(self.material);
        model.clamped = if self.both_ends { [Side::LEFT, Side::RIGHT].into() } else { [Side::LEFT].into() };
        model.body_force = self.body_force();
        let patch = build::rectangle([0.0, 0.0], [1.0, self.height], degree, elements).unwrap();
        solver(patch, model, self.settings)
    }
}

/// The smallest residual and the largest of the last iterations in units of the estimate, and the estimate itself,
/// relative to the largest term.
fn floor(solver: &mut StructureSolver<2>, dt: f64) -> [f64; 3] {
    solver.begin_step(dt, dt);
    let settings = newton::Settings { bound: Bound::Relative(1e-30), ..*solver.newton_settings() };
    let mut levels = Vec::new();
    newton::solve(solver, &settings, Limit::AtMost(40), |solver, iteration| {
        let round_offs = solver.round_offs();
        levels.push((round_offs, iteration.after.relative / round_offs));
        Verdict::Continue
    })
    .unwrap();
    let last = &levels[levels.len() - 8..];
    let least = last.iter().map(|level| level.0).fold(f64::INFINITY, f64::min);
    let most = last.iter().map(|level| level.0).fold(0.0, f64::max);
    [least, most, last[7].1]
}

#[test]
fn measure() {
    for (name, material) in [
        ("svk", svk(250.0, 0.0)),
        ("svk .3", svk(1e7, 0.3)),
        ("svk .4999", svk(1e7, 0.4999)),
        ("nh", neo_hookean(1e7, 0.3)),
        ("nh .4999", neo_hookean(1e7, 0.4999)),
        ("linear", linear(1e7, 0.3)),
    ] {
        for height in [0.2, 0.02, 2e-3, 2e-4] {
            for degree in [[1, 1], [2, 2], [3, 2], [3, 3]] {
                for reach in [1e-6, 0.05] {
                    let found = floor(
                        &mut Strip { reach, ..Strip::new(material, height) }.patch(degree, [16, 1]),
                        1.0,
                    );
                    let settings = dynamic(0.5);
                    let moving = floor(
                        &mut Strip { settings, reach, ..Strip::new(material, height) }.patch(degree, [16, 1]),
                        1e-3,
                    );
                    println!(
                        "{name:8} {height:6} {degree:?} {reach:e} least {:8.3} most {:8.3} estimate {:8.1e}   dyn {:8.3} {:8.3} {:8.1e}",
                        found[0], found[1], found[2], moving[0], moving[1], moving[2]
                    );
                }
            }
        }
    }
}
