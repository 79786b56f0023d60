//! Where runs are done: the release binary, what it did before, and as many at a time as asked.

use std::collections::BTreeMap;
use std::hash::{DefaultHasher, Hash, Hasher};
use std::io::IsTerminal;
use std::path::{Path, PathBuf};
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::Instant;

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use serde::{Deserialize, Serialize};

use super::run::{self, Outcome, Run};
use crate::task::{self, TaskError, captured, cargo};

/// The release binary and the outcomes of its earlier runs.
pub(crate) struct Workshop<'a> {
    root: &'a Path,
    binary: PathBuf,
    /// Checksum of the binary: the revision of all source that decides about a run.
    revision: u64,
    /// `target/reproduce`.
    folder: PathBuf,
    jobs: usize,
    /// Whether outcomes of earlier runs are taken.
    remember: bool,
}

/// An outcome and what it is the outcome of.
#[derive(Serialize, Deserialize)]
struct Kept {
    key: String,
    outcome: Outcome,
}

/// What a batch of runs cost here.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Spent {
    /// Runs that were done, the others being remembered.
    pub(crate) done: usize,
    /// Wall-clock time of the whole batch \[s\].
    pub(crate) wall_seconds: f64,
    /// Processor time of the runs that were done \[s\].
    pub(crate) cpu_seconds: f64,
}

impl<'a> Workshop<'a> {
    /// Builds the release binary. `jobs` runs go at a time; without `remember` every run is done anew.
    pub(crate) fn open(root: &'a Path, jobs: usize, remember: bool) -> Result<Self, TaskError> {
        let binary = build(root)?;
        let target =
            binary.parent().and_then(Path::parent).expect("cargo puts a binary into target/<profile>");
        let folder = target.join("reproduce");
        let revision = checksum(&task::read_bytes(&binary)?);
        Ok(Self { root, binary, revision, folder, jobs, remember })
    }

    /// The same, with another number of runs at a time and no memory.
    pub(crate) fn anew(&self, jobs: usize) -> Self {
        Self { binary: self.binary.clone(), folder: self.folder.clone(), jobs, remember: false, ..*self }
    }

    /// A folder for what runs need beside the scene.
    pub(crate) fn supplies(&self) -> PathBuf {
        self.folder.join("supplies")
    }

    /// Does the runs, or remembers them, and returns their outcomes in the order of `runs`.
    ///
    /// Which runs go at the same time and in which order they end changes no outcome.
    pub(crate) fn run_all(&self, runs: &[Run]) -> Result<(Vec<Outcome>, Spent), TaskError> {
        let begun = Instant::now();
        let keys = runs.iter().map(|run| self.key(run)).collect::<Result<Vec<String>, TaskError>>()?;
        let mut outcomes: BTreeMap<&str, Outcome> = BTreeMap::new();
        let mut open: BTreeMap<&str, &Run> = BTreeMap::new();
        for (key, run) in keys.iter().zip(runs) {
            match self.remembered(key) {
                Some(outcome) => drop(outcomes.insert(key, outcome)),
                None => drop(open.insert(key, run)),
            }
        }
        // In the order asked for: long runs, which come last in a table, should not all wait for the end.
        let mut open: Vec<(&str, &Run)> = open.into_iter().collect();
        open.sort_by_key(|(key, _)| keys.iter().position(|other| other == key));
        let bar = bar(open.len());
        let results = in_parallel(self.jobs, &open, |(key, run)| {
            let outcome = self.perform(key, run);
            bar.set_message(format!("{} {}", run.case.short(), run.setting));
            bar.inc(1);
            outcome
        });
        bar.finish_and_clear();
        let mut spent = Spent { done: open.len(), ..Spent::default() };
        for ((key, _), outcome) in open.iter().zip(results) {
            let outcome = outcome?;
            spent.cpu_seconds += outcome.summary.cpu_seconds.unwrap_or(outcome.summary.wall_seconds);
            outcomes.insert(key, outcome);
        }
        spent.wall_seconds = begun.elapsed().as_secs_f64();
        Ok((keys.iter().map(|key| outcomes[key.as_str()].clone()).collect(), spent))
    }

    /// Does a run outside the memory and leaves its files in the folder that is returned.
    pub(crate) fn run_with_files(&self, name: &str, arguments: &[String]) -> Result<PathBuf, TaskError> {
        let folder = self.folder.join("files").join(name);
        match run::start(self.root, &self.binary, arguments, &folder)? {
            None => Ok(folder),
            Some(said) => Err(TaskError::Failed(said)),
        }
    }

    /// Everything that decides about the outcome of a run.
    fn key(&self, run: &Run) -> Result<String, TaskError> {
        let mut scene = String::new();
        for (name, bytes) in task::files_of(&self.root.join("scenes").join(run.case.scene()))? {
            if matches!(name.rsplit('.').next(), Some("toml" | "msh")) {
                scene += &format!("{name} {:016x}\n", checksum(&bytes));
            }
        }
        Ok(format!("binary {:016x}\n{scene}{}\n", self.revision, run.arguments().join(" ")))
    }

    fn kept(&self, key: &str) -> PathBuf {
        self.folder.join("outcomes").join(format!("{:016x}.json", checksum(key.as_bytes())))
    }

    fn remembered(&self, key: &str) -> Option<Outcome> {
        let text = self.remember.then(|| std::fs::read_to_string(self.kept(key)).ok())??;
        let kept: Kept = serde_json::from_str(&text).ok()?;
        (kept.key == key).then_some(kept.outcome)
    }

    fn perform(&self, key: &str, run: &Run) -> Result<Outcome, TaskError> {
        let folder = self.folder.join("runs").join(format!("{:016x}", checksum(key.as_bytes())));
        let failure = run::start(self.root, &self.binary, &run.arguments(), &folder)?;
        let outcome = run::read_outcome(&folder, failure)?;
        task::remove_folder(&folder)?;
        let kept = Kept { key: key.to_owned(), outcome };
        task::write(
            &self.kept(key),
            &serde_json::to_string_pretty(&kept).expect("an outcome is plain data"),
        )?;
        Ok(kept.outcome)
    }
}

/// Builds the release binary and returns its path.
fn build(root: &Path) -> Result<PathBuf, TaskError> {
    let arguments = ["build", "--release", "--package", "partita-cli", "--bin", "partita"];
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

fn checksum(bytes: &[u8]) -> u64 {
    let mut hasher = DefaultHasher::new();
    bytes.hash(&mut hasher);
    hasher.finish()
}

/// `work` on each item, `jobs` at a time; the results stand in the order of the items.
fn in_parallel<T: Sync, R: Send>(jobs: usize, items: &[T], work: impl Fn(&T) -> R + Sync) -> Vec<R> {
    let next = AtomicUsize::new(0);
    let results: Mutex<Vec<Option<R>>> = Mutex::new(items.iter().map(|_| None).collect());
    std::thread::scope(|scope| {
        for _ in 0..jobs.clamp(1, items.len().max(1)) {
            scope.spawn(|| {
                while let Some((index, item)) = take(&next, items) {
                    let result = work(item);
                    results.lock().expect("no worker panics while it stores")[index] = Some(result);
                }
            });
        }
    });
    let results = results.into_inner().expect("no worker panics while it stores");
    results.into_iter().map(|result| result.expect("every item is taken once")).collect()
}

fn take<'a, T>(next: &AtomicUsize, items: &'a [T]) -> Option<(usize, &'a T)> {
    let index = next.fetch_add(1, Ordering::Relaxed);
    items.get(index).map(|item| (index, item))
}

/// A bar on stderr, where that is a terminal.
fn bar(runs: usize) -> ProgressBar {
    let target = if std::io::stderr().is_terminal() {
        ProgressDrawTarget::stderr()
    } else {
        ProgressDrawTarget::hidden()
    };
    let style = ProgressStyle::with_template("run {pos}/{len} {bar:30} {eta} left  {msg}")
        .expect("the template is well formed");
    ProgressBar::with_draw_target(Some(runs as u64), target).with_style(style)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_binary_is_the_last_executable_that_cargo_names() {
        let messages = "{\"reason\":\"compiler-artifact\",\"executable\":null}\n\
                        {\"reason\":\"compiler-artifact\",\"executable\":\"target/release/partita\"}\n\
                        {\"reason\":\"build-finished\",\"success\":true}\n";
        assert_eq!(executable(messages), Some(PathBuf::from("target/release/partita")));
        assert_eq!(executable("{\"reason\":\"build-finished\",\"success\":true}\n"), None);
    }

    #[test]
    fn results_stand_in_the_order_of_the_items_for_any_number_of_jobs() {
        let items: Vec<usize> = (0..50).collect();
        let squares: Vec<usize> = items.iter().map(|i| i * i).collect();
        for jobs in [0, 1, 3, 100] {
            assert_eq!(in_parallel(jobs, &items, |i| i * i), squares, "{jobs} jobs");
        }
        assert!(in_parallel(4, &[0; 0], |i: &usize| *i).is_empty());
    }
}
