//! Sides that cross.

use super::Contact;
use crate::seam::Seams;
use crate::side::{End, Side};
use crate::spline::Spline;

/// Chords of a curved element.
const CHORDS: usize = 8;
/// Sine of the angle between two chords from which a crossing is one of the curves, too.
const STEEP: f64 = 0.5;
/// The direction in which chords are swept: sides along the axes do not pile up in it.
const SWEEP: [f64; 2] = [0.8, 0.6];

/// A chord of a side.
#[derive(Clone, Copy)]
struct Chord {
    ends: [[f64; 2]; 2],
    side: usize,
    index: usize,
    /// Whether it meets the first chord of its side.
    closes: bool,
}

impl Chord {
    fn range(&self) -> [f64; 2] {
        let [a, b] = self.ends.map(|[x, y]| SWEEP[0] * x + SWEEP[1] * y);
        [a.min(b), a.max(b)]
    }

    fn direction(&self) -> [f64; 2] {
        let [a, b] = self.ends;
        [b[0] - a[0], b[1] - a[1]]
    }
}

/// The first crossing of plane sides in the order of the sweep.
pub(super) fn find<const D: usize>(
    edges: &[(Side, Spline<D>)],
    seams: &Seams,
    touch: f64,
) -> Option<Contact<D>> {
    if D != 2 {
        return None;
    }
    let mut chords: Vec<Chord> = edges
        .iter()
        .enumerate()
        .flat_map(|(side, (of, edge))| chords_of(side, edge, seams.is_loop(*of)))
        .collect();
    chords.sort_by(|a, b| a.range()[0].total_cmp(&b.range()[0]));
    for (i, chord) in chords.iter().enumerate() {
        let end = chord.range()[1];
        for other in chords[i + 1..].iter().take_while(|other| other.range()[0] <= end) {
            if are_neighbours(chord, other, touch) {
                continue;
            }
            if let Some(place) = crossing(chord, other) {
                let sides = [edges[chord.side].0, edges[other.side].0];
                return Some(Contact { sides, place: std::array::from_fn(|c| place[c]), crosses: true });
            }
        }
    }
    None
}

fn chords_of<const D: usize>(side: usize, edge: &Spline<D>, is_loop: bool) -> Vec<Chord> {
    let knots = &edge.knots()[0];
    let cuts = if knots.degree() == 1 { 1 } else { CHORDS };
    let mut places: Vec<[f64; 2]> = Vec::new();
    let mut push = |xi: f64| {
        let point = edge.point(&[xi]);
        places.push([point[0], point[1]]);
    };
    for element in edge.elements() {
        (0..cuts).for_each(|i| push(element.at([i as f64 / cuts as f64])[0]));
    }
    push(knots.end(End::End));
    let last = places.len() - 2;
    let chord = |(index, ends): (usize, &[[f64; 2]])| Chord {
        ends: [ends[0], ends[1]],
        side,
        index,
        closes: is_loop && index == last,
    };
    places.windows(2).enumerate().map(chord).collect()
}

/// Whether two chords meet in an end.
fn are_neighbours(a: &Chord, b: &Chord, touch: f64) -> bool {
    if a.side == b.side {
        let closes = (a.closes && b.index == 0) || (b.closes && a.index == 0);
        return closes || a.index.abs_diff(b.index) <= 1;
    }
    let near = |p: [f64; 2], q: [f64; 2]| (p[0] - q[0]).hypot(p[1] - q[1]) <= touch;
    a.ends.iter().any(|p| b.ends.iter().any(|q| near(*p, *q)))
}

/// Where two chords cross inside of both, at a steep angle.
fn crossing(a: &Chord, b: &Chord) -> Option<[f64; 2]> {
    let cross = |u: [f64; 2], v: [f64; 2]| u[0] * v[1] - u[1] * v[0];
    let length = |u: [f64; 2]| u[0].hypot(u[1]);
    let (u, v) = (a.direction(), b.direction());
    let sine = cross(u, v);
    if sine.is_nan() || sine.abs() < STEEP * length(u) * length(v) || sine == 0.0 {
        return None;
    }
    let from = [b.ends[0][0] - a.ends[0][0], b.ends[0][1] - a.ends[0][1]];
    let (s, t) = (cross(from, v) / sine, cross(from, u) / sine);
    let inside = |share: f64| 0.0 < share && share < 1.0;
    (inside(s) && inside(t)).then(|| [a.ends[0][0] + s * u[0], a.ends[0][1] + s * u[1]])
}
