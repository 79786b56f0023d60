//! What round-off leaves of a residual is known before the loop stands still there.
use partita_numerics::Field;

use partita_iga::{Side, build};
use partita_mesh::CellKind;
use partita_mesh::generate::{SolidRectangle, solid_rectangle};
use partita_numerics::newton::{self, Bound, Limit, Problem, Verdict};
use partita_structure::{
    BodyForce, LineSearch, Material, Rayleigh, StructureModel, StructureSettings, StructureSolver,
};

use crate::common::{KINDS, bare, dynamic, linear, neo_hookean, on_mesh, quasi_static, solver, svk};

/// A strip of 1 m, clamped at both ends, that its own weight bends by about `reach` m.
struct Strip {
    material: Material,
    height: f64,
    reach: f64,
    settings: StructureSettings,
}

impl Strip {
    fn new(material: Material, height: f64, reach: f64) -> Self {
        let line_search = Some(LineSearch { tolerance: 0.8, max_evaluations: 10 });
        Self { material, height, reach, settings: StructureSettings { line_search, ..quasi_static() } }
    }

    fn model(&self) -> StructureModel<2> {
        let Self { material, height, reach, .. } = *self;
        let bending = material.young_modulus() * height.powi(3) / 12.0;
        let membrane =
            if material.is_linear() { 0.0 } else { material.young_modulus() * height * reach.powi(2) };
        let mut model = bare(material);
        model.body_force = BodyForce::Constant([0.0, -384.0 * (bending + membrane) * reach / height]);
        model
    }

    fn patch(&self, degree: [usize; 2], elements: [usize; 2]) -> StructureSolver<2> {
        let mut model = self.model();
        model.clamped = [Side::LEFT, Side::RIGHT].into();
        solver(
            build::rectangle([0.0, 0.0], [1.0, self.height], degree, elements).unwrap(),
            model,
            self.settings,
        )
    }

    fn mesh(&self, kind: CellKind) -> StructureSolver<2> {
        let mut model = self.model();
        model.clamped = ["left", "right"].into_iter().map(str::to_owned).collect();
        let shape = SolidRectangle { origin: [0.0; 2], size: [1.0, self.height], divisions: [16, 1] };
        on_mesh(solid_rectangle(&shape, kind).unwrap(), model, self.settings)
    }
}

/// Residuals of the last iterations of a long loop, the smallest and the largest, in units of their round-off, and this
/// relative to the largest term.
fn floor(solver: &mut StructureSolver<2>, dt: f64) -> [f64; 3] {
    solver.begin_step(dt, dt).expect("a step");
    let settings = newton::Settings { divergence_factor: 1e30, ..*solver.newton_settings() };
    let mut levels: Vec<[f64; 2]> = Vec::new();
    // The loop ends at round-off; what follows shows whether it ends too early.
    for bound in [Bound::Relative(1e-10), Bound::Relative(1e-30)] {
        let settings = newton::Settings { bound, ..settings };
        let report = newton::solve(solver, &settings, Limit::ToConvergence, |_, _| Verdict::Continue);
        let report = report.unwrap_or_else(|failure| panic!("{failure:?}"));
        assert!(report.converged);
    }
    for _ in 0..6 {
        solver.assemble(true).unwrap();
        solver.solve_and_update().unwrap();
        let residual = solver.assemble(false).unwrap();
        let round_offs = solver.round_offs();
        levels.push([round_offs, residual.relative / round_offs]);
    }
    let least = levels.iter().map(|level| level[0]).fold(f64::INFINITY, f64::min);
    let most = levels.iter().map(|level| level[0]).fold(0.0, f64::max);
    [least, most, levels[0][1]]
}

/// The estimate bounds what is left, and by not much more than an order of magnitude.
fn assert_bounds(name: &str, [least, most, relative]: [f64; 3]) {
    println!("{name}: {least:.3} to {most:.3} of the estimate, which is {relative:.1e} of the largest term");
    assert!(most < 0.8, "{name}: {most} round-offs are left");
    assert!(least > 0.02, "{name}: the estimate is {} times what is left", 1.0 / least);
}

fn materials() -> [(&'static str, Material); 6] {
    [
        ("svk", svk(250.0, 0.0)),
        ("svk, nu 0.3", svk(2e11, 0.3)),
        ("svk, nu 0.4999", svk(1e7, 0.4999)),
        ("neo-Hookean", neo_hookean(1e7, 0.3)),
        ("neo-Hookean, nu 0.4999", neo_hookean(1e7, 0.4999)),
        ("linear", linear(1e7, 0.3)),
    ]
}

#[test]
fn round_off_of_slender_strips_is_estimated_whatever_their_material_degree_and_thickness() {
    for (name, material) in materials() {
        // The factor of a strip thinner than these, or of one of these that is nearly incompressible, is refused as inaccurate.
        let heights: &[f64] = if material.poisson_ratio() > 0.4 { &[0.2, 0.02] } else { &[0.2, 0.02, 2e-3] };
        for &height in heights {
            for degree in [[1, 1], [2, 2], [3, 2], [3, 3]] {
                let strip = Strip::new(material, height, 0.02 * height);
                let name = format!("{name}, {height} m thick, degrees {degree:?}");
                assert_bounds(&name, floor(&mut strip.patch(degree, [16, 1]), 1.0));
            }
        }
    }
}

#[test]
fn round_off_of_large_and_of_small_deflections_is_estimated() {
    for (name, material) in materials() {
        for reach in [1e-9, 1e-4, 0.02] {
            let strip = Strip::new(material, 0.02, reach);
            let elements = if reach > 1e-3 { [32, 2] } else { [8, 3] };
            assert_bounds(
                &format!("{name}, bent by {reach} m"),
                floor(&mut strip.patch([2, 2], elements), 1.0),
            );
        }
    }
}

#[test]
fn round_off_of_every_kind_of_cell_is_estimated() {
    for kind in KINDS {
        for height in [0.05, 1e-3] {
            let strip = Strip::new(svk(1e7, 0.3), height, 0.5 * height);
            assert_bounds(&format!("{kind:?}, {height} m thick"), floor(&mut strip.mesh(kind), 1.0));
        }
    }
}

#[test]
fn round_off_of_inertia_and_damping_is_estimated() {
    let rayleigh = Some(Rayleigh { mass: 1.0, stiffness: 0.01 });
    for settings in [
        dynamic(0.5),
        StructureSettings { rayleigh, ..dynamic(1.0) },
        StructureSettings { rayleigh, ..quasi_static() },
    ] {
        for dt in [1e-6, 1e-3, 1.0] {
            let strip = Strip { settings, ..Strip::new(svk(1e7, 0.3), 0.01, 1e-3) };
            let mut solver = strip.patch([2, 2], [16, 1]);
            for step in 1..=3 {
                solver.step_alone(f64::from(step) * dt, dt).unwrap();
            }
            let [least, most, relative] = floor(&mut solver, 4.0 * dt);
            println!("dt = {dt}: {least:.3} to {most:.3}, {relative:.1e}");
            assert!(most < 0.8 && least > 1e-3, "{settings:?}, dt = {dt}: {least} to {most}");
        }
    }
}

#[test]
fn a_wall_of_two_thousandths_converges_where_its_round_off_lies_above_the_bound() {
    let strip = Strip::new(svk(250.0, 0.0), 2e-3, 1e-4);
    let mut solver = strip.patch([3, 2], [16, 1]);
    let report = solver.step_alone(1.0, 1.0).unwrap();
    println!("{report:?}");
    assert!(report.at_round_off && report.exit.relative > 1e-10, "{report:?}");
}

#[test]
fn a_tangent_that_leads_nowhere_is_no_round_off() {
    // Beyond its buckling load a strip has no straight equilibrium that Newton's method would find within few iterations.
    let mut strip = Strip::new(svk(1e7, 0.3), 0.02, 1e-3);
    strip.settings.newton.max_iterations = 2;
    let failure = strip.patch([2, 2], [16, 1]).step_alone(1.0, 1.0).unwrap_err();
    assert!(matches!(failure, newton::Failure::TooManyIterations { .. }), "{failure}");
}
