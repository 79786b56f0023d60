//! `$Entities` of format 4.1: which physical groups the points, curves, surfaces and volumes belong to.

use std::collections::HashMap;

use super::cursor::Cursor;
use super::error::ParseError;
use super::fault::Fault;
use super::numbering::GroupSets;

/// The set of groups of each entity, found by dimension and tag.
pub(super) type Entities = HashMap<(usize, i64), usize>;

pub(super) fn read(cursor: &mut Cursor, sets: &mut GroupSets) -> Result<Entities, ParseError> {
    let mut counts = [0; 4];
    for count in &mut counts {
        let announced = cursor.size("a number of entities")?;
        *count = cursor.bounded("entities", announced, [1, 1, 3])?;
    }
    cursor.end_record("the numbers of entities")?;
    let mut entities = Entities::new();
    for (dimension, count) in counts.into_iter().enumerate() {
        for _ in 0..count {
            let tag = cursor.int("an entity's tag")?;
            if entities.insert((dimension, tag), GroupSets::NONE).is_some() {
                return Err(cursor.fail(Fault::DuplicateEntity { dimension, tag }));
            }
            let groups = groups_of_entity(cursor, dimension)?;
            entities.insert((dimension, tag), sets.number(&groups));
            cursor.end_record("an entity")?;
        }
    }
    Ok(entities)
}

/// Passes the place and the boundary of an entity; its groups are what counts.
fn groups_of_entity(cursor: &mut Cursor, dimension: usize) -> Result<Vec<u64>, ParseError> {
    let coordinates = if dimension == 0 { 3 } else { 6 };
    for _ in 0..coordinates {
        cursor.real("a coordinate of an entity")?;
    }
    let announced = cursor.size("a number of physical groups")?;
    let count = cursor.bounded("physical groups", announced, [1, 0, 0])?;
    let mut groups = Vec::with_capacity(count);
    for _ in 0..count {
        // A sign would be the group's own orientation; here it follows from the cells.
        groups.push(cursor.int("a physical group")?.unsigned_abs());
    }
    groups.sort_unstable();
    groups.dedup();
    if dimension > 0 {
        let announced = cursor.size("a number of bounding entities")?;
        for _ in 0..cursor.bounded("bounding entities", announced, [1, 0, 0])? {
            cursor.int("a bounding entity")?;
        }
    }
    Ok(groups)
}
