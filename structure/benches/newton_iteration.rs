//! One Newton iteration of the structure and its parts, on the thin plate of the tank and on a patch of 30k dofs.
//!
//! Both are quadratic, clamped at two sides, of St. Venant-Kirchhoff material in plane strain, in a state of large
//! deflection under generalized-alpha with spectral radius 0.5.
use partita_numerics::Field;

use std::hint::black_box;

use criterion::{Criterion, criterion_group, criterion_main};
use partita_iga::{Side, build};
use partita_numerics::newton::Problem;
use partita_numerics::{Factor, Method};
use partita_structure::{
    BodyForce, Law, Material, Plane, StructureModel, StructureSettings, StructureSolver, TimeScheme,
};

fn deflected(size: [f64; 2], elements: [usize; 2]) -> StructureSolver<2> {
    let patch = build::rectangle([0.0, 0.0], size, [2, 2], elements).expect("a valid rectangle");
    let model = StructureModel {
        density: 1000.0,
        material: Material::new(Law::StVenantKirchhoff, 5e6, 0.3, Plane::Strain)
            .expect("a valid material")
            .into(),
        body_force: BodyForce::Constant([0.0, -9.81e3]),
        clamped: [Side::LEFT, Side::RIGHT].into(),
        held: Vec::new(),
        wetted: [Side::TOP].into(),
    };
    let time = TimeScheme::GeneralizedAlpha { spectral_radius: 0.5 };
    let settings = StructureSettings { time, ..StructureSettings::default() };
    let mut solver = StructureSolver::new(patch.into(), model, settings).expect("a valid structure");
    for step in 1..=3 {
        solver.step_alone(0.01 * f64::from(step), 0.01).expect("the structure bends");
    }
    solver.begin_step(0.04, 0.01).expect("a step");
    solver
}

fn newton_iteration(criterion: &mut Criterion) {
    for (size, elements) in [([1.0, 0.05], [60, 1]), ([1.0, 0.4], [120, 120])] {
        let mut solver = deflected(size, elements);
        let name = format!("{} dofs", solver.parts()[0].dofs.len());
        let mut group = criterion.benchmark_group(name);

        group.bench_function("residual", |b| b.iter(|| solver.assemble(false)));
        group.bench_function("residual and tangent", |b| b.iter(|| solver.assemble(true)));
        for method in [Method::Llt, Method::Ldlt] {
            let (pattern, values) = solver.tangent();
            let mut factor = Factor::new(method, pattern).expect("memory suffices");
            group.bench_function(format!("refactor {method:?}"), |b| b.iter(|| factor.refactor(values)));
            let mut x = vec![1.0; pattern.size()];
            group.bench_function(format!("solve {method:?}"), |b| b.iter(|| factor.solve(black_box(&mut x))));
        }
        let start = solver.values().to_vec();
        group.bench_function("iteration", |b| {
            b.iter(|| {
                solver.guess(&start);
                solver.assemble(true).expect("a residual");
                solver.solve_and_update().expect("a regular tangent");
            });
        });
        group.finish();
    }
}

criterion_group! {
    name = benches;
    config = Criterion::default().sample_size(20);
    targets = newton_iteration
}
criterion_main!(benches);
