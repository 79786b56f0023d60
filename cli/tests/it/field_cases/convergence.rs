//! What stops a run, or lets it pass, at the limits of the arithmetic.

mod backflow;
mod idle;
mod lid;
mod outlets;
mod rest;
mod resume;
mod secants;
mod slender;
mod stall;
mod times;
mod wrong_file;

use super::Case;
use crate::program::Outcome;

impl Case {
    /// Runs `scene.toml` into `out`, in place of an earlier run, with these overrides.
    fn run_with(&self, out: &str, sets: &[&str]) -> Outcome {
        let overrides = sets.iter().flat_map(|set| ["--set", set]);
        let arguments = ["run", "scene.toml", "--force", "--out", out].into_iter().chain(overrides);
        self.partita(&arguments.collect::<Vec<_>>())
    }
}

/// What a run wrote to stderr, without the breaks and bars of the terminal.
fn plain(outcome: &Outcome) -> String {
    let words = outcome.stderr.split_whitespace().filter(|word| !["×", "│"].contains(word));
    words.collect::<Vec<_>>().join(" ")
}
