//! One level of a case: a run of the release binary that is begun, taken up where it was cut off, or already there.

use std::collections::BTreeMap;
use std::hash::{DefaultHasher, Hash, Hasher};
use std::path::{Path, PathBuf};
use std::process::Command;

use serde::Deserialize;

use super::case::{Case, Quantity, Take, Until};
use super::row::{Row, six_digits};
use super::signal::{last_period, last_period_with, repetition};
use super::signals::{self, Samples};
use crate::task::{TaskError, captured, run};

/// Checkpoints of a run, the older one second.
const CHECKPOINTS: [&str; 2] = ["checkpoint.bin", "checkpoint.previous.bin"];

/// What is read of a run's `summary.json`.
#[derive(Debug, Deserialize)]
struct Summary {
    converged: bool,
    ending: String,
    steps: usize,
    coupling_iterations: usize,
    cpu_seconds: Option<f64>,
}

/// What a level came to.
pub(super) struct Found {
    /// A row a quantity.
    pub(super) rows: Vec<Row>,
    /// The last periods of a case that has some.
    pub(super) samples: Option<Samples>,
    /// The folder of the run.
    pub(super) dir: PathBuf,
}

/// What comes out of a level; the run behind it is in `folder/<case>-<level>`.
pub(super) fn level(
    root: &Path,
    binary: &Path,
    case: &Case,
    level: usize,
    folder: &Path,
) -> Result<Found, TaskError> {
    let settings: Vec<&str> =
        case.set.iter().chain(&case.levels[level - 1]).flat_map(|set| ["--set", set.as_str()]).collect();
    let scene = case.scene.strip_prefix(root).unwrap_or(&case.scene);
    let run = Run {
        root,
        binary,
        dir: folder.join(format!("{}-{level}", case.name)),
        key: key(binary, &case.scene, &settings)?,
        until: case.until.as_ref(),
    };
    let summary = run.outcome(scene, &settings)?;
    let mut check = run.program("check");
    check.arg(scene).args(&settings);
    let dofs = unknowns(&captured(check)?);
    let probes = Probes::read(&run.dir.join("probes.csv"))?;
    let swings = case.quantities.iter().any(|quantity| quantity.take != Take::Last);
    let time = if swings { probes.end() } else { None };
    let repeats = case.until.as_ref().and_then(|until| probes.repetition(until));
    let lead = case.until.as_ref().map(|until| until.column.as_str());
    let rows = case.quantities.iter().map(|quantity| {
        let ours = probes.take(quantity, lead).map_err(|what| {
            TaskError::Failed(format!("{} level {level}, {}: {what}", case.name, quantity.name))
        })?;
        Ok(Row {
            simulated_seconds: time.map_or_else(String::new, six_digits),
            repeats_percent: repeats.map_or_else(String::new, |percent| format!("{percent:.2}")),
            ..row(case, level, quantity, ours, dofs, &summary)
        })
    });
    Ok(Found {
        rows: rows.collect::<Result<_, TaskError>>()?,
        samples: signals::last(case, &probes.0),
        dir: run.dir,
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

/// A run and what decides about its numbers.
struct Run<'a> {
    root: &'a Path,
    binary: &'a Path,
    dir: PathBuf,
    key: String,
    /// Where it may end before its scene does.
    until: Option<&'a Until>,
}

impl Run<'_> {
    /// The summary of the whole run. Nothing is done twice: a finished run of the same binary and settings is read, a
    /// run that was cut off is taken up at its checkpoint, any other is thrown away and begun.
    fn outcome(&self, scene: &Path, settings: &[&str]) -> Result<Summary, TaskError> {
        if self.is_this_one() {
            if let Ok(summary) = self.summary()
                && self.is_over(&summary)?
            {
                eprintln!("{}: done before", self.name());
                return self.judged(summary);
            }
            if CHECKPOINTS.iter().any(|name| self.dir.join(name).is_file()) {
                eprintln!("{}: taken up where it was cut off", self.name());
                return self.to_its_end();
            }
        }
        eprintln!("{}: begun", self.name());
        self.clear()?;
        if let Some(folder) = self.dir.parent() {
            std::fs::create_dir_all(folder)
                .map_err(|source| TaskError::File { path: folder.to_owned(), source })?;
        }
        std::fs::write(self.key_file(), &self.key)
            .map_err(|source| TaskError::File { path: self.key_file(), source })?;
        let mut command = self.program("run");
        command.arg(scene).args(settings).arg("--quiet").arg("--out").arg(&self.dir);
        if let Some(until) = self.until {
            command.args(["--steps", &until.every.to_string()]);
        }
        run(command)?;
        self.to_its_end()
    }

    /// Takes the run up as often as it needs; between two times it is looked at whether its periods repeat.
    fn to_its_end(&self) -> Result<Summary, TaskError> {
        loop {
            let steps = match self.summary() {
                Ok(summary) if self.is_over(&summary)? => return self.judged(summary),
                Ok(summary) if !["stopped", "interrupted"].contains(&summary.ending.as_str()) => {
                    return self.judged(summary);
                }
                Ok(summary) => summary.steps,
                // It was cut off before it could write one.
                Err(_) => 0,
            };
            let mut command = self.program("resume");
            command.arg(&self.dir).arg("--quiet");
            if let Some(until) = self.until {
                command.args(["--steps", &(steps + until.every).to_string()]);
            }
            run(command)?;
        }
    }

    /// Whether nothing is left to do.
    fn is_over(&self, summary: &Summary) -> Result<bool, TaskError> {
        if summary.ending == "completed" {
            return Ok(true);
        }
        let Some(until) = self.until.filter(|_| summary.ending == "stopped") else { return Ok(false) };
        let probes = Probes::read(&self.dir.join("probes.csv"))?;
        Ok(probes.repetition(until).is_some_and(|percent| percent < until.percent))
    }

    /// Removes the key first: a folder without one is never taken for a run.
    fn clear(&self) -> Result<(), TaskError> {
        let refused = |path: &Path, source| TaskError::File { path: path.to_owned(), source };
        let key = self.key_file();
        if key.exists() {
            std::fs::remove_file(&key).map_err(|source| refused(&key, source))?;
        }
        if self.dir.exists() {
            std::fs::remove_dir_all(&self.dir).map_err(|source| refused(&self.dir, source))?;
        }
        Ok(())
    }

    fn judged(&self, summary: Summary) -> Result<Summary, TaskError> {
        let at_its_end = summary.ending == "completed" || self.is_over(&summary)?;
        if summary.converged && at_its_end {
            return Ok(summary);
        }
        let Summary { ending, converged, steps, .. } = summary;
        let state = if converged { "" } else { ", not every step converged" };
        Err(TaskError::Failed(format!("{}: {ending} after {steps} steps{state}", self.name())))
    }

    fn summary(&self) -> Result<Summary, TaskError> {
        let path = self.dir.join("summary.json");
        let text = std::fs::read_to_string(&path)
            .map_err(|source| TaskError::File { path: path.clone(), source })?;
        serde_json::from_str(&text).map_err(|error| TaskError::Failed(format!("{}: {error}", path.display())))
    }

    fn is_this_one(&self) -> bool {
        std::fs::read_to_string(self.key_file()).is_ok_and(|key| key == self.key)
    }

    fn key_file(&self) -> PathBuf {
        self.dir.with_extension("key")
    }

    fn name(&self) -> String {
        self.dir.file_name().unwrap_or_default().to_string_lossy().into_owned()
    }

    fn program(&self, word: &str) -> Command {
        let mut command = Command::new(self.binary);
        command.current_dir(self.root).arg(word);
        command
    }
}

/// What a run depends on: the program, its settings, and every scene, mesh and patch beside its own.
fn key(binary: &Path, scene: &Path, settings: &[&str]) -> Result<String, TaskError> {
    let read =
        |path: &Path| std::fs::read(path).map_err(|source| TaskError::File { path: path.to_owned(), source });
    let mut hasher = DefaultHasher::new();
    settings.hash(&mut hasher);
    read(binary)?.hash(&mut hasher);
    read(&scene.join("scene.toml"))?.hash(&mut hasher);
    for path in shapes(scene.parent().unwrap_or(scene))? {
        read(&path)?.hash(&mut hasher);
    }
    Ok(format!("{:016x}\n", hasher.finish()))
}

/// Meshes and spline files in the folders of a folder, sorted.
fn shapes(scenes: &Path) -> Result<Vec<PathBuf>, TaskError> {
    let entries = |folder: &Path| -> Result<Vec<PathBuf>, TaskError> {
        let refused = |source| TaskError::File { path: folder.to_owned(), source };
        let entries = std::fs::read_dir(folder).map_err(refused)?;
        entries.map(|entry| entry.map(|entry| entry.path()).map_err(refused)).collect()
    };
    let mut found = Vec::new();
    for folder in entries(scenes)?.iter().filter(|path| path.is_dir()) {
        found.extend(entries(folder)?.into_iter().filter(|path| {
            let name = path.file_name().unwrap_or_default();
            path.extension().is_some_and(|end| end == "msh")
                || path.extension().is_some_and(|end| end == "toml")
                    && name != "scene.toml"
                    && name != "benchmark.toml"
        }));
    }
    found.sort();
    Ok(found)
}

/// Sum of the counts before the word `unknowns` in what `partita check` says.
pub(crate) fn unknowns(described: &str) -> usize {
    let words: Vec<&str> =
        described.split_whitespace().map(|word| word.trim_end_matches([',', ';'])).collect();
    words
        .windows(2)
        .filter(|pair| pair[1] == "unknowns")
        .filter_map(|pair| pair[0].parse::<usize>().ok())
        .sum()
}

/// A run's `probes.csv` by its columns.
struct Probes(BTreeMap<String, Vec<f64>>);

impl Probes {
    fn read(path: &Path) -> Result<Self, TaskError> {
        let text = std::fs::read_to_string(path)
            .map_err(|source| TaskError::File { path: path.to_owned(), source })?;
        Ok(Self::parse(&text))
    }

    fn parse(text: &str) -> Self {
        let mut lines = text.lines();
        let names: Vec<&str> = lines.next().unwrap_or_default().split(',').collect();
        let mut columns = vec![Vec::new(); names.len()];
        for line in lines {
            for (column, cell) in columns.iter_mut().zip(line.split(',')) {
                column.push(cell.parse().unwrap_or(f64::NAN));
            }
        }
        Self(names.into_iter().map(str::to_owned).zip(columns).collect())
    }

    /// The time at the end \[s\].
    fn end(&self) -> Option<f64> {
        self.0.get("time")?.last().copied()
    }

    /// How well the last periods repeat each other \[%\]; nothing where there are too few.
    fn repetition(&self, until: &Until) -> Option<f64> {
        repetition(self.0.get("time")?, self.0.get(&until.column)?, until.periods)
    }

    /// The value of a quantity, in its own unit; where a column leads, over that one's last period.
    fn take(&self, quantity: &Quantity, lead: Option<&str>) -> Result<f64, String> {
        let column =
            |name: &str| self.0.get(name).ok_or_else(|| format!("probes.csv has no column `{name}`"));
        let (times, values) = (column("time")?, column(&quantity.column)?);
        if quantity.take == Take::Last {
            let last = values.last().ok_or("the run has no steps")?;
            return Ok(quantity.scale * last);
        }
        let swing = match lead {
            Some(lead) => last_period_with(times, values, column(lead)?),
            None => last_period(times, values),
        };
        let swing = swing.ok_or("the signal has no whole period")?;
        Ok(match quantity.take {
            Take::Mean => quantity.scale * swing.mean,
            Take::Amplitude => quantity.scale * swing.amplitude,
            Take::Frequency | Take::Last => swing.frequency,
        })
    }
}

#[cfg(test)]
mod tests {
    use std::fmt::Write as _;

    use super::*;

    #[test]
    fn unknowns_of_both_fields_are_added() {
        let described = "Flag\n  fluid       100 triangles, 60 nodes, 151 unknowns\n  structure   \
                         18 x 1 elements of degree 2 x 2, 60 control points, 114 unknowns\nscene is sound\n";
        assert_eq!(unknowns(described), 265);
        assert_eq!(unknowns("no numbers"), 0);
    }

    #[test]
    fn quantities_are_taken_in_their_own_units() {
        let mut text = "step,time,tip_y\n".to_owned();
        for step in 1..=400 {
            let time = 0.01 * f64::from(step);
            let value = -0.06 - 0.065 * (std::f64::consts::TAU * 1.25 * time).sin();
            writeln!(text, "{step},{time},{value}").expect("a String takes any text");
        }
        let probes = Probes::parse(&text);
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
            probes.take(&quantity, None)
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
