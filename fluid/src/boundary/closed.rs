//! Moving walls of a closed domain: the normal velocity that keeps the balance of volume.
//!
//! The difference `w = D_t x` of a wall's nodes misses the rate of the volume that they enclose by O(dt^order), as for a
//! wheel that turns: every chord from an old to a new place of its rim cuts through the rim. An outflow takes up what is
//! missing. A closed domain has none, and its equations have a solution only if nothing is missing.

use partita_mesh::{Facet, Mesh};
use partita_numerics::small::dot;
use partita_numerics::time::Bdf;

/// A node whose area vector is shorter than this part of the longest one has no normal.
const NO_NORMAL: f64 = 1e-6;

/// The walls with a motion of their own in a domain without outflow.
pub(crate) struct ClosedWalls<const D: usize> {
    nodes: Vec<usize>,
    /// Boundary facets at these nodes.
    facets: Vec<Facet<D>>,
    /// For each node of the mesh its place in `nodes`.
    places: Vec<Option<usize>>,
    /// Area vectors of `nodes`: at the end of the step, and their means over this step and the one before.
    now: Vec<[f64; D]>,
    latest: Vec<[f64; D]>,
    earlier: Vec<[f64; D]>,
    /// What is added to w, in the order of `nodes` `[m/s]`.
    correction: Vec<[f64; D]>,
}

/// Displacements of all nodes at `t_{n+1}`, `t_n` and `t_{n-1}` `[m]`, `node * D + c`.
type Levels<'a> = [&'a [f64]; 3];

impl<const D: usize> ClosedWalls<D> {
    /// The walls at `nodes`; `None` if there are none.
    pub(crate) fn new(mesh: &Mesh<D>, nodes: impl IntoIterator<Item = usize>) -> Option<Self> {
        let nodes: Vec<usize> = nodes.into_iter().collect();
        if nodes.is_empty() {
            return None;
        }
        let mut places = vec![None; mesh.points().len()];
        for (place, &node) in nodes.iter().enumerate() {
            places[node] = Some(place);
        }
        let touches = |facet: &&Facet<D>| facet.nodes.iter().any(|node| places[*node].is_some());
        let zero = vec![[0.0; D]; nodes.len()];
        Some(Self {
            facets: mesh.topology().boundary().iter().filter(touches).copied().collect(),
            places,
            now: zero.clone(),
            latest: zero.clone(),
            earlier: zero.clone(),
            correction: zero,
            nodes,
        })
    }

    /// Computes the corrections of a step.
    ///
    /// With the area vectors `S_i(x) = dV/dx_i = sum over facets of (N_i, n)` the volume swept in a step is
    ///
    /// ```text
    /// V^{n+1} - V^n = sum_i S_i . (x_i^{n+1} - x_i^n),    S_i the mean over the straight way from one place to the other
    /// ```
    ///
    /// and the normal part of the fluid's velocity `u_i` at a wall follows from what its node sweeps:
    ///
    /// ```text
    /// S_i^{n+1} . u_i = c_0 S_i . (x_i^{n+1} - x_i^n) - c_2 S_i . (x_i^n - x_i^{n-1}),    sum_i S_i^{n+1} . u_i = D_t V
    /// ```
    ///
    /// The tangential part is that of w. A wall that is only translated keeps w.
    pub(crate) fn update(&mut self, reference: &[[f64; D]], levels: Levels<'_>, bdf: &Bdf) {
        let [newest, current, previous] = levels;
        let [c0, _, c2] = bdf.c;
        area_vectors(&self.facets, &self.places, reference, &[(1.0, newest, newest)], &mut self.now);
        mean_area_vectors(&self.facets, &self.places, reference, [current, newest], &mut self.latest);
        mean_area_vectors(&self.facets, &self.places, reference, [previous, current], &mut self.earlier);
        let longest = self.now.iter().map(|vector| dot(vector, vector)).fold(0.0, f64::max);
        for (place, &node) in self.nodes.iter().enumerate() {
            let at = |level: &[f64], c: usize| level[node * D + c];
            let step: [f64; D] = std::array::from_fn(|c| at(newest, c) - at(current, c));
            let before: [f64; D] = std::array::from_fn(|c| at(current, c) - at(previous, c));
            let w: [f64; D] = std::array::from_fn(|c| c0 * step[c] - c2 * before[c]);
            let swept = c0 * dot(&self.latest[place], &step) - c2 * dot(&self.earlier[place], &before);
            let vector = self.now[place];
            let squared = dot(&vector, &vector);
            let factor = if squared > NO_NORMAL * NO_NORMAL * longest {
                (swept - dot(&vector, &w)) / squared
            } else {
                0.0
            };
            self.correction[place] = vector.map(|s| factor * s);
        }
    }

    /// The flux of the corrections `[m^2/s in 2D, m^3/s in 3D]`.
    pub(crate) fn corrected_flux(&self) -> f64 {
        self.correction.iter().zip(&self.now).map(|(correction, vector)| dot(correction, vector)).sum()
    }

    /// What is added to w at a node `[m/s]`.
    pub(super) fn correction(&self, node: usize) -> [f64; D] {
        self.places[node].map_or([0.0; D], |place| self.correction[place])
    }
}

/// `S_i` as a mean over the straight way between two places: Simpson's rule, exact for a polynomial of degree `D - 1`.
fn mean_area_vectors<const D: usize>(
    facets: &[Facet<D>],
    places: &[Option<usize>],
    reference: &[[f64; D]],
    [from, to]: [&[f64]; 2],
    vectors: &mut [[f64; D]],
) {
    let weights = [(1.0 / 6.0, from, from), (4.0 / 6.0, from, to), (1.0 / 6.0, to, to)];
    area_vectors(facets, places, reference, &weights, vectors);
}

/// The weighted sum of `S_i` at points half way between two displacements.
fn area_vectors<const D: usize>(
    facets: &[Facet<D>],
    places: &[Option<usize>],
    reference: &[[f64; D]],
    terms: &[(f64, &[f64], &[f64])],
    vectors: &mut [[f64; D]],
) {
    vectors.fill([0.0; D]);
    let corners = Facet { nodes: std::array::from_fn(|k| k), cell: 0 };
    for &(weight, one, other) in terms {
        for facet in facets {
            let points: [[f64; D]; D] = facet.nodes.map(|node| {
                std::array::from_fn(|c| reference[node][c] + 0.5 * (one[node * D + c] + other[node * D + c]))
            });
            let vector = corners.area_vector(&points);
            for place in facet.nodes.iter().filter_map(|node| places[*node]) {
                for c in 0..D {
                    vectors[place][c] += weight * vector[c] / D as f64;
                }
            }
        }
    }
}
