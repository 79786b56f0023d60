//! What a benchmark is: `benchmark.toml` beside a scene.

use std::path::{Path, PathBuf};

use serde::Deserialize;

use crate::task::{self, TaskError};

/// A scene with a setting, its levels, and what the literature says about it.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Case {
    /// What it is called on the command line and in the tables.
    pub(super) name: String,
    /// One line about it.
    pub(super) title: String,
    /// Where its references come from.
    pub(super) source: String,
    /// What the reader of the results should know. Default: nothing.
    #[serde(default)]
    pub(super) remark: String,
    /// Overrides of the scene on every level.
    #[serde(default)]
    pub(super) set: Vec<String>,
    /// Overrides of the scene on each level, the coarsest first.
    pub(super) levels: Vec<Vec<String>>,
    /// Where a run may end before the scene does. Default: nowhere.
    #[serde(default)]
    pub(super) until: Option<Until>,
    /// What is compared.
    #[serde(rename = "quantity")]
    pub(super) quantities: Vec<Quantity>,
    /// Folder of its scene.
    #[serde(skip)]
    pub(super) scene: PathBuf,
}

/// A run ends where the last periods of a signal repeat each other.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Until {
    /// Column of `probes.csv`.
    pub(super) column: String,
    /// So many periods must agree.
    pub(super) periods: usize,
    /// Amplitude and length of each differ by less than this from the last one's \[%\].
    pub(super) percent: f64,
    /// Steps between two looks.
    pub(super) every: usize,
}

/// A number of the literature, and where ours is found.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Quantity {
    /// Its name, with its unit.
    pub(super) name: String,
    /// Column of `probes.csv`.
    pub(super) column: String,
    /// What of the column.
    pub(super) take: Take,
    /// Factor from the column's unit to that of the name. Default: 1.
    #[serde(default = "one")]
    pub(super) scale: f64,
    /// The literature's value.
    pub(super) reference: f64,
    /// Of an amplitude whose mean is too near to zero to be compared: that mean, for the pictures. Default: none.
    #[serde(default)]
    pub(super) around: Option<f64>,
    /// How far ours may be from it on the finest level \[%\].
    pub(super) target_percent: f64,
}

fn one() -> f64 {
    1.0
}

/// A number from a column.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub(super) enum Take {
    /// The value at the end of the run.
    Last,
    /// Of the last period.
    Mean,
    /// Of the last period.
    Amplitude,
    /// Of the last period.
    Frequency,
}

/// All cases of the workspace, in the order of their scenes' names.
pub(super) fn all(root: &Path) -> Result<Vec<Case>, TaskError> {
    let mut cases = Vec::new();
    for folder in task::folders_of(&root.join("scenes"))? {
        let path = folder.join("benchmark.toml");
        if !path.is_file() {
            continue;
        }
        cases.extend(
            task::read_toml::<File>(&path)?
                .cases
                .into_iter()
                .map(|case| Case { scene: folder.clone(), ..case }),
        );
    }
    Ok(cases)
}

/// `benchmark.toml`.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct File {
    #[serde(rename = "case")]
    cases: Vec<Case>,
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::task::workspace_root;

    /// Those that run until their swing repeats.
    const PERIODIC: [&str; 5] = ["cfd3", "cfd3-step-0.00125", "fsi2", "fsi3", "fsi3-step-0.001"];

    #[test]
    fn the_shipped_cases_are_sound() {
        let cases = all(workspace_root()).expect("they can be read");
        let mut names: Vec<&str> = cases.iter().map(|case| case.name.as_str()).collect();
        for needed in [
            "cavity-re100",
            "cavity-re400",
            "cavity-re1000",
            "cfd1",
            "csm1",
            "csm3",
            "fsi1",
            "cfd3",
            "fsi2",
            "fsi3",
        ] {
            assert!(names.contains(&needed), "{needed} is missing in {names:?}");
        }
        names.sort_unstable();
        names.dedup();
        assert_eq!(names.len(), cases.len(), "a name is given twice");
        let periodic: Vec<&str> =
            cases.iter().filter(|case| case.until.is_some()).map(|case| case.name.as_str()).collect();
        assert_eq!(periodic, PERIODIC);
        for case in &cases {
            assert!(case.levels.len() >= 3, "{} has fewer than three levels", case.name);
            assert!(!case.quantities.is_empty(), "{} compares nothing", case.name);
            if let Some(until) = &case.until {
                assert!(
                    case.quantities.iter().any(|quantity| quantity.column == until.column),
                    "{}",
                    case.name
                );
                assert!(until.periods > 1 && until.every > 0 && until.percent > 0.0, "{}", case.name);
            }
            for quantity in &case.quantities {
                assert!(quantity.reference != 0.0, "{}: a relative error of nothing", case.name);
                assert!(!quantity.name.contains([',', '"', '|']), "{} stands in tables", quantity.name);
            }
        }
    }

    #[test]
    fn a_misspelled_key_is_refused() {
        assert!(toml::from_str::<File>("[[case]]\nnam = \"x\"\n").is_err());
        assert!(toml::from_str::<File>("[[cases]]\nname = \"x\"\n").is_err());
    }
}
