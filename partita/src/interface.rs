//! Where fluid and structure meet: the operator H between their interface points.

use partita_coupling::transfer::mortar::Mortar;
use partita_coupling::{MatrixTransfer, Transfer};
use partita_fluid::FluidSolver;
use partita_numerics::gauss;
use partita_structure::{Segment, StructureError, StructureSolver};
use sprs::TriMat;

use crate::error::BuildError;
use partita_scene::schema;

mod coarsest;

pub(crate) use coarsest::{Coarsest, coarsest};

/// Elements of the structure along an edge of the fluid, up to which the mortar method is chosen. A coarser fluid takes means
/// over many elements: neither operator is clearly better there, and interpolation keeps every node on the structure.
pub(crate) const MORTAR_UP_TO: f64 = 5.0;

/// The operator that a scene's choice comes to, with the coarsest facet of the interface.
pub(crate) fn chosen(asked: schema::Transfer, coarsest: Option<&Coarsest>) -> schema::Transfer {
    let coarse = coarsest.is_some_and(|coarsest| coarsest.exceeds(MORTAR_UP_TO));
    match asked {
        schema::Transfer::Automatic if coarse => schema::Transfer::Interpolation,
        schema::Transfer::Automatic => schema::Transfer::Mortar,
        other => other,
    }
}

/// Gauss points beyond the degree of the structure: `R_a` times a linear multiplier is exact on straight elements with one more,
/// the rest is for rational and unevenly stretched ones.
const MORE_POINTS: usize = 3;

/// The transfer `d_f = H x`, `F = H^T f`, with the rows of the fluid's interface nodes of a method: interpolation
/// `R_a(xi_i)`, or [`mortar`](partita_coupling::transfer::mortar).
///
/// Columns of nodes that do not move at all are left out: their displacement is zero, and what the fluid puts on them goes
/// into the support. A fluid node that lies on such nodes alone has an empty row. A node that moves in one direction has its
/// column; the component that is held stays zero, and its force goes into the support.
///
/// # Errors
/// When a fluid node lies farther from the wetted sides than `tolerance` times the interface's extent.
pub(crate) fn transfer(
    fluid: &FluidSolver<2>,
    structure: &StructureSolver<2>,
    method: schema::Transfer,
    tolerance: f64,
) -> Result<Box<dyn Transfer>, BuildError> {
    let points: Vec<[f64; 2]> =
        fluid.interface_nodes().iter().map(|&node| fluid.mesh().points()[node]).collect();
    let tolerance = tolerance * extent(&points);
    let nodal = structure.interface_rows(&points, tolerance)?;
    let count = points.len();
    let rows = match chosen(method, coarsest(fluid, structure).as_ref()) {
        schema::Transfer::Interpolation => nodal,
        _ => mortar(points, facets(fluid), nodal, structure, tolerance)?,
    };
    let mut weights = TriMat::new((count, structure.interface_points().len()));
    for (row, entries) in rows.iter().enumerate() {
        for (node, weight) in entries {
            if let Ok(column) = structure.interface_points().binary_search(node) {
                weights.add_triplet(row, column, *weight);
            }
        }
    }
    Ok(Box::new(MatrixTransfer::new(weights.to_csr(), 2)))
}

/// The rows of the mortar method over all nodes of the structure.
fn mortar(
    points: Vec<[f64; 2]>,
    facets: Vec<[usize; 2]>,
    nodal: Vec<Vec<(usize, f64)>>,
    structure: &StructureSolver<2>,
    tolerance: f64,
) -> Result<Vec<Vec<(usize, f64)>>, StructureError> {
    let (space, wetted) = (structure.space(), &structure.model().wetted);
    let corners = space.boundary_ends(wetted);
    let at_corner = |point: &[f64; 2]| {
        corners.iter().any(|(_, corner)| (corner[0] - point[0]).hypot(corner[1] - point[1]) <= tolerance)
    };
    let is_corner: Vec<bool> = points.iter().map(at_corner).collect();
    let mortar = Mortar::new(points, facets, &is_corner);
    let breakpoints: Vec<[f64; 2]> = space.boundary_elements(wetted).into_iter().flatten().collect();
    let samples = mortar.samples(&breakpoints, &gauss::line(space.boundary_degree(wetted) + MORE_POINTS));
    let segments: Vec<_> = samples
        .iter()
        .map(|samples| Segment { ends: samples.ends, points: samples.points.clone() })
        .collect();
    let sampled = structure.segment_rows(&segments, tolerance)?;
    Ok(mortar.rows(nodal, &samples, &sampled))
}

/// The facets of the fluid's interface by the numbers of its interface nodes.
fn facets(fluid: &FluidSolver<2>) -> Vec<[usize; 2]> {
    let number = |node: usize| fluid.interface_nodes().binary_search(&node).expect("a node of the interface");
    fluid.interface_facets().map(|facet| facet.nodes.map(number)).collect()
}

/// Diagonal of the bounding box \[m\].
fn extent(points: &[[f64; 2]]) -> f64 {
    let side = |c: usize| {
        let (low, high) = points.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), point| {
            (low.min(point[c]), high.max(point[c]))
        });
        high - low
    };
    side(0).hypot(side(1))
}

#[cfg(test)]
mod tests;
