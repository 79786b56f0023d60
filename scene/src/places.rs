//! Where the keys of a scene stand, for messages that come after it was read.

use std::collections::BTreeMap;
use std::ops::Range;

use toml::de::{DeTable, DeValue};

use super::document::Document;
use super::sources::Sources;

/// The file and line, or the override, of every key that is spelt out.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Places(BTreeMap<Vec<String>, String>);

impl Places {
    pub(super) fn of(document: &Document<'_>, sources: &Sources) -> Self {
        let mut places = BTreeMap::new();
        collect(document.table().get_ref(), sources, &mut Vec::new(), &mut places);
        Self(places)
    }

    /// The place of a key and its name, `scene.toml:12, fluid.viscosity`. For a key that has its default it is that of the
    /// table it belongs to.
    #[must_use]
    pub fn describe(&self, path: &[&str]) -> String {
        let key = path.join(".");
        let names: Vec<String> = path.iter().map(ToString::to_string).collect();
        let place = (1..=names.len()).rev().find_map(|length| self.0.get(&names[..length]));
        place.map_or_else(|| key.clone(), |place| format!("{place}, {key}"))
    }
}

fn collect(
    table: &DeTable<'_>,
    sources: &Sources,
    path: &mut Vec<String>,
    places: &mut BTreeMap<Vec<String>, String>,
) {
    for (key, value) in table {
        path.push(key.get_ref().to_string());
        places.insert(path.clone(), place(sources, &key.span()));
        if let DeValue::Table(inner) = value.get_ref() {
            collect(inner, sources, path, places);
        }
        path.pop();
    }
}

/// The name of a text and the line in it; an override has one line and is shown itself.
fn place(sources: &Sources, span: &Range<usize>) -> String {
    let source = sources.holding(span.start);
    let start = source.local(span).start;
    if source.is_override() {
        return format!("{} {}", source.name, source.text());
    }
    let line = 1 + source.text()[..start].matches('\n').count();
    format!("{}:{line}", source.name)
}
