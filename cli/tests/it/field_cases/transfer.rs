//! Loads between meshes that do not match.

mod patch;

use super::Case;

/// Runs a scene of a case into `out` with these overrides, which must succeed.
#[track_caller]
fn run(case: &Case, scene: &str, out: &str, sets: &[&str]) {
    let sets = sets.iter().flat_map(|set| ["--set", set]);
    let arguments = ["run", scene, "--out", out, "--force", "--quiet"].into_iter().chain(sets);
    let outcome = case.partita(&arguments.collect::<Vec<_>>());
    assert_eq!(outcome.code, 0, "{}", outcome.stderr);
}
