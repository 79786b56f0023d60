//! Nodes and elements of format 4.1, entity by entity; text and binary files have the same layout.

use super::cursor::Cursor;
use super::entities::Entities;
use super::error::ParseError;
use super::fault::Fault;
use super::numbering::{Blocks, GroupSets, NodeList, kind};

pub(super) fn nodes(cursor: &mut Cursor) -> Result<NodeList, ParseError> {
    let Header { blocks, total } = header(cursor)?;
    let capacity = cursor.bounded("nodes", total, [0, 1, 3])?;
    let mut nodes = NodeList::with_capacity(capacity);
    for _ in 0..blocks {
        node_block(cursor, &mut nodes)?;
    }
    check_total(cursor, "nodes", total, nodes.tags.len())?;
    Ok(nodes)
}

/// All tags of the entity's nodes, then all coordinates.
fn node_block(cursor: &mut Cursor, nodes: &mut NodeList) -> Result<(), ParseError> {
    let dimension = cursor.dimension()?;
    cursor.int("an entity's tag")?;
    // Parameters on the curve or surface follow the coordinates; they are not needed.
    let parameters = match cursor.int("whether nodes have parameters (0 or 1)")? {
        0 => 0,
        1 => dimension,
        value => return Err(cursor.fail(Fault::Parametric { value })),
    };
    let announced = cursor.size("the number of nodes of an entity")?;
    let count = cursor.bounded("nodes", announced, [0, 1, 3 + parameters])?;
    cursor.end_record("the header of an entity's nodes")?;
    for _ in 0..count {
        let tag = cursor.size("a node's tag")?;
        nodes.add_tag(cursor, tag)?;
        cursor.end_record("a node's tag")?;
    }
    for _ in 0..count {
        nodes.points.push(cursor.point()?);
        for _ in 0..parameters {
            cursor.real("a parameter of a node")?;
        }
        cursor.end_record("a node's coordinates")?;
    }
    Ok(())
}

/// Without `$Entities` no element belongs to a group.
pub(super) fn elements(
    cursor: &mut Cursor,
    nodes: &NodeList,
    entities: Option<&Entities>,
) -> Result<Blocks, ParseError> {
    let Header { blocks: entity_blocks, total } = header(cursor)?;
    cursor.bounded("elements", total, [0, 2, 0])?;
    let mut blocks = Blocks::default();
    let mut read = 0;
    for _ in 0..entity_blocks {
        read += element_block(cursor, nodes, entities, &mut blocks)?;
    }
    check_total(cursor, "elements", total, read)?;
    Ok(blocks)
}

fn element_block(
    cursor: &mut Cursor,
    nodes: &NodeList,
    entities: Option<&Entities>,
    blocks: &mut Blocks,
) -> Result<usize, ParseError> {
    let dimension = cursor.dimension()?;
    let tag = cursor.int("an entity's tag")?;
    let set = match entities.map(|entities| entities.get(&(dimension, tag))) {
        None => GroupSets::NONE,
        Some(Some(&set)) => set,
        Some(None) => return Err(cursor.fail(Fault::MissingEntity { dimension, tag })),
    };
    let kind = kind(cursor)?;
    if kind.dimension() != dimension {
        return Err(cursor.fail(Fault::ElementOfEntity { kind, dimension, tag }));
    }
    let announced = cursor.size("the number of elements of an entity")?;
    let count = cursor.bounded("elements", announced, [0, 1 + kind.node_count(), 0])?;
    cursor.end_record("the header of an entity's elements")?;
    let block = blocks.nodes(kind, set);
    for _ in 0..count {
        let element = cursor.size("an element's tag")?;
        for _ in 0..kind.node_count() {
            let node = cursor.size("a node of an element")?;
            block.push(nodes.find(cursor, element, node)?);
        }
        cursor.end_record("an element")?;
    }
    Ok(count)
}

struct Header {
    blocks: usize,
    total: u64,
}

/// Numbers of blocks and of all their entries; the range of tags that follows is no news.
fn header(cursor: &mut Cursor) -> Result<Header, ParseError> {
    let blocks = cursor.size("the number of blocks")?;
    let blocks = cursor.bounded("blocks", blocks, [3, 1, 0])?;
    let total = cursor.size("the total of all blocks")?;
    cursor.size("the smallest tag")?;
    cursor.size("the largest tag")?;
    cursor.end_record("the header of the section")?;
    Ok(Header { blocks, total })
}

fn check_total(cursor: &Cursor, what: &'static str, announced: u64, found: usize) -> Result<(), ParseError> {
    let found = found as u64;
    if found == announced { Ok(()) } else { Err(cursor.fail(Fault::Total { what, announced, found })) }
}
