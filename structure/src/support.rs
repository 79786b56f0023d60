//! Supports: which components of the displacement stay zero.

use crate::boundary::Boundary;
use crate::error::StructureError;
use crate::space::Space;

/// Parts of the boundary that keep some components of their displacement at zero: rollers, planes of symmetry.
///
/// ```
/// use partita_iga::Side;
/// use partita_structure::Held;
///
/// // Slides up and down a wall at x = const.
/// let roller = Held { parts: Side::RIGHT.into(), components: [true, false] };
/// # let _: Held<2> = roller;
/// ```
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Held<const D: usize> {
    /// The parts: sides of a patch, groups of a mesh.
    pub parts: Boundary,
    /// Which components are zero.
    pub components: [bool; D],
}

impl<const D: usize> Space<D> {
    /// Which dofs `node * D + c` do not move: all of the nodes of `clamped`, some of those of `held`.
    ///
    /// # Errors
    /// When the space has no such part.
    pub fn held_dofs(&self, clamped: &Boundary, held: &[Held<D>]) -> Result<Vec<bool>, StructureError> {
        let mut dofs = vec![false; self.node_count() * D];
        for node in self.nodes_of(clamped)? {
            dofs[node * D..][..D].fill(true);
        }
        for Held { parts, components } in held {
            for node in self.nodes_of(parts)? {
                for (dof, held) in dofs[node * D..][..D].iter_mut().zip(components) {
                    *dof |= held;
                }
            }
        }
        Ok(dofs)
    }
}
