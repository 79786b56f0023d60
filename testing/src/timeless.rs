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

/// A table without quoted entries.
///
/// # Panics
/// When it has no header.
#[must_use]
pub fn table(text: &str) -> String {
    let mut rows = text.lines().map(|line| line.split(',').collect::<Vec<_>>());
    let header = rows.next().expect("a header");
    let kept: Vec<usize> = (0..header.len()).filter(|&i| !header[i].ends_with("_seconds")).collect();
    let timeless = |row: Vec<&str>| kept.iter().map(|&i| row[i]).collect::<Vec<_>>().join(",") + "\n";
    [header].into_iter().chain(rows).map(timeless).collect()
}
