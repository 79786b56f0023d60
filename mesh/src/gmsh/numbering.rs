//! While a file is read: nodes found by their tags, elements sorted into blocks.

use std::collections::{BTreeMap, HashMap};

use super::cursor::Cursor;
use super::document::ElementBlock;
use super::element::{ElementKind, foreign_name};
use super::error::ParseError;
use super::fault::Fault;

/// Nodes in the order of the file, found by their tags.
#[derive(Default)]
pub(super) struct NodeList {
    pub(super) tags: Vec<u64>,
    pub(super) points: Vec<[f64; 3]>,
    index: HashMap<u64, usize>,
}

impl NodeList {
    pub(super) fn with_capacity(count: usize) -> Self {
        Self {
            tags: Vec::with_capacity(count),
            points: Vec::with_capacity(count),
            index: HashMap::with_capacity(count),
        }
    }

    /// Takes the tag that the cursor has just read.
    pub(super) fn add_tag(&mut self, cursor: &Cursor, tag: u64) -> Result<(), ParseError> {
        if tag == 0 {
            return Err(cursor.fail(Fault::NodeZero));
        }
        if self.index.insert(tag, self.tags.len()).is_some() {
            return Err(cursor.fail(Fault::DuplicateNode { tag }));
        }
        self.tags.push(tag);
        Ok(())
    }

    /// The index of the node whose tag the cursor has just read.
    pub(super) fn find(&self, cursor: &Cursor, element: u64, tag: u64) -> Result<usize, ParseError> {
        let found = self.index.get(&tag).copied();
        found.ok_or_else(|| cursor.fail(Fault::MissingNode { element, node: tag }))
    }
}

/// Sets of physical groups, each kept once: elements carry a set's number.
pub(super) struct GroupSets {
    sets: Vec<Vec<u64>>,
    numbers: HashMap<Vec<u64>, usize>,
}

impl GroupSets {
    /// The set without groups.
    pub(super) const NONE: usize = 0;

    pub(super) fn new() -> Self {
        Self { sets: vec![Vec::new()], numbers: HashMap::from([(Vec::new(), Self::NONE)]) }
    }

    /// The number of a set, given as ascending tags.
    pub(super) fn number(&mut self, groups: &[u64]) -> usize {
        if let Some(&number) = self.numbers.get(groups) {
            return number;
        }
        self.sets.push(groups.to_vec());
        self.numbers.insert(groups.to_vec(), self.sets.len() - 1);
        self.sets.len() - 1
    }
}

/// Nodes of elements by kind and number of their set of groups.
#[derive(Default)]
pub(super) struct Blocks(BTreeMap<(ElementKind, usize), Vec<usize>>);

impl Blocks {
    pub(super) fn nodes(&mut self, kind: ElementKind, set: usize) -> &mut Vec<usize> {
        self.0.entry((kind, set)).or_default()
    }

    /// The blocks of a document: those with elements, by kind and then by groups.
    pub(super) fn finish(self, sets: &GroupSets) -> Vec<ElementBlock> {
        let block = |((kind, set), nodes): ((ElementKind, usize), Vec<usize>)| ElementBlock {
            kind,
            groups: sets.sets[set].clone(),
            nodes,
        };
        let mut blocks: Vec<_> =
            self.0.into_iter().filter(|(_, nodes)| !nodes.is_empty()).map(block).collect();
        blocks.sort_by(|a, b| (a.kind, &a.groups).cmp(&(b.kind, &b.groups)));
        blocks
    }
}

/// Reads the number of an element type.
pub(super) fn kind(cursor: &mut Cursor) -> Result<ElementKind, ParseError> {
    let code = cursor.int("an element type")?;
    let name = foreign_name(code);
    let kind = i32::try_from(code).ok().and_then(ElementKind::from_code);
    kind.ok_or_else(|| cursor.fail(Fault::ForeignElement { code, name }))
}
