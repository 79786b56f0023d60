//! Two ways to the same result, timed in turns, so that a busy machine slows down both.

use std::time::Instant;

/// Medians of the milliseconds of each.
pub(crate) struct Medians {
    pub(crate) first: f64,
    pub(crate) second: f64,
}

impl Medians {
    /// How many times as long the first takes.
    pub(crate) fn ratio(&self) -> f64 {
        self.first / self.second
    }
}

/// Runs each once to warm up, then `rounds` times in turns.
pub(crate) fn alternate(rounds: usize, mut first: impl FnMut(), mut second: impl FnMut()) -> Medians {
    let milliseconds = |work: &mut dyn FnMut()| {
        let start = Instant::now();
        work();
        start.elapsed().as_secs_f64() * 1e3
    };
    first();
    second();
    let mut times: [Vec<f64>; 2] = [Vec::new(), Vec::new()];
    for _ in 0..rounds {
        times[0].push(milliseconds(&mut first));
        times[1].push(milliseconds(&mut second));
    }
    let [first, second] = times.map(|mut times| {
        times.sort_by(f64::total_cmp);
        times[times.len() / 2]
    });
    Medians { first, second }
}
