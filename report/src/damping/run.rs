//! The runs behind the rows.

use partita::scene::schema::{Scene, StructureTimeScheme};

use super::case::{CASES, Case};
use super::row::{RADII, Radius, Row};
use super::series::{Series, distance, sampled, second_difference};
use crate::csv::Csv;
use crate::run::Run;
use crate::runs::Runs;
use crate::task::TaskError;

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

/// Runs all cases in one batch, so that cases with the same reference share its runs.
pub(super) fn all(runs: &Runs) -> Result<Vec<Row>, TaskError> {
    let (wanted, steps): (Vec<Run<'static>>, Vec<(&Case, usize)>) = CASES
        .iter()
        .flat_map(|case| runs_of(case).into_iter().map(move |(finer, run)| (run, (case, finer))))
        .unzip();
    let (outcomes, _) = runs.all(&wanted)?;
    let mut read = Vec::new();
    for ((run, outcome), (case, finer)) in wanted.iter().zip(&outcomes).zip(steps) {
        outcome.converged(run)?;
        let radius = spectral_radius(&run.resolved(&runs.root)?.scene)?;
        read.push(measured(case, finer, &outcome.probes()?, radius)?);
    }
    let each = read.chunks(read.len() / CASES.len());
    Ok(CASES.iter().zip(each).flat_map(|(case, outcomes)| rows_of(case, outcomes)).collect())
}

/// The fine runs of a case, which take longest, then a coarse one for each radius; each with its steps in a coarse one.
fn runs_of(case: &Case) -> Vec<(usize, Run<'static>)> {
    let fine = [REFERENCE, OTHER].map(|radius| (case.finer, run(case, case.finer, Some(radius))));
    let coarse = RADII.iter().filter_map(|radius| match radius {
        Radius::Given(value) => Some((1, run(case, 1, Some(*value)))),
        Radius::Default => Some((1, run(case, 1, None))),
        Radius::Reference => None,
    });
    fine.into_iter().chain(coarse).collect()
}

/// The rows of a case from the outcomes of its runs.
fn rows_of(case: &Case, outcomes: &[Outcome]) -> Vec<Row> {
    let [reference, other, coarse @ ..] = outcomes else { unreachable!("two fine runs come first") };
    let mut coarse = coarse.iter();
    let row_of = |radius| match radius {
        Radius::Reference => {
            let apart = row(case, radius, other, reference);
            let measured = row(case, radius, reference, reference);
            Row { second_difference: measured.second_difference, value: measured.value, ..apart }
        }
        Radius::Given(_) | Radius::Default => {
            row(case, radius, coarse.next().expect("a run for each radius"), reference)
        }
    };
    RADII.into_iter().map(row_of).collect()
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

/// A run with `finer` steps in each coarse one.
fn run(case: &Case, finer: usize, radius: Option<f64>) -> Run<'static> {
    let scheme = match radius {
        Some(radius) => format!("structure.time_scheme={{generalized_alpha={{spectral_radius={radius:?}}}}}"),
        None => "structure.time_scheme=generalized_alpha".to_owned(),
    };
    let time =
        [format!("time.step={:?}", case.step / finer as f64), format!("time.steps={}", case.steps * finer)];
    let coarse = if finer == 1 { case.coarse } else { &[] };
    let name = format!("{}: {} steps, {scheme}", case.name, case.steps * finer);
    Run::new(name, case.scene).with(case.set).with(coarse).with(&[scheme]).with(&time)
}

/// What is measured of a run, sampled at the ends of the coarse steps.
fn measured(case: &Case, finer: usize, probes: &Csv, radius: f64) -> Result<Outcome, TaskError> {
    let of = |names| Ok::<Series, TaskError>(sampled(&probes.vectors(names)?, finer));
    let force = case.coupled.then(|| of(["load_force_x", "load_force_y"])).transpose()?;
    let tip = of(["tip_displacement_x", "tip_displacement_y"])?;
    if tip.len() != case.steps {
        return Err(TaskError::Failed(format!("{}: {} of {} steps", case.name, tip.len(), case.steps)));
    }
    Ok(Outcome { tip, force, radius })
}

fn spectral_radius(scene: &Scene) -> Result<f64, TaskError> {
    match scene.structure.as_ref().map(|structure| &structure.time_scheme) {
        Some(StructureTimeScheme::GeneralizedAlpha { spectral_radius }) => Ok(spectral_radius.get()),
        _ => Err(TaskError::Failed("the structure has no spectral radius".to_owned())),
    }
}
