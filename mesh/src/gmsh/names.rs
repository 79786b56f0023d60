//! `$PhysicalNames`: text in every format.

use std::collections::HashSet;

use super::cursor::Cursor;
use super::document::GroupName;
use super::error::ParseError;
use super::fault::{Fault, excerpt};

/// Reads lines of dimension, tag and quoted name.
pub(super) fn read(cursor: &mut Cursor) -> Result<Vec<GroupName>, ParseError> {
    let count: u64 = cursor.text_number("the number of names")?;
    // A line has a dimension, a tag and a name in quotes: never shorter than three numbers.
    let least = 6;
    let left = cursor.rest().len();
    if count > (left / least) as u64 {
        return Err(cursor.fail(Fault::TooMany { what: "names", count, left }));
    }
    cursor.end_line("the number of names")?;
    let mut known = HashSet::new();
    let mut names = Vec::new();
    for _ in 0..count {
        let group = line(cursor)?;
        if !known.insert((group.dimension, group.tag)) {
            let GroupName { dimension, tag, name } = group;
            return Err(cursor.fail(Fault::DuplicateName { dimension, tag, name }));
        }
        cursor.end_line("a name")?;
        names.push(group);
    }
    Ok(names)
}

fn line(cursor: &mut Cursor) -> Result<GroupName, ParseError> {
    let dimension = cursor.text_number("a group's dimension")?;
    if dimension > 3 {
        let value = i32::try_from(dimension).unwrap_or(i32::MAX);
        return Err(cursor.fail(Fault::Dimension { value }));
    }
    let tag = cursor.text_number("a group's tag")?;
    let line = cursor.line();
    let text = line.trim_ascii();
    let quoted = text.strip_prefix(b"\"").and_then(|text| text.strip_suffix(b"\""));
    let Some(name) = quoted.and_then(|name| str::from_utf8(name).ok()).filter(|name| !name.is_empty()) else {
        return Err(cursor.fail(Fault::Name { found: excerpt(text) }));
    };
    cursor.at += line.len();
    Ok(GroupName { dimension, tag, name: name.to_owned() })
}
