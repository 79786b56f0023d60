//! Conservative transfer between points and the sides of a patch.
//!
//! Each point is projected once to the closest point `xi_i` of the undeformed sides. The basis functions there make
//! the rows of `H = [R_a(xi_i)]`, which maps a field on the control points to the points; its transpose carries
//! forces back:
//!
//! ```text
//! d = H D        F = H^T f
//! ```
//!
//! As `sum_a R_a = 1`, the total force is kept; as the same matrix maps both ways, so is the virtual work
//! `F . D = f . d`; and as `sum_a R_a P_a = x`, so is the moment, where the points lie on the patch. This holds for any
//! two resolutions (Hosters, Helmig, Stavrev, Behr and Elgeti, *Fluid-structure interaction with NURBS-based
//! coupling*, Comput. Methods Appl. Mech. Eng. 332, 2018).
//!
//! ```
//! use partita_iga::{Side, build, transfer};
//!
//! let plate = build::rectangle([0.0, 0.0], [1.0, 0.1], [2, 2], [4, 1])?;
//! let nodes = [[0.0, 0.1], [0.3, 0.1], [1.0, 0.1], [1.0, 0.05]];
//! let rows = transfer::rows(&plate, &[Side::TOP, Side::RIGHT], &nodes, 1e-6)?;
//!
//! // A node at the corner moves with the corner's control point and nothing else.
//! assert_eq!(rows[2].weights, [(17, 1.0)]);
//!
//! let mut forces = vec![[0.0; 2]; plate.control_points().len()];
//! transfer::add_to_control_points(&rows, &[[0.0, -1.0]; 4], &mut forces);
//! let total: f64 = forces.iter().map(|force| force[1]).sum();
//! assert!((total + 4.0).abs() < 1e-14);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

use crate::basis::{BasisValues, Derivatives};
use crate::project::{Projection, Projector};
use crate::side::Side;
use crate::spline::Spline;

/// The entries of a row of `H`: numbers of control points, or of nodes, and their weights.
pub type Weights = Vec<(usize, f64)>;

/// One row of `H`: the weights of the control points of a patch at a point, and where on the patch that is.
#[derive(Clone, Debug, PartialEq)]
pub struct Row {
    /// Control points with a weight other than zero, in ascending order of the patch's numbering, and their weights: the
    /// basis functions at the projected point, whose sum is one.
    pub weights: Weights,
    /// The side that the point is closest to.
    pub side: Side,
    /// Parameters of the projected point on that side.
    pub xi: Vec<f64>,
    /// Distance between the point and its projection.
    pub distance: f64,
}

/// Projects points to the closest of several sides of a patch and evaluates the basis functions there.
///
/// Where two sides are equally close (at a corner), the one listed first is taken. Control points carry their numbers
/// in the patch, so a corner is the same control point from either side; a point at a corner has one weight,
/// exactly 1.
///
/// # Errors
/// When there are no sides, the patch lacks one of them, a point is not finite, or its distance exceeds `tolerance`.
/// The error names the first such point.
pub fn rows<const D: usize>(
    patch: &Spline<D>,
    sides: &[Side],
    points: &[[f64; D]],
    tolerance: f64,
) -> Result<Vec<Row>, TransferError> {
    if sides.is_empty() {
        return Err(TransferError::NoSides);
    }
    if let Some(&side) = sides.iter().find(|side| !patch.has_side(**side)) {
        return Err(TransferError::NoSuchSide { side, parameters: patch.parameters() });
    }
    let edges: Vec<_> = sides.iter().map(|&side| Edge::new(patch, side)).collect();
    let mut targets: Vec<_> = edges.iter().map(|edge| (edge, Projector::new(&edge.spline))).collect();
    points.iter().enumerate().map(|(index, point)| row(index, point, &mut targets, tolerance)).collect()
}

/// Field at the points, `d = H D`, for `N` components a point.
///
/// # Panics
/// When there are not as many values as rows.
pub fn to_points<const N: usize>(rows: &[Row], control_points: &[[f64; N]], points: &mut [[f64; N]]) {
    assert_eq!(rows.len(), points.len(), "one value for each row");
    for (row, point) in rows.iter().zip(points) {
        *point = [0.0; N];
        for &(a, weight) in &row.weights {
            (0..N).for_each(|c| point[c] += weight * control_points[a][c]);
        }
    }
}

/// Adds the forces at the points to those of the control points, `F += H^T f`, for `N` components a point.
///
/// # Panics
/// When there are not as many values as rows.
pub fn add_to_control_points<const N: usize>(
    rows: &[Row],
    points: &[[f64; N]],
    control_points: &mut [[f64; N]],
) {
    assert_eq!(rows.len(), points.len(), "one value for each row");
    for (row, point) in rows.iter().zip(points) {
        for &(a, weight) in &row.weights {
            (0..N).for_each(|c| control_points[a][c] += weight * point[c]);
        }
    }
}

/// A side and the numbers of its control points in the patch.
struct Edge<const D: usize> {
    side: Side,
    spline: Spline<D>,
    control_points: Vec<usize>,
}

impl<const D: usize> Edge<D> {
    fn new(patch: &Spline<D>, side: Side) -> Self {
        let (spline, control_points) = patch.side(side);
        Self { side, spline, control_points }
    }

    fn row(&self, projection: Projection<D>) -> Row {
        let mut basis = BasisValues::new(&self.spline);
        self.spline.basis(&projection.xi, Derivatives::None, &mut basis);
        let entries = basis.active().iter().zip(basis.values()).filter(|(_, weight)| **weight != 0.0);
        let weights = entries.map(|(&a, &weight)| (self.control_points[a], weight)).collect();
        Row { weights, side: self.side, xi: projection.xi, distance: projection.distance }
    }
}

fn row<const D: usize>(
    index: usize,
    point: &[f64; D],
    targets: &mut [(&Edge<D>, Projector<'_, D>)],
    tolerance: f64,
) -> Result<Row, TransferError> {
    if point.iter().any(|x| !x.is_finite()) {
        return Err(TransferError::NotFinite { index, position: point.to_vec() });
    }
    let projections = targets.iter_mut().map(|(edge, projector)| (edge, projector.closest_point(point)));
    let (edge, nearest) = projections
        .min_by(|(_, a), (_, b)| a.distance.total_cmp(&b.distance))
        .expect("at least one side was given");
    if nearest.distance <= tolerance {
        return Ok(edge.row(nearest));
    }
    let (side, distance) = (edge.side, nearest.distance);
    Err(TransferError::TooFar { index, position: point.to_vec(), side, distance, tolerance })
}

/// Why points cannot be tied to a patch.
#[derive(Clone, Debug, PartialEq, thiserror::Error, miette::Diagnostic)]
pub enum TransferError {
    /// There is nothing to project to.
    #[error("points cannot be projected to no side at all")]
    #[diagnostic(help("name at least one side of the patch"))]
    NoSides,
    /// The patch has too few parameters for a side.
    #[error("a patch of {parameters} parameters has no side `{side}`")]
    #[diagnostic(help(
        "curves have left and right, surfaces also \
             bottom and top, volumes also front and back"
    ))]
    NoSuchSide {
        /// The side asked for.
        side: Side,
        /// Number of parameters of the patch.
        parameters: usize,
    },
    /// A coordinate of a point is infinite or not a number.
    #[error("point {index} at {position:?} is not finite")]
    #[diagnostic(help("look where the points come from"))]
    NotFinite {
        /// Index of the point.
        index: usize,
        /// Its coordinates.
        position: Vec<f64>,
    },
    /// A point lies off all sides.
    #[error(
        "point {index} at {position:?} lies {distance} away from the nearest side `{side}`, which is more than the \
         tolerance of {tolerance} (lengths in the unit of the patch)"
    )]
    #[diagnostic(help(
        "check that points and patch show the same \
         shape, in the same place and unit; if they do, raise the tolerance above {distance}"
    ))]
    TooFar {
        /// Index of the point.
        index: usize,
        /// Its coordinates.
        position: Vec<f64>,
        /// The side that is nearest.
        side: Side,
        /// Distance from it.
        distance: f64,
        /// Largest distance allowed.
        tolerance: f64,
    },
}
