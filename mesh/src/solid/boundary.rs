//! The boundary of a solid mesh: the edges that one cell owns alone.

use std::collections::HashMap;

use super::{NamedEdges, SolidGroup, check_range, reference};
use crate::Place;
use crate::cell::Cells;
use crate::error::MeshError;

/// An edge as its cell sees it: both ends, then the node between them, if any; the cell is on its left.
#[derive(Debug, Clone)]
pub(super) struct Edge {
    pub(super) nodes: Vec<usize>,
    cell: usize,
}

/// The edges that belong to one cell only, in the order of their cells.
pub(super) fn edges(cells: &Cells) -> Result<Vec<Edge>, MeshError> {
    let mut all: Vec<Edge> = Vec::new();
    for (cell, nodes) in cells.iter().enumerate() {
        for local in reference::edges(cells.kind) {
            all.push(Edge { nodes: local.iter().map(|&a| nodes[a]).collect(), cell });
        }
    }
    let mut owners: HashMap<Vec<usize>, Vec<usize>> = HashMap::new();
    for edge in &all {
        owners.entry(key(&edge.nodes)).or_default().push(edge.cell);
    }
    if let Some(edge) = all.iter().find(|edge| owners[&key(&edge.nodes)].len() > 2) {
        let nodes = key(&edge.nodes);
        return Err(MeshError::SharedFacet { cells: owners[&nodes].clone(), nodes });
    }
    all.retain(|edge| owners[&key(&edge.nodes)].len() == 1);
    Ok(all)
}

/// Finds each named edge on the boundary and takes its direction from there.
pub(super) fn groups<const D: usize>(
    points: &[[f64; D]],
    cells: &Cells,
    boundary: &[Edge],
    groups: Vec<NamedEdges>,
) -> Result<Vec<SolidGroup>, MeshError> {
    let edges: HashMap<Vec<usize>, &Edge> = boundary.iter().map(|edge| (key(&edge.nodes), edge)).collect();
    let mut named: HashMap<Vec<usize>, usize> = HashMap::new();
    let mut resolved: Vec<SolidGroup> = Vec::with_capacity(groups.len());
    for (name, given) in groups {
        assert_eq!(
            given.kind,
            reference::edge_kind(cells.kind),
            "edges of group `{name}` do not fit the cells"
        );
        if resolved.iter().any(|group| group.name == name) {
            return Err(MeshError::DuplicateGroup { name });
        }
        if given.is_empty() {
            return Err(MeshError::EmptyGroup { name });
        }
        let mut group = SolidGroup { name, edges: Cells::new(given.kind, Vec::new()) };
        for (index, nodes) in given.iter().enumerate() {
            check_range(nodes, points.len(), || format!("edge {index} of group `{}`", group.name))?;
            let edge = edges.get(&key(nodes)).filter(|edge| edge.nodes.get(2) == nodes.get(2));
            let Some(edge) = edge else {
                let place = middle(points, nodes);
                return Err(MeshError::NotOnBoundary {
                    group: group.name,
                    facet: index,
                    nodes: nodes.to_vec(),
                    place,
                });
            };
            if let Some(first) = named.insert(key(nodes), resolved.len()) {
                let first = resolved.get(first).map_or(&group.name, |group| &group.name).clone();
                let place = middle(points, nodes);
                return Err(MeshError::InTwoGroups {
                    nodes: nodes.to_vec(),
                    place,
                    first,
                    second: group.name,
                });
            }
            group.edges.nodes.extend(&edge.nodes);
        }
        resolved.push(group);
    }
    Ok(resolved)
}

/// The same for an edge and the edge the other way round.
fn key(nodes: &[usize]) -> Vec<usize> {
    let mut key = nodes.to_vec();
    key.sort_unstable();
    key
}

fn middle<const D: usize>(points: &[[f64; D]], nodes: &[usize]) -> Place {
    let middle: [f64; D] = std::array::from_fn(|i| 0.5 * (points[nodes[0]][i] + points[nodes[1]][i]));
    Place::from(middle)
}
