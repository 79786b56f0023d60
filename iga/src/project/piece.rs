//! Pieces of a spline so nearly affine that Newton's method cannot lose its way on them.

use super::Sample;
use crate::basis::BasisValues;
use crate::knots::Knots;
use crate::spline::{MAX_PARAMETERS, Spline};

/// A piece is cut where its first derivatives change by more than this share of their size.
const LARGEST_CHANGE: f64 = 0.5;
/// An element is cut at most this often along each parameter.
const MAX_CUTS: usize = 6;
/// Samples of a piece along each parameter: both ends and the middle.
const SAMPLES: usize = 3;

/// A part of an element, with what decides whether to search it, and from where.
#[derive(Clone, Debug)]
pub(super) struct Piece<const D: usize> {
    /// The part as a spline of one element; its parameters are those of the whole spline.
    pub(super) spline: Spline<D>,
    /// Box round its control points, and so round the piece.
    pub(super) bounds: [[f64; D]; 2],
    samples: Grid<Sample<D>>,
}

/// Cuts a spline into pieces.
pub(super) fn pieces<const D: usize>(spline: &Spline<D>) -> Vec<Piece<D>> {
    let mut basis = BasisValues::new(spline);
    let mut pieces = Vec::new();
    for element in elements(spline) {
        let mut uncut = vec![(element, [0; MAX_PARAMETERS])];
        while let Some((part, mut cuts)) = uncut.pop() {
            if let Some(parameter) = worst_parameter(&part, cuts) {
                cuts[parameter] += 1;
                uncut.extend(halves(&part, parameter).map(|half| (half, cuts)));
            } else {
                pieces.push(Piece::new(part, &mut basis));
            }
        }
    }
    pieces
}

/// Each element as a spline of its own.
fn elements<const D: usize>(spline: &Spline<D>) -> Vec<Spline<D>> {
    let mut parts = vec![spline.clone()];
    for (i, knots) in spline.knots().iter().enumerate() {
        let slices = |part: &Spline<D>| -> Vec<Spline<D>> {
            (0..knots.element_count()).map(|e| part.restricted(i, knots.element(e))).collect()
        };
        parts = parts.iter().flat_map(slices).collect();
    }
    parts
}

impl<const D: usize> Piece<D> {
    fn new(spline: Spline<D>, basis: &mut BasisValues) -> Self {
        let samples =
            Grid::new(spline.degrees().map(|degree| if degree == 0 { 1 } else { SAMPLES }), |position| {
                let mut xi = [0.0; MAX_PARAMETERS];
                for (i, knots) in spline.knots().iter().enumerate() {
                    let [start, end] = knots.domain();
                    xi[i] = [start, 0.5 * (start + end), end][position[i]];
                }
                Sample::at(&spline, xi, basis)
            });
        Self { bounds: spline.bounding_box(), spline, samples }
    }

    /// Samples none of whose neighbours is closer to `point`.
    pub(super) fn local_minima(&self, point: &[f64; D]) -> impl Iterator<Item = Sample<D>> {
        let squares: Vec<f64> =
            self.samples.entries.iter().map(|sample| sample.square_distance(point)).collect();
        let is_minimum =
            move |index: &usize| self.samples.neighbours(*index).all(|n| squares[*index] <= squares[n]);
        (0..self.samples.entries.len()).filter(is_minimum).map(|index| self.samples.entries[index])
    }
}

fn halves<const D: usize>(part: &Spline<D>, parameter: usize) -> [Spline<D>; 2] {
    let [start, end] = part.knots()[parameter].domain();
    let middle = 0.5 * (start + end);
    [[start, middle], [middle, end]].map(|range| part.restricted(parameter, range))
}

/// Whether there is a number between the ends of a parameter.
fn has_middle(knots: &Knots) -> bool {
    let [start, end] = knots.domain();
    let middle = 0.5 * (start + end);
    start < middle && middle < end
}

/// The parameter along which a one-element spline is farthest from affine, if that is worth a cut.
fn worst_parameter<const D: usize>(part: &Spline<D>, cuts: [usize; MAX_PARAMETERS]) -> Option<usize> {
    let points = Grid { shape: part.shape(), entries: part.control_points().to_vec() };
    let change = |j: usize| {
        let derivatives = (0..part.parameters()).map(|i| points.differences(i));
        derivatives.map(|first| first.relative_change(j)).fold(0.0, f64::max)
    };
    let changes: Vec<f64> = (0..part.parameters()).map(change).collect();
    let can_cut = |i: usize| cuts[i] < MAX_CUTS && has_middle(&part.knots()[i]);
    let worth_it = (0..changes.len()).filter(|&i| changes[i] > LARGEST_CHANGE && can_cut(i));
    worth_it.max_by(|&i, &j| changes[i].total_cmp(&changes[j]))
}

/// One entry for each point of a grid, along the first parameter first.
#[derive(Clone, Debug)]
struct Grid<T> {
    shape: [usize; MAX_PARAMETERS],
    entries: Vec<T>,
}

impl<T> Grid<T> {
    fn new(shape: [usize; MAX_PARAMETERS], entry: impl FnMut([usize; MAX_PARAMETERS]) -> T) -> Self {
        let position = |index| [index % shape[0], index / shape[0] % shape[1], index / (shape[0] * shape[1])];
        let entries = (0..shape.iter().product()).map(position).map(entry).collect();
        Self { shape, entries }
    }

    fn stride(&self, parameter: usize) -> usize {
        self.shape[..parameter].iter().product()
    }

    fn position(&self, index: usize, parameter: usize) -> usize {
        index / self.stride(parameter) % self.shape[parameter]
    }

    /// The entries before and after this one along each parameter.
    fn neighbours(&self, index: usize) -> impl Iterator<Item = usize> {
        (0..MAX_PARAMETERS).flat_map(move |i| {
            let position = self.position(index, i);
            let before = (position > 0).then(|| index - self.stride(i));
            let after = (position + 1 < self.shape[i]).then(|| index + self.stride(i));
            before.into_iter().chain(after)
        })
    }
}

impl<const N: usize> Grid<[f64; N]> {
    /// Differences between each entry and the next along a parameter.
    fn differences(&self, parameter: usize) -> Self {
        let mut shape = self.shape;
        shape[parameter] -= 1;
        let stride = self.stride(parameter);
        let starts = (0..self.entries.len()).filter(|&a| self.position(a, parameter) < shape[parameter]);
        let difference = |a: usize| std::array::from_fn(|c| self.entries[a + stride][c] - self.entries[a][c]);
        Self { shape, entries: starts.map(difference).collect() }
    }

    /// Largest change from one end of a parameter to the other, as a share of the mean; infinite when that vanishes.
    fn relative_change(&self, parameter: usize) -> f64 {
        if self.shape[parameter] < 2 {
            return 0.0;
        }
        let steps = (self.shape[parameter] - 1) as f64;
        let largest = self.differences(parameter).entries.iter().map(norm).fold(0.0, f64::max);
        let sum: [f64; N] = std::array::from_fn(|c| self.entries.iter().map(|entry| entry[c]).sum::<f64>());
        // 0/0 is no change.
        (steps * largest * self.entries.len() as f64 / norm(&sum)).max(0.0)
    }
}

fn norm<const N: usize>(vector: &[f64; N]) -> f64 {
    vector.iter().map(|x| x * x).sum::<f64>().sqrt()
}
