//! `$PhysicalNames`: text in every format.

use std::collections::HashSet;

use super::cursor::Cursor;
use super::document::{ElementBlock, GroupName};
use super::error::ParseError;
use super::fault::{Fault, excerpt};
use super::header::Version;

/// A name as the file gives it; format 2.0 does not say of which dimension its group is.
pub(super) struct Label {
    dimension: Option<usize>,
    tag: u64,
    name: String,
}

/// Reads lines of dimension (unless the format is 2.0), tag and quoted name.
pub(super) fn read(cursor: &mut Cursor, version: Version) -> Result<Vec<Label>, ParseError> {
    let count: u64 = cursor.text_number("the number of names")?;
    // A line has a tag and a name in quotes: never shorter than three numbers.
    let least = 6;
    let left = cursor.rest().len();
    if count > (left / least) as u64 {
        return Err(cursor.fail(Fault::TooMany { what: "names", count, left }));
    }
    cursor.end_line("the number of names")?;
    let mut known = HashSet::new();
    let mut names = Vec::new();
    for _ in 0..count {
        let group = line(cursor, version)?;
        if !known.insert((group.dimension, group.tag)) {
            return Err(second_name(cursor, group.dimension.unwrap_or_default(), group));
        }
        cursor.end_line("a name")?;
        names.push(group);
    }
    Ok(names)
}

fn second_name(cursor: &Cursor, dimension: usize, group: Label) -> ParseError {
    cursor.fail(Fault::DuplicateName { dimension, tag: group.tag, name: group.name })
}

fn line(cursor: &mut Cursor, version: Version) -> Result<Label, ParseError> {
    let first: i64 = cursor.text_number("a group's dimension")?;
    let place = cursor.mark;
    cursor.skip(|byte| byte == b' ' || byte == b'\t');
    let (dimension, tag) = if cursor.rest().starts_with(b"\"") {
        let tag = u64::try_from(first).map_err(|_| Fault::Negative { wanted: "a group's tag", value: first });
        (None, tag.map_err(|fault| cursor.fail(fault))?)
    } else {
        // gmsh writes -1 where it has read a name without dimension.
        let dimension = match first {
            0..=3 => usize::try_from(first).ok(),
            -1 => None,
            value => {
                cursor.mark = place;
                return Err(cursor.fail(Fault::Dimension { value }));
            }
        };
        (dimension, cursor.text_number("a group's tag")?)
    };
    let line = cursor.line();
    let text = line.trim_ascii();
    let Some(name) = quoted(text) else {
        return Err(cursor.fail(Fault::Name { found: excerpt(text) }));
    };
    if dimension.is_none() && (version != Version::TwoZero || first == -1) {
        return Err(cursor.fail(Fault::NameWithoutDimension { tag, name: name.to_owned() }));
    }
    cursor.at += line.len();
    Ok(Label { dimension, tag, name: name.to_owned() })
}

/// The name between the first two quotes; attributes that other tools write behind it are passed over.
fn quoted(text: &[u8]) -> Option<&str> {
    let inner = text.strip_prefix(b"\"")?;
    let end = inner.iter().position(|&byte| byte == b'"')?;
    let (name, rest) = (&inner[..end], &inner[end + 1..]);
    // A quote within the name would cut it.
    let ends =
        rest.first().is_none_or(u8::is_ascii_whitespace) && rest.split(|&byte| byte == b'"').count() % 2 == 1;
    str::from_utf8(name).ok().filter(|name| ends && !name.is_empty())
}

/// The names of groups; a name without dimension is that of every group of its number.
pub(super) fn resolve(
    cursor: &Cursor,
    names: Vec<Label>,
    blocks: &[ElementBlock],
) -> Result<Vec<GroupName>, ParseError> {
    let groups_of = |block: &ElementBlock| {
        block.groups.iter().map(|&tag| (block.kind.dimension(), tag)).collect::<Vec<_>>()
    };
    let groups: HashSet<(usize, u64)> = blocks.iter().flat_map(groups_of).collect();
    let mut known = HashSet::new();
    let mut resolved = Vec::new();
    for name in names {
        let holds = |&dimension: &usize| match name.dimension {
            Some(of_name) => of_name == dimension,
            None => groups.contains(&(dimension, name.tag)),
        };
        for dimension in (0..=3).filter(holds) {
            if !known.insert((dimension, name.tag)) {
                return Err(second_name(cursor, dimension, name));
            }
            resolved.push(GroupName { dimension, tag: name.tag, name: name.name.clone() });
        }
    }
    Ok(resolved)
}
