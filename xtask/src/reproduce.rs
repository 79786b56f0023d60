//! Published runs, repeated with the release binary.
//!
//! A run is a scene and settings on its command line; what comes back is the `summary.json` of its output folder.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::process::Command;

use serde::Deserialize;

use crate::task::{TaskError, captured, cargo, run};

/// Steps of a quick reproduction.
const QUICK_STEPS: usize = 5;

/// Newton iterations a solver call may take.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Limit {
    AtMost(usize),
    ToConvergence,
}

impl Limit {
    /// As a scene file says it.
    fn in_scene(self) -> String {
        match self {
            Self::AtMost(count) => count.to_string(),
            Self::ToConvergence => "unlimited".to_owned(),
        }
    }

    /// As the paper's tables say it.
    fn in_table(self) -> String {
        match self {
            Self::AtMost(count) => count.to_string(),
            Self::ToConvergence => "inf".to_owned(),
        }
    }
}

/// The limits (N^f, N^s) of one run.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Setting {
    fluid: Limit,
    structure: Limit,
}

const QUICK_SETTINGS: [Setting; 4] = [
    Setting { fluid: Limit::AtMost(1), structure: Limit::AtMost(1) },
    Setting { fluid: Limit::ToConvergence, structure: Limit::ToConvergence },
    Setting { fluid: Limit::AtMost(2), structure: Limit::AtMost(3) },
    Setting { fluid: Limit::ToConvergence, structure: Limit::AtMost(1) },
];

/// What is read of a run's `summary.json`.
#[derive(Debug, Deserialize)]
struct Summary {
    converged: bool,
    steps: usize,
    coupling_iterations: usize,
    newton_fluid: usize,
    newton_structure: usize,
    wall_seconds: f64,
}

/// Runs the first steps of the tank at four settings; a step that does not converge is a failure.
pub(crate) fn quick(root: &Path) -> Result<(), TaskError> {
    let binary = build(root)?;
    let folder = results_folder(&binary).join("quick");
    if folder.exists() {
        std::fs::remove_dir_all(&folder)
            .map_err(|source| TaskError::File { path: folder.clone(), source })?;
    }
    let mut runs = Vec::new();
    for setting in QUICK_SETTINGS {
        runs.push((setting, run_scene(root, &binary, "elastic-bottom", setting, QUICK_STEPS, &folder)?));
    }
    println!("elastic-bottom, {QUICK_STEPS} steps\n\n{}", table(&runs));
    judge(&runs, QUICK_STEPS)
}

/// Builds the release binary and returns its path.
fn build(root: &Path) -> Result<PathBuf, TaskError> {
    let arguments = ["build", "--release", "--package", "partita", "--bin", "partita"];
    let mut command = cargo(root, &arguments);
    command.arg("--message-format=json-render-diagnostics");
    executable(&captured(command)?)
        .ok_or_else(|| TaskError::Failed("cargo built no binary of the package partita".to_owned()))
}

/// The path in the last of cargo's messages that names an executable.
fn executable(messages: &str) -> Option<PathBuf> {
    #[derive(Deserialize)]
    struct Message {
        executable: Option<PathBuf>,
    }
    messages.lines().rev().find_map(|line| serde_json::from_str::<Message>(line).ok()?.executable)
}

/// `target/reproduce`, beside the profile's folder that holds the binary.
fn results_folder(binary: &Path) -> PathBuf {
    let target = binary.parent().and_then(Path::parent).expect("cargo puts a binary into target/<profile>");
    target.join("reproduce")
}

fn run_scene(
    root: &Path,
    binary: &Path,
    scene: &str,
    setting: Setting,
    steps: usize,
    folder: &Path,
) -> Result<Summary, TaskError> {
    let (fluid, structure) = (setting.fluid, setting.structure);
    let out = folder.join(format!("{scene}-{}-{}", fluid.in_table(), structure.in_table()));
    let mut command = Command::new(binary);
    command.current_dir(root).arg("run").arg(format!("scenes/{scene}"));
    command.arg("--set").arg(format!("coupling.newton.fixed.fluid={}", fluid.in_scene()));
    command.arg("--set").arg(format!("coupling.newton.fixed.structure={}", structure.in_scene()));
    command.args(["--steps", &steps.to_string(), "--quiet", "--out"]).arg(&out);
    run(command)?;
    read_summary(&out.join("summary.json"))
}

fn read_summary(path: &Path) -> Result<Summary, TaskError> {
    let text =
        std::fs::read_to_string(path).map_err(|source| TaskError::File { path: path.to_owned(), source })?;
    serde_json::from_str(&text).map_err(|error| TaskError::Failed(format!("{}: {error}", path.display())))
}

fn table(runs: &[(Setting, Summary)]) -> String {
    let mut text = format!(
        "{:>4} {:>4} {:>9} {:>13} {:>17} {:>13} {:>8}\n",
        "N^f", "N^s", "coupling", "Newton fluid", "Newton structure", "Newton total", "seconds"
    );
    for (Setting { fluid, structure }, summary) in runs {
        let total = summary.newton_fluid + summary.newton_structure;
        let mark = if summary.converged { "" } else { "  not converged" };
        writeln!(
            text,
            "{:>4} {:>4} {:>9} {:>13} {:>17} {:>13} {:>8.2}{mark}",
            fluid.in_table(),
            structure.in_table(),
            summary.coupling_iterations,
            summary.newton_fluid,
            summary.newton_structure,
            total,
            summary.wall_seconds,
        )
        .expect("a String takes any text");
    }
    text
}

/// Every run has to have done all its steps, each to tolerance.
fn judge(runs: &[(Setting, Summary)], steps: usize) -> Result<(), TaskError> {
    let wrong: Vec<String> = runs
        .iter()
        .filter(|(_, summary)| !summary.converged || summary.steps != steps)
        .map(|(setting, summary)| {
            let (fluid, structure) = (setting.fluid.in_table(), setting.structure.in_table());
            let state = if summary.converged { "every one converged" } else { "not every one converged" };
            format!("({fluid}, {structure}): {} of {steps} steps, {state}", summary.steps)
        })
        .collect();
    if wrong.is_empty() { Ok(()) } else { Err(TaskError::Failed(wrong.join("\n"))) }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn summary(converged: bool, steps: usize) -> Summary {
        let text = format!(
            r#"{{"converged":{converged},"steps":{steps},"coupling_iterations":62,"newton_fluid":62,
                "newton_structure":61,"wall_seconds":0.25,"cpu_seconds":0.24,"seconds":{{"fluid":0.1}}}}"#
        );
        serde_json::from_str(&text).expect("a summary")
    }

    #[test]
    fn an_unconverged_or_short_run_is_a_failure() {
        let runs = |converged, steps| {
            [(QUICK_SETTINGS[0], summary(true, 5)), (QUICK_SETTINGS[3], summary(converged, steps))]
        };
        assert!(judge(&runs(true, 5), 5).is_ok());
        let error = judge(&runs(false, 5), 5).expect_err("one step is unconverged").to_string();
        assert_eq!(error, "(inf, 1): 5 of 5 steps, not every one converged");
        assert!(judge(&runs(true, 4), 5).is_err());
    }

    #[test]
    fn the_table_has_a_line_a_run() {
        let text = table(&[(QUICK_SETTINGS[1], summary(true, 5)), (QUICK_SETTINGS[2], summary(false, 5))]);
        let lines: Vec<Vec<&str>> = text.lines().map(|line| line.split_whitespace().collect()).collect();
        assert_eq!(lines[1], ["inf", "inf", "62", "62", "61", "123", "0.25"]);
        assert_eq!(lines[2], ["2", "3", "62", "62", "61", "123", "0.25", "not", "converged"]);
    }

    #[test]
    fn the_binary_is_the_last_executable_that_cargo_names() {
        let messages = "{\"reason\":\"compiler-artifact\",\"executable\":null}\n\
                        {\"reason\":\"compiler-artifact\",\"executable\":\"target/release/partita\"}\n\
                        {\"reason\":\"build-finished\",\"success\":true}\n";
        assert_eq!(executable(messages), Some(PathBuf::from("target/release/partita")));
        assert_eq!(executable("{\"reason\":\"build-finished\",\"success\":true}\n"), None);
    }
}
