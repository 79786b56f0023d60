//! One Newton iteration of the fluid and its parts, on the tank's mesh and on one fifty times as large.
//!
//! ```text
//! cargo bench -p partita-fluid
//! ```

#[path = "../../numerics/benches/alternating/mod.rs"]
mod alternating;
mod tank;

use partita_numerics::Field;
use std::hint::black_box;

use criterion::{BenchmarkId, Criterion, criterion_group, criterion_main};
use partita_numerics::newton::Problem;
use partita_numerics::{Factor, Method};

use tank::{displacement, tank};

fn newton_iteration(criterion: &mut Criterion) {
    for divisions in [10, 70] {
        let mut fluid = tank(divisions);
        let mut group = criterion.benchmark_group("fluid");
        let size = format!("{} dofs", fluid.values().len());
        let id = |part: &str| BenchmarkId::new(part, &size);
        group.sample_size(if divisions > 10 { 20 } else { 100 });
        group.bench_function(id("newton iteration"), |bencher| {
            bencher.iter(|| {
                black_box(fluid.assemble(true)).expect("an assembly");
                fluid.solve_and_update().expect("a solution");
            });
        });
        group.bench_function(id("residual and tangent"), |bencher| bencher.iter(|| fluid.assemble(true)));
        group.bench_function(id("residual"), |bencher| bencher.iter(|| fluid.assemble(false)));
        let (pattern, values) = fluid.tangent();
        let mut factor = Factor::new(Method::NodeBlockLu, pattern).expect("a pattern");
        group.bench_function(id("refactor"), |bencher| bencher.iter(|| factor.refactor(values)));
        let mut solution = vec![1.0; pattern.size()];
        group.bench_function(id("solve"), |bencher| {
            bencher.iter(|| {
                solution.fill(1.0);
                factor.solve(black_box(&mut solution));
            });
        });
        let moved = displacement(&fluid);
        group.bench_function(id("impose"), |bencher| bencher.iter(|| fluid.impose(black_box(&moved))));
        group.finish();
    }
}

/// Refactor and solve a tangent with faer's LU and with the one of the fluid, in turns.
fn against_faer(_: &mut Criterion) {
    println!("equations  faer [ms]  node blocks [ms]  ratio   (refactor and solve)");
    for (divisions, rounds) in [(10, 400), (29, 60), (70, 12)] {
        let mut fluid = tank(divisions);
        fluid.assemble(true).expect("an assembly");
        let (pattern, values) = fluid.tangent();
        let work = |method| {
            let mut factor = Factor::new(method, pattern).expect("a pattern");
            let mut solution = vec![1.0; pattern.size()];
            move || {
                factor.refactor(black_box(values)).expect("a regular tangent");
                solution.fill(1.0);
                factor.solve(black_box(&mut solution));
            }
        };
        let medians = alternating::alternate(rounds, work(Method::Lu), work(Method::NodeBlockLu));
        let (size, ratio) = (pattern.size(), medians.ratio());
        println!("{size:9}  {:9.3}  {:16.3}  {ratio:5.2}", medians.first, medians.second);
    }
}

criterion_group!(benches, against_faer, newton_iteration);
criterion_main!(benches);
