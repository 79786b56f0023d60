//! The text of a sweep file: its keys, and what is wrong where one cannot be read.

pub(crate) mod map;
pub(crate) mod study;
mod template;

use std::ops::Range;
use std::path::{Path, PathBuf};

use partita_scene::SceneError;
use partita_scene::spelling::nearest;
use serde::de::DeserializeOwned;
use toml::Spanned;

use crate::sweep::{Kind, Run, Sweep};

/// A sweep file's name and text, to point into.
#[derive(Debug, Clone)]
pub(crate) struct Source {
    path: PathBuf,
    text: String,
    /// What the file is called in messages: "study", "map".
    word: &'static str,
}

impl Source {
    pub(crate) fn new(path: &Path, text: String, word: &'static str) -> Self {
        Self { path: path.to_owned(), text, word }
    }

    /// The name of the file without its ending.
    fn stem(&self) -> String {
        self.path.file_stem().map_or_else(|| self.word.to_owned(), |stem| stem.to_string_lossy().into_owned())
    }

    /// A path that the file names relative to itself.
    fn beside(&self, path: &str) -> PathBuf {
        self.path.parent().unwrap_or(Path::new("")).join(path)
    }

    /// The sweep that this file describes.
    fn sweep(&self, title: &str, scene: &str, runs: Vec<Run>, kind: Kind) -> Sweep {
        Sweep {
            name: self.stem(),
            title: title.to_owned(),
            file: self.path.clone(),
            text: self.text.clone(),
            scene: self.beside(scene),
            runs,
            kind,
        }
    }

    /// A problem at a place of the text.
    fn error(
        &self,
        what: impl Into<String>,
        place: Range<usize>,
        label: impl Into<String>,
        hint: impl Into<String>,
    ) -> SceneError {
        self.marked(&what.into(), &[(place, &label.into())], &hint.into())
    }

    /// A problem that several places have a part in.
    fn marked(&self, what: &str, marks: &[(Range<usize>, &str)], hint: &str) -> SceneError {
        SceneError::in_text(&self.path.display().to_string(), &self.text, what, hint, marks)
    }

    /// Reads the text.
    fn parse<F: DeserializeOwned>(&self) -> Result<F, SceneError> {
        toml::from_str(&self.text).map_err(|error| self.explain(&error))
    }

    fn explain(&self, error: &toml::de::Error) -> SceneError {
        let Self { word, .. } = self;
        let place = error.span().unwrap_or(0..0);
        let message = error.message();
        let names: Vec<&str> = message.split('`').skip(1).step_by(2).collect();
        let (what, label, hint) = if message.starts_with("unknown field") {
            let hint = match nearest(names[0], names[1..].iter().copied()) {
                Some(near) => format!("did you mean `{near}`?"),
                None => format!("known here: {}", names[1..].join(", ")),
            };
            (format!("`{}` is not a key of a {word}", names[0]), "unknown key".to_owned(), hint)
        } else if message.starts_with("unknown variant") {
            let hint = format!("choose one of {}", names[1..].join(", "));
            (format!("`{}` cannot be chosen here", names[0]), "unknown choice".to_owned(), hint)
        } else if message.starts_with("missing field") {
            let key = names[0];
            let what = format!("the {word} lacks `{key}`");
            (what, format!("`{key}` is missing here"), meaning(key).to_owned())
        } else if let Some((_, wanted)) =
            message.strip_prefix("invalid ").and_then(|message| message.rsplit_once(", expected "))
        {
            let wanted = kind(wanted);
            (format!("this should be {wanted}"), format!("not {wanted}"), format!("give {wanted}"))
        } else {
            let hint = format!("a {word} is written in TOML: lines `key = value` under headings `[table]`");
            ("this is not TOML".to_owned(), message.to_owned(), hint)
        };
        self.error(what, place, label, hint)
    }

    /// Names must differ.
    fn differ<'n>(
        &self,
        names: impl Iterator<Item = &'n Spanned<String>>,
        what: &str,
    ) -> Result<(), SceneError> {
        let mut seen: Vec<&str> = Vec::new();
        for name in names {
            if seen.contains(&name.get_ref().as_str()) {
                return Err(self.error(what, name.span(), "the second time", "give each its own name"));
            }
            seen.push(name.get_ref());
        }
        Ok(())
    }
}

/// What to give for a key that must be there.
fn meaning(key: &str) -> &'static str {
    match key {
        "title" => "give a line that names it: title = \"...\"",
        "scene" => {
            "name a scene file or its folder, relative to this file: scene = \"../scenes/elastic-bottom\""
        }
        "quantity" => "say what is measured: [quantity] with `name`, `column` and `take`",
        "reference" => "say what it is measured against: [reference] with `set` for a run, or with `value`",
        "choice" => "add a table [[choice]] with a `name`, and with what it sets",
        "parameter" => "write two tables [[parameter]], each with `name`, `values` and `set`",
        "steps" => "give the number of time steps of a cell: steps = 30",
        "values" => "give a list of numbers or words, such as values = [0.01, 1, 100]",
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
        "i64" => "a whole number",
        "a string" => "text in quotes",
        "a sequence" => "a list",
        _ if kind.starts_with("struct ") || kind == "a map" => "a table",
        _ => kind,
    }
}

/// The first thing that is wrong with a scene, and how to mend it; how many more there are.
fn first_problem(error: &SceneError) -> (String, String) {
    let (what, hint) = error.first();
    // The line for the command line, where the overrides are `--set`s.
    let hint = hint.lines().filter(|line| !line.contains("`--set`s")).collect::<Vec<_>>().join("\n");
    match error.problems().len() {
        0 | 1 => (what, hint),
        more => (format!("{what} (and {} more)", more - 1), hint),
    }
}
