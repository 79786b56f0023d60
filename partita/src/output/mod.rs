//! The output folder of a run.
//!
//! | file | content |
//! |---|---|
//! | `scene.toml` | the scene with every default written out; it runs again as it is |
//! | `run.json` | in its place, the settings of a run that a program built without a scene |
//! | `input/` | the files that the scene names, as they were read |
//! | `run.jsonl` | the record: a line for each coupling iteration, each step, and each step that failed and was repeated |
//! | `steps.csv` | convergence and counts of each step, for plots |
//! | `probes.csv` | values that the scene asks for, a row for each step |
//! | `fluid.pvd`, `structure.pvd`, `fields/` | fields for a viewer |
//! | `summary.json` | counts and times of the whole run, written at its end |
//! | `checkpoint.bin`, `checkpoint.previous.bin` | see [`crate::checkpoint`] |
//!
//! `run.jsonl` holds everything that is recorded, once: resume, summary and [`tables`] are made from it. A table of all
//! iterations or steps is written by `partita table RUN`, when it is wanted. `steps.csv` repeats a dozen numbers per step,
//! no more; a run goes on without reading them.
//!
//! Records, tables and summary count the work of each field: assemblies of the residual, those of them with a tangent,
//! factorizations of it, solves with it, factorizations that fell back to a slower method, and factorizations and solves
//! for the motion of the mesh.
//!
//! Lines and rows go to the system one by one, so that a killed run keeps its history. A resumed run cuts every file
//! behind the step of its checkpoint and goes on there: but for times, the files of a resumed run and of one that was
//! never stopped are the same bytes. Times stand in the object `seconds` of a line, to the microsecond.

mod csv;
mod error;
pub mod fields;
mod input;
mod lines;
mod record;
pub mod space;
mod summary;
pub mod table;
pub mod tables;

use std::fs;
use std::path::{Path, PathBuf};
use std::time::Instant;

use partita_coupling::record::{IterationRecord, StepRecord};
use partita_coupling::{Record, RetryRecord};

use crate::checkpoint::{self, Stamp};
use csv::CsvFile;
use fields::{FieldFiles, Series, Snapshot, remove_if_there};
use lines::LineFile;
use partita_scene::{INPUT_FOLDER, Input};
use record::{Line, ProbeRow};

pub use crate::clock::{Clock, Spent};
pub use error::OutputError;
pub use summary::{Ending, OtherField, Seconds, Summary, Totals, Work};

/// The resolved scene.
pub const SCENE: &str = "scene.toml";
/// Records, one a line.
pub const RECORDS: &str = "run.jsonl";
/// Steps as a table.
pub const STEPS: &str = "steps.csv";
/// What earlier versions wrote beside the records, with nothing in it that these lack.
const EARLIER: &str = "iterations.csv";
/// Probed values as a table.
pub const PROBES: &str = "probes.csv";
/// What is run, where no scene says so.
pub const DESCRIPTION: &str = "run.json";
/// Counts and times of the whole run.
pub const SUMMARY: &str = "summary.json";

/// What the columns of a run's tables are called after.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Columns {
    /// The two fields.
    pub(crate) fields: [String; 2],
    /// All columns of all probes.
    pub(crate) probes: Vec<String>,
}

/// Writes the output folder of a run.
///
/// ```no_run
/// use partita::output::{Clock, Ending, RunWriter};
/// # fn records() -> Vec<(Vec<partita_coupling::IterationRecord>, partita_coupling::StepRecord)> { vec![] }
///
/// let probes = ["tip_y".to_owned()];
/// let mut writer = RunWriter::create("runs/tank".as_ref(), "title = \"tank\"\n", &probes, Clock::start())?;
/// for (iterations, step) in records() {
///     for iteration in &iterations {
///         writer.iteration(iteration)?;
///     }
///     writer.step(&step)?;
///     writer.probes(step.step, step.time, &[0.1])?;
/// }
/// let summary = writer.finish(Ending::Completed)?;
/// print!("{}", summary.table().to_plain());
/// # Ok::<(), partita::output::OutputError>(())
/// ```
#[derive(Debug)]
pub struct RunWriter {
    dir: PathBuf,
    records: LineFile,
    steps: CsvFile<StepRecord>,
    probes: CsvFile<ProbeRow>,
    probe_count: usize,
    fields: FieldFiles,
    totals: Totals,
    clock: Clock,
}

impl RunWriter {
    /// Starts the folder `dir` of a new run: `scene` is the text of its resolved scene, `probes` names the columns of
    /// `probes.csv`, `clock` has run since the program started.
    ///
    /// # Errors
    /// [`OutputError::Occupied`] when the folder is not empty (see [`remove_run`]), or what the system refuses.
    pub fn create(dir: &Path, scene: &str, probes: &[String], clock: Clock) -> Result<Self, OutputError> {
        let columns = Columns { fields: record::scene_fields(), probes: probes.to_vec() };
        Self::create_with(dir, (SCENE, scene), &columns, clock)
    }

    /// Starts the folder `dir` of a new run with fields of any name: the file that says what is run has this name and text.
    pub(crate) fn create_with(
        dir: &Path,
        (name, text): (&str, &str),
        columns: &Columns,
        clock: Clock,
    ) -> Result<Self, OutputError> {
        let refused = |source| OutputError::Write { path: dir.to_owned(), source };
        fs::create_dir_all(dir).map_err(refused)?;
        if fs::read_dir(dir).map_err(refused)?.next().is_some() {
            return Err(OutputError::Occupied { dir: dir.to_owned() });
        }
        // First: it marks the folder as a run's, which --force may replace.
        let records = LineFile::create(dir.join(RECORDS))?;
        let path = dir.join(name);
        fs::write(&path, text).map_err(|source| OutputError::Write { path, source })?;
        Ok(Self {
            dir: dir.to_owned(),
            records,
            steps: CsvFile::create(dir.join(STEPS), record::step_columns(&columns.fields))?,
            probes: CsvFile::create(dir.join(PROBES), record::probe_columns(&columns.probes))?,
            probe_count: columns.probes.len(),
            fields: FieldFiles::create(dir)?,
            totals: Totals::default(),
            clock,
        })
    }

    /// Writes copies of the files that the scene names.
    ///
    /// # Errors
    /// What the system refuses.
    pub(crate) fn keep(&mut self, inputs: &[Input]) -> Result<(), OutputError> {
        self.timed(|run| input::keep(&run.dir, inputs))
    }

    /// Takes up the folder `dir` at the step of a checkpoint: what was written after it is dropped.
    ///
    /// # Errors
    /// When a file is missing, lacks steps, or is not what a run with these `probes` writes.
    pub fn resume(dir: &Path, stamp: &Stamp, probes: &[String], clock: Clock) -> Result<Self, OutputError> {
        let columns = Columns { fields: record::scene_fields(), probes: probes.to_vec() };
        Self::resume_with(dir, stamp, &columns, clock)
    }

    /// The same of a run with fields of any name.
    pub(crate) fn resume_with(
        dir: &Path,
        stamp: &Stamp,
        columns: &Columns,
        mut clock: Clock,
    ) -> Result<Self, OutputError> {
        let step = stamp.step;
        let (records, totals) = resume_records(dir.join(RECORDS), step)?;
        let (steps, step_rows) =
            CsvFile::resume(dir.join(STEPS), record::step_columns(&columns.fields), step)?;
        let (probe_file, _) =
            CsvFile::resume(dir.join(PROBES), record::probe_columns(&columns.probes), step)?;
        let complete = [(&records, totals.steps == step), (steps.file(), step_rows == step)];
        if let Some((file, _)) = complete.iter().find(|(_, complete)| !complete) {
            return Err(OutputError::Cut { path: file.path().to_owned(), step });
        }
        remove_if_there(&dir.join(SUMMARY))?;
        remove_if_there(&dir.join(EARLIER))?;
        clock.go_on_from(stamp.spent);
        Ok(Self {
            dir: dir.to_owned(),
            records,
            steps,
            probes: probe_file,
            probe_count: columns.probes.len(),
            fields: FieldFiles::resume(dir, stamp.time)?,
            totals,
            clock,
        })
    }

    /// Writes a coupling iteration.
    ///
    /// # Errors
    /// What the system refuses.
    pub fn iteration(&mut self, record: &IterationRecord) -> Result<(), OutputError> {
        self.timed(|run| run.records.append(&Line::Iteration(record).to_json()))
    }

    /// Writes a finished step, after its iterations.
    ///
    /// # Errors
    /// What the system refuses.
    pub fn step(&mut self, record: &StepRecord) -> Result<(), OutputError> {
        self.totals.add(record);
        self.timed(|run| {
            run.records.append(&Line::Step(record).to_json())?;
            run.steps.append(record)
        })
    }

    /// Writes that a step has failed and is repeated with half its size, after its iterations.
    ///
    /// # Errors
    /// What the system refuses.
    pub fn retry(&mut self, record: &RetryRecord) -> Result<(), OutputError> {
        self.totals.retries += 1;
        self.timed(|run| run.records.append(&Line::Retry(record).to_json()))
    }

    /// Writes the probed values at the end of a step (0: at the start).
    ///
    /// # Errors
    /// What the system refuses.
    ///
    /// # Panics
    /// When there is not a value for each probe.
    pub fn probes(&mut self, step: usize, time: f64, values: &[f64]) -> Result<(), OutputError> {
        assert_eq!(values.len(), self.probe_count, "there is a value for each probe");
        self.timed(|run| run.probes.append(&ProbeRow { step, time, values: values.to_vec() }))
    }

    /// Writes a field at the end of a step (0: at the start).
    ///
    /// # Errors
    /// What the system refuses.
    pub fn fields<const D: usize>(
        &mut self,
        series: Series,
        step: usize,
        time: f64,
        snapshot: &Snapshot<'_, D>,
    ) -> Result<(), OutputError> {
        self.timed(|run| run.fields.write(series, step, time, snapshot))
    }

    /// Whether the fields at `time` \[s\] are the last ones that were written.
    #[must_use]
    pub fn shows(&self, time: f64) -> bool {
        self.fields.last_time() == Some(time)
    }

    /// The mark of a checkpoint taken now, at the end of a step. Records and tables are on the disk when this returns,
    /// so that a checkpoint is never ahead of them.
    ///
    /// # Errors
    /// What the system refuses.
    pub fn stamp(&mut self, step: usize, time: f64) -> Result<Stamp, OutputError> {
        self.timed(|run| {
            let files = [&run.records, run.steps.file(), run.probes.file()];
            files.into_iter().try_for_each(LineFile::synchronize)
        })?;
        Ok(Stamp { step, time, spent: self.clock.spent() })
    }

    /// The folder.
    #[must_use]
    pub fn dir(&self) -> &Path {
        &self.dir
    }

    /// Counts and times of the finished steps.
    #[must_use]
    pub fn totals(&self) -> &Totals {
        &self.totals
    }

    /// Writes `summary.json` and returns what it says.
    ///
    /// # Errors
    /// What the system refuses.
    pub fn finish(&mut self, ending: Ending) -> Result<Summary, OutputError> {
        self.write_summary(Summary::new(ending, &self.totals, &self.clock.spent()))
    }

    /// Writes the `summary.json` of a run that failed, and returns what it says.
    ///
    /// # Errors
    /// What the system refuses.
    pub fn fail(&mut self, cause: String) -> Result<Summary, OutputError> {
        self.write_summary(Summary::failed(&self.totals, &self.clock.spent(), cause))
    }

    fn write_summary(&self, summary: Summary) -> Result<Summary, OutputError> {
        let path = self.dir.join(SUMMARY);
        match fs::write(&path, summary.to_json()) {
            Ok(()) => Ok(summary),
            Err(source) => {
                // Half a summary is none.
                let _ = fs::remove_file(&path);
                Err(OutputError::Write { path, source })
            }
        }
    }

    fn timed(&mut self, write: impl FnOnce(&mut Self) -> Result<(), OutputError>) -> Result<(), OutputError> {
        let start = Instant::now();
        let result = write(self);
        self.clock.add_output(start.elapsed());
        result
    }
}

/// Cuts the records behind `step`; returns the totals of what is kept, too.
fn resume_records(path: PathBuf, step: usize) -> Result<(LineFile, Totals), OutputError> {
    let mut totals = Totals::default();
    let file = LineFile::resume(path, |_, line| {
        match serde_json::from_str(line).map_err(|error| error.to_string())? {
            Record::Iteration(record) if record.step <= step => {}
            Record::Step(record) if record.step <= step => totals.add(&record),
            Record::Retry(record) if record.step <= step => totals.retries += 1,
            _ => return Ok(false),
        }
        Ok(true)
    })?;
    Ok((file, totals))
}

/// Removes what a run has written to `dir`, so that a new one can start there.
///
/// # Errors
/// When the folder holds anything else, or another process writes to it: then nothing was removed. Or what the system
/// refuses.
pub fn remove_run(dir: &Path) -> Result<(), OutputError> {
    let records = dir.join(RECORDS);
    let Ok(file) = fs::File::open(&records) else { return Ok(()) };
    let _lock = lines::lock(file, &records)?;
    let collections = Series::ALL.map(Series::collection);
    let files = [SCENE, DESCRIPTION, STEPS, EARLIER, PROBES, SUMMARY].into_iter().chain(checkpoint::FILES);
    let ours: Vec<&str> = files.chain(collections.iter().map(String::as_str)).collect();
    let known = |name: &str| {
        let name = name.strip_suffix(".part").unwrap_or(name);
        name == RECORDS || name == fields::FOLDER || name == INPUT_FOLDER || ours.contains(&name)
    };
    refuse_foreign(dir, known)?;
    refuse_foreign(&dir.join(fields::FOLDER), fields::is_ours)?;
    refuse_foreign(&dir.join(INPUT_FOLDER), input::is_ours)?;
    for name in ours {
        remove_if_there(&dir.join(name))?;
    }
    fields::remove_all(dir)?;
    input::remove_all(dir)?;
    // Last: while it is there, what is left is known to be a run's.
    remove_if_there(&records)
}

/// Fails at an entry of `dir` whose name is not `known`; a folder that is not there has none.
fn refuse_foreign(dir: &Path, known: impl Fn(&str) -> bool) -> Result<(), OutputError> {
    let Ok(entries) = fs::read_dir(dir) else { return Ok(()) };
    match entries.flatten().find(|entry| !entry.file_name().to_str().is_some_and(&known)) {
        Some(entry) => Err(OutputError::Foreign { path: entry.path() }),
        None => Ok(()),
    }
}
