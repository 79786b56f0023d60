//! The runs behind the rows.

use std::path::Path;
use std::process::Command;

use serde::Deserialize;

use super::family::{self, Member, WHOLE};
use super::row::Row;
use crate::csv::Csv;
use crate::task::{self, TaskError};

/// The effects of physics among those of `partita plan`, in the order of the page.
const PHYSICS: [&str; 8] = [
    "fluid",
    "fluid inertia",
    "convection",
    "mesh motion",
    "structure",
    "structural inertia",
    "geometric nonlinearity",
    "coupling",
];

/// What is read of a run's `summary.json`.
#[derive(Debug, Deserialize)]
struct Summary {
    steps: usize,
    converged: bool,
    fluid: Work,
    structure: Work,
    seconds: Seconds,
}

#[derive(Debug, Deserialize)]
struct Work {
    assemblies: usize,
    factorizations: usize,
    mesh_factorizations: usize,
}

#[derive(Debug, Deserialize)]
struct Seconds {
    fluid: f64,
    structure: f64,
    mesh_motion: f64,
    transfer: f64,
    acceleration: f64,
}

/// A finished run.
struct Outcome {
    effects: String,
    summary: Summary,
    /// Displacement of the tip at every step; zero where the beam is rigid.
    tip: Vec<[f64; 2]>,
    load: Vec<[f64; 2]>,
}

/// Runs all members, one after the other so that each has the machine to itself.
pub(super) fn family(root: &Path) -> Result<Vec<Row>, TaskError> {
    let binary = task::release_binary(root)?;
    let folder = binary.parent().and_then(Path::parent).expect("target/release/partita").join("effects");
    task::remove_folder(&folder)?;
    let members = family::all();
    let mut outcomes = Vec::new();
    for (index, member) in members.iter().enumerate() {
        eprintln!("{}", member.name);
        outcomes.push(outcome(root, &binary, member, &folder.join(index.to_string()))?);
    }
    let whole = members.iter().position(|member| member.name == WHOLE).expect("it is a member");
    let row = |(member, outcome): (&Member, &Outcome)| row(member, outcome, &outcomes[whole]);
    Ok(members.iter().zip(&outcomes).map(row).collect())
}

fn row(member: &Member, Outcome { effects, summary, tip, load }: &Outcome, whole: &Outcome) -> Row {
    let Seconds { fluid, structure, mesh_motion, transfer, acceleration } = summary.seconds;
    let seconds = fluid + structure + mesh_motion + transfer + acceleration;
    let fields = [&summary.fluid, &summary.structure];
    Row {
        name: member.name.to_owned(),
        effects: effects.clone(),
        seconds_per_step: format!("{:.5}", seconds / summary.steps.max(1) as f64),
        factorizations: fields.iter().map(|field| field.factorizations + field.mesh_factorizations).sum(),
        assemblies: fields.iter().map(|field| field.assemblies).sum(),
        error: format!("{:.3e}", distance(tip, &whole.tip)),
        load_error: format!("{:.3e}", distance(load, &whole.load)),
    }
}

/// `max |a - b| / max |b|` over the steps.
fn distance(a: &[[f64; 2]], b: &[[f64; 2]]) -> f64 {
    let largest = |vectors: &mut dyn Iterator<Item = [f64; 2]>| {
        vectors.fold(0.0, |largest: f64, [x, y]| largest.max(x.hypot(y)))
    };
    let apart = largest(&mut a.iter().zip(b).map(|(a, b)| [a[0] - b[0], a[1] - b[1]]));
    apart / largest(&mut b.iter().copied())
}

fn outcome(root: &Path, binary: &Path, member: &Member, dir: &Path) -> Result<Outcome, TaskError> {
    let program = |word: &str| {
        let mut command = Command::new(binary);
        command.current_dir(root).arg(word).arg(member.scene.file());
        for set in member.scene.settings().iter().chain(member.set) {
            command.arg("--set").arg(set);
        }
        command
    };
    let effects = effects(&task::captured(program("plan"))?);
    let mut command = program("run");
    command.arg("--quiet").arg("--out").arg(dir);
    task::run(command)?;
    let path = dir.join("summary.json");
    let summary: Summary = serde_json::from_str(&task::read(&path)?)
        .map_err(|error| TaskError::Failed(format!("{}: {error}", path.display())))?;
    if !summary.converged {
        return Err(TaskError::Failed(format!("{}: not every step converged", member.name)));
    }
    let (tip, load) = probes(&dir.join("probes.csv"))?;
    Ok(Outcome { effects, summary, tip, load })
}

/// The effects that run, from the table of `partita plan`.
fn effects(plan: &str) -> String {
    let running = |name: &&str| {
        let line = plan.lines().find_map(|line| line.strip_prefix(*name)?.strip_prefix("  "))?;
        match line.trim_start().split("  ").next()? {
            "no" => None,
            "yes" => Some((*name).to_owned()),
            how => Some(format!("{name} {how}")),
        }
    };
    PHYSICS.iter().filter_map(running).collect::<Vec<_>>().join(" + ")
}

type Series = Vec<[f64; 2]>;

fn probes(path: &Path) -> Result<(Series, Series), TaskError> {
    let table = Csv::read(path)?;
    let pair = |names: [&str; 2]| -> Result<Series, TaskError> {
        table.rows().map(|row| Ok([row.value(names[0])?, row.value(names[1])?])).collect()
    };
    let load = pair(["load_force_x", "load_force_y"])?;
    // A rigid beam has no tip to ask for: it stays where it is.
    let is_rigid = table.rows().next().is_none_or(|row| row.text("tip_displacement_x").is_err());
    let tip = if is_rigid {
        vec![[0.0; 2]; load.len()]
    } else {
        pair(["tip_displacement_x", "tip_displacement_y"])?
    };
    Ok((tip, load))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn effects_are_read_off_the_plan() {
        let plan = "A title\n\neffect         runs     why\n-------------  -------  ---\nfluid          yes      [fluid]\n\
                    fluid inertia  no       steady\nstructure      yes      x\ncoupling       one way  y\n";
        assert_eq!(effects(plan), "fluid + structure + coupling one way");
    }

    #[test]
    fn distances_are_relative_to_the_largest() {
        let (a, b) = ([[0.0, 0.0], [3.0, 0.0]], [[0.0, 0.0], [3.0, 4.0]]);
        assert!((distance(&a, &b) - 0.8).abs() < 1e-15);
        assert!((distance(&[[0.0; 2]; 2], &b) - 1.0).abs() < 1e-15);
    }
}
