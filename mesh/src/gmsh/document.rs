//! What a gmsh file holds, independent of its version and encoding.

use super::element::ElementKind;

/// A gmsh file: nodes, elements and the names of physical groups.
///
/// The same mesh saved as 2.0, 2.2 or 4.1, as text or binary, gives the same document (elements in several groups
/// excepted, see [`ElementBlock::groups`]). Entities, parameters, partitions of 2.2, element tags, periodicity and
/// results are passed over.
#[derive(Debug, Clone, PartialEq)]
pub struct GmshFile {
    /// The number gmsh gave each node: positive, in any order, with gaps.
    pub node_tags: Vec<u64>,
    /// Coordinates of each node, in the order of `node_tags`; finite.
    pub points: Vec<[f64; 3]>,
    /// All elements, sorted by kind and then by groups; no two blocks share both.
    pub blocks: Vec<ElementBlock>,
    /// Names of physical groups, in the order of the file.
    pub names: Vec<GroupName>,
}

/// The elements of one kind that lie in the same physical groups.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ElementBlock {
    /// Kind of every element.
    pub kind: ElementKind,
    /// Tags of the physical groups, ascending; empty for elements outside of all groups.
    ///
    /// Format 2.2 knows one group an element and repeats an element that has several.
    pub groups: Vec<u64>,
    /// Nodes of all elements, element after element: indices into [`GmshFile::points`].
    pub nodes: Vec<usize>,
}

/// The name of a physical group.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct GroupName {
    /// 0 for points, 1 for curves, 2 for surfaces, 3 for volumes; tags count anew in each dimension.
    pub dimension: usize,
    /// Number of the group.
    pub tag: u64,
    /// What the user calls it.
    pub name: String,
}

impl GmshFile {
    /// What a physical group is called: its name, or `group-<tag>` when the file gives none.
    #[must_use]
    pub fn group_name(&self, dimension: usize, tag: u64) -> String {
        let named = self.names.iter().find(|group| (group.dimension, group.tag) == (dimension, tag));
        named.map_or_else(|| default_name(tag), |group| group.name.clone())
    }

    /// Number of elements of a kind, in all groups.
    #[must_use]
    pub fn count(&self, kind: ElementKind) -> usize {
        self.blocks.iter().filter(|block| block.kind == kind).map(ElementBlock::len).sum()
    }
}

/// The name of a group without one.
pub(super) fn default_name(tag: u64) -> String {
    format!("group-{tag}")
}

impl ElementBlock {
    /// Number of elements.
    #[must_use]
    pub fn len(&self) -> usize {
        self.nodes.len() / self.kind.node_count()
    }

    /// Whether there is no element.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.nodes.is_empty()
    }

    /// Nodes of one element after the other.
    pub fn elements(&self) -> impl Iterator<Item = &[usize]> {
        self.nodes.chunks_exact(self.kind.node_count())
    }
}
