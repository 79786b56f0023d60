//! A scene as text: every default filled in, numbers as a person would write them.

use std::fmt::Write;

use serde::Serialize;
use toml::{Table, Value};

use super::schema::Scene;

/// The scene as TOML that reads back as the same scene.
///
/// # Panics
///
/// Never: a scene that was read can be written.
#[must_use]
pub fn to_toml(scene: &Scene) -> String {
    let mut text = String::new();
    write_table(&mut text, &table_of(scene), &mut Vec::new());
    text
}

/// A part of a scene in a few words: `qr3 0.01`, `fixed (fluid 1, structure unlimited)`.
///
/// # Panics
/// When `part` is no part of a scene, and TOML has no form for it.
pub fn words(part: &impl Serialize) -> String {
    spoken(&Value::try_from(part).expect("a scene is made of tables, lists, numbers and text"))
}

fn spoken(value: &Value) -> String {
    match value {
        Value::String(word) => word.clone(),
        Value::Table(table) => {
            let entries = table.iter().map(|(name, value)| match value {
                Value::Table(_) => format!("{name} ({})", spoken(value)),
                _ => format!("{name} {}", spoken(value)),
            });
            entries.collect::<Vec<_>>().join(", ")
        }
        other => inline(other),
    }
}

/// The scene as a table, every default filled in.
pub(super) fn table_of(scene: &Scene) -> Table {
    Table::try_from(scene).expect("a scene is made of tables, lists, numbers and text")
}

/// Plain values first, then the tables below under their own headings.
fn write_table(text: &mut String, table: &Table, path: &mut Vec<String>) {
    let (tables, values): (Vec<_>, Vec<_>) = table.iter().partition(|(_, value)| stands_alone(value));
    if !values.is_empty() {
        if !path.is_empty() {
            put(text, format_args!("\n[{}]\n", path.join(".")));
        }
        for (name, value) in values {
            put(text, format_args!("{} = {}\n", key(name), inline(value)));
        }
    }
    for (name, value) in tables {
        if let Value::Table(inner) = value {
            path.push(key(name));
            write_table(text, inner, path);
            path.pop();
        }
    }
}

/// A table stands under its own heading unless it is a chain down to one value: `{ relative = 1e-10 }`.
fn stands_alone(value: &Value) -> bool {
    match value {
        Value::Table(table) => table.len() != 1 || table.values().any(stands_alone),
        _ => false,
    }
}

pub(super) fn inline(value: &Value) -> String {
    match value {
        Value::Float(number) => float(*number),
        Value::Array(list) => format!("[{}]", list.iter().map(inline).collect::<Vec<_>>().join(", ")),
        Value::Table(table) => {
            let entries = table.iter().map(|(name, value)| format!("{} = {}", key(name), inline(value)));
            format!("{{ {} }}", entries.collect::<Vec<_>>().join(", "))
        }
        other => other.to_string(),
    }
}

/// The shortest digits that give the same bits, with an exponent where zeros would have to be counted.
fn float(number: f64) -> String {
    if number == 0.0 || (1e-4..1e7).contains(&number.abs()) {
        format!("{number:?}")
    } else {
        format!("{number:e}")
    }
}

/// A name as a key of TOML, in quotes where it must be.
pub(super) fn key(name: &str) -> String {
    let bare = |c: char| c.is_ascii_alphanumeric() || matches!(c, '_' | '-');
    if !name.is_empty() && name.chars().all(bare) { name.to_owned() } else { basic_string(name) }
}

fn basic_string(name: &str) -> String {
    let mut quoted = String::from('"');
    for c in name.chars() {
        match c {
            '"' | '\\' => put(&mut quoted, format_args!("\\{c}")),
            c if c.is_control() => put(&mut quoted, format_args!("\\u{:04X}", u32::from(c))),
            c => quoted.push(c),
        }
    }
    quoted.push('"');
    quoted
}

fn put(text: &mut String, arguments: std::fmt::Arguments<'_>) {
    text.write_fmt(arguments).expect("writing to a string does not fail");
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_short_and_keep_their_bits() {
        for (number, text) in [
            (0.0, "0.0"),
            (1000.0, "1000.0"),
            (5e6, "5000000.0"),
            (2.1e11, "2.1e11"),
            (5e-9, "5e-9"),
            (-9.81, "-9.81"),
        ] {
            assert_eq!(float(number), text);
            assert_eq!(
                toml::from_str::<Table>(&format!("a = {text}")).unwrap()["a"].as_float(),
                Some(number)
            );
        }
    }

    #[test]
    fn keys_are_quoted_where_they_must_be() {
        for name in ["left", "inner wall", "", "a.b", "say \"hi\"", "tab\t", "é"] {
            let line = format!("{} = 1", key(name));
            let read: Table = toml::from_str(&line).unwrap();
            assert_eq!(read.keys().collect::<Vec<_>>(), [name], "{line}");
        }
    }
}
