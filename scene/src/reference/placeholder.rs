//! The smallest value that can be read at a path of a scene.

use serde_json::Value;

use super::{SCENE, list, member, object, resolved, variant_name};

/// A value that stands in for one that cannot be read.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) enum Placeholder {
    /// A number that lies in every range of the schema.
    Number,
    /// A whole number.
    Count,
    /// True or false.
    Flag,
    /// Any text.
    Text,
    /// The name of a choice.
    Word(String),
    /// Several values.
    List(Vec<Placeholder>),
    /// The keys that must be given.
    Table(Vec<(String, Placeholder)>),
}

/// A value for the key at a path; `None` where the schema has no such key.
pub(crate) fn placeholder(path: &[String]) -> Option<Placeholder> {
    let node = path.iter().try_fold(&*SCENE, |node, name| member(node, name).map(|(_, node)| node))?;
    of(node)
}

fn of(node: &'static Value) -> Option<Placeholder> {
    let node = resolved(node);
    if let Some(word) = node.get("const").and_then(Value::as_str) {
        return Some(Placeholder::Word(word.to_owned()));
    }
    if let Some(first) = list(node, "oneOf").chain(list(node, "anyOf")).next() {
        return of_variant(first);
    }
    match kind(node)? {
        "number" => Some(Placeholder::Number),
        "integer" => Some(Placeholder::Count),
        "boolean" => Some(Placeholder::Flag),
        "string" => match list(node, "enum").next().and_then(Value::as_str) {
            Some(word) => Some(Placeholder::Word(word.to_owned())),
            None => Some(Placeholder::Text),
        },
        "array" => {
            let least = node.get("minItems").and_then(Value::as_u64).unwrap_or(0);
            let item = node.get("items").and_then(of)?;
            Some(Placeholder::List((0..least).map(|_| item.clone()).collect()))
        }
        "object" => {
            let required = list(node, "required").filter_map(Value::as_str);
            let entry = |name: &'static str| {
                let (_, inner) = object(node, "properties").find(|(key, _)| *key == name)?;
                Some((name.to_owned(), of(inner)?))
            };
            Some(Placeholder::Table(required.map(entry).collect::<Option<_>>()?))
        }
        _ => None,
    }
}

/// A choice that holds something is a table of one name.
fn of_variant(variant: &'static Value) -> Option<Placeholder> {
    let name = variant_name(resolved(variant));
    match (name, object(resolved(variant), "properties").next()) {
        (Some(name), Some((_, inner))) => Some(Placeholder::Table(vec![(name.to_owned(), of(inner)?)])),
        _ => of(variant),
    }
}

/// The type, or the first of several.
fn kind(node: &'static Value) -> Option<&'static str> {
    let kind = node.get("type")?;
    kind.as_str().or_else(|| kind.as_array()?.first()?.as_str())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(path: &str) -> Option<Placeholder> {
        placeholder(&path.split('.').map(str::to_owned).collect::<Vec<_>>())
    }

    #[test]
    fn every_required_key_has_a_placeholder() {
        assert_eq!(at("title"), Some(Placeholder::Text));
        assert_eq!(at("time.steps"), Some(Placeholder::Count));
        assert_eq!(at("fluid.density"), Some(Placeholder::Number));
        assert_eq!(
            at("fluid.mesh.rectangle.size"),
            Some(Placeholder::List(vec![Placeholder::Number, Placeholder::Number]))
        );
        assert_eq!(at("fluid.colour"), None);
        for table in ["time", "fluid", "structure", "coupling", "fluid.mesh", "structure.material"] {
            assert!(at(table).is_some(), "{table}");
        }
    }
}
