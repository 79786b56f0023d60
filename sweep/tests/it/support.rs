//! Small sweeps, and how they are run here.

use std::fs;
use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};
use std::sync::atomic::AtomicBool;

use partita_sweep::{Executed, Findings, Order, Sweep, SweepError, Threads};
use tempfile::TempDir;

/// A cantilever, and a study of it that is sound; tests break it in one place.
pub(crate) use partita_testing::cantilever::{SCENE, STUDY as SOUND};

/// A map of it: nine cells, of which one fails by design, because its limit of Newton iterations is too low for its load.
pub(crate) const MAP: &str = r#"title = "Cantilever: load and modulus"
scene = "cantilever.toml"
steps = 2

[[parameter]]
name = "load"
values = [1, 10, 1000]
set = ["structure.body_force=[0, -$(x)]"]

[[parameter]]
name = "modulus"
values = [1e4, 1e5, 1e6]
set = ["structure.material.saint_venant_kirchhoff.young_modulus=$(x)", "structure.newton.max_iterations=13"]

[[choice]]
name = "full Newton"
"#;

/// A new folder with the scene and a sweep in it.
pub(crate) struct Case {
    guard: TempDir,
    file: PathBuf,
}

impl Case {
    pub(crate) fn new(sweep: &str) -> Self {
        let guard = tempfile::tempdir().expect("a temporary folder");
        fs::write(guard.path().join("cantilever.toml"), SCENE).expect("the scene is written");
        let file = guard.path().join("bending.toml");
        fs::write(&file, sweep).expect("the sweep is written");
        Self { guard, file }
    }

    pub(crate) fn path(&self) -> &Path {
        self.guard.path()
    }

    pub(crate) fn dir(&self) -> PathBuf {
        self.path().join("out")
    }

    pub(crate) fn load(&self) -> Sweep {
        Sweep::load(&self.file).expect("a sound sweep")
    }

    pub(crate) fn file(&self) -> &Path {
        &self.file
    }

    /// Replaces the text of the sweep.
    pub(crate) fn rewrite(&self, sweep: &str) {
        fs::write(&self.file, sweep).expect("the sweep is written");
    }

    pub(crate) fn read(&self, name: &str) -> String {
        fs::read_to_string(self.dir().join(name)).expect("a file in the output folder")
    }

    /// Forgets the results of these runs, as if the program had been killed before they ended.
    pub(crate) fn forget(&self, sweep: &Sweep, runs: impl IntoIterator<Item = usize>) {
        for index in runs {
            fs::remove_file(self.result_file(sweep, index)).expect("a result");
        }
    }

    /// The file of a run's result.
    pub(crate) fn result_file(&self, sweep: &Sweep, index: usize) -> PathBuf {
        self.dir().join("runs").join(format!("{}.json", sweep.runs()[index].fingerprint))
    }
}

/// Runs what is missing with this many jobs.
pub(crate) fn execute(sweep: &Sweep, dir: &Path, jobs: usize) -> Result<Executed, SweepError> {
    execute_unless(sweep, dir, jobs, &AtomicBool::new(false))
}

/// The same, unless it is told to stop.
pub(crate) fn execute_unless(
    sweep: &Sweep,
    dir: &Path,
    jobs: usize,
    stop: &AtomicBool,
) -> Result<Executed, SweepError> {
    let mut threads = Threads::new(NonZeroUsize::new(jobs).expect("some jobs"), stop);
    sweep.execute(Order { dir, force: false, only: None }, &mut threads, &mut ())
}

/// The report of a study.
pub(crate) fn report(sweep: &Sweep, dir: &Path) -> partita_sweep::study::Report {
    match sweep.collect(dir).expect("a folder of results").findings {
        Findings::Study(report) => *report,
        Findings::Map(..) => panic!("a study was asked for"),
    }
}

/// Names in a folder, sorted.
pub(crate) fn entries(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).expect("the folder is there");
    let mut names: Vec<String> =
        entries.map(|entry| entry.expect("an entry").file_name().to_string_lossy().into_owned()).collect();
    names.sort();
    names
}

/// A table without its times.
pub(crate) fn without_times(csv: &str) -> String {
    let seconds = csv.lines().next().and_then(|head| head.split(',').position(|name| name == "cpu_seconds"));
    let Some(seconds) = seconds else { return csv.to_owned() };
    // The names that come before the column hold one comma each, in quotes.
    let line = |line: &str| {
        let shift = usize::from(line.contains('"'));
        let kept = line.split(',').enumerate().filter(|(at, _)| *at != seconds + shift);
        kept.map(|(_, field)| field).collect::<Vec<_>>().join(",") + "\n"
    };
    csv.lines().map(line).collect()
}
