//! From a file and overrides to a scene that can be built.

use std::fs;
use std::io::ErrorKind;
use std::path::{Path, PathBuf};

use serde::Deserialize;
use toml::de::{DeTable, DeValue};
use toml::{Table, Value};

use super::check::Check;
use super::diagnose::SceneError;
use super::document::{self, Document};
use super::finding::Finding;
use super::overrides::Override;
use super::places::Places;
use super::schema::{Count, Output, Scene, Warnings};
use super::shapes::{self, Shapes};
use super::sources::Sources;
use super::translate::translate;
use super::validate::{validate, validate_shapes};
use super::write;
use crate::file_kind::FileKind;

/// A scene that has passed every check, with its shapes.
#[derive(Debug, Clone)]
pub struct Resolved {
    /// What was asked for, defaults included.
    pub scene: Scene,
    /// The fluid's mesh and the structure's patch.
    pub shapes: Shapes,
    /// What the scene is called: its folder, or its file without the ending.
    pub name: String,
    /// The file it was read from.
    pub file: PathBuf,
    /// Where its keys stand.
    pub places: Places,
}

impl Resolved {
    /// The scene as TOML with every default and override written out, naming the copies of its files that a run
    /// keeps: in the folder of the run it runs again as it is.
    #[must_use]
    pub fn to_toml(&self) -> String {
        let mut scene = self.scene.clone();
        shapes::name_copies(&mut scene);
        write::to_toml(&scene)
    }

    /// What decides about the numbers of a step: the scene without how far a run of it goes, what it writes and which warnings
    /// it accepts, and a checksum of each file that it is built from.
    #[must_use]
    pub fn decisive(&self) -> String {
        let mut resolved = self.clone();
        resolved.scene.time.steps = Count::literal(1);
        resolved.scene.output = Output::default();
        resolved.scene.warnings = Warnings::default();
        let inputs = resolved.shapes.inputs.iter();
        let sums = inputs
            .map(|input| format!("# {} has checksum {:08x}\n", input.name, crc32fast::hash(&input.bytes)));
        resolved.to_toml() + &sums.collect::<String>()
    }
}

/// The file name that stands for its folder.
pub const SCENE_FILE: &str = "scene.toml";

/// Reads the scene in a file, or in the folder that holds a `scene.toml`, and the files it names, and applies the
/// overrides `key.path=value` in their order.
///
/// # Errors
///
/// [`SceneError`] with every place that is wrong and how to mend it.
pub fn load(path: &Path, overrides: &[String]) -> Result<Resolved, SceneError> {
    let file = if path.is_dir() { path.join(SCENE_FILE) } else { path.to_owned() };
    let text = fs::read_to_string(&file).map_err(|error| unreadable(path, &file, &error))?;
    if let Some((what, hint)) = FileKind::Scene.misplaced(path) {
        return Err(SceneError::plain(what, hint));
    }
    let folder = file.parent().unwrap_or(Path::new(""));
    let resolved = read_in(folder, &file.display().to_string(), &text, overrides)?;
    Ok(Resolved { name: name_of(&file), file, ..resolved })
}

/// Reads the scene in a text, as if it stood in a file of this folder; `name` is what messages and the scene are called.
///
/// # Errors
///
/// [`SceneError`] with every place that is wrong and how to mend it.
pub fn read_in(folder: &Path, name: &str, text: &str, overrides: &[String]) -> Result<Resolved, SceneError> {
    let (scene, shapes, places) = resolve(name, text, overrides, |sources| {
        let (scene, document) = check(sources)?;
        let mut findings = Check::new(&document);
        let shapes = Shapes::make(&scene, folder, &mut findings);
        validate_shapes(&mut findings, &scene, &shapes);
        findings.done((scene, shapes, Places::of(&document, sources)))
    })?;
    Ok(Resolved { scene, shapes, name: name.to_owned(), file: folder.join(name), places })
}

/// Reads the scene in a text; `name` is what messages call it. Files that it names are not looked at.
///
/// # Errors
///
/// [`SceneError`] with every place that is wrong and how to mend it.
pub fn parse(name: &str, text: &str, overrides: &[String]) -> Result<Scene, SceneError> {
    resolve(name, text, overrides, |sources| Ok(check(sources)?.0))
}

/// Reads text and overrides with `read`; where it finds fault, tells whether the text alone is sound.
fn resolve<T>(
    name: &str,
    text: &str,
    overrides: &[String],
    read: impl Fn(&Sources) -> Result<T, Vec<Finding>>,
) -> Result<T, SceneError> {
    let overrides = overrides.iter().map(|given| read_override(given)).collect::<Result<Vec<_>, _>>()?;
    if let Some(error) = rivals(&overrides) {
        return Err(error);
    }
    let sources = Sources::new(name, text, &overrides);
    read(&sources).map_err(|mut findings| {
        let alone = Sources::new(name, text, &[]);
        if !overrides.is_empty() && read(&alone).is_ok() {
            findings.iter_mut().for_each(Finding::blame_overrides);
        }
        SceneError::new(findings, &sources)
    })
}

/// Everything that can be checked without another file. Where the scene as a whole can still be judged in spite of single
/// mistakes, what does not fit together is found with them.
fn check(sources: &Sources) -> Result<(Scene, Document<'_>), Vec<Finding>> {
    let document = document::merge(sources).map_err(|finding| vec![finding])?;
    let Reading { scene, findings, is_whole } = read(&document, sources);
    let mut all = Check::new(&document);
    if let Some(scene) = scene.as_ref().filter(|_| is_whole) {
        validate(&mut all, scene);
    }
    for finding in findings {
        all.add(finding);
    }
    all.done(())?;
    Ok((scene.expect("a document without findings was read"), document))
}

fn read_override(given: &str) -> Result<Override, SceneError> {
    Override::read(given).map_err(|what| {
        SceneError::argument(
            given,
            &what,
            "an override is `--set key.path=value`, such as `--set time.steps=3`",
        )
    })
}

/// Two overrides that make different choices in one place: the last would win without a word.
fn rivals(overrides: &[Override]) -> Option<SceneError> {
    let mut pairs = overrides
        .iter()
        .enumerate()
        .flat_map(|(at, later)| overrides[..at].iter().map(move |earlier| (earlier, later)));
    pairs.find_map(|(earlier, later)| {
        let (place, first, second) = earlier.rivals(later)?;
        Some(SceneError::argument(
            &later.text,
            &format!("{} cannot be both `{first}` and `{second}`", place.join(".")),
            &format!("leave out this one, or `--set {}`", earlier.text),
        ))
    })
}

/// What was read of a document.
struct Reading {
    /// The scene, with something else in the place of each mistake.
    scene: Option<Scene>,
    findings: Vec<Finding>,
    /// Whether no mistake changes what the parts of the scene are.
    is_whole: bool,
}

/// Mistakes that are shown at once; beyond them nobody reads on.
const MOST_FINDINGS: usize = 30;

/// Reads a document; each mistake is repaired in a copy of it, to find the next.
fn read(document: &Document<'_>, sources: &Sources) -> Reading {
    let mut draft = document.clone();
    let (mut findings, mut is_whole) = (Vec::new(), true);
    while findings.len() < MOST_FINDINGS {
        let table = draft.table().clone();
        match Scene::deserialize(toml::Deserializer::from(table)) {
            Ok(scene) => {
                lost(draft.table().get_ref(), &write::table_of(&scene), &mut Vec::new(), &mut findings);
                return Reading { scene: Some(scene), findings, is_whole };
            }
            Err(error) => {
                let (finding, repair) = translate(&error, &draft, sources);
                if findings.contains(&finding) {
                    break;
                }
                findings.push(finding);
                is_whole &= repair.keeps_the_meaning();
                repair.apply(&mut draft);
            }
        }
    }
    Reading { scene: None, findings, is_whole }
}

/// What is written but was not read: serde takes a list for a table, and the first two of three components, without a
/// word.
fn lost(written: &DeTable<'_>, read: &Table, path: &mut Vec<String>, findings: &mut Vec<Finding>) {
    for (key, value) in written {
        path.push(key.get_ref().to_string());
        let name = || path.join(".");
        match (value.get_ref(), read.get(key.get_ref().as_ref())) {
            (DeValue::Table(written), Some(Value::Table(read))) => lost(written, read, path, findings),
            (DeValue::Array(_), Some(Value::Table(_))) => findings.push(
                Finding::new(format!("{} should be a table", name()))
                    .mark(value.span(), "not a table")
                    .hint(format!("write a table [{}] with one `key = value` a line", name())),
            ),
            (DeValue::Array(written), Some(Value::Array(read))) if written.len() != read.len() => findings
                .push(
                    Finding::new(format!("{} should be a list of {} entries", name(), read.len()))
                        .mark(value.span(), format!("a list of {}", written.len()))
                        .hint(format!("leave {} entries", read.len())),
                ),
            _ => {}
        }
        path.pop();
    }
}

fn name_of(file: &Path) -> String {
    let stem = file.file_stem();
    let folder = || file.canonicalize().ok()?.parent()?.file_name().map(ToOwned::to_owned);
    let name = if file.ends_with(SCENE_FILE) {
        folder().or(stem.map(ToOwned::to_owned))
    } else {
        stem.map(ToOwned::to_owned)
    };
    name.map_or_else(|| "scene".to_owned(), |name| name.to_string_lossy().into_owned())
}

fn unreadable(path: &Path, file: &Path, error: &std::io::Error) -> SceneError {
    let what = format!("{} cannot be read: {error}", file.display());
    if error.kind() == ErrorKind::InvalidData {
        let what = format!("{} is not text", file.display());
        return SceneError::plain(what, "a scene file is text in UTF-8: name that file, or save it as UTF-8");
    }
    let hint = if path.is_dir() {
        format!("a folder stands for the `{SCENE_FILE}` in it; name the file if it is called otherwise")
    } else {
        "name a scene file, or a folder with a `scene.toml` in it".to_owned()
    };
    SceneError::plain(what, hint)
}
