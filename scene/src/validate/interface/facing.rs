//! Whether fluid and structure lie on opposite sides of the interface, and nowhere in the same place.

use partita_iga::{End, Side, Spline};
use partita_mesh::facet::Facet;
use partita_mesh::{Mesh, SolidMesh, simplex};
use partita_structure::{Boundary, Patch, Space};

/// A straight piece of the structure's boundary, and the unit normal that points out of the structure.
struct Piece {
    ends: [[f64; 2]; 2],
    normal: [f64; 2],
    part: String,
}

/// An edge of the fluid's interface that the structure touches from the fluid's side.
pub(super) struct Inside {
    /// Number of such edges.
    pub(super) count: usize,
    /// Middle of the first \[m\].
    pub(super) place: [f64; 2],
    /// The part of the structure there.
    pub(super) part: String,
}

/// Pieces as near to a node as the nearest, to this share of the interface's size, meet there.
const MEET: f64 = 1e-6;
/// Cosine of the angle between the outward normals of fluid and structure above which both lie on one side. They are
/// opposite, -1, where the shapes agree; coarse edges on a curve turn them by some ten degrees.
const SAME_SIDE: f64 = 0.1;
/// Straight pieces of a curved spline element.
const CUTS: usize = 4;

/// Finds edges whose outward normal is that of the structure at both ends. Where parts of the structure meet, in a corner, the
/// one that faces the fluid best counts.
pub(super) fn inside(
    facets: &[Facet<2>],
    points: &[[f64; 2]],
    space: &Space<2>,
    parts: &Boundary,
    size: f64,
) -> Option<Inside> {
    let pieces = pieces(space, parts);
    let mut found: Option<Inside> = None;
    for facet in facets {
        let normal = facet.normal(points);
        let mut worst: Option<(f64, &Piece)> = None;
        for node in facet.nodes {
            let (cosine, piece) = best_facing(&points[node], normal, &pieces, MEET * size)?;
            if worst.is_none_or(|(least, _)| cosine < least) {
                worst = Some((cosine, piece));
            }
        }
        // The better of both ends.
        let (cosine, piece) = worst?;
        if cosine > SAME_SIDE {
            let first = || Inside { count: 0, place: facet.centroid(points), part: piece.part.clone() };
            found.get_or_insert_with(first).count += 1;
        }
    }
    found
}

/// Of the pieces nearest to a point the least cosine between their normals and `normal`.
fn best_facing<'a>(
    point: &[f64; 2],
    normal: [f64; 2],
    pieces: &'a [Piece],
    meet: f64,
) -> Option<(f64, &'a Piece)> {
    let distances: Vec<f64> = pieces.iter().map(|piece| distance_to(point, &piece.ends)).collect();
    let nearest = distances.iter().copied().fold(f64::INFINITY, f64::min);
    let near = pieces.iter().zip(&distances).filter(|(_, distance)| **distance <= nearest + meet);
    let cosine = |piece: &Piece| piece.normal[0] * normal[0] + piece.normal[1] * normal[1];
    near.map(|(piece, _)| (cosine(piece), piece)).min_by(|(a, _), (b, _)| a.total_cmp(b))
}

fn pieces(space: &Space<2>, parts: &Boundary) -> Vec<Piece> {
    match (space, parts) {
        (Space::Patch(patch), Boundary::Sides(sides)) => {
            sides.iter().flat_map(|&side| of_side(patch.spline(), side)).collect()
        }
        (Space::Lagrange(mesh), Boundary::Groups(groups)) => {
            groups.iter().flat_map(|group| of_group(mesh, group)).collect()
        }
        _ => Vec::new(),
    }
}

fn of_side(patch: &Spline<2>, side: Side) -> Vec<Piece> {
    let curve = patch.side(side).0;
    let cuts = if curve.knots()[0].degree() == 1 { 1 } else { CUTS };
    let mut places = Vec::new();
    for element in curve.elements() {
        places.extend((0..cuts).map(|i| curve.point(&element.at([i as f64 / cuts as f64]))));
    }
    places.push(curve.point(&[curve.knots()[0].end(End::End)]));
    // The solid lies to the left of `bottom` and of `right`.
    let solid_on_left = (side.parameter == 0) == (side.end == End::End);
    let piece = |ends: &[[f64; 2]]| {
        let ends = if solid_on_left { [ends[0], ends[1]] } else { [ends[1], ends[0]] };
        straight(ends, &side.to_string())
    };
    places.windows(2).filter_map(piece).collect()
}

fn of_group(mesh: &SolidMesh<2>, name: &str) -> Vec<Piece> {
    let Some(group) = mesh.group(name) else { return Vec::new() };
    let place = |node: usize| mesh.points()[node];
    let of_edge = |edge: &[usize]| match *edge {
        [start, end, middle] => vec![[place(start), place(middle)], [place(middle), place(end)]],
        _ => vec![[place(edge[0]), place(edge[1])]],
    };
    group.edges.iter().flat_map(of_edge).filter_map(|ends| straight(ends, name)).collect()
}

/// A piece with the solid on its left; `None` if it has no length.
fn straight(ends: [[f64; 2]; 2], part: &str) -> Option<Piece> {
    let [a, b] = ends;
    let length = (b[0] - a[0]).hypot(b[1] - a[1]);
    let normal = [(b[1] - a[1]) / length, (a[0] - b[0]) / length];
    (length > 0.0).then(|| Piece { ends, normal, part: part.to_owned() })
}

/// A point of the structure this deep in the fluid, as a share of the nearest boundary edge of the fluid, does not come
/// from edges that cut off a curve.
const DEEP: f64 = 0.25;
/// Points of the structure that are looked at, at most.
const PROBES: usize = 64;

/// A place of the structure that lies well inside a triangle of the fluid \[m\].
pub(super) fn covered(
    mesh: &Mesh<2>,
    space: &Space<2>,
    wetted: &Boundary,
    tolerance: f64,
) -> Option<[f64; 2]> {
    let facets: Vec<&Facet<2>> = mesh.groups().iter().flat_map(|group| &group.facets).collect();
    let is_deep = |point: &[f64; 2]| {
        facets.iter().all(|facet| {
            let ends = facet.nodes.map(|node| mesh.points()[node]);
            distance_to(point, &ends) > (DEEP * facet.area(mesh.points())).max(tolerance)
        })
    };
    let holds = |nodes: &[usize], point: &[f64; 2]| {
        let corners = [0, 1, 2].map(|i| mesh.points()[nodes[i]]);
        (0..3).all(|i| cross(&corners[i], &corners[(i + 1) % 3], point) >= 0.0)
    };
    let in_fluid = |point: &[f64; 2]| mesh.cells().iter().any(|nodes| holds(nodes, point));
    probes(space, wetted).into_iter().find(|point| in_fluid(point) && is_deep(point))
}

/// Points all over a structure, its wetted parts excepted.
fn probes(space: &Space<2>, wetted: &Boundary) -> Vec<[f64; 2]> {
    match space {
        Space::Patch(patch) => probes_of_patch(patch, wetted),
        Space::Lagrange(mesh) => {
            let on_interface = space.nodes_of(wetted).unwrap_or_default();
            let boundary =
                mesh.boundary_nodes().iter().filter(|node| on_interface.binary_search(node).is_err());
            let boundary: Vec<[f64; 2]> = boundary.map(|&node| mesh.points()[node]).collect();
            let centroid = |nodes: &[usize]| {
                let corners: Vec<[f64; 2]> = nodes.iter().map(|&node| mesh.points()[node]).collect();
                simplex::centroid(&corners)
            };
            let cells: Vec<[f64; 2]> = mesh.cells().iter().map(centroid).collect();
            [thinned(&boundary), thinned(&cells)].concat()
        }
    }
}

fn probes_of_patch(patch: &Patch<2>, wetted: &Boundary) -> Vec<[f64; 2]> {
    let is_wetted = |side: Side| matches!(wetted, Boundary::Sides(sides) if sides.contains(&side));
    let spline = patch.spline();
    let at = |share: f64, parameter: usize| {
        let [start, end] = spline.knots()[parameter].domain();
        ((1.0 - share) * start + share * end).clamp(start, end)
    };
    let shares = |end: usize, sides: [Side; 2]| {
        let open = |side: Side| !is_wetted(side) && patch.seams().partner(side).is_none();
        let inner = (0..end).map(|i| (i as f64 + 0.5) / end as f64);
        let first = open(sides[0]).then_some(0.0);
        let last = open(sides[1]).then_some(1.0);
        first.into_iter().chain(inner).chain(last).collect::<Vec<f64>>()
    };
    let along = shares(12, [Side::LEFT, Side::RIGHT]);
    let across = shares(3, [Side::BOTTOM, Side::TOP]);
    across
        .iter()
        .flat_map(|&eta| along.iter().map(move |&xi| [xi, eta]))
        .map(|[xi, eta]| spline.point(&[at(xi, 0), at(eta, 1)]))
        .collect()
}

fn thinned(points: &[[f64; 2]]) -> Vec<[f64; 2]> {
    points.iter().step_by(points.len().div_ceil(PROBES).max(1)).copied().collect()
}

fn distance_to(point: &[f64; 2], [a, b]: &[[f64; 2]; 2]) -> f64 {
    let along = [b[0] - a[0], b[1] - a[1]];
    let from = [point[0] - a[0], point[1] - a[1]];
    let square = along[0] * along[0] + along[1] * along[1];
    let share = if square > 0.0 { (from[0] * along[0] + from[1] * along[1]) / square } else { 0.0 };
    let share = share.clamp(0.0, 1.0);
    (from[0] - share * along[0]).hypot(from[1] - share * along[1])
}

/// Twice the signed area of the triangle a, b, c.
fn cross(a: &[f64; 2], b: &[f64; 2], c: &[f64; 2]) -> f64 {
    (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
}
