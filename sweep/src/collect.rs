//! Table, picture, and what failed: made from the results that are there.

use std::path::Path;

use crate::error::SweepError;
use crate::folder::{CELLS, DIAGRAM, Folder, PICTURE, ROWS, State};
use crate::map::{self, Cell, Map};
use crate::result::RunResult;
use crate::study::Report;
use crate::sweep::{Kind, Run, Sweep};

/// What a sweep came to so far.
#[derive(Debug)]
pub struct Collected {
    /// What was measured.
    pub findings: Findings,
    /// Runs that ended early: which, and why.
    pub failed: Vec<Trouble>,
    /// Runs without a result.
    pub unfinished: Vec<Trouble>,
}

/// What is made of the results.
#[derive(Debug)]
pub enum Findings {
    /// Of a study.
    Study(Box<Report>),
    /// Of a map: its cells that have ended, and a line for each choice.
    Map(Vec<(Cell, map::Row)>, String),
}

/// A run that did not end well.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Trouble {
    /// The run.
    pub index: usize,
    /// What it sets.
    pub label: String,
    /// What happened, in a line.
    pub what: String,
    /// What to change, if there is something.
    pub remedy: String,
}

impl Sweep {
    /// Reads the results in the folder `dir`, and writes table and picture of them. The picture of a map is drawn when it is
    /// complete.
    ///
    /// # Errors
    /// When the folder is not that of this sweep or cannot be written, or the run that errors are measured against failed.
    pub fn collect(&self, dir: &Path) -> Result<Collected, SweepError> {
        let folder = Folder::look(dir, self)?;
        let results: Vec<Option<RunResult>> = self.runs.iter().map(|run| folder.result(run)).collect();
        let result = |index: usize| results[index].clone();
        let findings = match &self.kind {
            Kind::Study(study) => {
                let truth = study.truth(&result)?;
                let report = Report::new(self, study, truth.as_ref(), &result);
                folder.put(ROWS, &report.to_csv())?;
                folder.put_or_remove(DIAGRAM, report.diagram().as_deref())?;
                Findings::Study(Box::new(report))
            }
            Kind::Map(map) => self.map_findings(map, &folder, &result)?,
        };
        let trouble = |run: &Run, what: &str, remedy: &str| Trouble {
            index: run.index,
            label: run.label(),
            what: what.to_owned(),
            remedy: remedy.to_owned(),
        };
        let mut collected = Collected { findings, failed: Vec::new(), unfinished: Vec::new() };
        for (run, result) in self.runs.iter().zip(&results) {
            match result {
                Some(RunResult { failure: Some(failure), .. }) => {
                    collected.failed.push(trouble(run, &failure.what, &failure.remedy));
                }
                Some(_) => {}
                None => collected.unfinished.push(trouble(run, unfinished(folder.state(run)), "")),
            }
        }
        Ok(collected)
    }

    fn map_findings(
        &self,
        map: &Map,
        folder: &Folder,
        result: &dyn Fn(usize) -> Option<RunResult>,
    ) -> Result<Findings, SweepError> {
        let rows = map.rows(result);
        let is_whole = rows.len() == map.cells.len();
        folder.put(CELLS, &map::to_csv(map, &rows))?;
        folder.put_or_remove(PICTURE, is_whole.then(|| map::draw(&self.title, map, &rows)).as_deref())?;
        let summary = map.summary(&rows);
        Ok(Findings::Map(rows, summary))
    }
}

/// What is said of a run without a result.
fn unfinished(state: State) -> &'static str {
    match state {
        State::Running => "not finished: it is running",
        State::Interrupted => "not finished: it goes on from a checkpoint",
        State::Finished | State::Failed | State::Missing => "not finished",
    }
}

impl Collected {
    /// The findings in words: table and answer of a study, a line for each choice of a map.
    #[must_use]
    pub fn words(&self) -> String {
        match &self.findings {
            Findings::Study(report) => format!("{}\n{}", report.table().to_plain(), report.answer()),
            Findings::Map(_, summary) => summary.clone(),
        }
    }

    /// What failed and why, and what is not finished: a line for each run.
    #[must_use]
    pub fn troubles(&self) -> String {
        let line = |Trouble { index, label, what, remedy }: &Trouble| {
            let remedy = if remedy.is_empty() { String::new() } else { format!("; {remedy}") };
            format!("run {index} ({label}): {what}{remedy}\n")
        };
        self.failed.iter().chain(&self.unfinished).map(line).collect()
    }
}
