//! Runs of scenes by the program `partita`: as many at a time as asked, and none that was done before.

use std::collections::BTreeMap;
use std::io::IsTerminal;
use std::path::{Path, PathBuf};
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::Instant;

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

use crate::cache::{Cache, Entry};
use crate::program::{Program, checksum};
use crate::run::{Outcome, Run, Stop};
use crate::task::{self, TaskError};

/// The program, what it did before, and how many of it run at a time.
pub(crate) struct Runs {
    pub(crate) root: PathBuf,
    program: Program,
    cache: Cache,
    /// Runs at a time.
    pub(crate) jobs: usize,
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

impl Runs {
    /// `jobs` runs go at a time; a `fresh` run is done whether it is remembered or not.
    pub(crate) fn open(root: &Path, program: Program, jobs: usize, fresh: bool) -> Self {
        let cache = Cache::new(root.join("target/report"), !fresh);
        Self { root: root.to_owned(), program, cache, jobs }
    }

    /// The same with `jobs` runs at a time, all of them done again.
    pub(crate) fn again(mut self, jobs: usize) -> Self {
        self.cache.remembers = false;
        self.jobs = jobs;
        self
    }

    /// A folder for what runs need beside the scene.
    pub(crate) fn supplies(&self) -> PathBuf {
        self.root.join("target/report-supplies")
    }

    /// Does the runs, or remembers them, and returns their outcomes in the order of `runs`.
    ///
    /// Which runs go at the same time and in which order they end changes no outcome but times.
    pub(crate) fn all(&self, runs: &[Run<'_>]) -> Result<(Vec<Outcome>, Spent), TaskError> {
        let begun = Instant::now();
        let entries = runs.iter().map(|run| self.entry(run)).collect::<Result<Vec<Entry>, TaskError>>()?;
        let mut outcomes: Vec<Option<Outcome>> = Vec::new();
        let mut open: Vec<usize> = Vec::new();
        for (index, entry) in entries.iter().enumerate() {
            let outcome = self.cache.remembered::<Outcome>(entry);
            // The same run may be asked for twice.
            if outcome.is_none() && !entries[..index].contains(entry) {
                open.push(index);
            }
            outcomes.push(outcome);
        }
        let bar = bar(open.len());
        let results = in_parallel(self.jobs, &open, |&index| {
            bar.set_message(runs[index].name.clone());
            let outcome = self.cache.keep(&entries[index], |out| runs[index].perform(&self.program, out));
            bar.inc(1);
            outcome
        });
        bar.finish_and_clear();
        let mut spent = Spent { done: open.len(), ..Spent::default() };
        for (index, outcome) in open.into_iter().zip(results) {
            let outcome = outcome?;
            spent.cpu_seconds += outcome.summary.cpu_seconds.unwrap_or(outcome.summary.wall_seconds);
            outcomes[index] = Some(outcome);
        }
        spent.wall_seconds = begun.elapsed().as_secs_f64();
        let done: BTreeMap<&Entry, &Outcome> = entries
            .iter()
            .zip(&outcomes)
            .filter_map(|(entry, outcome)| Some((entry, outcome.as_ref()?)))
            .collect();
        let outcome = |entry: &Entry| done[entry].clone().in_folder(entry.out());
        Ok((entries.iter().map(outcome).collect(), spent))
    }

    /// One run that reached its end with every step converged.
    pub(crate) fn one(&self, run: &Run<'_>) -> Result<Outcome, TaskError> {
        let (mut outcomes, _) = self.all(std::slice::from_ref(run))?;
        let outcome = outcomes.pop().expect("an outcome for each run");
        outcome.converged(run)?;
        Ok(outcome)
    }

    /// The folder that `partita WORD FILE` writes for a study or a map; `words` change no number in it.
    pub(crate) fn sweep(&self, word: &str, file: &str, words: &[String]) -> Result<PathBuf, TaskError> {
        let mut key = format!("binary {:016x}\n{word} {file}\n", self.program.revision);
        key += &format!("{:016x}\n", checksum(&task::read_bytes(&self.root.join(file))?));
        // Its choices may name any mesh or spline.
        for folder in task::folders_of(&self.root.join("scenes"))? {
            for (name, bytes) in task::files_of(&folder)? {
                if matches!(name.rsplit('.').next(), Some("toml" | "msh")) {
                    key += &format!("{}/{name} {:016x}\n", folder.display(), checksum(&bytes));
                }
            }
        }
        let entry = self.cache.entry(key);
        if self.cache.remembered::<()>(&entry).is_none() {
            eprintln!("{word} {file}");
            self.cache.keep(&entry, |out| {
                let mut all = vec![word.to_owned(), file.to_owned()];
                all.extend_from_slice(words);
                all.extend(["--out".to_owned(), out.display().to_string()]);
                self.program.call_in_sight(&all)
            })?;
        }
        Ok(entry.out())
    }

    /// Goes on with a finished run in another folder, a copy of it.
    pub(crate) fn resume(&self, dir: &Path) -> Result<(), TaskError> {
        self.program.call_in_sight(&["resume".to_owned(), dir.display().to_string(), "--quiet".to_owned()])
    }

    /// Everything that decides about the outcome of a run: the program, the scene with all its settings, and the files it names.
    fn entry(&self, run: &Run<'_>) -> Result<Entry, TaskError> {
        let resolved = run.resolved(&self.root)?;
        let mut key = format!("binary {:016x}\n{}\n", self.program.revision, run.scene);
        match run.stop {
            Stop::AtTheEnd | Stop::When { .. } => {}
            Stop::After(steps) => key += &format!("steps {steps}\n"),
        }
        for input in &resolved.shapes.inputs {
            key += &format!("{} {:016x}\n", input.name, checksum(&input.bytes));
        }
        Ok(self.cache.entry(key + &resolved.to_toml()))
    }
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
    fn results_stand_in_the_order_of_the_items_for_any_number_of_jobs() {
        let items: Vec<usize> = (0..50).collect();
        let squares: Vec<usize> = items.iter().map(|i| i * i).collect();
        for jobs in [0, 1, 3, 100] {
            assert_eq!(in_parallel(jobs, &items, |i| i * i), squares, "{jobs} jobs");
        }
        assert!(in_parallel(4, &[0; 0], |i: &usize| *i).is_empty());
    }
}
