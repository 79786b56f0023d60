//! Transfer by a dual mortar method: loads of constant traction are exact for any two resolutions.
//!
//! Interpolation, `d_i = d(x_i)`, returns loads by a trapezoidal rule: with the nodal forces `f_i = t m_i` of a constant
//! traction t, `H^T f` puts `t sum_i m_i R_a(xi_i)` on point a in place of the consistent load `t integral R_a`. A mortar
//! method asks for equal displacements in the mean instead, against multipliers `psi_i` on the facets of the first field:
//!
//! ```text
//! integral psi_i sum_j N_j d_j = integral psi_i d(x),    d(x) = sum_a R_a(xi(x)) D_a    for every inner node i
//! ```
//!
//! with the linear shape functions `N_j` of the facets. The multipliers are dual to them, `integral psi_i N_j = 0` for
//! inner nodes `i != j`, so that every row stands alone:
//!
//! | facet (s from 0 at a to 1 at b)   | `psi_a`   | `psi_b`   |
//! |-----------------------------------|-----------|-----------|
//! | between two inner nodes           | 2 - 3 s   | 3 s - 1   |
//! | between an inner node and an end  | 1 at the inner node   |  |
//! | between two ends                  | no multiplier         |  |
//!
//! Ends are the nodes where a chain of facets starts or stops, its sharp corners, and the corners that the caller
//! names; they are interpolated, so that the fields meet there exactly. With `m_i = integral N_i`, the row of an inner node is
//!
//! ```text
//! H_ia = (integral psi_i R_a - sum over its end neighbours e of h_e/2 R_a(xi_e)) / m_i
//! ```
//!
//! Properties, for any two resolutions:
//!
//! * rows sum to one, as `sum_a R_a = 1`: translations and the total force are kept, and virtual work by the transpose;
//! * `sum_i m_i H_ia = integral R_a`, as the multipliers sum to one: the load of a constant traction is consistent
//!   (patch test). A chain of one facet has no inner node and is interpolated;
//! * where the nodes of both fields coincide and the second field is linear between them, H is the identity;
//! * displacements linear in x are kept, and so is the moment, where facets lie on the second field's boundary. Where
//!   chords cut off a curved boundary both hold to second order in their length, as does the boundary itself.
//!
//! Nothing is solved for. Sources: B. I. Wohlmuth, *A mortar finite element method using dual spaces for the Lagrange
//! multiplier*, SIAM J. Numer. Anal. 38 (2000), sections 2 and 3 (dual basis, constant beside ends); T. Klöppel, A. Popp, U.
//! Küttler, W. A. Wall, *Fluid-structure interaction for non-conforming interfaces based on a dual mortar formulation*,
//! Comput. Methods Appl. Mech. Eng. 200 (2011).

use std::collections::BTreeMap;

/// Cosine of the angle between neighbouring facets beyond which the node between them is an end: 45 degrees. The margin
/// decides for an octagon, which stands for a circle.
const SHARP: f64 = std::f64::consts::FRAC_1_SQRT_2 - 1e-9;

/// Breakpoints this close to each other or to a node, as part of the facet, do not cut it.
const APART: f64 = 1e-9;

/// Breakpoints this far from a facet, as part of its length, belong to another place of the boundary.
const REACH: f64 = 0.5;

/// Weights this small are round-off beside a sum of one.
const NO_WEIGHT: f64 = 1e-15;

/// The facets of the first field's interface in a plane: lines between its points.
#[derive(Debug, Clone, PartialEq)]
pub struct Mortar<const D: usize> {
    points: Vec<[f64; D]>,
    facets: Vec<[usize; 2]>,
    is_end: Vec<bool>,
}

/// The quadrature points of one facet.
#[derive(Debug, Clone, PartialEq)]
pub struct Samples<const D: usize> {
    /// Places of the nodes of the facet `[m]`.
    pub ends: [[f64; D]; 2],
    /// Places of the quadrature points `[m]`.
    pub points: Vec<[f64; D]>,
    /// Coordinate s in (0, 1) along the facet and weight of each; the weights sum to the facet's length `[m]`.
    rule: Vec<(f64, f64)>,
}

impl<const D: usize> Mortar<D> {
    /// The interface with `points` `[m]` and `facets` between them; `is_corner` names points that are ends, one flag each.
    ///
    /// # Panics
    /// When there is not one flag per point, or a facet names a point that does not exist.
    #[must_use]
    pub fn new(points: Vec<[f64; D]>, facets: Vec<[usize; 2]>, is_corner: &[bool]) -> Self {
        assert_eq!(points.len(), is_corner.len(), "one flag per point");
        let mut neighbours = vec![Vec::new(); points.len()];
        for &[a, b] in &facets {
            neighbours[a].push(b);
            neighbours[b].push(a);
        }
        let is_end = |(i, around): (usize, &Vec<usize>)| match around[..] {
            [a, b] => is_corner[i] || is_sharp([&points[a], &points[i], &points[b]]),
            _ => true,
        };
        let is_end = neighbours.iter().enumerate().map(is_end).collect();
        Self { points, facets, is_end }
    }

    /// Whether the row of a point is its interpolation.
    #[must_use]
    pub fn is_end(&self, point: usize) -> bool {
        self.is_end[point]
    }

    /// `m_i = integral N_i` `[m]`: half the length of the facets at each point.
    #[must_use]
    pub fn masses(&self) -> Vec<f64> {
        let mut masses = vec![0.0; self.points.len()];
        for facet in &self.facets {
            let half = 0.5 * self.length(facet);
            for &i in facet {
                masses[i] += half;
            }
        }
        masses
    }

    /// Quadrature points of every facet, in the order of the facets: those of `rule` on [0, 1] between any two breakpoints.
    ///
    /// `breakpoints` `[m]` are places where `R_a` is not smooth, such as the ends of the second field's elements; each
    /// cuts the facet where it projects to it.
    #[must_use]
    pub fn samples(&self, breakpoints: &[[f64; D]], rule: &[(f64, f64)]) -> Vec<Samples<D>> {
        self.facets.iter().map(|facet| self.samples_of(facet, breakpoints, rule)).collect()
    }

    fn samples_of(&self, facet: &[usize; 2], breakpoints: &[[f64; D]], rule: &[(f64, f64)]) -> Samples<D> {
        let ends @ [start, end] = facet.map(|i| self.points[i]);
        let length = self.length(facet);
        let at = |s: f64| std::array::from_fn(|c| start[c] + s * (end[c] - start[c]));
        let mut cuts: Vec<f64> = breakpoints
            .iter()
            .map(|place| (along(&start, place, &end) / (length * length), place))
            .filter(|(s, place)| {
                (APART..1.0 - APART).contains(s) && distance(place, &at(*s)) < REACH * length
            })
            .map(|(s, _)| s)
            .chain([0.0, 1.0])
            .collect();
        cuts.sort_by(f64::total_cmp);
        cuts.dedup_by(|later, first| *later - *first < APART);
        let cells = cuts.windows(2).flat_map(|cell| {
            let size = cell[1] - cell[0];
            rule.iter().map(move |&(s, weight)| (cell[0] + s * size, weight * size * length))
        });
        let rule: Vec<(f64, f64)> = cells.collect();
        Samples { ends, points: rule.iter().map(|&(s, _)| at(s)).collect(), rule }
    }

    /// The rows of `H`, from the interpolation `R_a` at every point (`nodal`) and at every quadrature point (`sampled`, in the
    /// order of `samples`). A row is a list of points of the second field and their weights.
    ///
    /// # Panics
    /// When there is not one row per point or per quadrature point.
    #[must_use]
    pub fn rows(
        &self,
        nodal: Vec<Vec<(usize, f64)>>,
        samples: &[Samples<D>],
        sampled: &[Vec<Vec<(usize, f64)>>],
    ) -> Vec<Vec<(usize, f64)>> {
        assert_eq!(nodal.len(), self.points.len(), "one row per point");
        assert!(samples.len() == self.facets.len() && sampled.len() == self.facets.len(), "rows per facet");
        let mut sums: Vec<BTreeMap<usize, f64>> = vec![BTreeMap::new(); self.points.len()];
        for ((facet, samples), sampled) in self.facets.iter().zip(samples).zip(sampled) {
            assert_eq!(samples.rule.len(), sampled.len(), "one row per quadrature point");
            for (&(s, weight), row) in samples.rule.iter().zip(sampled) {
                for (&i, psi) in facet.iter().zip(self.multipliers(facet, s)) {
                    add(&mut sums[i], psi * weight, row);
                }
            }
            // What the multiplier of the inner node sees of the end, whose displacement is known.
            for (i, end) in [(facet[0], facet[1]), (facet[1], facet[0])] {
                if !self.is_end[i] && self.is_end[end] {
                    add(&mut sums[i], -0.5 * self.length(facet), &nodal[end]);
                }
            }
        }
        let inner = |(sum, mass): (BTreeMap<usize, f64>, f64)| {
            let weights = sum.into_iter().map(|(a, weight)| (a, weight / mass));
            weights.filter(|(_, weight)| weight.abs() > NO_WEIGHT).collect()
        };
        let of_points = sums.into_iter().zip(self.masses()).zip(nodal).zip(&self.is_end);
        of_points.map(|((sum, nodal), is_end)| if *is_end { nodal } else { inner(sum) }).collect()
    }

    /// `psi_a` and `psi_b` at s of a facet; 0 for ends.
    fn multipliers(&self, [a, b]: &[usize; 2], s: f64) -> [f64; 2] {
        match [self.is_end[*a], self.is_end[*b]] {
            [false, false] => [2.0 - 3.0 * s, 3.0 * s - 1.0],
            [false, true] => [1.0, 0.0],
            [true, false] => [0.0, 1.0],
            [true, true] => [0.0, 0.0],
        }
    }

    fn length(&self, [a, b]: &[usize; 2]) -> f64 {
        distance(&self.points[*a], &self.points[*b])
    }
}

/// Adds a multiple of a row.
fn add(sum: &mut BTreeMap<usize, f64>, factor: f64, row: &[(usize, f64)]) {
    if factor != 0.0 {
        for &(a, weight) in row {
            *sum.entry(a).or_default() += factor * weight;
        }
    }
}

/// `(place - start) . (end - start)`
fn along<const D: usize>(start: &[f64; D], place: &[f64; D], end: &[f64; D]) -> f64 {
    (0..D).map(|c| (place[c] - start[c]) * (end[c] - start[c])).sum()
}

fn distance<const D: usize>(a: &[f64; D], b: &[f64; D]) -> f64 {
    (0..D).map(|c| (a[c] - b[c]).powi(2)).sum::<f64>().sqrt()
}

/// Whether the way from the first to the last point turns sharply at the middle one.
fn is_sharp<const D: usize>([a, middle, b]: [&[f64; D]; 3]) -> bool {
    let straight: f64 = (0..D).map(|c| (middle[c] - a[c]) * (b[c] - middle[c])).sum();
    straight < SHARP * distance(a, middle) * distance(middle, b)
}

#[cfg(test)]
mod tests;
