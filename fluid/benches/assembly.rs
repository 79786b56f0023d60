//! Residual and tangent of the fluid alone, in time per triangle: 400 triangles, as the tank of the paper has, and 19 600.
//!
//! ```text
//! cargo bench -p partita-fluid --bench assembly
//! ```
//!
//! criterion prints elements a second; the reciprocal is the time a triangle.

mod tank;

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use partita_numerics::newton::Problem;
use tank::tank;

fn assembly(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("assembly");
    for divisions in [10, 70] {
        let mut fluid = tank(divisions);
        let triangles = fluid.mesh().cells().len();
        group.throughput(Throughput::Elements(triangles as u64));
        for (part, with_tangent) in [("residual and tangent", true), ("residual", false)] {
            let id = BenchmarkId::new(part, format!("{triangles} triangles"));
            group.bench_function(id, |bencher| bencher.iter(|| fluid.assemble(with_tangent)));
        }
    }
    group.finish();
}

criterion_group!(benches, assembly);
criterion_main!(benches);
