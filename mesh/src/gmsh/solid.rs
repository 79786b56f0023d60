//! From a gmsh file to the mesh of a plane solid.

use super::convert::numbering;
use super::document::GmshFile;
use super::element::ElementKind;
use super::error::ConvertError;
use super::orientation;
use crate::cell::{CellKind, Cells};
use crate::solid::{NamedEdges, SolidMesh};

impl GmshFile {
    /// Makes the mesh of a plane solid of all triangles or all quadrilaterals, straight or of second order (of 8 or 9
    /// nodes), in a group or not.
    ///
    /// Groups, names, nodes and cells are taken as by [`into_mesh`](Self::into_mesh): lines of a physical group
    /// become edges of the boundary group of its name, nodes that no cell uses are left out, and so are groups inside the
    /// mesh; cells that are all clockwise are turned round.
    ///
    /// # Errors
    /// [`ConvertError`] when there are no such cells, cells of several kinds, lines of another order than the cells, no
    /// boundary group, nodes out of `z = 0`, cells of both orientations, or when [`SolidMesh::new`] refuses what was read.
    /// Its messages count nodes and cells from 0 as the mesh does.
    pub fn into_solid_mesh(self) -> Result<SolidMesh<2>, ConvertError> {
        let (kind, cell_kind) = self.solid_kind()?;
        let line = self.edge_kind(kind, cell_kind)?;
        let mut cells = self.cells(kind);
        let (numbers, used) = numbering(self.points.len(), &cells);
        self.check_plane(&used)?;
        orientation::unify(&self.points, kind, &mut cells)?;
        let points: Vec<[f64; 2]> =
            used.iter().map(|&node| [self.points[node][0], self.points[node][1]]).collect();
        let cells = Cells::new(cell_kind, cells.iter().map(|&node| numbers[node]).collect());
        let edge_kind = crate::solid::reference::edge_kind(cell_kind);
        let groups: Vec<NamedEdges> = self
            .boundary_groups(line, &numbers, (kind, &cells.nodes))?
            .into_iter()
            .map(|(name, nodes)| (name, Cells::new(edge_kind, nodes)))
            .collect();
        Ok(SolidMesh::new(points, cells, groups)?)
    }

    /// The one kind of plane cells in the file.
    fn solid_kind(&self) -> Result<(ElementKind, CellKind), ConvertError> {
        if let Some(block) = self.blocks.iter().find(|block| block.kind.dimension() > 2) {
            let (kind, count) = (block.kind, self.count(block.kind));
            return Err(ConvertError::TooManyDimensions { kind, count, dimension: 2 });
        }
        let mut kinds = self.blocks.iter().filter_map(|block| Some((block.kind, plane_cell(block.kind)?)));
        let Some((first, cell_kind)) = kinds.next() else {
            let largest = self.blocks.iter().map(|block| block.kind.dimension()).max();
            return Err(ConvertError::NoSolid { largest });
        };
        match kinds.find(|&(kind, _)| kind != first) {
            None => Ok((first, cell_kind)),
            Some((second, _)) => Err(ConvertError::MixedKinds {
                first,
                first_count: self.count(first),
                second,
                second_count: self.count(second),
            }),
        }
    }

    /// The kind of the lines that are edges of the cells; lines of the other kind are refused.
    fn edge_kind(&self, cell: ElementKind, cell_kind: CellKind) -> Result<ElementKind, ConvertError> {
        let (wanted, kind) = match crate::solid::reference::edge_kind(cell_kind) {
            CellKind::Line2 => (ElementKind::Line2, ElementKind::Line3),
            _ => (ElementKind::Line3, ElementKind::Line2),
        };
        match self.count(kind) {
            0 => Ok(wanted),
            count => Err(ConvertError::OtherEdges { kind, count, cell, wanted }),
        }
    }
}

fn plane_cell(kind: ElementKind) -> Option<CellKind> {
    match kind {
        ElementKind::Triangle3 => Some(CellKind::Triangle3),
        ElementKind::Triangle6 => Some(CellKind::Triangle6),
        ElementKind::Quadrilateral4 => Some(CellKind::Quadrilateral4),
        ElementKind::Quadrilateral8 => Some(CellKind::Quadrilateral8),
        ElementKind::Quadrilateral9 => Some(CellKind::Quadrilateral9),
        ElementKind::Point1
        | ElementKind::Line2
        | ElementKind::Line3
        | ElementKind::Tetrahedron4
        | ElementKind::Tetrahedron10 => None,
    }
}
