//! Sides of a patch that lie on each other, and sides that are a point.
//!
//! A ring is drawn by a patch whose `left` and `right` side are the same line, a disk by one with a side that is its
//! centre. The basis functions do not know: a field with one coefficient for each control point tears there. Fields that
//! use one *node* for all control points at one place of a seam are continuous across it:
//!
//! ```
//! use partita_iga::{Side, build, seam::Seams};
//!
//! let ring = build::annular_sector([0.0; 2], [1.0, 1.5], 0.0, std::f64::consts::TAU, [2, 1], [6, 1])?;
//! let seams = Seams::find(&ring);
//! assert_eq!(seams.partner(Side::LEFT), Some(Side::RIGHT));
//! assert_eq!((ring.control_points().len(), seams.node_count()), (20, 18));
//! assert_eq!(seams.nodes()[0], seams.nodes()[9]);
//! # Ok::<(), build::BuildError>(())
//! ```
//!
//! Across a seam such a field is continuous and no more, as at an inner knot of full multiplicity.

use std::fmt;

use crate::project::Projector;
use crate::side::{End, Side};
use crate::spline::Spline;

/// Places closer than this share of the patch's size are one place: far above round-off, far below any gap that means
/// something.
const TOUCH: f64 = 1e-9;
/// Places at which a side is compared with the others.
const SAMPLES: usize = 33;
/// Samples near a corner that may lie on the next side.
const CORNER: usize = 1;

/// Which sides of a patch are joined, and the node of each control point.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Seams {
    /// Parameters whose two sides are one.
    closed: Vec<usize>,
    points: Vec<Side>,
    nodes: Vec<usize>,
    first_of_node: Vec<usize>,
}

impl Seams {
    /// Finds the seams of a patch: opposite sides with the same control points, and weights in one ratio, and sides whose
    /// control points are all at one place (to 1e-9 of the patch's size).
    #[must_use]
    pub fn find<const D: usize>(patch: &Spline<D>) -> Self {
        let touch = TOUCH * size(patch);
        let mut leaders: Vec<usize> = (0..patch.control_points().len()).collect();
        let mut closed = Vec::new();
        for parameter in 0..patch.parameters() {
            let [start, end] = sides_of(parameter).map(|side| patch.side(side).1);
            if coincide(patch, &start, &end, touch) {
                closed.push(parameter);
                start.iter().zip(&end).for_each(|(&a, &b)| unite(&mut leaders, a, b));
            }
        }
        let mut points = Vec::new();
        // The only control point of a curve's end is no side that has shrunk.
        for side in patch.sides().filter(|_| patch.parameters() > 1) {
            let on_side = patch.side(side).1;
            let first = &patch.control_points()[on_side[0]];
            if on_side.iter().all(|&a| distance(first, &patch.control_points()[a]) <= touch) {
                points.push(side);
                on_side.iter().for_each(|&a| unite(&mut leaders, on_side[0], a));
            }
        }
        let (nodes, first_of_node) = number(&mut leaders);
        Self { closed, points, nodes, first_of_node }
    }

    /// Node of each control point, numbered in the order of the first control points.
    #[must_use]
    pub fn nodes(&self) -> &[usize] {
        &self.nodes
    }

    /// Number of nodes.
    #[must_use]
    pub fn node_count(&self) -> usize {
        self.first_of_node.len()
    }

    /// The first control point of each node.
    #[must_use]
    pub fn control_points(&self) -> &[usize] {
        &self.first_of_node
    }

    /// Whether no two control points share a node.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.node_count() == self.nodes.len()
    }

    /// The side that `side` is joined with; neither is part of the boundary.
    #[must_use]
    pub fn partner(&self, side: Side) -> Option<Side> {
        self.closed.contains(&side.parameter).then(|| opposite(side))
    }

    /// Whether the other parameters' sides close on themselves: the ends of `side` meet along a seam.
    #[must_use]
    pub fn is_loop(&self, side: Side) -> bool {
        self.closed.iter().any(|&parameter| parameter != side.parameter)
    }

    /// Sides that are a point.
    #[must_use]
    pub fn points(&self) -> &[Side] {
        &self.points
    }
}

/// Finds two sides of a patch that touch along a stretch without being joined: nothing holds them together there.
///
/// Looks at 33 places of each side, so that a contact shorter than a sixteenth of a side may be missed; sides that touch in
/// a point are none.
#[must_use]
pub fn contact<const D: usize>(patch: &Spline<D>, seams: &Seams) -> Option<Contact<D>> {
    let touch = TOUCH * size(patch);
    let free = |side: &Side| seams.partner(*side).is_none() && !seams.points().contains(side);
    let edges: Vec<(Side, Spline<D>)> = patch.sides().filter(free).map(|s| (s, patch.side(s).0)).collect();
    // Surfaces of volumes are left alone.
    if edges.iter().any(|(_, edge)| edge.parameters() != 1) {
        return None;
    }
    for (side, edge) in &edges {
        let places = samples(edge);
        for (other, target) in edges.iter().filter(|(other, _)| other != side) {
            let boxes = element_boxes(target);
            let near: Vec<bool> =
                places.iter().map(|place| boxes.iter().any(|b| outside(place, b) <= touch)).collect();
            if !near.iter().skip(CORNER).rev().skip(CORNER).any(|near| *near) {
                continue;
            }
            let mut projector = Projector::new(target);
            let on: Vec<&[f64; D]> = places[CORNER..SAMPLES - CORNER]
                .iter()
                .zip(&near[CORNER..])
                .filter(|(place, near)| **near && projector.closest_point(place).distance <= touch)
                .map(|(place, _)| place)
                .collect();
            if on.len() > 1 {
                return Some(Contact { sides: [*side, *other], place: *on[on.len() / 2] });
            }
        }
    }
    None
}

/// Two sides that touch.
#[derive(Clone, Debug, PartialEq)]
pub struct Contact<const D: usize> {
    /// The sides.
    pub sides: [Side; 2],
    /// A place that belongs to both.
    pub place: [f64; D],
}

impl<const D: usize> Contact<D> {
    /// What to do about it.
    #[must_use]
    pub fn remedy(&self) -> &'static str {
        let [side, other] = self.sides;
        if side == opposite(other) {
            "sides are joined where they have the same control points in the same order and weights in the same ratios: \
             copy those of one side to the other, or leave a gap"
        } else {
            "nothing would hold the two together: only opposite sides with the same control points are joined; draw the \
             shape another way, or leave a gap"
        }
    }
}

impl<const D: usize> fmt::Display for Contact<D> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [side, other] = self.sides;
        write!(f, "the sides `{side}` and `{other}` touch near {:.6?}", self.place)
    }
}

fn sides_of(parameter: usize) -> [Side; 2] {
    [End::Start, End::End].map(|end| Side { parameter, end })
}

fn opposite(side: Side) -> Side {
    let end = match side.end {
        End::Start => End::End,
        End::End => End::Start,
    };
    Side { end, ..side }
}

/// Whether two sides are the same spline: the same places, the same weights up to a factor.
fn coincide<const D: usize>(patch: &Spline<D>, start: &[usize], end: &[usize], touch: f64) -> bool {
    let (points, weights) = (patch.control_points(), patch.weights());
    let factor = weights[end[0]] / weights[start[0]];
    start.iter().zip(end).all(|(&a, &b)| {
        distance(&points[a], &points[b]) <= touch && (weights[b] / weights[a] / factor - 1.0).abs() <= TOUCH
    })
}

fn unite(leaders: &mut [usize], a: usize, b: usize) {
    let (a, b) = (leader(leaders, a), leader(leaders, b));
    leaders[a.max(b)] = a.min(b);
}

/// The smallest control point of the node that `a` belongs to.
fn leader(leaders: &mut [usize], mut a: usize) -> usize {
    while leaders[a] != a {
        leaders[a] = leaders[leaders[a]];
        a = leaders[a];
    }
    a
}

fn number(leaders: &mut [usize]) -> (Vec<usize>, Vec<usize>) {
    let (mut nodes, mut first_of_node) = (Vec::with_capacity(leaders.len()), Vec::new());
    for a in 0..leaders.len() {
        let first = leader(leaders, a);
        if first == a {
            nodes.push(first_of_node.len());
            first_of_node.push(a);
        } else {
            nodes.push(nodes[first]);
        }
    }
    (nodes, first_of_node)
}

fn samples<const D: usize>(edge: &Spline<D>) -> Vec<[f64; D]> {
    let [start, end] = edge.knots()[0].domain();
    let at = |i: usize| i as f64 / (SAMPLES - 1) as f64;
    (0..SAMPLES).map(|i| edge.point(&[((1.0 - at(i)) * start + at(i) * end).clamp(start, end)])).collect()
}

/// Boxes round the control points of each element of a curve.
fn element_boxes<const D: usize>(curve: &Spline<D>) -> Vec<[[f64; D]; 2]> {
    let of_element = |element: usize| {
        let mut bounds = [[f64::INFINITY; D], [f64::NEG_INFINITY; D]];
        for a in curve.active_on(element) {
            for (c, x) in curve.control_points()[a].iter().enumerate() {
                bounds[0][c] = bounds[0][c].min(*x);
                bounds[1][c] = bounds[1][c].max(*x);
            }
        }
        bounds
    };
    (0..curve.element_count()).map(of_element).collect()
}

fn outside<const D: usize>(point: &[f64; D], [low, high]: &[[f64; D]; 2]) -> f64 {
    (0..D).map(|c| (point[c] - point[c].clamp(low[c], high[c])).abs()).fold(0.0, f64::max)
}

fn size<const D: usize>(patch: &Spline<D>) -> f64 {
    let [low, high] = patch.bounding_box();
    distance(&low, &high)
}

fn distance<const D: usize>(a: &[f64; D], b: &[f64; D]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b).powi(2)).sum::<f64>().sqrt()
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use super::*;
    use crate::{Knots, build};

    fn ring(sweep: f64) -> Spline<2> {
        build::annular_sector([0.3, -0.2], [1.0, 1.5], 0.7, sweep, [2, 2], [7, 2]).unwrap()
    }

    #[test]
    fn a_full_turn_is_closed_and_a_gap_that_means_something_is_not() {
        for sweep in [TAU, -TAU, TAU * (1.0 - 1e-11)] {
            let seams = Seams::find(&ring(sweep));
            assert_eq!(seams.partner(Side::RIGHT), Some(Side::LEFT), "{sweep}");
            assert_eq!(seams.partner(Side::TOP), None);
            assert!(seams.is_loop(Side::TOP) && !seams.is_loop(Side::LEFT));
        }
        for sweep in [TAU * (1.0 - 1e-4), 3.0] {
            assert!(Seams::find(&ring(sweep)).is_empty());
            assert_eq!(contact(&ring(sweep), &Seams::find(&ring(sweep))), None);
        }
    }

    #[test]
    fn both_ends_of_the_second_parameter_can_be_the_seam() {
        let quarter_turned = |patch: &Spline<2>| {
            let [n, m] = [patch.shape()[0], patch.shape()[1]];
            // x(eta, 1 - xi): still right-handed.
            let order: Vec<usize> = (0..n).rev().flat_map(|i| (0..m).map(move |j| j * n + i)).collect();
            let knots = vec![patch.knots()[1].clone(), patch.knots()[0].clone()];
            let points = order.iter().map(|&a| patch.control_points()[a]).collect();
            Spline::rational(knots, points, order.iter().map(|&a| patch.weights()[a]).collect()).unwrap()
        };
        let seams = Seams::find(&quarter_turned(&build_even()));
        assert_eq!(seams.partner(Side::BOTTOM), Some(Side::TOP));
        assert!(seams.is_loop(Side::LEFT));
    }

    /// Joints at halves, so that mirrored knots are the same.
    fn build_even() -> Spline<2> {
        build::annular_sector([0.0; 2], [1.0, 1.5], 0.0, TAU, [2, 1], [4, 1]).unwrap()
    }

    #[test]
    fn a_side_that_is_a_point_has_one_node() {
        let knots = vec![Knots::uniform(1, 2).unwrap(), Knots::uniform(1, 1).unwrap()];
        let fan = vec![[0.0, 0.0], [0.0, 0.0], [0.0, 0.0], [-1.0, -1.0], [0.0, -1.5], [1.0, -1.0]];
        let fan: Vec<[f64; 2]> = fan.into_iter().map(|[x, y]: [f64; 2]| [x, -y]).rev().collect();
        let patch = Spline::new(knots, fan).unwrap();
        let seams = Seams::find(&patch);
        assert_eq!(seams.points(), [Side::TOP]);
        assert_eq!(seams.nodes(), [0, 1, 2, 3, 3, 3]);
        assert_eq!(contact(&patch, &seams), None);
    }

    #[test]
    fn sides_that_touch_otherwise_are_named() {
        // A slit square whose left side lies on its bottom, drawn round the origin.
        let knots = vec![Knots::uniform(2, 1).unwrap(), Knots::uniform(2, 1).unwrap()];
        let folded = vec![
            [0.0, 0.0],
            [0.5, 0.0],
            [1.0, 0.0],
            [0.5, 0.0],
            [-0.5, 1.0],
            [0.0, 1.5],
            [1.0, 0.0],
            [0.0, -1.5],
            [-1.5, 0.0],
        ];
        let patch = Spline::new(knots, folded).unwrap();
        let found = contact(&patch, &Seams::find(&patch)).expect("a contact");
        assert_eq!(found.sides, [Side::LEFT, Side::BOTTOM]);
        assert!(found.place[1].abs() < 1e-12, "{found}");
        // The end of a strip on another side of it: a 6 with corners.
        let knots = vec![Knots::uniform(1, 5).unwrap(), Knots::uniform(1, 1).unwrap()];
        let outer = [[0.0, 3.0], [0.0, 0.0], [2.0, 0.0], [2.0, 2.0], [1.0, 2.0], [0.5, 2.0]];
        let inner = [[0.5, 3.0], [0.5, 0.5], [1.5, 0.5], [1.5, 1.5], [1.0, 1.5], [0.5, 1.5]];
        let patch = Spline::new(knots, [outer, inner].concat()).unwrap();
        let found = contact(&patch, &Seams::find(&patch)).expect("a contact");
        assert_eq!(found.sides, [Side::RIGHT, Side::TOP]);
    }

    #[test]
    fn a_rectangle_has_neither() {
        let patch = build::rectangle([0.0; 2], [1.0, 0.01], [2, 2], [40, 1]).unwrap();
        let seams = Seams::find(&patch);
        assert!(seams.is_empty());
        assert_eq!(contact(&patch, &seams), None);
    }

    #[test]
    fn weights_in_another_ratio_are_touching_sides_but_no_seam() {
        let closed = build_even();
        let mut weights = closed.weights().to_vec();
        let last = weights.len() - 1;
        weights[last] *= 2.0;
        let other =
            Spline::rational(closed.knots().to_vec(), closed.control_points().to_vec(), weights).unwrap();
        let seams = Seams::find(&other);
        assert!(seams.is_empty());
        assert_eq!(contact(&other, &seams).expect("a contact").sides, [Side::LEFT, Side::RIGHT]);
    }
}
