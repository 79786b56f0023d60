//! What `cargo xtask performance` asks of the fluid, one size in one process, so that the peak of memory is that of the size.
//!
//! ```text
//! cargo bench -p partita-fluid --bench performance -- parts 70 faer   # a Newton iteration, part by part
//! cargo bench -p partita-fluid --bench performance -- threads 70      # its factorization by two threads, beside one
//! cargo bench -p partita-fluid --bench performance -- step 70 2       # a whole time step, by two threads
//! ```
//!
//! The size is the number of divisions a side, n, for about 6 n^2 equations. Lines to stdout are
//! `part,dofs,threads,milliseconds,ratio_to_faer`, and `memory,dofs,factor_megabytes,peak_megabytes`.

#[path = "../../numerics/benches/alternating/mod.rs"]
mod alternating;
mod tank;
use partita_numerics::Field;

use std::hint::black_box;
use std::time::{Duration, Instant};

use partita_fluid::FluidSolver;
use partita_numerics::newton::{Limit, Problem};
use partita_numerics::{Factor, Method};

use alternating::alternate;
use tank::{displacement, tank, tank_for};

/// What one measurement may take.
const BUDGET: Duration = Duration::from_secs(3);

fn main() {
    // Cargo adds `--bench`.
    let words: Vec<String> = std::env::args().skip(1).filter(|word| word != "--bench").collect();
    let words: Vec<&str> = words.iter().map(String::as_str).collect();
    let size = |word: &str| word.parse().expect("a number of divisions");
    match words[..] {
        ["parts", divisions] => parts(size(divisions), false),
        ["parts", divisions, "faer"] => parts(size(divisions), true),
        ["threads", divisions] => threads(size(divisions)),
        ["step", divisions] => step(size(divisions), 1),
        ["step", divisions, threads] => step(size(divisions), size(threads)),
        _ => {
            eprintln!(
                "performance: say `parts N`, `parts N faer`, `threads N`, `step N` or `step N THREADS`"
            );
        }
    }
}

fn milliseconds(work: impl FnOnce()) -> f64 {
    let start = Instant::now();
    work();
    start.elapsed().as_secs_f64() * 1e3
}

fn row(part: &str, (dofs, threads): (usize, usize), milliseconds: f64, ratio: Option<f64>) {
    let ratio = ratio.map_or_else(String::new, |ratio| format!("{ratio:.3}"));
    println!("{part},{dofs},{threads},{milliseconds:.4},{ratio}");
}

/// Median of as many runs as fit into the budget, and at least three.
fn median(mut work: impl FnMut()) -> f64 {
    let rounds = rounds(milliseconds(&mut work));
    let mut times: Vec<f64> = (0..rounds).map(|_| milliseconds(&mut work)).collect();
    times.sort_by(f64::total_cmp);
    times[rounds / 2]
}

fn rounds(milliseconds: f64) -> usize {
    let fit = BUDGET.as_secs_f64() * 1e3 / milliseconds;
    (3..1000).take_while(|&rounds| f64::from(rounds) <= fit).count().max(3)
}

type Work = fn(&mut Contender);

/// A tank in its first step, and a factorization of its tangents.
struct Contender {
    fluid: FluidSolver<2>,
    factor: Factor,
    threads: usize,
    solution: Vec<f64>,
}

impl Contender {
    fn new(divisions: usize, method: Method, threads: usize) -> Self {
        let mut fluid = tank(divisions);
        fluid.assemble(true).expect("an assembly");
        let (pattern, _) = fluid.tangent();
        let factor = Factor::with_threads(method, pattern, threads).expect("memory suffices");
        let solution = vec![1.0; pattern.size()];
        Self { fluid, factor, threads, solution }
    }

    fn dofs(&self) -> usize {
        self.solution.len()
    }

    fn assemble(&mut self) {
        black_box(self.fluid.assemble(true)).expect("an assembly");
    }

    fn analyse(&mut self) {
        let (method, pattern) = (self.factor.method(), self.fluid.tangent().0);
        self.factor = Factor::with_threads(method, pattern, self.threads).expect("memory suffices");
    }

    fn refactor(&mut self) {
        self.factor.refactor(black_box(self.fluid.tangent().1)).expect("a regular tangent");
    }

    fn solve(&mut self) {
        self.solution.fill(1.0);
        self.factor.solve(black_box(&mut self.solution));
    }

    /// Without the update of the iterate, which would let one run into the next.
    fn newton_iteration(&mut self) {
        self.assemble();
        self.refactor();
        self.solve();
    }
}

/// What is compared.
const WORKS: [(&str, Work); 3] = [
    ("refactor", Contender::refactor),
    ("solve", Contender::solve),
    ("newton iteration", Contender::newton_iteration),
];

/// Assembly, analysis, factorization, solution, and a whole Newton iteration, beside faer's LU where asked for.
fn parts(divisions: usize, with_faer: bool) {
    let mut ours = Contender::new(divisions, Method::NodeBlockLu, 1);
    let mut faer = with_faer.then(|| Contender::new(divisions, Method::Lu, 1));
    let dofs = (ours.dofs(), 1);
    row("assembly", dofs, median(|| ours.assemble()), None);
    row("analysis", dofs, milliseconds(|| ours.analyse()), None);
    for (part, work) in WORKS {
        let (own, ratio) = match &mut faer {
            None => (median(|| work(&mut ours)), None),
            Some(faer) => {
                // Both in turns: what else the machine does slows down both.
                let once = milliseconds(|| work(&mut ours)) + milliseconds(|| work(faer));
                let medians = alternate(rounds(once), || work(faer), || work(&mut ours));
                (medians.second, Some(medians.ratio()))
            }
        };
        row(part, dofs, own, ratio);
    }
}

/// A factorization by one thread and by two, in turns.
fn threads(divisions: usize) {
    let [mut one, mut two] = [1, 2].map(|threads| Contender::new(divisions, Method::NodeBlockLu, threads));
    for (part, work) in WORKS {
        let once = milliseconds(|| work(&mut one)) + milliseconds(|| work(&mut two));
        let medians = alternate(rounds(once), || work(&mut one), || work(&mut two));
        row(part, (two.dofs(), 2), medians.second, None);
        eprintln!("{part}: {:.2} times as fast as by one thread, in turns", medians.ratio());
    }
}

/// A time step with a moving bottom, to convergence, and the memory it needs.
fn step(divisions: usize, threads: usize) {
    let mut fluid = tank_for(divisions, threads);
    let dofs = fluid.tangent().0.size();
    let moved = displacement(&fluid);
    let elapsed = milliseconds(|| {
        fluid.impose(&moved).expect("a motion");
        fluid.advance(Limit::ToConvergence).expect("convergence");
        fluid.commit();
    });
    row("fluid step", (dofs, threads), elapsed, None);
    if threads > 1 {
        // Memory is told of one thread, to compare with.
        return;
    }
    let megabytes =
        |bytes: Option<usize>| bytes.map_or_else(String::new, |bytes| format!("{:.1}", bytes as f64 / 1e6));
    println!("memory,{dofs},{},{}", megabytes(fluid.factor_bytes()), megabytes(peak_bytes()));
}

/// The largest memory of this process so far, where the system tells.
fn peak_bytes() -> Option<usize> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"))?;
    let kibibytes: usize = line.trim().strip_suffix("kB")?.trim_end().parse().ok()?;
    Some(1024 * kibibytes)
}
