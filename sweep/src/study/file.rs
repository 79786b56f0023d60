//! The text of a study file: its keys, and what is wrong where one cannot be read.

use serde::Deserialize;
use toml::Spanned;

use super::error::{Source, StudyError};
use partita_scene::spelling::nearest;

/// A study file.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct File {
    pub(super) title: String,
    /// What it is about, for those who write about it.
    #[serde(default, rename = "remark")]
    _remark: String,
    /// Settings of other studies, `study, choice, refinement`, whose errors remain beside the ones here: for the same readers.
    #[serde(default, rename = "beside")]
    _beside: Vec<String>,
    pub(super) scene: Spanned<String>,
    #[serde(default)]
    pub(super) set: Vec<Spanned<String>>,
    pub(super) wanted: Option<Spanned<f64>>,
    pub(super) quantity: Quantity,
    pub(super) reference: Spanned<Reference>,
    pub(super) refinements: Option<Spanned<Vec<Spanned<Refinement>>>>,
    pub(super) choice: Spanned<Vec<Spanned<Choice>>>,
}

/// `[quantity]`: what is measured.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Quantity {
    pub(super) name: String,
    pub(super) column: Spanned<String>,
    pub(super) take: Spanned<Take>,
    pub(super) from: Option<Spanned<f64>>,
    pub(super) to: Option<Spanned<f64>>,
    #[serde(default)]
    pub(super) error: Measure,
}

/// Which number a run's values in time come to.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub(super) enum Take {
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
pub(super) enum Measure {
    /// As part of the reference's magnitude.
    #[default]
    Relative,
    /// As it is.
    Absolute,
}

/// `[reference]`: a run, or a value.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Reference {
    pub(super) set: Option<Spanned<Vec<Spanned<String>>>>,
    pub(super) check: Option<Spanned<Vec<Spanned<String>>>>,
    pub(super) value: Option<Spanned<f64>>,
    pub(super) uncertainty: Option<Spanned<f64>>,
}

/// `[[choice]]`: a curve.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Choice {
    pub(super) name: Spanned<String>,
    #[serde(default)]
    pub(super) set: Vec<Spanned<String>>,
    pub(super) refinements: Option<Spanned<Vec<Spanned<Refinement>>>>,
}

/// A point of a curve.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Refinement {
    pub(super) name: Spanned<String>,
    pub(super) set: Vec<Spanned<String>>,
}

/// Reads the text.
pub(super) fn parse(source: &Source) -> Result<File, StudyError> {
    toml::from_str(&source.text).map_err(|error| explain(&error, source))
}

fn explain(error: &toml::de::Error, source: &Source) -> StudyError {
    let place = error.span().unwrap_or(0..0);
    let message = error.message();
    let names: Vec<&str> = message.split('`').skip(1).step_by(2).collect();
    let (what, label, hint) = if message.starts_with("unknown field") {
        let hint = match nearest(names[0], names[1..].iter().copied()) {
            Some(near) => format!("did you mean `{near}`?"),
            None => format!("known here: {}", names[1..].join(", ")),
        };
        (format!("`{}` is not a key of a study", names[0]), "unknown key".to_owned(), hint)
    } else if message.starts_with("unknown variant") {
        let hint = format!("choose one of {}", names[1..].join(", "));
        (format!("`{}` cannot be chosen here", names[0]), "unknown choice".to_owned(), hint)
    } else if message.starts_with("missing field") {
        let key = names[0];
        let what = format!("the study lacks `{key}`");
        (what, format!("`{key}` is missing here"), meaning(key).to_owned())
    } else if let Some((_, wanted)) =
        message.strip_prefix("invalid ").and_then(|message| message.rsplit_once(", expected "))
    {
        let wanted = kind(wanted);
        (format!("this should be {wanted}"), format!("not {wanted}"), format!("give {wanted}"))
    } else {
        let hint = "a study is written in TOML: lines `key = value` under headings `[table]`".to_owned();
        ("this is not TOML".to_owned(), message.to_owned(), hint)
    };
    source.error(what, place, label, hint)
}

/// What to give for a key that must be there.
fn meaning(key: &str) -> &'static str {
    match key {
        "title" => "give a line that names the study: title = \"...\"",
        "scene" => {
            "name a scene file or its folder, relative to the study: scene = \"../scenes/elastic-bottom\""
        }
        "quantity" => "say what is measured: [quantity] with `name`, `column` and `take`",
        "reference" => "say what it is measured against: [reference] with `set` for a run, or with `value`",
        "choice" => "add a curve: [[choice]] with a `name` and `refinements`",
        "column" => "name a column of probes.csv",
        "take" => "choose one of last, max, min, mean, history",
        "name" => "give it a name that tables and diagrams can show",
        "set" => "give a list of overrides, such as set = [\"time.step=0.01\"]; an empty one sets nothing",
        _ => "",
    }
}

/// serde's name of a kind in plain words.
fn kind(kind: &str) -> &str {
    match kind {
        "f64" => "a number",
        "a string" => "text in quotes",
        "a sequence" => "a list",
        _ if kind.starts_with("struct ") || kind == "a map" => "a table",
        _ => kind,
    }
}
