//! Closest points.

mod newton;

use crate::basis::{BasisValues, Derivatives};
use crate::element::Element;
use crate::spline::{MAX_PARAMETERS, Spline};
use newton::Search;

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
/// Each element lies in the box round its control points (the weights are positive), so an element whose box is
/// farther away than the best point found cannot hold a better one. In the others a Newton method that stays inside
/// the element starts from every local minimum of a grid of samples. Where several points are equally close,
/// the one found first is returned, always the same.
///
/// Ends are exact: a point that projects to the end of a parameter gets that end to the last bit, also when round-off
/// (1e-10 of the parameter's range) says otherwise.
#[derive(Clone, Debug)]
pub struct Projector<'a, const D: usize> {
    spline: &'a Spline<D>,
    candidates: Vec<Candidate<D>>,
    /// Samples of each element along each parameter, 1 for missing ones.
    grid: [usize; MAX_PARAMETERS],
    basis: BasisValues,
}

/// An element and what decides whether to search it, and from where.
#[derive(Clone, Debug)]
struct Candidate<const D: usize> {
    element: Element,
    bounds: [[f64; D]; 2],
    samples: Vec<Sample<D>>,
}

/// A point of the spline with its parameters; unused ones are zero.
#[derive(Clone, Copy, Debug)]
struct Sample<const D: usize> {
    xi: [f64; MAX_PARAMETERS],
    point: [f64; D],
}

impl<'a, const D: usize> Projector<'a, D> {
    /// Samples the spline.
    #[must_use]
    pub fn new(spline: &'a Spline<D>) -> Self {
        let mut basis = BasisValues::new(spline);
        let grid = spline.degrees().map(|degree| 2 * degree + 1);
        let candidates = spline.elements().map(|element| Candidate {
            element,
            bounds: bounding_box(spline, element),
            samples: units(grid).map(|unit| sample(spline, element, unit, &mut basis)).collect(),
        });
        Self { spline, candidates: candidates.collect(), grid, basis }
    }

    /// The closest point of the spline to `point`.
    ///
    /// # Panics
    /// When a coordinate is not finite.
    #[must_use]
    pub fn closest_point(&mut self, point: &[f64; D]) -> Projection<D> {
        assert!(point.iter().all(|x| x.is_finite()), "the point {point:?} to be projected is not finite");
        let mut nearest_first: Vec<_> = self
            .candidates
            .iter()
            .map(|candidate| (square_to_box(point, &candidate.bounds), candidate))
            .collect();
        nearest_first.sort_by(|(a, _), (b, _)| a.total_cmp(b));

        let mut best: Option<(f64, Sample<D>)> = None;
        for (bound, candidate) in nearest_first {
            if best.is_some_and(|(square, _)| square < bound) {
                break;
            }
            let mut search = Search::new(self.spline, candidate.element, *point, &mut self.basis);
            for start in local_minima(candidate, self.grid, point) {
                let found = search.descend(start);
                let square = square_distance(&found.point, point);
                if best.is_none_or(|(least, _)| square < least) {
                    best = Some((square, found));
                }
            }
        }
        let (square, found) = best.expect("a spline has an element, and its samples a smallest distance");
        let xi = found.xi[..self.spline.parameters()].to_vec();
        Projection { xi, point: found.point, distance: square.sqrt() }
    }
}

/// Box round the control points that act on an element.
fn bounding_box<const D: usize>(spline: &Spline<D>, element: Element) -> [[f64; D]; 2] {
    let mut bounds = [[f64::INFINITY; D], [f64::NEG_INFINITY; D]];
    for a in spline.active_on(element.index()) {
        for (c, x) in spline.control_points()[a].iter().enumerate() {
            bounds[0][c] = bounds[0][c].min(*x);
            bounds[1][c] = bounds[1][c].max(*x);
        }
    }
    bounds
}

/// Points of the unit cube on a grid, along the first parameter first.
fn units(grid: [usize; MAX_PARAMETERS]) -> impl Iterator<Item = [f64; MAX_PARAMETERS]> {
    (0..grid.iter().product()).map(move |index| {
        let position = [index % grid[0], index / grid[0] % grid[1], index / (grid[0] * grid[1])];
        std::array::from_fn(|i| match grid[i] {
            1 => 0.0,
            count => position[i] as f64 / (count - 1) as f64,
        })
    })
}

fn sample<const D: usize>(
    spline: &Spline<D>,
    element: Element,
    unit: [f64; MAX_PARAMETERS],
    basis: &mut BasisValues,
) -> Sample<D> {
    let xi = element.padded_at(unit);
    spline.basis_on(element.index(), &xi[..spline.parameters()], Derivatives::None, basis);
    Sample { xi, point: basis.value_of(spline.control_points()) }
}

/// Samples none of whose neighbours on the grid is closer to `point`.
fn local_minima<const D: usize>(
    candidate: &Candidate<D>,
    grid: [usize; MAX_PARAMETERS],
    point: &[f64; D],
) -> Vec<Sample<D>> {
    let squares: Vec<f64> = candidate.samples.iter().map(|s| square_distance(&s.point, point)).collect();
    let strides = [1, grid[0], grid[0] * grid[1]];
    let is_minimum = |index: usize| {
        (0..MAX_PARAMETERS).all(|i| {
            let position = index / strides[i] % grid[i];
            (position == 0 || squares[index] <= squares[index - strides[i]])
                && (position + 1 == grid[i] || squares[index] <= squares[index + strides[i]])
        })
    };
    (0..squares.len()).filter(|&index| is_minimum(index)).map(|index| candidate.samples[index]).collect()
}

fn square_distance<const D: usize>(a: &[f64; D], b: &[f64; D]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b).powi(2)).sum()
}

fn square_to_box<const D: usize>(point: &[f64; D], [low, high]: &[[f64; D]; 2]) -> f64 {
    (0..D).map(|c| (point[c] - point[c].clamp(low[c], high[c])).powi(2)).sum()
}
