//! The runs behind the rows.

use std::path::{Path, PathBuf};
use std::process::Command;

use serde::Deserialize;

use super::case::{CASES, Case};
use super::row::{RADII, Radius, Row};
use super::series::{Series, distance, sampled, second_difference};
use crate::csv::Csv;
use crate::task::{self, TaskError};

/// Radius of the references, and the other one that shows whether they depend on it.
const REFERENCE: f64 = 0.5;
const OTHER: f64 = 0.2;

/// Displacement of the tip and, where there is a fluid, the force on the structure, at the common times.
struct Outcome {
    tip: Series,
    force: Option<Series>,
    /// The radius that the run had.
    radius: f64,
}

/// What is read of the scene that a run writes, with its defaults written out.
#[derive(Deserialize)]
struct Scene {
    structure: Structure,
}

#[derive(Deserialize)]
struct Structure {
    time_scheme: TimeScheme,
}

#[derive(Deserialize)]
struct TimeScheme {
    generalized_alpha: GeneralizedAlpha,
}

#[derive(Deserialize)]
struct GeneralizedAlpha {
    spectral_radius: f64,
}

/// Runs all cases.
pub(super) fn all(root: &Path) -> Result<Vec<Row>, TaskError> {
    let binary = task::release_binary(root)?;
    let folder = binary.parent().and_then(Path::parent).expect("target/release/partita").join("damping");
    task::remove_folder(&folder)?;
    let runner = Runner { root, binary, folder };
    let mut references: Vec<(&Case, [Outcome; 2])> = Vec::new();
    let mut rows = Vec::new();
    for case in &CASES {
        if !references.iter().any(|(other, _)| case.shares_the_reference_of(other)) {
            let fine = |radius| runner.outcome(case, case.finer, Some(radius));
            references.push((case, [fine(REFERENCE)?, fine(OTHER)?]));
        }
        let known = references.iter().find(|(other, _)| case.shares_the_reference_of(other));
        let [reference, other] = known.map(|(_, both)| both).expect("it has just been run");
        for radius in RADII {
            let given = |radius| runner.outcome(case, 1, radius);
            let row = match radius {
                Radius::Given(value) => row(case, radius, &given(Some(value))?, reference),
                Radius::Default => row(case, radius, &given(None)?, reference),
                Radius::Reference => {
                    let apart = row(case, radius, other, reference);
                    let measured = row(case, radius, reference, reference);
                    Row { second_difference: measured.second_difference, value: measured.value, ..apart }
                }
            };
            println!("{}", row.shown());
            rows.push(row);
        }
    }
    Ok(rows)
}

fn row(case: &Case, radius: Radius, run: &Outcome, reference: &Outcome) -> Row {
    let forces = run.force.as_ref().zip(reference.force.as_ref());
    Row {
        case: case.name.to_owned(),
        radius,
        value: run.radius,
        second_difference: run.force.as_deref().map(second_difference),
        displacement_error: distance(&run.tip, &reference.tip),
        force_error: forces.map(|(run, reference)| distance(run, reference)),
    }
}

struct Runner<'a> {
    root: &'a Path,
    binary: PathBuf,
    folder: PathBuf,
}

impl Runner<'_> {
    /// One run with `finer` steps in each coarse one, sampled at the coarse ones' ends.
    fn outcome(&self, case: &Case, finer: usize, radius: Option<f64>) -> Result<Outcome, TaskError> {
        let dir = self.folder.join("run");
        task::remove_folder(&dir)?;
        let scheme = match radius {
            Some(radius) => {
                format!("structure.time_scheme={{generalized_alpha={{spectral_radius={radius:?}}}}}")
            }
            None => "structure.time_scheme=generalized_alpha".to_owned(),
        };
        let time = [
            format!("time.step={:?}", case.step / finer as f64),
            format!("time.steps={}", case.steps * finer),
        ];
        let coarse = if finer == 1 { case.coarse } else { &[] };
        let mut command = Command::new(&self.binary);
        command.current_dir(self.root).args(["run", case.scene, "--quiet", "--out"]).arg(&dir);
        let fixed = case.set.iter().chain(coarse).copied();
        for set in fixed.chain([scheme.as_str()]).chain(time.iter().map(String::as_str)) {
            command.arg("--set").arg(set);
        }
        eprintln!("{}: {} steps, {scheme}", case.name, case.steps * finer);
        task::captured(command)?;
        let probes = Csv::read(&dir.join("probes.csv"))?;
        let of = |names: [&str; 2]| -> Result<Series, TaskError> {
            let all = probes.rows().map(|row| Ok([row.value(names[0])?, row.value(names[1])?]));
            Ok(sampled(&all.collect::<Result<Series, TaskError>>()?, finer))
        };
        let force = case.coupled.then(|| of(["load_force_x", "load_force_y"])).transpose()?;
        let tip = of(["tip_displacement_x", "tip_displacement_y"])?;
        if tip.len() != case.steps {
            return Err(TaskError::Failed(format!("{}: {} of {} steps", case.name, tip.len(), case.steps)));
        }
        Ok(Outcome { tip, force, radius: spectral_radius(&dir.join("scene.toml"))? })
    }
}

fn spectral_radius(path: &Path) -> Result<f64, TaskError> {
    let scene: Scene = toml::from_str(&task::read(path)?)
        .map_err(|error| TaskError::Failed(format!("{}: {error}", path.display())))?;
    Ok(scene.structure.time_scheme.generalized_alpha.spectral_radius)
}
