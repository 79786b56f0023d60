//! Physical groups of a file, and the part of it that lies in some of them.

use std::collections::{BTreeMap, HashMap, HashSet};

use super::document::{ElementBlock, GmshFile, GroupName, default_name};
use super::error::ConvertError;
use super::sides::Owners;

/// A physical group as a file has it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct PhysicalGroup {
    /// 0 for points, 1 for curves, 2 for surfaces, 3 for volumes.
    pub dimension: usize,
    /// Its name, or `group-<tag>`.
    pub name: String,
    /// Number of its elements; none where only its name is there.
    pub elements: usize,
}

impl GmshFile {
    /// All physical groups, by dimension and tag.
    #[must_use]
    pub fn groups(&self) -> Vec<PhysicalGroup> {
        let mut groups: BTreeMap<(usize, u64), PhysicalGroup> = BTreeMap::new();
        for group in &self.names {
            let (dimension, name) = (group.dimension, group.name.clone());
            groups.insert((dimension, group.tag), PhysicalGroup { dimension, name, elements: 0 });
        }
        for block in &self.blocks {
            let dimension = block.kind.dimension();
            for &tag in &block.groups {
                let unnamed = || PhysicalGroup { dimension, name: default_name(tag), elements: 0 };
                groups.entry((dimension, tag)).or_insert_with(unnamed).elements += block.len();
            }
        }
        groups.into_values().collect()
    }

    /// The part of the file that makes one mesh in `dimension` 2 or 3: the cells of the physical surfaces (volumes) of
    /// these `names`, and of the elements one dimension below those that are sides of such cells. Without names all of
    /// the file, if it has no more than one physical surface (volume) and that holds every cell.
    ///
    /// A curve between two surfaces is in the part on either side of it, and a boundary there.
    ///
    /// ```no_run
    /// use partita_mesh::gmsh::GmshFile;
    ///
    /// let file = GmshFile::read("flap.msh".as_ref())?;
    /// let fluid = file.clone().part(2, &["water"])?.into_mesh::<2>()?;
    /// let flap = file.part(2, &["flap"])?.into_solid_mesh()?;
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// [`ConvertError::UnknownRegion`] for a name without cells; [`ConvertError::SeveralRegions`] and
    /// [`ConvertError::Unassigned`] where there are no names and the file leaves a choice.
    pub fn part(self, dimension: usize, names: &[impl AsRef<str>]) -> Result<Self, ConvertError> {
        let regions = self.regions(dimension);
        if names.is_empty() {
            return self.whole(dimension, regions);
        }
        if let Some(name) =
            names.iter().map(AsRef::as_ref).find(|name| !regions.iter().any(|known| known == name))
        {
            return Err(ConvertError::UnknownRegion { dimension, name: name.to_owned(), groups: regions });
        }
        Ok(self.restricted(dimension, |name| names.iter().any(|given| given.as_ref() == name)))
    }

    /// Names of the physical groups that have cells of a dimension, each once.
    #[must_use]
    pub fn regions(&self, dimension: usize) -> Vec<String> {
        let mut known = HashSet::new();
        let with_cells = self.groups().into_iter().filter(|g| g.dimension == dimension && g.elements > 0);
        with_cells.map(|group| group.name).filter(|name| known.insert(name.clone())).collect()
    }

    fn whole(self, dimension: usize, regions: Vec<String>) -> Result<Self, ConvertError> {
        if regions.len() > 1 {
            return Err(ConvertError::SeveralRegions { dimension, groups: regions });
        }
        let cells = self.unassigned(dimension);
        if !regions.is_empty() && cells > 0 {
            return Err(ConvertError::Unassigned { dimension, cells, groups: regions });
        }
        Ok(self)
    }

    /// Number of cells in no physical group; format 2.2 may give a cell once with and once without.
    fn unassigned(&self, dimension: usize) -> usize {
        let of = |grouped: bool| {
            let cells = move |block: &&ElementBlock| {
                block.kind.dimension() == dimension && block.groups.is_empty() != grouped
            };
            self.blocks.iter().filter(cells).flat_map(ElementBlock::elements)
        };
        let known: HashSet<&[usize]> = of(true).collect();
        of(false).filter(|cell| !known.contains(cell)).count()
    }

    /// Keeps the cells of the chosen groups and what touches them.
    fn restricted(self, dimension: usize, is_chosen: impl Fn(&str) -> bool) -> Self {
        let names: HashMap<u64, &str> =
            self.names_of(dimension).map(|group| (group.tag, &*group.name)).collect();
        let chosen = |&tag: &u64| {
            names.get(&tag).map_or_else(|| is_chosen(&default_name(tag)), |name| is_chosen(name))
        };
        let mut blocks: Vec<ElementBlock> = self
            .blocks
            .iter()
            .filter(|block| match block.kind.dimension() {
                of_block if of_block == dimension => block.groups.iter().any(chosen),
                of_block => of_block + 1 < dimension,
            })
            .cloned()
            .collect();
        let below = |block: &&ElementBlock| block.kind.dimension() + 1 == dimension;
        let sides = sides(self.blocks.iter().filter(below), &blocks, dimension);
        // A name without any element in the file stays, and is refused as it would be without a choice.
        let (touching, all) = (tags(sides.iter()), tags(self.blocks.iter().filter(below)));
        let names = self.names.iter().filter(|group| match group.dimension {
            of_group if of_group == dimension => is_chosen(&group.name),
            of_group if of_group + 1 == dimension => {
                touching.contains(&group.tag) || !all.contains(&group.tag)
            }
            _ => true,
        });
        let names = names.cloned().collect();
        blocks.extend(sides);
        blocks.sort_by(|a, b| (a.kind, &a.groups).cmp(&(b.kind, &b.groups)));
        Self { blocks, names, ..self }
    }

    fn names_of(&self, dimension: usize) -> impl Iterator<Item = &GroupName> {
        self.names.iter().filter(move |group| group.dimension == dimension)
    }
}

/// The elements of `below` that are sides of the cells of a dimension in `blocks`.
fn sides<'a>(
    below: impl Iterator<Item = &'a ElementBlock> + Clone,
    blocks: &[ElementBlock],
    dimension: usize,
) -> Vec<ElementBlock> {
    let cells = blocks.iter().filter(|block| block.kind.dimension() == dimension);
    let nodes = |block: &'a ElementBlock| (block.kind, &block.nodes[..]);
    let owners = Owners::new(below.clone().map(nodes), cells.map(|block| (block.kind, &block.nodes[..])));
    let kept = |block: &ElementBlock| {
        let touches = |facet: &&[usize]| owners.of(block.kind, facet) > 0;
        let nodes = block.elements().filter(touches).flatten().copied().collect();
        ElementBlock { nodes, ..block.clone() }
    };
    below.map(kept).filter(|block| !block.is_empty()).collect()
}

fn tags<'a>(blocks: impl Iterator<Item = &'a ElementBlock>) -> HashSet<u64> {
    blocks.flat_map(|block| block.groups.iter().copied()).collect()
}
