//! What is read of a study file: its words. The settings are the affair of `partita study`.

use std::path::Path;

use serde::Deserialize;

use crate::task::{self, TaskError};

/// The shipped studies, in the order of the page: from one field to two.
pub(super) const STUDIES: [&str; 9] = [
    "manufactured-flow",
    "csm1",
    "fsi1",
    "tank-time",
    "tank-mesh",
    "tank-tolerance",
    "beam-time",
    "beam-mesh",
    "beam-tolerance",
];

/// A study file.
#[derive(Debug, Clone, Deserialize)]
pub(super) struct Study {
    #[serde(skip)]
    pub(super) name: String,
    pub(super) title: String,
    /// What the page says about it.
    pub(super) remark: String,
    /// Rows `study, choice, setting` of other studies, whose errors remain beside the ones here.
    #[serde(default)]
    pub(super) beside: Vec<String>,
    /// Folder of the scene, from that of the study.
    pub(super) scene: String,
    pub(super) wanted: f64,
    pub(super) quantity: Quantity,
}

#[derive(Debug, Clone, Deserialize)]
pub(super) struct Quantity {
    name: String,
    #[serde(default)]
    error: Measure,
}

#[derive(Debug, Clone, Copy, Default, Deserialize)]
#[serde(rename_all = "snake_case")]
enum Measure {
    #[default]
    Relative,
    Absolute,
}

impl Study {
    /// Its file, from the root of the workspace.
    pub(super) fn file(name: &str) -> String {
        format!("studies/{name}.toml")
    }

    pub(super) fn read(root: &Path, name: &str) -> Result<Self, TaskError> {
        let study: Self = task::read_toml(&root.join(Self::file(name)))?;
        Ok(Self { name: name.to_owned(), ..study })
    }

    /// What the error is of, as the diagram says it.
    pub(super) fn error_of(&self) -> String {
        let kind = match self.quantity.error {
            Measure::Relative => "relative error",
            Measure::Absolute => "error",
        };
        format!("{kind} of the {}", self.quantity.name)
    }

    /// Whether it asks how loose tolerances may be: then it says which errors stand beside theirs.
    pub(super) fn is_of_tolerances(&self) -> bool {
        !self.beside.is_empty()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::task::workspace_root;

    #[test]
    fn the_shipped_studies_say_what_they_are_about() {
        for name in STUDIES {
            let study = Study::read(workspace_root(), name).expect("a shipped study");
            assert!(!study.remark.trim().is_empty() && study.wanted > 0.0, "{name}");
            assert_eq!(study.is_of_tolerances(), name.ends_with("-tolerance"), "{name}");
        }
    }
}
