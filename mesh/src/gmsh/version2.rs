//! Nodes and elements of format 2.2. Their counts are text in binary files, too.

use super::cursor::{Cursor, Encoding};
use super::element::ElementKind;
use super::error::ParseError;
use super::fault::Fault;
use super::numbering::{Blocks, GroupSets, NodeList, kind};

pub(super) fn nodes(cursor: &mut Cursor) -> Result<NodeList, ParseError> {
    let announced = cursor.text_number("the number of nodes")?;
    let count = cursor.bounded("nodes", announced, [1, 0, 3])?;
    cursor.end_line("the number of nodes")?;
    let mut nodes = NodeList::with_capacity(count);
    for _ in 0..count {
        let tag = cursor.unsigned("a node's tag")?;
        nodes.add_tag(cursor, tag)?;
        nodes.points.push(cursor.point()?);
        cursor.end_record("a node")?;
    }
    Ok(nodes)
}

pub(super) fn elements(
    cursor: &mut Cursor,
    nodes: &NodeList,
    sets: &mut GroupSets,
) -> Result<Blocks, ParseError> {
    let announced = cursor.text_number("the number of elements")?;
    // The shortest element is a point without tags: its own tag and its node, beside a header in binary files.
    let count = cursor.bounded("elements", announced, [2, 0, 0])?;
    cursor.end_line("the number of elements")?;
    let mut reader = Elements { nodes, sets, blocks: Blocks::default() };
    if cursor.encoding == Encoding::Ascii {
        reader.text(cursor, count)?;
    } else {
        reader.binary(cursor, count)?;
    }
    Ok(reader.blocks)
}

struct Elements<'a> {
    nodes: &'a NodeList,
    sets: &'a mut GroupSets,
    blocks: Blocks,
}

impl Elements<'_> {
    /// A line an element: tag, type, number of tags, tags, nodes.
    fn text(&mut self, cursor: &mut Cursor, count: usize) -> Result<(), ParseError> {
        for _ in 0..count {
            let element = cursor.unsigned("an element's tag")?;
            let kind = kind(cursor)?;
            let tags = cursor.unsigned("the number of an element's tags")?;
            self.tags_and_nodes(cursor, element, kind, tags)?;
            cursor.end_record("an element")?;
        }
        Ok(())
    }

    /// Batches of a type, a count and a number of tags; then tag, tags and nodes of each element.
    fn binary(&mut self, cursor: &mut Cursor, count: usize) -> Result<(), ParseError> {
        let (announced, mut read) = (count as u64, 0);
        while read < announced {
            let kind = kind(cursor)?;
            let batch = cursor.unsigned("the number of elements of a batch")?;
            let tags = cursor.unsigned("the number of an element's tags")?;
            read += batch;
            if read > announced {
                return Err(cursor.fail(Fault::Total { what: "elements", announced, found: read }));
            }
            for _ in 0..batch {
                let element = cursor.unsigned("an element's tag")?;
                self.tags_and_nodes(cursor, element, kind, tags)?;
            }
        }
        Ok(())
    }

    /// The first tag is the physical group, 0 for none; entity and partitions follow and are not needed.
    fn tags_and_nodes(
        &mut self,
        cursor: &mut Cursor,
        element: u64,
        kind: ElementKind,
        tags: u64,
    ) -> Result<(), ParseError> {
        let mut group = 0;
        for index in 0..tags {
            let tag = cursor.int("an element's tag of group or entity")?;
            if index == 0 {
                group = tag.unsigned_abs();
            }
        }
        let set = if group == 0 { GroupSets::NONE } else { self.sets.number(&[group]) };
        let block = self.blocks.nodes(kind, set);
        for _ in 0..kind.node_count() {
            let node = cursor.unsigned("a node of an element")?;
            block.push(self.nodes.find(cursor, element, node)?);
        }
        Ok(())
    }
}
