//! The schema as a reference: what a key means, what may be chosen, where a key belongs.
//!
//! All of it comes from the doc comments and types of [`schema`](super::schema), so messages cannot fall behind.

mod page;
mod placeholder;

use std::sync::LazyLock;

use schemars::schema_for;
use serde_json::Value;

use super::schema::Scene;

pub use page::markdown;
pub(super) use placeholder::{Placeholder, placeholder};

static SCENE: LazyLock<Value> = LazyLock::new(|| schema_for!(Scene).to_value());

/// What the key or choice at a path means.
pub(super) fn describe(path: &[String]) -> Option<String> {
    let (name, parents) = path.split_last()?;
    let parent = parents.iter().try_fold(&*SCENE, |node, name| member(node, name).map(|(_, node)| node))?;
    let (description, _) = member(parent, name)?;
    description.map(|text| text.replace('\\', "").replace('\n', " "))
}

/// The choices at a path, if it is a place to choose.
pub(super) fn choices(path: &[String]) -> Vec<&'static str> {
    let node = path.iter().try_fold(&*SCENE, |node, name| member(node, name).map(|(_, node)| node));
    // A choice that may be left out is an alternative to nothing.
    let places = node.into_iter().flat_map(|node| std::iter::once(node).chain(list(resolved(node), "anyOf")));
    places.flat_map(|node| list(resolved(node), "oneOf")).filter_map(variant_name).collect()
}

/// The tables, written `[fluid.mesh.rectangle]`, that have a key of this name.
pub(super) fn homes_of(key: &str) -> Vec<String> {
    let mut homes = Vec::new();
    search(&SCENE, key, &mut Vec::new(), &mut homes);
    homes.dedup();
    homes
}

/// A table as a scene writes it.
pub(super) fn table(path: &[String]) -> String {
    if path.is_empty() { "the scene".to_owned() } else { format!("[{}]", path.join(".")) }
}

fn search(node: &'static Value, key: &str, path: &mut Vec<String>, homes: &mut Vec<String>) {
    let node = resolved(node);
    if object(node, "properties").any(|(name, _)| name == key) {
        homes.push(table(path));
    }
    let named = object(node, "properties").map(|(name, inner)| (name.as_str(), inner));
    let any_name = node.get("additionalProperties").map(|inner| ("*", inner));
    let choices = list(node, "oneOf").flat_map(|choice| object(choice, "properties"));
    let choices = choices.map(|(name, inner)| (name.as_str(), inner));
    for (name, inner) in named.chain(any_name).chain(choices) {
        path.push(name.to_owned());
        search(inner, key, path, homes);
        path.pop();
    }
    for inner in list(node, "anyOf") {
        search(inner, key, path, homes);
    }
}

/// The description and the schema of a named member: a key, or one of several choices.
fn member(node: &'static Value, name: &str) -> Option<(Option<&'static str>, &'static Value)> {
    let node = resolved(node);
    if let Some(inner) = node.get("properties").and_then(|properties| properties.get(name)) {
        let text = inner.get("description").or_else(|| node.get("description"));
        return Some((text.and_then(Value::as_str), inner));
    }
    if node.get("const").is_some_and(|word| word == name) {
        return Some((node.get("description").and_then(Value::as_str), node));
    }
    let any_name = node.get("additionalProperties").filter(|inner| inner.is_object());
    alternatives(node).find_map(|inner| member(inner, name)).or(any_name.map(|inner| (None, inner)))
}

fn resolved(node: &'static Value) -> &'static Value {
    let name = node.get("$ref").and_then(Value::as_str).and_then(|path| path.strip_prefix("#/$defs/"));
    name.map_or(node, |name| &SCENE["$defs"][name])
}

fn alternatives(node: &'static Value) -> impl Iterator<Item = &'static Value> {
    list(node, "oneOf").chain(list(node, "anyOf"))
}

fn list(node: &'static Value, key: &str) -> impl Iterator<Item = &'static Value> {
    node.get(key).and_then(Value::as_array).into_iter().flatten()
}

fn object(node: &'static Value, key: &str) -> impl Iterator<Item = (&'static String, &'static Value)> {
    node.get(key).and_then(Value::as_object).into_iter().flatten()
}

fn variant_name(variant: &'static Value) -> Option<&'static str> {
    let word = variant.get("const").and_then(Value::as_str);
    word.or_else(|| object(variant, "properties").next().map(|(name, _)| name.as_str()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::schema::CHOICES;

    fn path(text: &str) -> Vec<String> {
        text.split('.').map(str::to_owned).collect()
    }

    #[test]
    fn keys_and_choices_are_described_with_their_units() {
        for (key, text) in [
            ("fluid.density", "Density [kg/m3]."),
            ("time.step", "Size of a time step [s]."),
            ("fluid.mesh.rectangle.size", "Width and height [m]."),
            (
                "coupling.newton.fixed.fluid",
                "Newton iterations of one fluid call, or `\"unlimited\"`: to convergence. Default: `\"unlimited\"`.",
            ),
            (
                "fluid.boundary.left.no_slip",
                "The fluid sticks to the wall; where the mesh moves, to the moving wall.",
            ),
            ("fluid.boundary.left.velocity", "Given velocity [m/s] in `x`, `y`, `t`."),
        ] {
            assert_eq!(describe(&path(key)).as_deref(), Some(text), "{key}");
        }
        assert_eq!(describe(&path("fluid.colour")), None);
    }

    #[test]
    fn a_key_is_found_where_it_belongs() {
        assert_eq!(homes_of("viscosity"), ["[fluid]"]);
        assert_eq!(homes_of("relaxation"), ["[coupling.acceleration.constant]"]);
        assert_eq!(homes_of("colour"), Vec::<String>::new());
    }

    #[test]
    fn the_list_of_choices_is_the_schemas() {
        for place in CHOICES {
            assert!(
                !choices(&path(&place.replace(".*.filter", ".iqn_ils.filter"))).is_empty(),
                "{place} is no place to choose"
            );
        }
        let listed =
            |found: &str| CHOICES.iter().any(|place| place.replace(".*.filter", ".iqn_ils.filter") == found);
        let mut all = Vec::new();
        places_to_choose(&SCENE, &mut Vec::new(), &mut all);
        assert!(all.len() >= CHOICES.len(), "the walk through the schema misses places: {all:?}");
        for place in all.iter().filter(|place| !place.contains(".iqn_imvls.") && !place.contains(".iqn_mvj."))
        {
            assert!(listed(place), "{place} is missing in CHOICES");
        }
    }

    /// Places with a choice that is a table; a bare word among bare words needs no care.
    fn places_to_choose(node: &'static Value, path: &mut Vec<String>, all: &mut Vec<String>) {
        let node = resolved(node);
        let tables = node.get("oneOf").and_then(Value::as_array).into_iter().flatten();
        if tables.into_iter().any(|variant| variant.get("properties").is_some()) {
            all.push(path.join("."));
        }
        for (name, inner) in object(node, "properties") {
            path.push(name.clone());
            places_to_choose(inner, path, all);
            path.pop();
        }
        if let Some(inner) = node.get("additionalProperties").filter(|inner| inner.is_object()) {
            path.push("*".to_owned());
            places_to_choose(inner, path, all);
            path.pop();
        }
        for inner in alternatives(node) {
            places_to_choose(inner, path, all);
        }
    }

    /// The text says `Default: ...` and marks a word with `(default)`; the value is what the type gives.
    #[test]
    fn the_default_in_words_is_that_of_the_schema() {
        let (mut wrong, mut compared) = (Vec::new(), 0);
        compare_defaults(&SCENE, &mut Vec::new(), &mut wrong, &mut compared);
        assert_eq!(wrong, Vec::<String>::new());
        assert!(compared > 60, "{compared} defaults are hardly all");
    }

    fn compare_defaults(
        node: &'static Value,
        path: &mut Vec<String>,
        wrong: &mut Vec<String>,
        compared: &mut usize,
    ) {
        let node = resolved(node);
        for (name, inner) in object(node, "properties") {
            path.push(name.clone());
            let text = inner.get("description").or_else(|| resolved(inner).get("description"));
            let told = text.and_then(Value::as_str).and_then(told_default);
            if let (Some(told), Some(value)) = (told, inner.get("default")) {
                *compared += 1;
                if !is_told(&told, value) {
                    wrong.push(format!("{}: the text says {told}, the schema {value}", path.join(".")));
                }
            }
            compare_defaults(inner, path, wrong, compared);
            path.pop();
        }
        let any_name = node.get("additionalProperties").filter(|inner| inner.is_object());
        for inner in alternatives(node).chain(any_name) {
            compare_defaults(inner, path, wrong, compared);
        }
    }

    /// What a doc comment calls the default.
    fn told_default(text: &str) -> Option<String> {
        let text = text.split_whitespace().collect::<Vec<_>>().join(" ");
        if let Some((before, _)) = text.split_once(" (default") {
            return before.rsplit('`').nth(1).map(str::to_owned);
        }
        let (_, told) = text.split_once("Default: ")?;
        let value = match told.strip_prefix('`') {
            Some(code) => code.split('`').next(),
            None => told.strip_suffix('.').or(told.split_once(". ").map(|(value, _)| value)),
        };
        value.map(str::to_owned)
    }

    /// Whether these words mean this value: TOML, the name of a choice, or `none` for what is empty.
    fn is_told(told: &str, value: &Value) -> bool {
        let name =
            value.as_object().filter(|choice| choice.len() == 1).and_then(|choice| choice.keys().next());
        if told.starts_with("none") {
            let items = value.as_array().map(Vec::len).or(value.as_object().map(serde_json::Map::len));
            return items == Some(0) || value.as_array().is_some_and(|all| all.iter().all(|x| *x == 0.0));
        }
        match format!("x = {told}").parse::<toml::Table>() {
            Ok(table) => {
                same(&serde_json::to_value(&table["x"]).expect("TOML is JSON, but for dates"), value)
            }
            Err(_) => value == told || name.is_some_and(|name| name == told),
        }
    }

    /// Equal, and 1 is 1.0.
    fn same(a: &Value, b: &Value) -> bool {
        match (a, b) {
            (Value::Array(a), Value::Array(b)) => {
                a.len() == b.len() && a.iter().zip(b).all(|(a, b)| same(a, b))
            }
            (Value::Object(a), Value::Object(b)) => {
                a.len() == b.len() && a.iter().all(|(key, a)| b.get(key).is_some_and(|b| same(a, b)))
            }
            _ => a == b || (a.is_number() && a.as_f64() == b.as_f64()),
        }
    }

    #[test]
    fn a_default_in_words_is_found_and_compared() {
        assert_eq!(told_default("A length. Default: 1e-6.").as_deref(), Some("1e-6"));
        assert_eq!(told_default("Time: `\"bdf1\"` (default), or `\"bdf2\"`.").as_deref(), Some("\"bdf1\""));
        assert!(is_told("1", &serde_json::json!(1.0)) && !is_told("1", &serde_json::json!(0.5)));
        assert!(
            is_told("\"bdf1\"", &serde_json::json!("bdf1"))
                && !is_told("\"bdf1\"", &serde_json::json!("bdf2"))
        );
        assert!(
            is_told("none; they stay fixed", &serde_json::json!([]))
                && !is_told("none", &serde_json::json!(["a"]))
        );
        assert!(!is_told("{ qr3 = 1e-3 }", &serde_json::json!({ "qr3": 0.01 })));
    }

    #[test]
    fn every_key_is_documented() {
        let (mut bare, mut seen) = (Vec::new(), 0);
        undocumented(&SCENE, &mut Vec::new(), &mut bare, &mut seen);
        assert_eq!(bare, Vec::<String>::new());
        assert!(seen > 100, "{seen} keys are hardly all");
    }

    fn undocumented(node: &'static Value, path: &mut Vec<String>, bare: &mut Vec<String>, seen: &mut usize) {
        let node = resolved(node);
        for (name, inner) in object(node, "properties") {
            path.push(name.clone());
            *seen += 1;
            if describe(path).is_none() {
                bare.push(path.join("."));
            }
            undocumented(inner, path, bare, seen);
            path.pop();
        }
        for inner in alternatives(node) {
            undocumented(inner, path, bare, seen);
        }
    }
}
