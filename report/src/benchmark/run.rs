//! One level of a case: a run that may end where its signal repeats.

use std::path::{Path, PathBuf};

use partita::output::{self, Summary};

use super::case::{Case, Quantity, Take, Until};
use super::row::{Row, six_digits};
use super::signal::{last_period, last_period_with, repetition};
use super::signals::{self, Samples};
use crate::csv::Csv;
use crate::run::{Run, Stop};
use crate::runs::Runs;
use crate::task::TaskError;

/// What a level came to.
pub(super) struct Found {
    /// A row a quantity.
    pub(super) rows: Vec<Row>,
    /// The last periods of a case that has some.
    pub(super) samples: Option<Samples>,
    /// The folder of the run.
    pub(super) dir: PathBuf,
}

/// What comes out of a level.
pub(super) fn level(runs: &Runs, case: &Case, level: usize) -> Result<Found, TaskError> {
    let scene = case.scene.strip_prefix(&runs.root).unwrap_or(&case.scene).display().to_string();
    let reached = |out: &Path| {
        let probes = Csv::read(&out.join(output::PROBES))?;
        let until = case.until.as_ref();
        Ok(until.is_some_and(|until| repeats(&probes, until).is_some_and(|percent| percent < until.percent)))
    };
    let stop = case
        .until
        .as_ref()
        .map_or(Stop::AtTheEnd, |until| Stop::When { every: until.every, reached: &reached });
    let name = format!("{} level {level}", case.name);
    let run = Run::new(&name, scene).with(&case.set).with(&case.levels[level - 1]).ending(stop);
    eprintln!("{name}");
    let outcome = runs.one(&run)?;
    let (dofs, probes) = (run.unknowns(&runs.root)?, outcome.probes()?);
    let swings = case.quantities.iter().any(|quantity| quantity.take != Take::Last);
    let time = if swings { probes.numbers("time").and_then(|times| times.last().copied()) } else { None };
    let repeats = case.until.as_ref().and_then(|until| repeats(&probes, until));
    let lead = case.until.as_ref().map(|until| until.column.as_str());
    let rows = case.quantities.iter().map(|quantity| {
        let ours = take(&probes, quantity, lead)
            .map_err(|what| TaskError::Failed(format!("{name}, {}: {what}", quantity.name)))?;
        Ok(Row {
            simulated_seconds: time.map_or_else(String::new, six_digits),
            repeats_percent: repeats.map_or_else(String::new, |percent| format!("{percent:.2}")),
            ..row(case, level, quantity, ours, dofs, &outcome.summary)
        })
    });
    Ok(Found {
        rows: rows.collect::<Result<_, TaskError>>()?,
        samples: signals::last(case, &probes),
        dir: outcome.out.clone(),
    })
}

fn row(case: &Case, level: usize, quantity: &Quantity, ours: f64, dofs: usize, summary: &Summary) -> Row {
    let error = 100.0 * (ours - quantity.reference) / quantity.reference.abs();
    let coupled = summary.coupling_iterations as f64 / summary.steps.max(1) as f64;
    Row {
        case: case.name.clone(),
        level,
        quantity: quantity.name.clone(),
        reference: quantity.reference.to_string(),
        ours: six_digits(ours),
        error_percent: format!("{error:.3}"),
        target_percent: quantity.target_percent.to_string(),
        dofs,
        steps: summary.steps,
        cpu_seconds: summary.cpu_seconds.map_or_else(String::new, |seconds| format!("{seconds:.2}")),
        // A field alone takes one "iteration" a step.
        coupling_per_step: if coupled > 1.0 { format!("{coupled:.2}") } else { String::new() },
        simulated_seconds: String::new(),
        repeats_percent: String::new(),
    }
}

/// How well the last periods repeat each other \[%\]; `None` if there are too few.
fn repeats(probes: &Csv, until: &Until) -> Option<f64> {
    repetition(&probes.numbers("time")?, &probes.numbers(&until.column)?, until.periods)
}

/// The value of a quantity, in its own unit; where a column leads, over that one's last period.
fn take(probes: &Csv, quantity: &Quantity, lead: Option<&str>) -> Result<f64, String> {
    let column =
        |name: &str| probes.numbers(name).ok_or_else(|| format!("probes.csv has no column `{name}`"));
    let (times, values) = (column("time")?, column(&quantity.column)?);
    if quantity.take == Take::Last {
        let last = values.last().ok_or("the run has no steps")?;
        return Ok(quantity.scale * last);
    }
    let swing = match lead {
        Some(lead) => last_period_with(&times, &values, &column(lead)?),
        None => last_period(&times, &values),
    };
    let swing = swing.ok_or("the signal has no whole period")?;
    Ok(match quantity.take {
        Take::Mean => quantity.scale * swing.mean,
        Take::Amplitude => quantity.scale * swing.amplitude,
        Take::Frequency | Take::Last => swing.frequency,
    })
}

#[cfg(test)]
mod tests {
    use std::fmt::Write as _;

    use super::*;
    use crate::task::workspace_root;

    #[test]
    fn unknowns_of_both_fields_are_added() {
        let unknowns =
            |scene: &str| Run::new("a scene", scene).unknowns(workspace_root()).expect("a shipped scene");
        let [fluid, structure, both] =
            ["scenes/turek-hron-cfd1", "scenes/turek-hron-csm1", "scenes/turek-hron-fsi1"].map(unknowns);
        assert!(fluid > 0 && structure > 0 && both > structure, "{fluid}, {structure}, {both}");
    }

    #[test]
    fn quantities_are_taken_in_their_own_units() {
        let mut text = "step,time,tip_y\n".to_owned();
        for step in 1..=400 {
            let time = 0.01 * f64::from(step);
            let value = -0.06 - 0.065 * (std::f64::consts::TAU * 1.25 * time).sin();
            writeln!(text, "{step},{time},{value}").expect("a String takes any text");
        }
        let probes = Csv::parse(&text).expect("a table");
        let take = |take, column: &str| {
            let quantity = Quantity {
                name: "u".into(),
                column: column.into(),
                take,
                scale: 1000.0,
                reference: 1.0,
                around: None,
                target_percent: 1.0,
            };
            super::take(&probes, &quantity, None)
        };
        for (what, expected) in
            [(Take::Last, -60.0), (Take::Mean, -60.0), (Take::Amplitude, 65.0), (Take::Frequency, 1.25)]
        {
            let found = take(what, "tip_y").expect("a value");
            assert!((found - expected).abs() < 1e-3 * expected.abs(), "{what:?}: {found}");
        }
        assert!(take(Take::Last, "tip_x").expect_err("no such column").contains("`tip_x`"));
        assert!(take(Take::Mean, "step").expect_err("it only grows").contains("no whole period"));
    }
}
