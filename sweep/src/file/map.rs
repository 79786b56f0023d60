//! A map file: its tables, and how a [`Sweep`] is made from them. Every cell is a sound scene before the first one runs.

use partita_scene::SceneError;
use serde::Deserialize;
use toml::Spanned;

use super::Source;
use super::template::{self, Value};
use crate::fingerprint::Fingerprint;
use crate::map::{Axis, Cell, Map};
use crate::sweep::{Kind, Run, Sweep};

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

/// Reads a map and the scene of each of its cells.
pub(crate) fn read(source: &Source) -> Result<Sweep, SceneError> {
    let file: File = source.parse()?;
    let reader = Reader { source, file: &file };
    let map = reader.map()?;
    let runs = reader.runs(&map)?;
    Ok(source.sweep(&file.title, file.scene.get_ref(), runs, Kind::Map(map)))
}

struct Reader<'a> {
    source: &'a Source,
    file: &'a File,
}

impl Reader<'_> {
    fn map(&self) -> Result<Map, SceneError> {
        let file = self.file;
        self.count(&file.steps, "steps")?;
        let newton_budget = self.count(&file.newton_budget, "newton_budget")?;
        let [rows, columns] = &file.parameter[..] else {
            let place = file.parameter.get(2).map_or(0..0, Spanned::span);
            let what = format!("a map has two parameters, not {}", file.parameter.len());
            return Err(self.source.error(what, place, "", "write two tables [[parameter]]"));
        };
        let parameters = [rows.get_ref(), columns.get_ref()];
        self.check_names(parameters)?;
        let axes = parameters.map(|parameter| Axis {
            name: parameter.name.get_ref().clone(),
            label: parameter.label.clone().unwrap_or_else(|| parameter.name.get_ref().clone()),
            values: parameter.values.get_ref().iter().map(|given| value(given.get_ref()).text()).collect(),
        });
        let mut cells = Vec::new();
        for choice in 0..file.choice.len() {
            for row in 0..axes[0].values.len() {
                cells.extend((0..axes[1].values.len()).map(|column| Cell { choice, values: [row, column] }));
            }
        }
        let choices = file.choice.iter().map(|choice| choice.name.get_ref().clone()).collect();
        Ok(Map { newton_budget, largest_energy_growth: file.largest_energy_growth, axes, choices, cells })
    }

    /// The run of each cell.
    fn runs(&self, map: &Map) -> Result<Vec<Run>, SceneError> {
        let settings = [self.settings(0)?, self.settings(1)?];
        let words = |given: &[Spanned<String>]| -> Vec<String> {
            given.iter().map(|word| word.get_ref().clone()).collect()
        };
        let always = [
            format!("time.steps={}", self.file.steps.get_ref()),
            "output.fields_every=0".into(),
            "output.checkpoint_every=0".into(),
        ];
        let common = words(&self.file.set);
        // The scene without what the map varies: its own mistakes are shown in its own text.
        partita_scene::load(&self.source.beside(self.file.scene.get_ref()), &[])?;
        let run = |(index, cell): (usize, &Cell)| {
            let chosen = words(&self.file.choice[cell.choice].set);
            let [row, column] = [0, 1].map(|axis| &settings[axis][cell.values[axis]]);
            let overrides = [&always[..], &common, &chosen, row, column].concat();
            let fingerprint = self.fingerprint(cell, &overrides, map.newton_budget)?;
            Ok(Run { index, labels: map.labels(cell), overrides, fingerprint })
        };
        map.cells.iter().enumerate().map(run).collect()
    }

    /// Reads the scene of a cell.
    fn fingerprint(&self, cell: &Cell, overrides: &[String], budget: usize) -> Result<String, SceneError> {
        let scene = self.source.beside(self.file.scene.get_ref());
        let resolved = partita_scene::load(&scene, overrides).map_err(|error| {
            let mut marks = vec![(self.file.choice[cell.choice].name.span(), "this choice")];
            for axis in [0, 1] {
                let values = self.file.parameter[axis].get_ref().values.get_ref();
                marks.push((values[cell.values[axis]].span(), "this value"));
            }
            let (what, hint) = error.first();
            self.source.marked(&format!("a cell of the map is no sound scene: {what}"), &marks, &hint)
        })?;
        Ok(Fingerprint::of(&resolved).and(&format!("newton_budget = {budget}")).text())
    }

    /// The overrides of each value of a parameter.
    fn settings(&self, axis: usize) -> Result<Vec<Vec<String>>, SceneError> {
        let parameter = self.file.parameter[axis].get_ref();
        let fill = |given: &Spanned<Given>, set: &Spanned<String>| {
            template::fill(set.get_ref(), &value(given.get_ref())).map_err(|what| {
                let hint = "the formula of a value stands in `$(...)`, such as `structure.density=$(1000/x)`";
                self.source.marked(&what, &[(set.span(), "in this"), (given.span(), "with this value")], hint)
            })
        };
        let values = parameter.values.get_ref();
        values.iter().map(|given| parameter.set.iter().map(|set| fill(given, set)).collect()).collect()
    }

    fn count(&self, given: &Spanned<i64>, what: &str) -> Result<usize, SceneError> {
        usize::try_from(*given.get_ref()).ok().filter(|&count| count > 0).ok_or_else(|| {
            let what = format!("{what} is not a count of at least 1");
            self.source.error(what, given.span(), "out of range", "write a whole number above 0")
        })
    }

    /// Names are columns of tables and must differ; there must be something to run.
    fn check_names(&self, parameters: [&Parameter; 2]) -> Result<(), SceneError> {
        let wrong = |what: String, place, hint: &str| Err(self.source.error(what, place, "here", hint));
        for parameter in parameters {
            let (name, place) = (parameter.name.get_ref(), parameter.name.span());
            if name.is_empty() || !name.chars().all(|c| c.is_ascii_alphanumeric() || c == '_') {
                let hint =
                    "it is a column of a table: use letters, digits and _, and write the rest into `label`";
                return wrong(format!("`{name}` is no name of a parameter"), place, hint);
            }
            if parameter.values.get_ref().is_empty() {
                let place = parameter.values.span();
                return wrong("a parameter without values".to_owned(), place, "write at least one");
            }
            if parameter.set.is_empty() {
                let hint = "name at least one key of the scene, such as `time.step=$(x)`";
                return wrong(format!("`{name}` sets nothing"), place, hint);
            }
        }
        self.source.differ(parameters.into_iter().map(|p| &p.name), "two parameters have this name")?;
        if self.file.choice.is_empty() {
            let hint = "write at least one table [[choice]]";
            return wrong("the map has no choice".to_owned(), 0..0, hint);
        }
        self.source.differ(self.file.choice.iter().map(|c| &c.name), "two choices have this name")
    }
}

fn value(given: &Given) -> Value {
    match given {
        Given::Number(number) => Value::Number(*number),
        Given::Word(word) => Value::Word(word.clone()),
    }
}
