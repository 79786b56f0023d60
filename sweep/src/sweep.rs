//! A sweep in memory: a list of runs, and what is made of their results.

use std::path::{Path, PathBuf};

use partita_scene::file_kind::FileKind;
use partita_scene::{Resolved, SceneError};

use crate::file::{self, Source};
use crate::fingerprint::Fingerprint;
use crate::map::Map;
use crate::study::Study;

/// A sweep whose runs are all sound.
#[derive(Debug, Clone)]
pub struct Sweep {
    pub(crate) name: String,
    pub(crate) title: String,
    pub(crate) file: PathBuf,
    pub(crate) text: String,
    /// The scene file or its folder.
    pub(crate) scene: PathBuf,
    pub(crate) runs: Vec<Run>,
    /// What is measured, and what is made of it.
    pub kind: Kind,
}

/// What a run of a sweep measures, and what is made of the results.
#[derive(Debug, Clone)]
pub enum Kind {
    /// Error against cost: `study.csv` and `study.svg`.
    Study(Study),
    /// Outcomes over two parameters: `cells.csv` and `map.svg`.
    Map(Map),
}

/// One run of a sweep.
#[derive(Debug, Clone)]
pub struct Run {
    /// Its place in the sweep, from 0.
    pub index: usize,
    /// What is set, as names and values.
    pub labels: Vec<(String, String)>,
    /// Overrides of the scene.
    pub overrides: Vec<String>,
    /// Sixteen digits that change with everything that decides about its result, and with nothing else.
    pub fingerprint: String,
}

impl Run {
    /// What is set, in a line.
    #[must_use]
    pub fn label(&self) -> String {
        self.labels.iter().map(|(_, value)| value.as_str()).collect::<Vec<_>>().join(", ")
    }
}

impl Sweep {
    /// Reads the file of a study or of a map, whichever it is, and checks every run in it.
    ///
    /// # Errors
    /// [`SceneError`] with the place that is wrong and how to mend it. Nothing has been written then.
    pub fn load(path: &Path) -> Result<Self, SceneError> {
        let is_map =
            std::fs::read_to_string(path).is_ok_and(|text| FileKind::of(&text) == Some(FileKind::Map));
        Self::load_as(if is_map { FileKind::Map } else { FileKind::Study }, path)
    }

    /// Reads a file that must be of this kind.
    ///
    /// # Errors
    /// As [`load`](Self::load), and where the file is of another kind.
    pub fn load_as(kind: FileKind, path: &Path) -> Result<Self, SceneError> {
        if let Some((what, hint)) = kind.misplaced(path) {
            return Err(SceneError::plain(what, hint));
        }
        let (word, hint) = match kind {
            FileKind::Map => ("map", "name a map file, such as maps/tank.toml"),
            _ => ("study", "name a study file: TOML with a scene, choices and a reference"),
        };
        let text = std::fs::read_to_string(path).map_err(|error| {
            SceneError::plain(format!("{} cannot be read: {error}", path.display()), hint)
        })?;
        let source = Source::new(path, text, word);
        if kind == FileKind::Map { file::map::read(&source) } else { file::study::read(&source) }
    }

    /// The name of its file, without the ending.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Its file.
    #[must_use]
    pub fn file(&self) -> &Path {
        &self.file
    }

    /// All its runs.
    #[must_use]
    pub fn runs(&self) -> &[Run] {
        &self.runs
    }

    /// What a file of this kind is called.
    pub(crate) fn word(&self) -> &'static str {
        match self.kind {
            Kind::Study(_) => "study",
            Kind::Map(_) => "map",
        }
    }

    /// What it is called, such as "map `tank`".
    pub(crate) fn is_called(&self) -> String {
        format!("{} `{}`", self.word(), self.name)
    }

    /// Of all its runs together.
    pub(crate) fn fingerprint(&self) -> String {
        let start = Fingerprint::empty().and(self.word());
        self.runs.iter().fold(start, |all, run| all.and(&run.fingerprint)).text()
    }

    /// The scene of a run.
    pub(crate) fn resolve(&self, run: &Run) -> Result<Resolved, SceneError> {
        partita_scene::load(&self.scene, &run.overrides)
    }

    /// Newton iterations of all fields that a run may take.
    pub(crate) fn newton_budget(&self) -> usize {
        match &self.kind {
            Kind::Study(_) => usize::MAX,
            Kind::Map(map) => map.newton_budget,
        }
    }

    /// Whether the processor time of a run is part of the result.
    pub(crate) fn wants_seconds(&self) -> bool {
        matches!(self.kind, Kind::Study(_))
    }
}
