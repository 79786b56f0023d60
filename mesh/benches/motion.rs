//! Mesh motion at 700 and 30 000 dofs: what a step costs and what a coupling iteration costs.

use std::hint::black_box;

use criterion::{Criterion, criterion_group, criterion_main};
use partita_mesh::generate::{Diagonal, RectangleMesh, rectangle};
use partita_mesh::motion::prescribed_dofs;
use partita_mesh::{Mesh, MeshMotion, MotionMode, MotionSettings};

fn square(divisions: usize) -> Mesh<2> {
    let square = RectangleMesh {
        origin: [0.0; 2],
        size: [1.0; 2],
        divisions: [divisions; 2],
        pattern: Diagonal::Crossed,
    };
    rectangle(&square).expect("a square can be meshed")
}

fn motion(criterion: &mut Criterion) {
    for divisions in [13, 86] {
        let mesh = square(divisions);
        let prescribed = prescribed_dofs(&mesh, &[]).expect("no sliding");
        let settings = MotionSettings { mode: MotionMode::Incremental, ..MotionSettings::default() };
        let mut motion = MeshMotion::new(&mesh, settings, &prescribed).expect("a held mesh");
        let committed = vec![0.0; 2 * mesh.points().len()];
        let given = mesh.points().iter().flat_map(|[x, y]| [0.0, 0.1 * x * (1.0 - x) * (1.0 - y)]);
        let mut displacement: Vec<f64> = given.collect();

        let mut group = criterion.benchmark_group(format!("motion/{}_dofs", displacement.len()));
        group.bench_function("assemble_and_factor", |bencher| {
            bencher.iter(|| motion.begin_step(black_box(&committed)).expect("valid"));
        });
        group.bench_function("displace", |bencher| {
            bencher.iter(|| motion.displace(&committed, black_box(&mut displacement)).expect("finite"));
        });
        group.bench_function("check", |bencher| {
            bencher.iter(|| motion.check(black_box(&displacement)).expect("valid"));
        });
        group.finish();
    }
}

criterion_group!(benches, motion);
criterion_main!(benches);
