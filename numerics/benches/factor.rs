//! Assembly, factorization and solution at the sizes of the small case and of a fine mesh.

mod alternating;
#[path = "../tests/it/grid.rs"]
mod grid;

use std::hint::black_box;

use criterion::{BenchmarkId, Criterion, criterion_group, criterion_main};
use partita_numerics::{Connectivity, Factor, Method, Scatter};

use grid::{Flow, System};

const FLOW: Flow = Flow { viscosity: 1e-3, dt: 1e-2, velocity: [1.0, 0.5] };

/// The squares a side that give about 700 and about 30 000 equations.
fn grids(method: Method) -> [usize; 2] {
    match method {
        Method::Lu | Method::NodeBlockLu => [15, 99],
        Method::Llt | Method::Ldlt => [18, 122],
    }
}

/// The system a method is meant for, on a grid of `n` x `n` squares.
fn system(method: Method, n: usize) -> System {
    match method {
        Method::Lu | Method::NodeBlockLu => grid::flow(n, FLOW, true),
        Method::Llt | Method::Ldlt => grid::elasticity(n, 0.3, true),
    }
}

fn factorization(criterion: &mut Criterion) {
    for method in [Method::Lu, Method::NodeBlockLu, Method::Llt, Method::Ldlt] {
        for n in grids(method) {
            let System { pattern, values, .. } = system(method, n);
            let size = pattern.size();
            let mut factor = Factor::new(method, &pattern).expect("memory suffices");
            factor.refactor(&values).expect("the system is regular");
            let mut group = criterion.benchmark_group(format!("{method:?}"));
            group.bench_function(BenchmarkId::new("refactor", size), |bencher| {
                bencher.iter(|| factor.refactor(black_box(&values)));
            });
            let mut rhs = vec![1.0; size];
            group.bench_function(BenchmarkId::new("solve", size), |bencher| {
                bencher.iter(|| {
                    rhs.fill(1.0);
                    factor.solve(black_box(&mut rhs));
                });
            });
            group.finish();
        }
    }
}

fn assembly(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("assembly");
    for n in grids(Method::Lu) {
        let System { dofs, pattern, mut values } = system(Method::Lu, n);
        let triangles = Connectivity::from_nodes(3, &grid::triangles(n), 3);
        let scatter = Scatter::new(&pattern, &dofs, &triangles);
        let (x, mut y) = (vec![1.0; pattern.size()], vec![0.0; pattern.size()]);
        group.bench_function(BenchmarkId::new("multiply", pattern.size()), |bencher| {
            bencher.iter(|| pattern.multiply(black_box(&values), &x, &mut y));
        });
        let local = [1e-3; 81];
        group.bench_function(BenchmarkId::new("scatter", triangles.len()), |bencher| {
            bencher.iter(|| {
                for triangle in 0..triangles.len() {
                    scatter.add_matrix(triangle, black_box(&local), &mut values);
                }
            });
        });
    }
    group.finish();
}

fn analysis(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("analysis");
    for method in [Method::Lu, Method::NodeBlockLu, Method::Ldlt] {
        let System { pattern, .. } = system(method, grids(method)[1]);
        group.bench_function(BenchmarkId::new(format!("{method:?}"), pattern.size()), |bencher| {
            bencher.iter(|| Factor::new(method, black_box(&pattern)));
        });
    }
    group.finish();
}

/// Refactor and solve with both methods for LU, in turns.
fn against_faer(_: &mut Criterion) {
    println!("equations  faer [ms]  node blocks [ms]  ratio   (refactor and solve)");
    for (n, rounds) in [(15, 400), (41, 60), (99, 12), (182, 5)] {
        let System { pattern, values, .. } = grid::flow(n, FLOW, true);
        let work = |method| {
            let mut factor = Factor::new(method, &pattern).expect("memory suffices");
            let mut rhs = vec![1.0; pattern.size()];
            let values = &values;
            move || {
                factor.refactor(black_box(values)).expect("the system is regular");
                rhs.fill(1.0);
                factor.solve(black_box(&mut rhs));
            }
        };
        let medians = alternating::alternate(rounds, work(Method::Lu), work(Method::NodeBlockLu));
        let (size, ratio) = (pattern.size(), medians.ratio());
        println!("{size:9}  {:9.3}  {:16.3}  {ratio:5.2}", medians.first, medians.second);
    }
}

criterion_group! {
    name = benches;
    config = Criterion::default().sample_size(20);
    targets = against_faer, assembly, factorization, analysis
}
criterion_main!(benches);
