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

mod contact;

use crate::side::{End, Side};
use crate::spline::Spline;

/// Places closer than this share of the patch's size are one place: far above round-off, far below any gap that means
/// something.
const TOUCH: f64 = 1e-9;
/// A gap larger than this share of the way from one side to the other, across the patch, is meant.
const GAP: f64 = 1e-3;

pub use contact::{Contact, contact};

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
            // A thin plate is no ring.
            let touch = touch.min(GAP * length(patch, parameter));
            if coincide(patch, &start, &end, touch) {
                closed.push(parameter);
                start.iter().zip(&end).for_each(|(&a, &b)| unite(&mut leaders, a, b));
            }
        }
        let mut points = Vec::new();
        // The only control point of a curve's end is no side that has shrunk.
        for side in patch.sides().filter(|_| patch.parameters() > 1) {
            let on_side = patch.side(side).1;
            // Nor is the end of a thin plate a point: all lines along it are as short.
            let along = (0..patch.parameters()).filter(|parameter| *parameter != side.parameter);
            let longest = along.map(|parameter| length(patch, parameter)).fold(0.0, f64::max);
            let touch = touch.min(GAP * longest);
            let first = &patch.control_points()[on_side[0]];
            if on_side.iter().all(|&a| distance(first, &patch.control_points()[a]) <= touch) {
                points.push(side);
                for &a in &on_side {
                    unite(&mut leaders, on_side[0], a);
                }
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

/// The first parameter whose two sides almost touch, and the largest gap between them: a ring that was not quite closed.
/// Nothing holds the sides together there.
#[must_use]
pub fn narrow_gap<const D: usize>(patch: &Spline<D>, seams: &Seams) -> Option<(usize, f64)> {
    let gap = |parameter: usize| {
        let [start, end] = sides_of(parameter).map(|side| patch.side(side).1);
        let gaps = start.iter().zip(&end).map(|(&a, &b)| {
            let [a, b] = [a, b].map(|index| &patch.control_points()[index]);
            distance(a, b)
        });
        gaps.fold(0.0, f64::max)
    };
    let open = (0..patch.parameters()).filter(|parameter| !seams.closed.contains(parameter));
    open.map(|parameter| (parameter, gap(parameter)))
        .find(|(parameter, gap)| *gap <= GAP * length(patch, *parameter))
}

/// The longest way along a parameter, over its control points.
fn length<const D: usize>(patch: &Spline<D>, parameter: usize) -> f64 {
    let shape = patch.shape();
    let stride: usize = shape[..parameter].iter().product();
    let points = patch.control_points();
    let starts = (0..points.len()).filter(|a| (a / stride).is_multiple_of(shape[parameter]));
    let along = |start: usize| {
        let line = (0..shape[parameter] - 1).map(|i| start + i * stride);
        line.map(|a| distance(&points[a], &points[a + stride])).sum::<f64>()
    };
    starts.map(along).fold(0.0, f64::max)
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
            let seams = Seams::find(&ring(sweep));
            assert!(seams.is_empty());
            assert_eq!(narrow_gap(&ring(sweep), &seams).is_some(), sweep > 3.0, "{sweep}");
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
        assert_eq!((contact(&patch, &seams), narrow_gap(&patch, &seams)), (None, None));
        let foil = build::rectangle([0.0; 2], [1.0, 1e-10], [2, 2], [4, 1]).unwrap();
        let seams = Seams::find(&foil);
        assert!(seams.is_empty());
        assert_eq!((contact(&foil, &seams), narrow_gap(&foil, &seams)), (None, None));
    }

    #[test]
    fn a_strip_that_crosses_itself_is_named() {
        let strip = |points: &[[f64; 2]]| {
            let (curve, _) = crate::fit::through(points, 3).unwrap();
            build::strip(&curve, 0.1, build::Alignment::Middle, [2, 1], [20, 1]).unwrap()
        };
        let found = |patch: &Spline<2>| contact(patch, &Seams::find(patch));
        let loops = [[1.0, 0.5], [0.5, 0.3], [0.0, 0.0], [-0.5, -0.4], [-1.0, 0.0], [-0.5, 0.4], [0.0, 0.0]];
        let open = strip(&loops[..6]);
        assert_eq!(found(&open), None);
        let crossed = strip(&[&loops[..], &[[0.5, -0.3], [1.0, -0.5]]].concat());
        let Some(Contact { crosses: true, place: [x, y], .. }) = found(&crossed) else {
            panic!("no crossing")
        };
        assert!(x.hypot(y) < 0.2, "({x}, {y})");
        // Windings that lie close to each other do not.
        let angle = |i: i32| f64::from(i) * 0.5;
        let spiral: Vec<[f64; 2]> = (0..60)
            .map(|i| [(1.0 + 0.02 * angle(i)) * angle(i).cos(), (1.0 + 0.02 * angle(i)) * angle(i).sin()])
            .collect();
        let (curve, _) = crate::fit::through(&spiral, 3).unwrap();
        let coil = build::strip(&curve, 0.12, build::Alignment::Middle, [2, 1], [60, 1]).unwrap();
        assert_eq!(found(&coil), None);
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
