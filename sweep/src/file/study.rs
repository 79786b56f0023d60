//! A study file: its tables, and how a [`Sweep`] is made from them.

mod check;

use partita_scene::SceneError;
use serde::Deserialize;
use toml::Spanned;

use super::Source;
use crate::study::{Reference, Setting, Study};
use crate::sweep::{Kind, Run, Sweep};
use check::{Checked, Reader, Standard};

/// A study file.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct File {
    title: String,
    /// What it is about, for those who write about it.
    #[serde(default, rename = "remark")]
    _remark: String,
    /// Settings of other studies, `study, choice, refinement`, whose errors remain beside the ones here: for the same readers.
    #[serde(default, rename = "beside")]
    _beside: Vec<String>,
    scene: Spanned<String>,
    #[serde(default)]
    set: Vec<Spanned<String>>,
    wanted: Option<Spanned<f64>>,
    quantity: QuantityTable,
    reference: Spanned<ReferenceTable>,
    refinements: Option<Spanned<Vec<Spanned<Refinement>>>>,
    choice: Spanned<Vec<Spanned<Choice>>>,
}

/// `[quantity]`: what is measured.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct QuantityTable {
    name: String,
    column: Spanned<String>,
    take: Spanned<Take>,
    from: Option<Spanned<f64>>,
    to: Option<Spanned<f64>>,
    #[serde(default)]
    error: Measure,
}

/// Which number a run's values in time come to.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub(crate) enum Take {
    /// The last one.
    Last,
    /// The largest.
    Max,
    /// The smallest.
    Min,
    /// The mean over time.
    Mean,
    /// All of them: the error is the largest distance at a common time.
    History,
}

/// How a distance becomes an error.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Deserialize)]
#[serde(rename_all = "snake_case")]
pub(crate) enum Measure {
    /// As part of the reference's magnitude.
    #[default]
    Relative,
    /// As it is.
    Absolute,
}

/// `[reference]`: a run, or a value.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct ReferenceTable {
    set: Option<Spanned<Vec<Spanned<String>>>>,
    check: Option<Spanned<Vec<Spanned<String>>>>,
    value: Option<Spanned<f64>>,
    uncertainty: Option<Spanned<f64>>,
}

/// `[[choice]]`: a curve.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Choice {
    name: Spanned<String>,
    #[serde(default)]
    set: Vec<Spanned<String>>,
    refinements: Option<Spanned<Vec<Spanned<Refinement>>>>,
}

/// A point of a curve.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Refinement {
    name: Spanned<String>,
    set: Vec<Spanned<String>>,
}

/// Reads a study and builds every run of it once. The runs that errors are measured against come first.
pub(crate) fn read(source: &Source) -> Result<Sweep, SceneError> {
    let file: File = source.parse()?;
    let reader = Reader::new(source, &file);
    reader.numbers()?;
    let points = reader.points()?;
    let standard = reader.standard()?;
    reader.same_end(&points, &standard)?;
    let quantity = reader.quantity();
    let mut runs = Vec::new();
    let mut add = |labels: Vec<(String, String)>, checked: Checked| {
        runs.push(Run {
            index: runs.len(),
            labels,
            overrides: checked.overrides,
            fingerprint: checked.fingerprint,
        });
        runs.len() - 1
    };
    let alone = |name: &str| vec![("run".to_owned(), name.to_owned())];
    let reference = match standard {
        Standard::Value { value, uncertainty } => Reference::Value { value, uncertainty },
        Standard::Run { run, check } => Reference::Run {
            run: add(alone("the reference run"), *run),
            check: check.map(|check| add(alone("the run that checks the reference"), *check)),
        },
    };
    let mut settings = Vec::new();
    for (choice, refinement, checked) in points {
        let labels = [("choice", &choice), ("refinement", &refinement)];
        let run = add(labels.map(|(name, value)| (name.to_owned(), value.clone())).to_vec(), checked);
        settings.push(Setting { choice, refinement, run });
    }
    let wanted = file.wanted.as_ref().map(|wanted| *wanted.get_ref());
    let study = Study { quantity, wanted, reference, settings };
    Ok(source.sweep(&file.title, file.scene.get_ref(), runs, Kind::Study(study)))
}
