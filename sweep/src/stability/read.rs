//! A map file, read and checked: every cell of it is a sound scene before the first one runs.

use std::fs;
use std::ops::Range;
use std::path::Path;

use serde::Deserialize;
use toml::Spanned;

use super::template::{self, Value};
use partita_scene::SceneError;
use partita_scene::file_kind::FileKind;
use partita_scene::spelling::nearest;

/// A map file as it is written.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct File {
    title: String,
    scene: Spanned<String>,
    steps: Spanned<i64>,
    #[serde(default)]
    set: Vec<Spanned<String>>,
    #[serde(default = "budget")]
    newton_budget: Spanned<i64>,
    #[serde(default = "largest_growth")]
    largest_energy_growth: f64,
    parameter: Vec<Spanned<Parameter>>,
    choice: Vec<Choice>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Parameter {
    name: Spanned<String>,
    label: Option<String>,
    values: Spanned<Vec<Spanned<Given>>>,
    set: Vec<Spanned<String>>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Choice {
    name: Spanned<String>,
    #[serde(default)]
    set: Vec<Spanned<String>>,
}

#[derive(Debug, Deserialize)]
#[serde(untagged)]
enum Given {
    Number(f64),
    Word(String),
}

fn budget() -> Spanned<i64> {
    Spanned::new(0..0, 20_000)
}

fn largest_growth() -> f64 {
    100.0
}

/// A map whose cells are all sound scenes.
#[derive(Debug, Clone)]
pub struct Map {
    /// One line that names it.
    pub title: String,
    /// What it is called: its file without the ending.
    pub name: String,
    /// Newton iterations, both fields together, that a cell may take.
    pub newton_budget: usize,
    /// A cell whose energy grows by more than this factor is not called converged.
    pub largest_energy_growth: f64,
    /// The two axes.
    pub axes: [Axis; 2],
    /// Names of the choices, accelerators as a rule.
    pub choices: Vec<String>,
    /// All cells: choice by choice, within it row by row of the first parameter.
    pub cells: Vec<Cell>,
    /// The file's text.
    pub text: String,
}

/// One parameter.
#[derive(Debug, Clone)]
pub struct Axis {
    /// Its column in tables.
    pub name: String,
    /// How pictures call it.
    pub label: String,
    /// Its values, as they are written in tables.
    pub values: Vec<String>,
}

/// One run of a map.
#[derive(Debug, Clone)]
pub struct Cell {
    /// Index of the choice.
    pub choice: usize,
    /// Indices of the values of both parameters.
    pub values: [usize; 2],
    /// The scene file.
    pub scene: std::path::PathBuf,
    /// What is set in it.
    pub overrides: Vec<String>,
}

impl Map {
    /// Reads a map file and checks every cell of it.
    ///
    /// # Errors
    /// [`SceneError`] with the place in the map and how to mend it. Nothing has been written then.
    pub fn load(path: &Path) -> Result<Self, SceneError> {
        if let Some((what, hint)) = FileKind::Map.misplaced(path) {
            return Err(SceneError::plain(what, hint));
        }
        let text = fs::read_to_string(path).map_err(|error| {
            let what = format!("{} cannot be read: {error}", path.display());
            SceneError::plain(what, "name a map file, such as maps/tank.toml")
        })?;
        let source = Source { name: path.display().to_string(), text };
        let file: File = toml::from_str(&source.text).map_err(|error| source.syntax(&error))?;
        let map = source.check(&file, path)?;
        map.check_scenes(&source, &file)?;
        Ok(map)
    }

    /// The values of a cell, as written in tables.
    #[must_use]
    pub fn values(&self, cell: &Cell) -> [&str; 2] {
        [0, 1].map(|axis| self.axes[axis].values[cell.values[axis]].as_str())
    }

    /// Reads the scene of each cell, first without what the map varies.
    fn check_scenes(&self, source: &Source, file: &File) -> Result<(), SceneError> {
        let Some(first) = self.cells.first() else { return Ok(()) };
        partita_scene::load(&first.scene, &[])?;
        for cell in &self.cells {
            if let Err(error) = partita_scene::load(&cell.scene, &cell.overrides) {
                let mut marks = vec![(file.choice[cell.choice].name.span(), "this choice")];
                for axis in [0, 1] {
                    let values = file.parameter[axis].get_ref().values.get_ref();
                    marks.push((values[cell.values[axis]].span(), "this value"));
                }
                let (what, hint) = error.first();
                let what = format!("a cell of the map is no sound scene: {what}");
                return Err(SceneError::in_text(&source.name, &source.text, &what, &hint, &marks));
            }
        }
        Ok(())
    }
}

/// The text of a map and its name in messages.
struct Source {
    name: String,
    text: String,
}

impl Source {
    fn fault(&self, place: Range<usize>, what: &str, hint: &str) -> SceneError {
        SceneError::in_text(&self.name, &self.text, what, hint, &[(place, "here")])
    }

    fn syntax(&self, error: &toml::de::Error) -> SceneError {
        let message = error.message();
        let names: Vec<&str> = message.split('`').skip(1).step_by(2).collect();
        let hint = match (message.starts_with("unknown field"), names.split_first()) {
            (true, Some((key, known))) => match nearest(key, known.iter().copied()) {
                Some(near) => format!("did you mean `{near}`?"),
                None => format!("keys that may stand here: {}", known.join(", ")),
            },
            _ => "a map names a title, a scene, steps, two [[parameter]] tables and its [[choice]] tables; \
                  docs/stability.md tells of them"
                .to_owned(),
        };
        self.fault(error.span().unwrap_or(0..0), message, &hint)
    }

    fn count(&self, given: &Spanned<i64>, what: &str) -> Result<usize, SceneError> {
        usize::try_from(*given.get_ref()).ok().filter(|&count| count > 0).ok_or_else(|| {
            self.fault(
                given.span(),
                &format!("{what} is not a count of at least 1"),
                "write a whole number above 0",
            )
        })
    }

    fn check(&self, file: &File, path: &Path) -> Result<Map, SceneError> {
        let steps = self.count(&file.steps, "steps")?;
        let newton_budget = self.count(&file.newton_budget, "newton_budget")?;
        let [rows, columns] = &file.parameter[..] else {
            let place = file.parameter.get(2).map_or(0..0, Spanned::span);
            let what = format!("a map has two parameters, not {}", file.parameter.len());
            return Err(self.fault(place, &what, "write two tables [[parameter]]"));
        };
        let parameters = [rows.get_ref(), columns.get_ref()];
        self.check_names(file, parameters)?;
        let common: Vec<String> = file.set.iter().map(|set| set.get_ref().clone()).collect();
        let always = [
            format!("time.steps={steps}"),
            "output.fields_every=0".into(),
            "output.checkpoint_every=0".into(),
        ];
        let scene = path.parent().unwrap_or(Path::new("")).join(file.scene.get_ref());
        let axes = [self.settings(parameters[0])?, self.settings(parameters[1])?];
        let mut cells = Vec::new();
        for (choice, named) in file.choice.iter().enumerate() {
            let chosen: Vec<String> = named.set.iter().map(|set| set.get_ref().clone()).collect();
            for (row, row_sets) in axes[0].iter().enumerate() {
                for (column, column_sets) in axes[1].iter().enumerate() {
                    let overrides = [&always[..], &common, &chosen, row_sets, column_sets].concat();
                    cells.push(Cell { choice, values: [row, column], scene: scene.clone(), overrides });
                }
            }
        }
        Ok(Map {
            title: file.title.clone(),
            name: path
                .file_stem()
                .map_or_else(|| "map".to_owned(), |stem| stem.to_string_lossy().into_owned()),
            newton_budget,
            largest_energy_growth: file.largest_energy_growth,
            axes: parameters.map(|parameter| Axis {
                name: parameter.name.get_ref().clone(),
                label: parameter.label.clone().unwrap_or_else(|| parameter.name.get_ref().clone()),
                values: parameter
                    .values
                    .get_ref()
                    .iter()
                    .map(|given| value(given.get_ref()).text())
                    .collect(),
            }),
            choices: file.choice.iter().map(|choice| choice.name.get_ref().clone()).collect(),
            cells,
            text: self.text.clone(),
        })
    }

    /// The overrides of each value of a parameter.
    fn settings(&self, parameter: &Parameter) -> Result<Vec<Vec<String>>, SceneError> {
        let values = parameter.values.get_ref();
        let fill = |given: &Spanned<Given>, set: &Spanned<String>| {
            template::fill(set.get_ref(), &value(given.get_ref())).map_err(|what| {
                let hint = "the formula of a value stands in `$(...)`, such as `structure.density=$(1000/x)`";
                let marks = [(set.span(), "in this"), (given.span(), "with this value")];
                SceneError::in_text(&self.name, &self.text, &what, hint, &marks)
            })
        };
        values.iter().map(|given| parameter.set.iter().map(|set| fill(given, set)).collect()).collect()
    }

    /// Names are columns of tables and must differ; there must be something to run.
    fn check_names(&self, file: &File, parameters: [&Parameter; 2]) -> Result<(), SceneError> {
        for parameter in parameters {
            let (name, place) = (parameter.name.get_ref(), parameter.name.span());
            if name.is_empty() || !name.chars().all(|c| c.is_ascii_alphanumeric() || c == '_') {
                let hint =
                    "it is a column of a table: use letters, digits and _, and write the rest into `label`";
                return Err(self.fault(place, &format!("`{name}` is no name of a parameter"), hint));
            }
            if parameter.values.get_ref().is_empty() {
                return Err(self.fault(
                    parameter.values.span(),
                    "a parameter without values",
                    "write at least one",
                ));
            }
            if parameter.set.is_empty() {
                let hint = "name at least one key of the scene, such as `time.step=$(x)`";
                return Err(self.fault(place, &format!("`{name}` sets nothing"), hint));
            }
        }
        if parameters[0].name.get_ref() == parameters[1].name.get_ref() {
            let place = parameters[1].name.span();
            return Err(self.fault(place, "both parameters have one name", "name them differently"));
        }
        if file.choice.is_empty() {
            return Err(self.fault(0..0, "the map makes no choice", "write at least one table [[choice]]"));
        }
        for (index, choice) in file.choice.iter().enumerate() {
            if file.choice[..index].iter().any(|earlier| earlier.name.get_ref() == choice.name.get_ref()) {
                let what = format!("there are two choices `{}`", choice.name.get_ref());
                return Err(self.fault(choice.name.span(), &what, "name them differently"));
            }
        }
        Ok(())
    }
}

fn value(given: &Given) -> Value {
    match given {
        Given::Number(number) => Value::Number(*number),
        Given::Word(word) => Value::Word(word.clone()),
    }
}
