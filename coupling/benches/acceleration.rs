//! What one proposal costs, by method and interface size, with the columns of a run in full swing.

use std::hint::black_box;

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use partita_coupling::{Acceleration, Accelerator, Answer, QuasiNewton};

/// Steps made before the measured one.
const STEPS: usize = 5;
/// Coupling iterations of each step, and of the measured one before the measured proposal.
const ITERATIONS: usize = 8;

/// Residual of a coupled problem in which the modes of the interface converge at different speed.
fn residual(x: &[f64], step: usize) -> Vec<f64> {
    let mode = |i: usize| -4.0 / (1.0 + i as f64) - 0.3 * ((i * i) as f64).sin().abs();
    let load = |i: usize| (0.37 * i as f64).sin() / (1.0 + i as f64).sqrt() * (1.0 + 0.1 * step as f64);
    (0..x.len())
        .map(|i| {
            let neighbour = x[(i + 1) % x.len()];
            load(i) + (mode(i) - 1.0) * x[i] - 0.2 * neighbour - 0.05 * (x[i] * neighbour).sin()
        })
        .collect()
}

fn iterate(accelerator: &mut dyn Accelerator, size: usize, step: usize) -> (Vec<f64>, Vec<f64>) {
    let mut x = vec![0.0; size];
    for _ in 0..ITERATIONS {
        let r = residual(&x, step);
        accelerator.propose(&mut x, &r, Answer::default());
    }
    let r = residual(&x, step);
    (x, r)
}

fn proposals(c: &mut Criterion) {
    let quasi_newton = QuasiNewton { history: Some(STEPS), ..QuasiNewton::default() };
    let methods = [
        ("constant", Acceleration::Constant { omega: 0.1 }, usize::MAX),
        ("aitken", Acceleration::Aitken { omega_0: 0.1 }, usize::MAX),
        ("iqn_ils", Acceleration::IqnIls(quasi_newton), usize::MAX),
        ("iqn_imvls", Acceleration::IqnImvls(quasi_newton), usize::MAX),
        ("iqn_mvj", Acceleration::IqnMvj(QuasiNewton { history: None, ..quasi_newton }), 1000),
    ];
    let mut group = c.benchmark_group("propose");
    group.sample_size(20);
    for size in [100, 1_000, 10_000] {
        group.throughput(Throughput::Elements(size as u64));
        for (name, method, largest) in methods {
            if size > largest {
                continue;
            }
            let mut accelerator = method.build(size).expect("valid settings");
            for step in 0..STEPS {
                let (x, r) = iterate(accelerator.as_mut(), size, step);
                accelerator.step_converged(&x, &r, Answer::default());
            }
            // Every sample starts from the same iterate: the columns of this step are made anew, unmeasured.
            group.bench_function(BenchmarkId::new(name, size), |bench| {
                bench.iter_batched_ref(
                    || {
                        let mut fresh = method.build(size).expect("valid settings");
                        fresh.restore(&accelerator.save()).expect("its own state");
                        let (x, r) = iterate(fresh.as_mut(), size, STEPS);
                        (fresh, x, r)
                    },
                    |(fresh, x, r)| black_box(fresh.propose(x, r, Answer::default())),
                    criterion::BatchSize::LargeInput,
                );
            });
        }
    }
    group.finish();
}

criterion_group!(benches, proposals);
criterion_main!(benches);
