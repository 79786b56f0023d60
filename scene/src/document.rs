//! A scene file and its overrides as one table in which every key and value knows its place.

use std::ops::Range;

use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::finding::Finding;
use super::schema;
use super::sources::Sources;

/// The scene file with what the overrides put into it.
pub(super) fn merge(sources: &Sources) -> Result<Document<'_>, Finding> {
    let (file, overrides) = sources.file_and_overrides();
    let root = DeTable::parse(file.padded()).map_err(|error| Finding::syntax(&error, sources))?;
    let mut document = Document { root };
    document.spell_out_choices();
    for source in overrides {
        let line = DeTable::parse(source.padded()).map_err(|error| Finding::syntax(&error, sources))?;
        insert(document.root.get_mut(), line.into_inner(), source.names(), &mut Vec::new())?;
        document.spell_out_choices();
    }
    Ok(document)
}

/// The merged table.
#[derive(Clone)]
pub(super) struct Document<'a> {
    root: Spanned<DeTable<'a>>,
}

/// Where an entry stands: its key, and what it is set to.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Entry {
    pub(super) key: Range<usize>,
    pub(super) value: Range<usize>,
}

impl<'a> Document<'a> {
    pub(super) fn table(&self) -> &Spanned<DeTable<'a>> {
        &self.root
    }

    /// The table at a path, if there is one.
    pub(super) fn table_at(&mut self, path: &[String]) -> Option<&mut DeTable<'a>> {
        let mut table = self.root.get_mut();
        for name in path {
            let DeValue::Table(inner) = table.get_mut(name.as_str())?.get_mut() else { return None };
            table = inner;
        }
        Some(table)
    }

    /// The entry at a path, or its nearest ancestor that is written down.
    pub(super) fn entry(&self, path: &[&str]) -> Option<Entry> {
        let mut table = self.root.get_ref();
        let mut found = None;
        for name in path {
            let Some((key, value)) = table.get_key_value(*name) else { break };
            found = Some(Entry { key: key.span(), value: value.span() });
            let DeValue::Table(inner) = value.get_ref() else { break };
            table = inner;
        }
        found
    }

    /// The names in the table at a path, and where they stand.
    pub(super) fn keys(&self, path: &[String]) -> Vec<(String, Range<usize>)> {
        let mut table = self.root.get_ref();
        for name in path {
            match table.get(name.as_str()).map(Spanned::get_ref) {
                Some(DeValue::Table(inner)) => table = inner,
                _ => return Vec::new(),
            }
        }
        table.keys().map(|key| (key.get_ref().to_string(), key.span())).collect()
    }

    /// The names from the root to the innermost entry whose key or value covers a place.
    pub(super) fn path_to(&self, place: &Range<usize>) -> Vec<String> {
        let mut path = Vec::new();
        descend(self.root.get_ref(), place, &mut path);
        path
    }

    /// Follows a choice down to the one value it holds: from `filter` to `filter.qr3`.
    ///
    /// The deserializer blames the table of the choice for that value.
    pub(super) fn follow_choice(&self, path: &mut Vec<String>, place: &mut Range<usize>) {
        while schema::is_choice(path) {
            let entries = self.keys(path);
            let [(name, _)] = &entries[..] else { return };
            path.push(name.clone());
            let names: Vec<&str> = path.iter().map(String::as_str).collect();
            if let Some(entry) = self.entry(&names) {
                *place = entry.value;
            }
        }
    }

    /// Writes `aitken = {}` for the bare word `"aitken"` wherever one of several choices is named, so that a
    /// choice that needs nothing else needs no table.
    pub(super) fn spell_out_choices(&mut self) {
        for choice in schema::CHOICES {
            let steps: Vec<&str> = choice.split('.').collect();
            each_at(self.root.get_mut(), &steps, &mut spell_out);
        }
    }
}

fn descend(table: &DeTable<'_>, place: &Range<usize>, path: &mut Vec<String>) -> bool {
    for (key, value) in table {
        path.push(key.get_ref().to_string());
        if let DeValue::Table(inner) = value.get_ref()
            && descend(inner, place, path)
        {
            return true;
        }
        if key.span() == *place || covers(&value.span(), place) {
            return true;
        }
        path.pop();
    }
    false
}

fn covers(outer: &Range<usize>, inner: &Range<usize>) -> bool {
    outer.start <= inner.start && inner.end <= outer.end
}

/// Calls `change` with every value the pattern names; `*` stands for any key.
fn each_at(table: &mut DeTable<'_>, steps: &[&str], change: &mut impl FnMut(&mut Spanned<DeValue<'_>>)) {
    let Some((first, rest)) = steps.split_first() else { return };
    for (key, value) in table.iter_mut() {
        if *first != "*" && key.get_ref() != first {
            continue;
        }
        if rest.is_empty() {
            change(value);
        } else if let DeValue::Table(inner) = value.get_mut() {
            each_at(inner, rest, change);
        }
    }
}

fn spell_out(value: &mut Spanned<DeValue<'_>>) {
    let span = value.span();
    if let DeValue::String(name) = value.get_mut() {
        let name = Spanned::new(span.clone(), std::mem::take(name));
        let nothing = Spanned::new(span, DeValue::Table(DeTable::new()));
        *value.get_mut() = DeValue::Table(DeTable::from_iter([(name, nothing)]));
    }
}

/// Moves the one entry of `from`, `names` deep, into `into`; returns the place of its value.
///
/// Where one of several choices is made, a new choice takes the place of the old one, and the table that holds it
/// stands where the override does: the deserializer blames that table for a wrong value of a choice.
fn insert<'a>(
    into: &mut DeTable<'a>,
    from: DeTable<'a>,
    names: usize,
    path: &mut Vec<String>,
) -> Result<Range<usize>, Finding> {
    let (key, value) = from.into_iter().next().expect("an override holds one entry");
    if schema::is_choice(path) && !into.contains_key(key.get_ref().as_ref()) {
        into.clear();
    }
    path.push(key.get_ref().to_string());
    if names == 1 {
        let place = value.span();
        into.remove(key.get_ref().as_ref());
        into.insert(key, value);
        return Ok(place);
    }
    let DeValue::Table(inner) = value.into_inner() else {
        unreachable!("a dotted key holds tables down to its last name")
    };
    let span = key.span();
    let slot = into.entry(key).or_insert_with(|| Spanned::new(span.clone(), DeValue::Table(DeTable::new())));
    let DeValue::Table(table) = slot.get_mut() else {
        return Err(Finding::new(format!("{} is a value, not a table", path.join(".")))
            .mark(span, "nothing can be set inside it")
            .hint(format!("set `{}` itself", path.join("."))));
    };
    let depth = path.len();
    let place = insert(table, inner, names - 1, path)?;
    if schema::is_choice(&path[..depth]) {
        *slot = Spanned::new(place.clone(), DeValue::Table(std::mem::take(table)));
    }
    Ok(place)
}
