//! Closest points.

mod newton;
mod piece;

use crate::basis::{BasisValues, Derivatives};
use crate::spline::{MAX_PARAMETERS, Spline};
use newton::Search;
use piece::Piece;

/// The point of a spline that is closest to a given one.
#[derive(Clone, Debug, PartialEq)]
pub struct Projection<const D: usize> {
    /// Its parameters.
    pub xi: Vec<f64>,
    /// Its position.
    pub point: [f64; D],
    /// How far away it is.
    pub distance: f64,
}

/// The point of `spline` that is closest to `point`: [`Projector`] for a single point.
///
/// # Panics
/// When a coordinate is not finite.
///
/// ```
/// use partita_iga::{build, project};
///
/// let ring = build::quarter_annulus(1.0, 1.5)?;
/// let projection = project::closest_point(&ring, &[2.0, 2.0]);
/// assert!((projection.distance - (8f64.sqrt() - 1.5)).abs() < 1e-14);
/// assert_eq!(projection.xi[0], 1.0); // on the outer arc, to the last bit
/// assert!((projection.xi[1] - 0.5).abs() < 1e-14);
/// # Ok::<(), build::BuildError>(())
/// ```
#[must_use]
pub fn closest_point<const D: usize>(spline: &Spline<D>, point: &[f64; D]) -> Projection<D> {
    Projector::new(spline).closest_point(point)
}

/// Finds the closest points of one spline to many points.
///
/// The spline is cut once into pieces that are nearly affine. Each lies in the box round its control points (the weights
/// are positive), so a piece whose box is farther away than the best point found cannot hold a better one.
/// In the others Newton's method, kept inside the piece, starts from every local minimum of a few samples. Where
/// several points are equally close, the one found first is returned, always the same.
///
/// This is a search, not a proof. It has found the closest point of thousands of arbitrary curves and surfaces with
/// weights from 0.3 to 3; where weights differ by powers of ten, or the spline folds within 1/64 of an element, a point
/// a little closer may be missed.
///
/// Ends are exact: a point that projects to the end of a parameter gets that end to the last bit, also when round-off
/// (1e-10 of the parameter's range) says otherwise.
#[derive(Clone, Debug)]
pub struct Projector<'a, const D: usize> {
    spline: &'a Spline<D>,
    pieces: Vec<Piece<D>>,
    basis: BasisValues,
}

/// A point of the spline with its parameters; unused ones are zero.
#[derive(Clone, Copy, Debug)]
struct Sample<const D: usize> {
    xi: [f64; MAX_PARAMETERS],
    point: [f64; D],
}

impl<'a, const D: usize> Projector<'a, D> {
    /// Cuts the spline into pieces.
    #[must_use]
    pub fn new(spline: &'a Spline<D>) -> Self {
        Self { spline, pieces: piece::pieces(spline), basis: BasisValues::new(spline) }
    }

    /// The closest point of the spline to `point`.
    ///
    /// # Panics
    /// When a coordinate is not finite.
    #[must_use]
    pub fn closest_point(&mut self, point: &[f64; D]) -> Projection<D> {
        assert!(point.iter().all(|x| x.is_finite()), "the point {point:?} to be projected is not finite");
        let mut nearest_first: Vec<_> =
            self.pieces.iter().map(|piece| (square_to_box(point, &piece.bounds), piece)).collect();
        nearest_first.sort_by(|(a, _), (b, _)| a.total_cmp(b));

        let mut best: Option<(f64, Sample<D>)> = None;
        for (bound, piece) in nearest_first {
            if best.is_some_and(|(square, _)| square < bound) {
                break;
            }
            for start in piece.local_minima(point) {
                let found = Search::new(&piece.spline, self.spline, *point, &mut self.basis).descend(start);
                // A piece is the spline up to round-off; the answer is on the spline itself.
                let found = Sample::at(self.spline, found.xi, &mut self.basis);
                let square = found.square_distance(point);
                if best.is_none_or(|(least, _)| square < least) {
                    best = Some((square, found));
                }
            }
        }
        let (square, found) = best.expect("a spline has a piece, and its samples a smallest distance");
        let xi = found.xi[..self.spline.parameters()].to_vec();
        Projection { xi, point: found.point, distance: square.sqrt() }
    }
}

impl<const D: usize> Sample<D> {
    fn at(spline: &Spline<D>, xi: [f64; MAX_PARAMETERS], basis: &mut BasisValues) -> Self {
        spline.basis(&xi[..spline.parameters()], Derivatives::None, basis);
        Self { xi, point: basis.value_of(spline.control_points()) }
    }

    fn square_distance(&self, point: &[f64; D]) -> f64 {
        (0..D).map(|c| (self.point[c] - point[c]).powi(2)).sum()
    }
}

fn square_to_box<const D: usize>(point: &[f64; D], [low, high]: &[[f64; D]; 2]) -> f64 {
    (0..D).map(|c| (point[c] - point[c].clamp(low[c], high[c])).powi(2)).sum()
}
