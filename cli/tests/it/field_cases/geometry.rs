//! Structures that only look whole, held or in place.

#![allow(clippy::float_cmp, reason = "what is held is zero, and what is joined the same, to the last bit")]

mod corner;
mod knots;
mod overlap;
mod parts;
mod ring;

use super::Case;
use crate::program::Outcome;

/// Runs a scene of a case into `out`, which must succeed.
fn run(case: &Case, scene: &str, out: &str, more: &[&str]) -> Outcome {
    let outcome = case.partita(&[&["run", scene, "--out", out, "--force", "--quiet"], more].concat());
    assert_eq!(outcome.code, 0, "{}", outcome.stderr);
    outcome
}

/// The message of a scene that `check` refuses, its line breaks and frames taken out.
fn refusal(case: &Case, scene: &str, more: &[&str]) -> String {
    let outcome = case.partita(&[&["check", scene], more].concat());
    assert_eq!(outcome.code, 2, "{}{}", outcome.stdout, outcome.stderr);
    unwrapped(&outcome.stderr)
}

/// A message without its frame and line breaks.
fn unwrapped(message: &str) -> String {
    message.replace(['│', '\n'], " ").split_whitespace().collect::<Vec<_>>().join(" ")
}

/// What `check` warns of in a sound scene: the lines of this name.
fn warnings(case: &Case, scene: &str, name: &str, more: &[&str]) -> Vec<String> {
    let outcome = case.partita(&[&["check", scene], more].concat());
    assert_eq!(outcome.code, 0, "{}", outcome.stderr);
    assert!(outcome.stdout.contains("scene is sound"), "{}", outcome.stdout);
    let named = |line: &&str| line.ends_with(&format!("[{name}]"));
    outcome.stderr.lines().filter(named).map(str::to_owned).collect()
}
