//! A document made readable where it is wrong, so that all its mistakes are found at once.
//!
//! What stands in for a mistake is never run: a scene with a finding is refused.

use toml::Spanned;
use toml::de::{DeArray, DeTable, DeValue};

use super::document::Document;
use super::reference::{Placeholder, placeholder};

/// What makes a document readable beyond a mistake.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) enum Repair {
    /// The last name of the path is no key: the one that was probably meant, or nothing, takes its place.
    Rename { path: Vec<String>, to: Option<String> },
    /// Nothing can be read at the path: a value that can takes its place.
    Replace { path: Vec<String> },
    /// The choice at the path is none: the one that was probably meant, or any, takes its place.
    Choose { path: Vec<String>, to: Option<String> },
}

impl Repair {
    /// Whether what the scene says as a whole can still be judged.
    pub(super) fn keeps_the_meaning(&self) -> bool {
        match self {
            Self::Rename { to, .. } | Self::Choose { to, .. } => to.is_some(),
            Self::Replace { path } => {
                matches!(placeholder(path), Some(Placeholder::Number | Placeholder::Count))
            }
        }
    }

    /// Repairs a document.
    pub(super) fn apply(&self, document: &mut Document<'_>) {
        match self {
            Self::Rename { path, to } => {
                let Some((name, table)) =
                    path.split_last().and_then(|(n, t)| Some((n, document.table_at(t)?)))
                else {
                    return;
                };
                let Some((key, value)) = table.remove_entry(name.as_str()) else { return };
                if let Some(to) = to.as_ref().filter(|to| !table.contains_key(to.as_str())) {
                    table.insert(Spanned::new(key.span(), to.clone().into()), value);
                }
            }
            Self::Replace { path } => put(document, path, placeholder(path).as_ref()),
            Self::Choose { path, to } => match (to, placeholder(path)) {
                (Some(to), _) => rename_choice(document, path, to),
                (None, stand_in) => put(document, path, stand_in.as_ref()),
            },
        }
        document.spell_out_choices();
    }
}

/// The choice at `path`, a word or a table of one name, under another name.
fn rename_choice(document: &mut Document<'_>, path: &[String], to: &str) {
    let Some((name, table)) = path.split_last().and_then(|(n, t)| Some((n, document.table_at(t)?))) else {
        return;
    };
    let Some(value) = table.get_mut(name.as_str()) else { return };
    match value.get_mut() {
        DeValue::Table(inner) => {
            let entries = std::mem::take(inner).into_iter().map(|(key, value)| (key.span(), value));
            *inner = entries.map(|(span, value)| (Spanned::new(span, to.to_owned().into()), value)).collect();
        }
        other => *other = DeValue::String(to.to_owned().into()),
    }
}

/// Sets what stands at a path, or removes it.
fn put(document: &mut Document<'_>, path: &[String], stand_in: Option<&Placeholder>) {
    let Some((name, table)) = path.split_last().and_then(|(n, t)| Some((n, document.table_at(t)?))) else {
        return;
    };
    let before = table.remove_entry(name.as_str());
    let span = before.as_ref().map_or(0..0, |(key, _)| key.span());
    if let Some(stand_in) = stand_in {
        table.insert(Spanned::new(span, name.clone().into()), Spanned::new(0..0, value_of(stand_in)));
    }
}

fn value_of(stand_in: &Placeholder) -> DeValue<'static> {
    let literal = |text| DeValue::parse(text).expect("a literal").into_inner();
    let no_place = |value| Spanned::new(0..0, value);
    match stand_in {
        Placeholder::Number => literal("0.25"),
        Placeholder::Count => literal("1"),
        Placeholder::Flag => literal("false"),
        Placeholder::Text => literal("\"x\""),
        Placeholder::Word(word) => DeValue::String(word.clone().into()),
        Placeholder::List(items) => {
            DeValue::Array(items.iter().map(|item| no_place(value_of(item))).collect::<DeArray<'static>>())
        }
        Placeholder::Table(entries) => {
            let entries = entries.iter().map(|(name, value)| (no_place_key(name), no_place(value_of(value))));
            DeValue::Table(entries.collect::<DeTable<'static>>())
        }
    }
}

fn no_place_key(name: &str) -> Spanned<std::borrow::Cow<'static, str>> {
    Spanned::new(0..0, name.to_owned().into())
}
