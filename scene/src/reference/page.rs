//! The reference of all keys as a page: a table for each table of a scene, and one for each choice.

use std::collections::BTreeMap;
use std::fmt::Write;

use serde_json::Value;

use super::{SCENE, list, object, resolved, variant_name};
use crate::warning::Kind;
use crate::write;

const HEAD: &str = "\
# Scene files

<!-- Generated from the schema: `UPDATE_DOCS=1 cargo test -p partita-cli scene_page` -->

Every key of a scene file, from the documentation of the types that read it. A scene is TOML; numbers are in SI units.
Where one of several choices is made, a choice that needs nothing else is a word (`acceleration = \"aitken\"`), any other
a table with the name of the choice (`[coupling.acceleration.constant]`). `--set key.path=value` on the command line
changes any key.

## The scene

";

/// All keys of a scene as a page of Markdown: value, default, unit and meaning.
#[must_use]
pub fn markdown() -> String {
    let mut page = Page { text: HEAD.to_owned(), shown: BTreeMap::new() };
    page.keys("", &SCENE);
    page.warnings();
    page.text
}

/// The page so far, and where it explains which type of the schema.
struct Page {
    text: String,
    shown: BTreeMap<&'static str, String>,
}

/// A part of a scene with a section of its own.
type Part = (String, &'static Value);

impl Page {
    fn line(&mut self, text: std::fmt::Arguments<'_>) {
        writeln!(self.text, "{text}").expect("writing to a string does not fail");
    }

    fn sections(&mut self, parts: Vec<Part>) {
        for (path, node) in parts {
            self.line(format_args!("\n## `{path}`\n"));
            let node = resolved(node);
            if let Some(text) = node.get("description").and_then(Value::as_str).map(meaning) {
                let text = text.split_once("`: ").map_or(text.as_str(), |(_, text)| text);
                if !text.starts_with('`') {
                    self.line(format_args!("{}\n", capital(text)));
                }
            }
            if node.get("oneOf").is_some() {
                self.choices(&path, node);
            } else {
                self.keys(&path, node);
            }
        }
    }

    /// The names that `warnings.accept` knows.
    fn warnings(&mut self) {
        self.line(format_args!(
            "\n## The warnings\n\n`check` and the start of `run` print a line for each; with `--deny-warnings` they end \
             with exit code 2 where one is not accepted.\n\n| name | given when |\n|---|---|"
        ));
        for kind in Kind::ALL {
            self.line(format_args!("| `{}` | {} |", kind.name(), meaning(kind.meaning())));
        }
    }

    /// Keys that must be given come first.
    fn keys(&mut self, path: &str, node: &'static Value) {
        let required: Vec<&str> = list(node, "required").filter_map(Value::as_str).collect();
        let mut keys: Vec<_> = object(node, "properties").collect();
        let place = |name: &str| required.iter().position(|&key| key == name).unwrap_or(required.len());
        keys.sort_by_key(|(name, _)| place(name));
        self.line(format_args!("| key | value | default | meaning |\n|---|---|---|---|"));
        let mut parts = Vec::new();
        for (name, inner) in keys {
            let value = self.value(&join(path, name), inner, &mut parts);
            let default = match inner.get("default") {
                Some(default) => written(default, resolved(inner).get("properties").is_some()),
                None if required.contains(&name.as_str()) => "must be given".to_owned(),
                None => "none".to_owned(),
            };
            let text = inner.get("description").or_else(|| resolved(inner).get("description"));
            let meaning = meaning(text.and_then(Value::as_str).unwrap_or_default());
            self.line(format_args!("| `{name}` | {value} | {default} | {meaning} |"));
        }
        self.sections(parts);
    }

    fn choices(&mut self, path: &str, node: &'static Value) {
        self.line(format_args!("| choice | holds | meaning |\n|---|---|---|"));
        let mut parts = Vec::new();
        for variant in list(node, "oneOf") {
            let Some(name) = variant_name(variant) else { continue };
            let holds = object(variant, "properties").next();
            let holds =
                holds.map_or_else(String::new, |(_, inner)| self.value(&join(path, name), inner, &mut parts));
            let meaning = meaning(variant["description"].as_str().unwrap_or_default());
            self.line(format_args!("| `{name}` | {holds} | {meaning} |"));
        }
        self.sections(parts);
    }

    /// What may stand at a path; a part that needs a section is added to `parts`.
    fn value(&mut self, path: &str, node: &'static Value, parts: &mut Vec<Part>) -> String {
        if let Some(some) = list(node, "anyOf").find(|inner| inner.get("$ref").is_some()) {
            return self.value(path, some, parts);
        }
        let inner = resolved(node);
        if inner.get("oneOf").is_some() || inner.get("properties").is_some() {
            return self.part(path, node, parts);
        }
        if let Some(each) = inner.get("additionalProperties") {
            return format!("for each name {}", self.value(&join(path, "<name>"), each, parts));
        }
        if let Some(each) = inner.get("items") {
            let each = self.value(path, each, parts);
            return if inner.get("minItems").is_some() {
                format!("two, each {each}")
            } else {
                format!("list, each {each}")
            };
        }
        // What stands beside a type by name is about the type, what stands at a key about the key.
        let named = if node.get("$ref").is_some() { inner.get("description") } else { None };
        named.and_then(Value::as_str).map_or_else(|| simple(inner), phrase)
    }

    fn part(&mut self, path: &str, node: &'static Value, parts: &mut Vec<Part>) -> String {
        let what = if resolved(node).get("oneOf").is_some() { "a choice" } else { "a table" };
        if let Some(name) = node.get("$ref").and_then(Value::as_str) {
            if let Some(place) = self.shown.get(name) {
                return format!("{what}, as [`{place}`](#{})", anchor(place));
            }
            self.shown.insert(name, path.to_owned());
        }
        parts.push((path.to_owned(), node));
        format!("[{what}](#{})", anchor(path))
    }
}

/// A value that needs no section.
fn simple(node: &Value) -> String {
    if let Some(least) = node["anyOf"][0].get("minimum") {
        return format!("a count of at least {least}, or `\"unlimited\"`");
    }
    match node["type"].as_str() {
        Some("string") => "text".to_owned(),
        Some("boolean") => "true or false".to_owned(),
        Some("integer") => "a count of zero or more".to_owned(),
        _ => "a number or an expression in quotes".to_owned(),
    }
}

/// A default as a scene writes it; the defaults of a whole table stand with its keys.
fn written(default: &Value, of_table: bool) -> String {
    let value = toml::Value::try_from(default).expect("defaults come from a scene");
    match &value {
        toml::Value::Table(table) if table.is_empty() => "none".to_owned(),
        _ if of_table => "that of its keys".to_owned(),
        _ => format!("`{}`", write::inline(&value)),
    }
}

/// A doc comment on one line, without the default, which has its own column.
fn meaning(text: &str) -> String {
    let text = text.split_whitespace().collect::<Vec<_>>().join(" ").replace('|', "\\|");
    text.split_once(" Default: ").map_or(text.clone(), |(meaning, _)| meaning.to_owned())
}

/// A sentence as a part of one.
fn phrase(text: &str) -> String {
    let mut letters = text.trim_end_matches('.').chars();
    letters.next().map_or_else(String::new, |first| first.to_lowercase().chain(letters).collect())
}

fn capital(text: &str) -> String {
    let mut letters = text.chars();
    letters.next().map_or_else(String::new, |first| first.to_uppercase().chain(letters).collect())
}

fn join(path: &str, name: &str) -> String {
    if path.is_empty() { name.to_owned() } else { format!("{path}.{name}") }
}

/// The anchor that a heading gets: letters, digits and underscores.
fn anchor(path: &str) -> String {
    path.chars().filter(|&c| c.is_alphanumeric() || c == '_').collect()
}
