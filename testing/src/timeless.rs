//! What a run writes, without what depends on the machine: objects `seconds` in records, columns that end in `_seconds`.

use std::fs;
use std::path::Path;

use serde_json::Value;

/// Text of a file, by the ending of its name.
///
/// # Panics
/// When it cannot be read, or is not what its ending says.
#[must_use]
pub fn file(path: &Path) -> String {
    let text = fs::read_to_string(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    match path.extension().and_then(|ending| ending.to_str()) {
        Some("jsonl") => text.lines().map(|line| record(line) + "\n").collect(),
        Some("csv") => table(&text),
        _ => text,
    }
}

/// A record of a run: a JSON object with one object in it.
///
/// # Panics
/// When it is something else.
#[must_use]
pub fn record(line: &str) -> String {
    let mut record: Value = serde_json::from_str(line).expect("a record");
    let inner = record.as_object_mut().and_then(|record| record.values_mut().next());
    inner.and_then(Value::as_object_mut).expect("one object").remove("seconds").expect("times");
    record.to_string()
}

/// A table without the columns that end in `_seconds`; one that has none stays as it is.
#[must_use]
pub fn table(text: &str) -> String {
    let header: Vec<&str> = text.lines().next().unwrap_or_default().split(',').collect();
    let is_time = |column: usize| header.get(column).is_some_and(|name| name.ends_with("_seconds"));
    if !(0..header.len()).any(is_time) {
        return text.to_owned();
    }
    let timeless = |line: &str| {
        let kept = line.split(',').enumerate().filter(|(column, _)| !is_time(*column));
        kept.map(|(_, entry)| entry).collect::<Vec<_>>().join(",") + "\n"
    };
    text.lines().map(timeless).collect()
}
