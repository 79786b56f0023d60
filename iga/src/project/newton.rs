//! Newton's method for the closest point of one piece, between the piece's bounds.

use super::Sample;
use crate::basis::{BasisValues, Derivatives};
use crate::knots::Knots;
use crate::nurbs::{Gradient, Hessian};
use crate::spline::{MAX_PARAMETERS, Spline};

/// An end of the spline is left only for a minimum that is farther away than this share of the parameter's range:
/// a point that misses a corner by round-off belongs to the corner.
const STICKINESS: f64 = 1e-10;
/// A step this small, as a share of the piece, changes nothing.
const SMALLEST_STEP: f64 = 1e-15;
/// Below this share of the piece, steps that no longer shrink are round-off.
const SMALL_STEP: f64 = 1e-8;
const MAX_ITERATIONS: usize = 60;
const MAX_HALVINGS: i32 = 20;

/// The search for the point of one piece that is closest to `target`.
pub(super) struct Search<'a, const D: usize> {
    piece: &'a Spline<D>,
    /// The spline that the piece is part of.
    whole: &'a Spline<D>,
    target: [f64; D],
    basis: &'a mut BasisValues,
}

/// `|x - q|^2 / 2` to second order.
struct Model {
    gradient: Gradient,
    hessian: Hessian,
    /// The Hessian without curvature, `x_,i . x_,j`: positive semidefinite everywhere.
    metric: Hessian,
}

impl<'a, const D: usize> Search<'a, D> {
    pub(super) fn new(
        piece: &'a Spline<D>,
        whole: &'a Spline<D>,
        target: [f64; D],
        basis: &'a mut BasisValues,
    ) -> Self {
        Self { piece, whole, target, basis }
    }

    /// Goes from `at` to a local minimum of the distance.
    pub(super) fn descend(&mut self, mut at: Sample<D>) -> Sample<D> {
        let mut previous = f64::INFINITY;
        for _ in 0..MAX_ITERATIONS {
            let model = self.model(&at);
            let held = self.held(&at, &model);
            let step = model.newton_step(held);
            let size = self.relative_size(&step);
            if size < SMALLEST_STEP || (size < SMALL_STEP && size > 0.5 * previous) {
                break;
            }
            previous = size;
            let Some(next) = self.line_search(&at, &step) else { break };
            at = next;
        }
        at
    }

    /// With `r = x - q`: `g_i = x_,i . r`, `H_ij = x_,i . x_,j + x_,ij . r`.
    fn model(&mut self, at: &Sample<D>) -> Model {
        self.piece.basis(&at.xi[..self.piece.parameters()], Derivatives::Second, self.basis);
        let first = self.basis.first_of(self.piece.control_points());
        let second = self.basis.second_of(self.piece.control_points());
        let r = std::array::from_fn(|c| at.point[c] - self.target[c]);
        let metric: Hessian = matrix(|i, j| dot(&first[i], &first[j]));
        let hessian = matrix(|i, j| metric[i][j] + dot(&second[i][j], &r));
        Model { gradient: std::array::from_fn(|i| dot(&first[i], &r)), hessian, metric }
    }

    /// Which parameters stay: missing ones, and those at a bound beyond which the distance would fall on.
    fn held(&self, at: &Sample<D>, model: &Model) -> [bool; MAX_PARAMETERS] {
        std::array::from_fn(|i| {
            let Some([start, end]) = self.range(i) else { return true };
            let [first, last] = self.whole.knots()[i].domain();
            let sticky = STICKINESS * (last - first) * model.metric[i][i];
            let slope = model.gradient[i];
            let held_at_start = at.xi[i] <= start && -slope <= if start <= first { sticky } else { 0.0 };
            let held_at_end = at.xi[i] >= end && slope <= if end >= last { sticky } else { 0.0 };
            held_at_start || held_at_end
        })
    }

    /// The longest of the steps `step, step/2, step/4, ...`, cut off at the bounds, that leads closer.
    fn line_search(&mut self, at: &Sample<D>, step: &Gradient) -> Option<Sample<D>> {
        let square = at.square_distance(&self.target);
        // Close to the minimum the gain of a full step hides behind the round-off of |x - q|^2.
        let size = at.square_distance(&[0.0; D]).sqrt() + square.sqrt();
        let round_off = 4.0 * f64::EPSILON * size * square.sqrt();
        (0..MAX_HALVINGS).find_map(|halvings| {
            let next = self.moved(at, step, 0.5f64.powi(halvings));
            let gained = square - next.square_distance(&self.target);
            (gained > 0.0 || halvings == 0 && gained >= -round_off).then_some(next)
        })
    }

    fn moved(&mut self, at: &Sample<D>, step: &Gradient, factor: f64) -> Sample<D> {
        let mut xi = at.xi;
        for (i, knots) in self.piece.knots().iter().enumerate() {
            let [start, end] = knots.domain();
            xi[i] = (xi[i] + factor * step[i]).clamp(start, end);
        }
        Sample::at(self.piece, xi, self.basis)
    }

    /// Largest entry of a step as a share of the piece.
    fn relative_size(&self, step: &Gradient) -> f64 {
        let shares = (0..MAX_PARAMETERS)
            .filter_map(|i| self.range(i).map(|[start, end]| step[i].abs() / (end - start)));
        shares.fold(0.0, f64::max)
    }

    fn range(&self, parameter: usize) -> Option<[f64; 2]> {
        self.piece.knots().get(parameter).map(Knots::domain)
    }
}

impl Model {
    /// `-H^-1 g` on the free parameters; with the metric in place of `H` where the distance curves downwards.
    fn newton_step(&self, held: [bool; MAX_PARAMETERS]) -> Gradient {
        let ridge = 1e-12 * (0..MAX_PARAMETERS).map(|i| self.metric[i][i]).sum::<f64>();
        let safe = matrix(|i, j| self.metric[i][j] + if i == j { ridge } else { 0.0 });
        let slope = std::array::from_fn(|i| if held[i] { 0.0 } else { -self.gradient[i] });
        let solve = |hessian| solve_positive(reduced(hessian, held), slope);
        solve(&self.hessian).or_else(|| solve(&safe)).unwrap_or_default()
    }
}

/// The matrix with rows and columns of held parameters replaced by those of the identity.
fn reduced(full: &Hessian, held: [bool; MAX_PARAMETERS]) -> Hessian {
    matrix(|i, j| match (held[i] || held[j], i == j) {
        (false, _) => full[i][j],
        (true, same) => f64::from(u8::from(same)),
    })
}

/// Solves `A x = b` by Cholesky's method; nothing where `A` is not safely positive definite.
fn solve_positive(a: Hessian, mut b: Gradient) -> Option<Gradient> {
    let mut l = Hessian::default();
    for j in 0..MAX_PARAMETERS {
        let pivot = a[j][j] - (0..j).map(|k| l[j][k] * l[j][k]).sum::<f64>();
        if pivot <= 1e-14 * a[j][j].abs() {
            return None;
        }
        l[j][j] = pivot.sqrt();
        for i in j + 1..MAX_PARAMETERS {
            l[i][j] = (a[i][j] - (0..j).map(|k| l[i][k] * l[j][k]).sum::<f64>()) / l[j][j];
        }
    }
    for i in 0..MAX_PARAMETERS {
        b[i] = (b[i] - (0..i).map(|k| l[i][k] * b[k]).sum::<f64>()) / l[i][i];
    }
    for i in (0..MAX_PARAMETERS).rev() {
        b[i] = (b[i] - (i + 1..MAX_PARAMETERS).map(|k| l[k][i] * b[k]).sum::<f64>()) / l[i][i];
    }
    Some(b)
}

fn matrix(entry: impl Fn(usize, usize) -> f64) -> Hessian {
    std::array::from_fn(|i| std::array::from_fn(|j| entry(i, j)))
}

fn dot<const D: usize>(a: &[f64; D], b: &[f64; D]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}
