//! Sides of cells, known by their corners: how many cells own each.

use std::collections::HashMap;

use super::element::ElementKind;

/// Corners of a side in ascending order; a line has no third.
type Key = [usize; 3];

/// The number of cells that own each of some facets.
pub(super) struct Owners(HashMap<Key, usize>);

impl Owners {
    /// Counts the owners of `facets` among `cells`; both come as nodes of some elements of a kind.
    pub(super) fn new<'a>(
        facets: impl IntoIterator<Item = (ElementKind, &'a [usize])>,
        cells: impl IntoIterator<Item = (ElementKind, &'a [usize])>,
    ) -> Self {
        let mut owners: HashMap<Key, usize> = HashMap::new();
        for (kind, nodes) in facets {
            owners.extend(nodes.chunks_exact(kind.node_count()).map(|facet| (key(kind, facet), 0)));
        }
        for (kind, nodes) in cells {
            for cell in nodes.chunks_exact(kind.node_count()) {
                for side in sides(kind) {
                    if let Some(count) = owners.get_mut(&sorted(side.iter().map(|&a| cell[a]))) {
                        *count += 1;
                    }
                }
            }
        }
        Self(owners)
    }

    /// How many cells own a facet; none where it was not asked for.
    pub(super) fn of(&self, facet: ElementKind, nodes: &[usize]) -> usize {
        self.0.get(&key(facet, nodes)).copied().unwrap_or_default()
    }
}

fn key(kind: ElementKind, nodes: &[usize]) -> Key {
    sorted(nodes[..=kind.dimension()].iter().copied())
}

fn sorted(corners: impl Iterator<Item = usize>) -> Key {
    let mut key = [usize::MAX; 3];
    key.iter_mut().zip(corners).for_each(|(entry, corner)| *entry = corner);
    key.sort_unstable();
    key
}

/// Local corners of the sides of a cell; lines and points have none that are looked for.
fn sides(kind: ElementKind) -> &'static [&'static [usize]] {
    match kind {
        ElementKind::Point1 | ElementKind::Line2 | ElementKind::Line3 => &[],
        ElementKind::Triangle3 | ElementKind::Triangle6 => &[&[0, 1], &[1, 2], &[2, 0]],
        ElementKind::Quadrilateral4 | ElementKind::Quadrilateral8 | ElementKind::Quadrilateral9 => {
            &[&[0, 1], &[1, 2], &[2, 3], &[3, 0]]
        }
        ElementKind::Tetrahedron4 | ElementKind::Tetrahedron10 => {
            &[&[0, 1, 2], &[0, 1, 3], &[0, 2, 3], &[1, 2, 3]]
        }
    }
}
