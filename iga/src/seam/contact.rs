//! Sides that touch or cross without being joined.

mod crossing;

use std::fmt;

use super::{GAP, Seams, TOUCH, length, opposite, size};
use crate::project::Projector;
use crate::side::Side;
use crate::spline::Spline;

/// Places at which a side is compared with the others.
const SAMPLES: usize = 33;
/// Samples near a corner that may lie on the next side.
const CORNER: usize = 1;

/// Finds two sides of a patch that touch along a stretch without being joined, where nothing holds them together, or that
/// cross, where the patch overlaps itself.
///
/// Looks for contact at 33 places of each side, so that one shorter than a sixteenth of a side may be missed; sides that
/// touch in a point are none. Looks for crossings between chords of the elements, and takes only those above 30 degrees,
/// which no curvature between the chords explains.
#[must_use]
pub fn contact<const D: usize>(patch: &Spline<D>, seams: &Seams) -> Option<Contact<D>> {
    // The two sides of a foil do not touch.
    let thin =
        (0..patch.parameters()).map(|parameter| length(patch, parameter)).fold(f64::INFINITY, f64::min);
    let touch = (TOUCH * size(patch)).min(GAP * thin);
    let free = |side: &Side| seams.partner(*side).is_none() && !seams.points().contains(side);
    let edges: Vec<(Side, Spline<D>)> = patch.sides().filter(free).map(|s| (s, patch.side(s).0)).collect();
    // Surfaces of volumes are left alone.
    if edges.iter().any(|(_, edge)| edge.parameters() != 1) {
        return None;
    }
    touching(&edges, touch).or_else(|| crossing::find(&edges, seams, touch))
}

fn touching<const D: usize>(edges: &[(Side, Spline<D>)], touch: f64) -> Option<Contact<D>> {
    for (side, edge) in edges {
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
                return Some(Contact { sides: [*side, *other], place: *on[on.len() / 2], crosses: false });
            }
        }
    }
    None
}

/// Two sides that touch or cross.
#[derive(Clone, Debug, PartialEq)]
pub struct Contact<const D: usize> {
    /// The sides.
    pub sides: [Side; 2],
    /// A place that belongs to both.
    pub place: [f64; D],
    /// Whether they cross.
    pub crosses: bool,
}

impl<const D: usize> Contact<D> {
    /// What to do about it.
    #[must_use]
    pub fn remedy(&self) -> &'static str {
        let [side, other] = self.sides;
        if self.crosses {
            "two parts of a structure cannot fill one place: lead the shape past itself"
        } else if side == opposite(other) {
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
        let place = &self.place;
        match (self.crosses, side == other) {
            (false, _) => write!(f, "the sides `{side}` and `{other}` of the patch touch near {place:.6?}"),
            (true, false) => write!(
                f,
                "the patch overlaps itself: its sides `{side}` and `{other}` cross near {place:.6?}"
            ),
            (true, true) => {
                write!(f, "the patch overlaps itself: its side `{side}` crosses itself near {place:.6?}")
            }
        }
    }
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
