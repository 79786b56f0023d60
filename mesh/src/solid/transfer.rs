//! Conservative transfer between points and the boundary of a solid mesh.
//!
//! Each point is projected once to the closest point of the undeformed boundary edges. The shape functions of that edge
//! make the rows of `H = [N_a(s_i)]`, which maps a field on the nodes to the points; its transpose carries forces back:
//!
//! ```text
//! d = H D        F = H^T f
//! ```
//!
//! As `sum_a N_a = 1`, the total force is kept; as the same matrix maps both ways, so is the virtual work
//! `F . D = f . d`; and as `sum_a N_a x_a = x`, so is the moment, where the points lie on the edges. Source: C. Farhat, M.
//! Lesoinne, P. Le Tallec, *Load and motion transfer algorithms for fluid/structure interaction problems with
//! non-matching discrete interfaces*, Comput. Methods Appl. Mech. Eng. 157 (1998), sections 3 and 4.

use super::{SolidMesh, reference};
use crate::Place;
use crate::cell::CellKind;

/// Samples a curved edge is searched from: between two of them its distance from a point has one minimum.
const SAMPLES: usize = 16;

/// A projection this close to a node (in s) is taken for the node: round-off alone keeps them apart.
const AT_NODE: f64 = 1e-10;

/// One row of `H`: the weights of the nodes of an edge at a point, and which part of the boundary that is.
#[derive(Debug, Clone, PartialEq)]
pub struct Row {
    /// Nodes with a weight other than zero, and their weights: the shape functions at the projected point, whose sum is one.
    pub weights: Vec<(usize, f64)>,
    /// The boundary group of the edge.
    pub group: String,
    /// Distance between the point and its projection `[m]`.
    pub distance: f64,
}

/// Why points cannot be tied to the boundary of a mesh.
#[derive(Debug, Clone, PartialEq, thiserror::Error, miette::Diagnostic)]
pub enum TransferError {
    /// There is nothing to project to.
    #[error("points cannot be projected to no boundary group at all")]
    #[diagnostic(help("name at least one group of the mesh"))]
    NoGroups,
    /// The mesh has no group of that name.
    #[error("the mesh has no boundary group `{group}`")]
    #[diagnostic(help("it has {known}"))]
    NoSuchGroup {
        /// The group asked for.
        group: String,
        /// Names of all groups.
        known: String,
    },
    /// A coordinate of a point is infinite or not a number.
    #[error("point {index} at {place} is not finite")]
    #[diagnostic(help("look where the points come from"))]
    NotFinite {
        /// Index of the point.
        index: usize,
        /// Its coordinates.
        place: Place,
    },
    /// A point lies off all groups.
    #[error(
        "point {index} at {place} lies {distance:e} m away from the nearest boundary group, `{group}`, which is more \
         than the tolerance of {tolerance:e} m"
    )]
    #[diagnostic(help(
        "check that points and mesh show the same shape, in the same place \
         and unit; if they do, raise the tolerance above that distance"
    ))]
    TooFar {
        /// Index of the point.
        index: usize,
        /// Where it is.
        place: Place,
        /// The group that is nearest.
        group: String,
        /// Distance from it `[m]`.
        distance: f64,
        /// Largest distance allowed `[m]`.
        tolerance: f64,
    },
}

/// Projects points to the closest edge of several boundary groups and evaluates its shape functions there.
///
/// Where two edges are equally close (at a node between them), the one listed first is taken; either gives the node
/// alone, with a weight of exactly 1.
///
/// # Errors
/// When there are no groups, the mesh lacks one of them, a point is not finite, or its distance exceeds `tolerance`
/// `[m]`. The error names the first such point.
///
/// ```
/// use partita_mesh::{CellKind, Cells, SolidMesh};
/// use partita_mesh::solid::transfer;
///
/// let points = vec![[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [0.0, 1.0]];
/// let cells = Cells::new(CellKind::Quadrilateral4, vec![0, 1, 2, 3]);
/// let top = ("top".to_owned(), Cells::new(CellKind::Line2, vec![2, 3]));
/// let mesh = SolidMesh::new(points, cells, vec![top])?;
/// let rows = transfer::rows(&mesh, &["top"], &[[0.5, 1.0], [2.0, 1.0]], 1e-9)?;
/// assert_eq!(rows[0].weights, [(2, 0.25), (3, 0.75)]);
/// assert_eq!(rows[1].weights, [(2, 1.0)]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn rows<const D: usize>(
    mesh: &SolidMesh<D>,
    groups: &[impl AsRef<str>],
    points: &[[f64; D]],
    tolerance: f64,
) -> Result<Vec<Row>, TransferError> {
    if groups.is_empty() {
        return Err(TransferError::NoGroups);
    }
    let mut edges = Vec::new();
    for name in groups.iter().map(AsRef::as_ref) {
        let group = mesh.group(name).ok_or_else(|| TransferError::NoSuchGroup {
            group: name.to_owned(),
            known: mesh.group_names(),
        })?;
        edges.extend(group.edges.iter().map(|nodes| Edge::new(mesh, &group.name, group.edges.kind, nodes)));
    }
    points.iter().enumerate().map(|(index, point)| row(index, point, &edges, tolerance)).collect()
}

/// Field at the points, `d = H D`, for `N` components a point.
///
/// # Panics
/// When there are not as many values as rows.
pub fn to_points<const N: usize>(rows: &[Row], nodes: &[[f64; N]], points: &mut [[f64; N]]) {
    assert_eq!(rows.len(), points.len(), "one value for each row");
    for (row, point) in rows.iter().zip(points) {
        *point = [0.0; N];
        for &(a, weight) in &row.weights {
            (0..N).for_each(|c| point[c] += weight * nodes[a][c]);
        }
    }
}

/// Adds the forces at the points to those of the nodes, `F += H^T f`, for `N` components a point.
///
/// # Panics
/// When there are not as many values as rows.
pub fn add_to_nodes<const N: usize>(rows: &[Row], points: &[[f64; N]], nodes: &mut [[f64; N]]) {
    assert_eq!(rows.len(), points.len(), "one value for each row");
    for (row, point) in rows.iter().zip(points) {
        for &(a, weight) in &row.weights {
            (0..N).for_each(|c| nodes[a][c] += weight * point[c]);
        }
    }
}

fn row<const D: usize>(
    index: usize,
    point: &[f64; D],
    edges: &[Edge<'_, D>],
    tolerance: f64,
) -> Result<Row, TransferError> {
    let place = || Place::from(*point);
    if point.iter().any(|x| !x.is_finite()) {
        return Err(TransferError::NotFinite { index, place: place() });
    }
    let mut best: Option<(f64, f64, &Edge<'_, D>)> = None;
    for edge in edges {
        if best.is_none_or(|(least, ..)| edge.square_to_box(point) < least) {
            let s = edge.closest(point);
            let square = edge.square_distance(s, point);
            if best.is_none_or(|(least, ..)| square < least) {
                best = Some((square, s, edge));
            }
        }
    }
    let (square, s, edge) = best.expect("a group has an edge");
    let (distance, group) = (square.sqrt(), edge.group.to_owned());
    if distance > tolerance {
        return Err(TransferError::TooFar { index, place: place(), group, distance, tolerance });
    }
    let shape = reference::line_shape(edge.kind, s).map(|[value, _]| value);
    let entries = edge.nodes.iter().zip(shape).filter(|(_, weight)| *weight != 0.0);
    let weights = entries.map(|(&node, weight)| (node, weight)).collect();
    Ok(Row { weights, group, distance })
}

/// An edge of the boundary, `x(s) = sum_a N_a(s) x_a` for s in [-1, 1].
struct Edge<'a, const D: usize> {
    group: &'a str,
    kind: CellKind,
    nodes: &'a [usize],
    points: [[f64; D]; 3],
    /// Low and high corner of a box that holds the edge.
    bounds: [[f64; D]; 2],
}

impl<'a, const D: usize> Edge<'a, D> {
    fn new(mesh: &SolidMesh<D>, group: &'a str, kind: CellKind, nodes: &'a [usize]) -> Self {
        let mut points = [[0.0; D]; 3];
        points.iter_mut().zip(nodes).for_each(|(point, &node)| *point = mesh.points()[node]);
        let of_nodes = &points[..nodes.len()];
        let extreme = |i: usize, pick: fn(f64, f64) -> f64, start: f64| {
            of_nodes.iter().map(|point| point[i]).fold(start, pick)
        };
        let low: [f64; D] = std::array::from_fn(|i| extreme(i, f64::min, f64::INFINITY));
        let high: [f64; D] = std::array::from_fn(|i| extreme(i, f64::max, f64::NEG_INFINITY));
        // A parabola leaves the box round its nodes by at most an eighth of it.
        let margin = |i: usize| if nodes.len() == 3 { 0.125 * (high[i] - low[i]) } else { 0.0 };
        let bounds =
            [std::array::from_fn(|i| low[i] - margin(i)), std::array::from_fn(|i| high[i] + margin(i))];
        Self { group, kind, nodes, points, bounds }
    }

    /// x(s) and dx/ds.
    fn at(&self, s: f64) -> [[f64; D]; 2] {
        let mut at = [[0.0; D]; 2];
        for (x, shape) in self.points.iter().zip(reference::line_shape(self.kind, s)) {
            for i in 0..D {
                at[0][i] += shape[0] * x[i];
                at[1][i] += shape[1] * x[i];
            }
        }
        at
    }

    fn square_distance(&self, s: f64, point: &[f64; D]) -> f64 {
        let [x, _] = self.at(s);
        (0..D).map(|i| (x[i] - point[i]).powi(2)).sum()
    }

    fn square_to_box(&self, point: &[f64; D]) -> f64 {
        let [low, high] = &self.bounds;
        (0..D).map(|i| (point[i] - point[i].clamp(low[i], high[i])).powi(2)).sum()
    }

    /// g(s) = (x(s) - point) . dx/ds, half the slope of the squared distance.
    fn slope(&self, s: f64, point: &[f64; D]) -> f64 {
        let [x, tangent] = self.at(s);
        (0..D).map(|i| (x[i] - point[i]) * tangent[i]).sum()
    }

    /// The s of the point of the edge that is closest to `point`: a node to the last bit where it is one.
    fn closest(&self, point: &[f64; D]) -> f64 {
        let s = match self.kind {
            CellKind::Line2 => {
                // g is linear.
                let (start, end) = (self.slope(-1.0, point), self.slope(1.0, point));
                ((start + end) / (start - end)).clamp(-1.0, 1.0)
            }
            _ => self.closest_of_curve(point),
        };
        let nodes: &[f64] = if self.nodes.len() == 3 { &[-1.0, 0.0, 1.0] } else { &[-1.0, 1.0] };
        nodes.iter().copied().find(|node| (s - node).abs() < AT_NODE).unwrap_or(s)
    }

    /// The best of both ends and of the minima between the samples.
    fn closest_of_curve(&self, point: &[f64; D]) -> f64 {
        let sample = |k: usize| 2.0 * k as f64 / SAMPLES as f64 - 1.0;
        let minima = (0..SAMPLES)
            .map(|k| [sample(k), sample(k + 1)])
            .filter(|&[low, high]| self.slope(low, point) <= 0.0 && self.slope(high, point) >= 0.0)
            .map(|[low, high]| self.root_of_slope(low, high, point));
        [-1.0, 1.0]
            .into_iter()
            .chain(minima)
            .min_by(|&a, &b| self.square_distance(a, point).total_cmp(&self.square_distance(b, point)))
            .expect("an edge has ends")
    }

    /// The root of g, which rises from `low` to `high`, by bisection to the last bit: setup alone pays for it.
    fn root_of_slope(&self, mut low: f64, mut high: f64, point: &[f64; D]) -> f64 {
        loop {
            let middle = f64::midpoint(low, high);
            if middle <= low || middle >= high {
                return middle;
            }
            if self.slope(middle, point) < 0.0 { low = middle } else { high = middle }
        }
    }
}
