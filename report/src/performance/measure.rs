//! Starts what is measured.

use std::path::Path;
use std::process::Command;

use super::Data;
use crate::program::{captured, cargo, run};
use crate::run::{Run, Stop, solving};
use crate::runs::Runs;
use crate::task::TaskError;

/// Divisions a side of the tank whose Newton iteration is taken apart: about 6 n^2 unknowns.
const PARTS: [usize; 5] = [10, 29, 70, 129, 223];
/// Those whose whole step and memory are measured.
const STEPS: [usize; 5] = [13, 41, 129, 223, 408];
/// Those whose iteration and whose step are measured for two threads, too.
const PARTS_OF_TWO: [usize; 3] = [70, 129, 223];
const STEPS_OF_TWO: [usize; 2] = [223, 408];
/// Up to here faer's LU is measured beside ours.
const FAER: usize = 129;
/// The paper's scenes, and the steps of each.
const SCENES: [(&str, usize); 2] = [("elastic-bottom", 20), ("beam-in-channel", 10)];

const fn about(divisions: usize) -> usize {
    6 * divisions * divisions
}

/// All measurements of sizes up to about `largest` unknowns.
pub(super) fn all(runs: &Runs, largest: usize) -> Result<Data, TaskError> {
    let root = &runs.root;
    let mut data = Data::new(machine(root)?);
    run(cargo(root, &["bench", "--package", "partita-fluid", "--bench", "performance", "--no-run"]))?;
    let fits = |divisions: &usize| about(*divisions) <= largest;
    for divisions in PARTS.into_iter().filter(fits) {
        let faer = if divisions <= FAER { &["faer"][..] } else { &[] };
        bench(root, &mut data, &[&["parts", &divisions.to_string()], faer].concat())?;
    }
    for divisions in STEPS.into_iter().filter(fits) {
        bench(root, &mut data, &["step", &divisions.to_string()])?;
    }
    for divisions in PARTS_OF_TWO.into_iter().filter(fits) {
        bench(root, &mut data, &["threads", &divisions.to_string()])?;
    }
    for divisions in STEPS_OF_TWO.into_iter().filter(fits) {
        bench(root, &mut data, &["step", &divisions.to_string(), "2"])?;
    }
    for (scene, steps) in SCENES {
        scene_steps(runs, &mut data, scene, steps)?;
    }
    Ok(data)
}

/// Runs the fluid's bench and adds its lines.
fn bench(root: &Path, data: &mut Data, words: &[&str]) -> Result<(), TaskError> {
    let command =
        cargo(root, &["bench", "--quiet", "--package", "partita-fluid", "--bench", "performance", "--"]);
    let mut command = command;
    command.args(words);
    let text = captured(command)?;
    print!("{text}");
    text.lines().try_for_each(|line| add(data, line))
}

/// Adds a line of the bench to the table it belongs to.
fn add(data: &mut Data, line: &str) -> Result<(), TaskError> {
    let cells: Vec<String> = line.split(',').map(str::to_owned).collect();
    match cells.len() {
        5 => data.times.push(cells),
        4 if cells[0] == "memory" => data.memory.push(cells[1..].to_vec()),
        _ => return Err(TaskError::Failed(format!("the bench says `{line}`, which is no measurement"))),
    }
    Ok(())
}

/// Mean time of the first steps of a scene, set-up and output left out.
fn scene_steps(runs: &Runs, data: &mut Data, scene: &str, steps: usize) -> Result<(), TaskError> {
    let path = format!("scenes/{scene}");
    let dofs = Run::new(scene, &path).unknowns(&runs.root)?;
    let summary = runs.one(&Run::new(scene, &path).without_fields().ending(Stop::After(steps)))?.summary;
    let milliseconds = 1e3 * solving(&summary.seconds) / summary.steps.max(1) as f64;
    let line = format!("step of {scene},{dofs},1,{milliseconds:.4},");
    println!("{line}");
    add(data, &line)
}

/// What the numbers were measured on, in a line.
fn machine(root: &Path) -> Result<String, TaskError> {
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    let described = std::fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
    let model = described.lines().find_map(|line| line.strip_prefix("model name")?.split_once(": "));
    let model = model.map_or("unknown processor", |(_, name)| name.trim());
    let mut rustc = Command::new(std::env::var_os("RUSTC").unwrap_or_else(|| "rustc".into()));
    rustc.current_dir(root).arg("--version");
    let version = captured(rustc)?;
    let version = version.split_whitespace().nth(1).unwrap_or("of unknown version");
    Ok(format!("{model}, {cores} cores, {}, Rust {version}\n", std::env::consts::OS))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_of_the_bench_find_their_tables() {
        let mut data = Data::new("A machine\n".to_owned());
        add(&mut data, "refactor,601,1,0.1234,4.500").expect("a time");
        add(&mut data, "memory,984,1.5,12.0").expect("a size");
        assert!(add(&mut data, "refactor,601").is_err() && add(&mut data, "a,b,c,d").is_err());
        assert_eq!((data.times.rows().count(), data.memory.rows().count()), (1, 1));
    }
}
