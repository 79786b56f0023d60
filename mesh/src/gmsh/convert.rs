//! From a gmsh file to a mesh of straight simplices with named boundary groups.

use std::collections::{BTreeMap, HashSet};

use super::document::{ElementBlock, GmshFile, default_name};
use super::element::ElementKind;
use super::error::ConvertError;
use super::orientation;
use super::sides::Owners;
use crate::cell::{CellKind, Cells};
use crate::mesh::{Mesh, NamedFacets};

/// A node farther from the plane than this part of the mesh's extent is not in it; CAD kernels leave round-off.
const IN_PLANE: f64 = 1e-12;

/// Marks a node that no cell uses.
const UNUSED: usize = usize::MAX;

impl GmshFile {
    /// Makes a mesh: in `D = 2` all triangles, in `D = 3` all tetrahedra, in a group or not.
    ///
    /// Lines (triangles in space) of a physical group become facets of the boundary group of its name, or
    /// `group-<tag>` when it has none; those outside of groups say nothing new and are left out, and so are points
    /// and nodes that no cell uses. Groups come in the order of their tags, nodes and cells keep their order.
    /// A cell that several blocks name because it is in several groups counts once.
    ///
    /// Cells that are all clockwise (negative) are turned round, see [`is_inverted`](Self::is_inverted): the surface was
    /// drawn the other way. Where both orientations meet, cells may overlap, so that is refused.
    ///
    /// A group that lies wholly inside the mesh, between two cells at each facet, is no boundary and is left out.
    ///
    /// # Errors
    /// [`ConvertError`] when there are no such cells, or quadrilaterals or elements of second order beside them,
    /// no boundary group, a plane mesh out of `z = 0`, cells of both orientations, or when
    /// [`Mesh::new`] refuses what was read. Its messages count nodes and cells from 0 as the mesh does.
    ///
    /// # Panics
    /// If `D` is neither 2 nor 3.
    pub fn into_mesh<const D: usize>(self) -> Result<Mesh<D>, ConvertError> {
        assert!(D == 2 || D == 3, "gmsh files make meshes in 2 or 3 dimensions, not {D}");
        self.check_kinds(D)?;
        let kind = ElementKind::simplex(D);
        let mut cells = self.cells(kind);
        let (numbers, used) = numbering(self.points.len(), &cells);
        if D == 2 {
            self.check_plane(&used)?;
        }
        orientation::unify(&self.points, kind, &mut cells)?;
        let points: Vec<[f64; D]> =
            used.iter().map(|&node| std::array::from_fn(|i| self.points[node][i])).collect();
        let nodes = cells.iter().map(|&node| numbers[node]).collect();
        let cells = Cells::new(CellKind::simplex(D), nodes);
        let groups = self.boundary_groups(ElementKind::simplex(D - 1), &numbers, (kind, &cells.nodes))?;
        let facets = |nodes: Vec<usize>| nodes.as_chunks::<D>().0.to_vec();
        let groups: Vec<NamedFacets<D>> =
            groups.into_iter().map(|(name, nodes)| (name, facets(nodes))).collect();
        Ok(Mesh::new(points, cells, groups)?)
    }

    fn check_kinds(&self, dimension: usize) -> Result<(), ConvertError> {
        for block in &self.blocks {
            let kind = block.kind;
            if kind.dimension() > dimension {
                let count = self.count(kind);
                return Err(ConvertError::TooManyDimensions { kind, count, dimension });
            }
            let wanted = ElementKind::simplex(kind.dimension());
            if kind.dimension() + 1 >= dimension && kind != wanted {
                let count = self.count(kind);
                return Err(ConvertError::UnsupportedKind { kind, count, wanted });
            }
        }
        let kind = ElementKind::simplex(dimension);
        if self.count(kind) == 0 {
            let largest = self.blocks.iter().map(|block| block.kind.dimension()).max();
            return Err(ConvertError::NoCells { kind, dimension, largest });
        }
        Ok(())
    }

    /// Nodes of all elements of a kind, block after block; what an earlier block holds is not taken again.
    pub(super) fn cells(&self, kind: ElementKind) -> Vec<usize> {
        let blocks: Vec<&ElementBlock> = self.blocks.iter().filter(|block| block.kind == kind).collect();
        if let [block] = blocks[..] {
            return block.nodes.clone();
        }
        let mut known: HashSet<&[usize]> = HashSet::new();
        let mut nodes = Vec::new();
        for block in blocks {
            nodes.extend(block.elements().filter(|cell| !known.contains(cell)).flatten());
            known.extend(block.elements());
        }
        nodes
    }

    pub(super) fn check_plane(&self, used: &[usize]) -> Result<(), ConvertError> {
        let points = || used.iter().map(|&node| self.points[node]);
        let extent = points().flat_map(|[x, y, _]| [x.abs(), y.abs()]).fold(0.0, f64::max);
        match points().position(|[_, _, z]| z.abs() > IN_PLANE * extent) {
            Some(index) => Err(ConvertError::NotPlanar {
                node: self.node_tags[used[index]],
                place: self.points[used[index]].into(),
            }),
            None => Ok(()),
        }
    }

    /// Names of all groups of boundary elements of a kind, and the nodes of their elements; `cells` are of one kind, with
    /// new numbers as the nodes that are returned.
    pub(super) fn boundary_groups(
        &self,
        kind: ElementKind,
        numbers: &[usize],
        cells: (ElementKind, &[usize]),
    ) -> Result<Vec<(String, Vec<usize>)>, ConvertError> {
        let dimension = kind.dimension();
        let named = self.names.iter().filter(|group| group.dimension == dimension);
        // A name without elements gives an empty group, which the mesh refuses: a condition there would act nowhere.
        let mut groups: BTreeMap<u64, (String, Vec<usize>)> =
            named.map(|group| (group.tag, (group.name.clone(), Vec::new()))).collect();
        for block in self.blocks.iter().filter(|block| block.kind == kind) {
            match block.groups[..] {
                [] => {}
                [tag] => {
                    let unnamed = || (default_name(tag), Vec::new());
                    self.append_facets(block, numbers, groups.entry(tag).or_insert_with(unnamed))?;
                }
                [first, second, ..] => {
                    let name = |tag| self.group_name(dimension, tag);
                    return Err(ConvertError::SharedFacets { first: name(first), second: name(second) });
                }
            }
        }
        let owners = Owners::new(groups.values().map(|(_, nodes)| (kind, &nodes[..])), [cells]);
        let is_inside = |facet: &[usize]| owners.of(kind, facet) == 2;
        groups.retain(|_, (_, nodes)| {
            nodes.is_empty() || !nodes.chunks_exact(kind.node_count()).all(is_inside)
        });
        if groups.values().all(|(_, facets)| facets.is_empty()) {
            return Err(ConvertError::NoGroups { facet: kind });
        }
        Ok(groups.into_values().collect())
    }

    fn append_facets(
        &self,
        block: &ElementBlock,
        numbers: &[usize],
        (name, facets): &mut (String, Vec<usize>),
    ) -> Result<(), ConvertError> {
        for facet in block.elements() {
            if let Some(&node) = facet.iter().find(|&&node| numbers[node] == UNUSED) {
                return Err(ConvertError::OffCells {
                    group: name.clone(),
                    node: self.node_tags[node],
                    place: self.points[node].into(),
                });
            }
            facets.extend(facet.iter().map(|&node| numbers[node]));
        }
        Ok(())
    }
}

/// Numbers of the nodes that cells use, without gaps and in their old order, and the old number of each new one.
pub(super) fn numbering(count: usize, cells: &[usize]) -> (Vec<usize>, Vec<usize>) {
    let mut numbers = vec![UNUSED; count];
    for &node in cells {
        numbers[node] = 0;
    }
    let used: Vec<usize> = (0..count).filter(|&node| numbers[node] != UNUSED).collect();
    for (number, &node) in used.iter().enumerate() {
        numbers[node] = number;
    }
    (numbers, used)
}
