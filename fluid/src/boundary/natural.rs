//! Facets with a condition on the stress.

use partita_mesh::{Facet, Mesh};

use super::MovedMesh;
use crate::error::FluidError;
use crate::model::{BoundaryCondition, FluidModel};

/// What a natural condition adds to the residual.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Natural<const D: usize> {
    /// Values of h `[Pa]` at the facet's nodes, in the order of the cell's.
    Traction { condition: usize, values: [[f64; D]; D] },
    /// The transposed stress of do-nothing, the backflow term, or both.
    Outflow { do_nothing: bool, backflow: bool },
}

/// A facet of a cell with something to add.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct NaturalFacet<const D: usize> {
    pub(crate) cell: usize,
    /// The cell's local node that is not on the facet.
    pub(crate) opposite: usize,
    /// The facet's nodes in the order of the cell's.
    nodes: [usize; D],
    pub(crate) natural: Natural<D>,
}

/// The facets of all natural conditions that are not simply zero.
pub(super) fn facets<const D: usize>(mesh: &Mesh<D>, model: &FluidModel<D>) -> Vec<NaturalFacet<D>> {
    let mut found = Vec::new();
    for (condition, (group, kind)) in model.boundary.iter().enumerate() {
        let natural = match *kind {
            BoundaryCondition::Traction(_) => Natural::Traction { condition, values: [[0.0; D]; D] },
            BoundaryCondition::DoNothing { backflow } => Natural::Outflow { do_nothing: true, backflow },
            BoundaryCondition::StressFree { backflow: true } => {
                Natural::Outflow { do_nothing: false, backflow: true }
            }
            _ => continue,
        };
        let group = mesh.group(group).expect("a checked group");
        found.extend(group.facets.iter().map(|facet| NaturalFacet::new(mesh, facet, natural)));
    }
    found
}

impl<const D: usize> NaturalFacet<D> {
    fn new(mesh: &Mesh<D>, facet: &Facet<D>, natural: Natural<D>) -> Self {
        let cell = mesh.cells().cell(facet.cell);
        let opposite =
            cell.iter().position(|node| !facet.nodes.contains(node)).expect("a node off the facet");
        let nodes = std::array::from_fn(|k| cell[if k < opposite { k } else { k + 1 }]);
        Self { cell: facet.cell, opposite, nodes, natural }
    }

    /// Evaluates a traction at the nodes of the moved mesh.
    pub(crate) fn update(&mut self, model: &FluidModel<D>, mesh: &MovedMesh<D>) -> Result<(), FluidError> {
        let Natural::Traction { condition, values } = &mut self.natural else { return Ok(()) };
        let BoundaryCondition::Traction(field) = &model.boundary[*condition].1 else {
            unreachable!("a traction comes from a traction condition")
        };
        for (value, node) in values.iter_mut().zip(self.nodes) {
            *value = mesh.evaluate(field, node, "traction")?;
        }
        Ok(())
    }
}
