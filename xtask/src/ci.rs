//! All that CI runs, in its order.

use std::path::Path;
use std::time::Instant;

use crate::task::{TaskError, built, cargo, run as run_command, shown};
use crate::tidy;

/// How one check is done.
enum Check {
    /// A cargo command, with an environment variable if it needs one.
    Cargo(&'static [&'static str], Option<(&'static str, &'static str)>),
    /// A task of this program.
    Task(&'static str, fn(&Path) -> Result<(), TaskError>),
}

/// The tests come first: they are what the README tells a reader to run. All checks share the dev profile, so the heavy
/// dependencies are compiled once.
const CHECKS: [(&str, Check); 6] = [
    ("test", Check::Cargo(&["test", "--workspace"], None)),
    ("fmt", Check::Cargo(&["fmt", "--all", "--check"], None)),
    ("clippy", Check::Cargo(&["clippy", "--workspace", "--all-targets", "--", "-D", "warnings"], None)),
    ("doc", Check::Cargo(&["doc", "--workspace", "--no-deps"], Some(("RUSTDOCFLAGS", "-D warnings")))),
    ("tidy", Check::Task("cargo xtask tidy", tidy::run)),
    ("report", Check::Task("partita-report check, in the dev profile", report)),
];

/// The names by which a check can be skipped.
pub(crate) fn names() -> impl Iterator<Item = &'static str> {
    CHECKS.iter().map(|(name, _)| *name)
}

/// Runs each check that is not skipped and stops at the first that fails.
pub(crate) fn run(root: &Path, skip: &[&str]) -> Result<(), TaskError> {
    let start = Instant::now();
    for (name, check) in CHECKS.iter().filter(|(name, _)| !skip.contains(name)) {
        let begun = Instant::now();
        perform(root, check)?;
        println!("== {name}: passed in {:.1} s\n", begun.elapsed().as_secs_f64());
    }
    println!("== all passed in {:.1} s", start.elapsed().as_secs_f64());
    Ok(())
}

/// Checks the pages, and the first steps of the paper's cases, by the programs as the tests have built them. The tests are
/// named because they decide about the features of the dependencies.
fn report(root: &Path) -> Result<(), TaskError> {
    run_command(cargo(root, &["build", "--workspace", "--bins", "--tests"]))?;
    let program = built("debug", "partita")?;
    let mut command = built("debug", "partita-report")?;
    command.current_dir(root).args(["check", "--program"]).arg(program.get_program());
    run_command(command)
}

fn perform(root: &Path, check: &Check) -> Result<(), TaskError> {
    match check {
        Check::Cargo(arguments, variable) => {
            let mut command = cargo(root, arguments);
            command.envs(*variable);
            let prefix = variable.map_or(String::new(), |(name, value)| format!("{name}=\"{value}\" "));
            println!("== {prefix}{}", shown(&command));
            run_command(command)
        }
        Check::Task(line, task) => {
            println!("== {line}");
            task(root)
        }
    }
}
