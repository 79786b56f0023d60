//! The identities of the mortar rows, on lines between nodes of linear shape functions and on closed rings.

use std::f64::consts::TAU;

use proptest::prelude::*;

use super::*;

type Row = Vec<(usize, f64)>;

/// Gauss points and weights on [0, 1], exact to degree 5.
const RULE: [(f64, f64); 3] =
    [(0.112_701_665_379_258_31, 5.0 / 18.0), (0.5, 8.0 / 18.0), (0.887_298_334_620_741_7, 5.0 / 18.0)];

/// Piecewise linear functions between `nodes` of a line, at x: hats, as the second field's `R_a`.
fn hats(nodes: &[f64], x: f64) -> Row {
    let k = nodes[1..nodes.len() - 1].partition_point(|node| *node <= x);
    let s = (x - nodes[k]) / (nodes[k + 1] - nodes[k]);
    [(k, 1.0 - s), (k + 1, s)].into_iter().filter(|(_, weight)| *weight != 0.0).collect()
}

/// `integral R_a` of the hats.
fn loads(nodes: &[f64]) -> Vec<f64> {
    let mut loads = vec![0.0; nodes.len()];
    for (k, element) in nodes.windows(2).enumerate() {
        let half = 0.5 * (element[1] - element[0]);
        (loads[k], loads[k + 1]) = (loads[k] + half, loads[k + 1] + half);
    }
    loads
}

/// A line from 0 to 1 whose facets and elements have these lengths, up to a factor, drawn at an angle in the plane.
struct Line {
    fluid: Vec<f64>,
    structure: Vec<f64>,
    direction: [f64; 2],
}

impl Line {
    fn new(facets: &[f64], elements: &[f64], angle: f64) -> Self {
        Self { fluid: sums(facets), structure: sums(elements), direction: [angle.cos(), angle.sin()] }
    }

    fn place(&self, x: f64) -> [f64; 2] {
        self.direction.map(|c| 2.0 + c * x)
    }

    fn mortar(&self) -> Mortar<2> {
        let points: Vec<_> = self.fluid.iter().map(|&x| self.place(x)).collect();
        // Facets may point either way.
        let facet = |i| if i % 2 == 0 { [i, i + 1] } else { [i + 1, i] };
        let facets = (0..points.len() - 1).map(facet).collect();
        let corners = vec![false; points.len()];
        Mortar::new(points, facets, &corners)
    }

    fn rows(&self) -> Vec<Row> {
        let mortar = self.mortar();
        let breakpoints: Vec<_> = self.structure.iter().map(|&x| self.place(x)).collect();
        let samples = mortar.samples(&breakpoints, &RULE);
        let along =
            |place: &[f64; 2]| (place[0] - 2.0) * self.direction[0] + (place[1] - 2.0) * self.direction[1];
        let row = |place: &[f64; 2]| hats(&self.structure, along(place));
        let sampled: Vec<_> =
            samples.iter().map(|samples| samples.points.iter().map(row).collect()).collect();
        let nodal = self.fluid.iter().map(|&x| hats(&self.structure, x)).collect();
        mortar.rows(nodal, &samples, &sampled)
    }
}

fn sums(lengths: &[f64]) -> Vec<f64> {
    let whole: f64 = lengths.iter().sum();
    let mut end = 0.0;
    let mut points = vec![0.0];
    for length in lengths {
        end += length / whole;
        points.push(end);
    }
    *points.last_mut().unwrap() = 1.0;
    points
}

/// `sum_a H_ia values_a` for every i.
fn applied(rows: &[Row], values: &[f64]) -> Vec<f64> {
    rows.iter().map(|row| row.iter().map(|&(a, weight)| weight * values[a]).sum()).collect()
}

/// `sum_i H_ia forces_i` for every a.
fn returned(rows: &[Row], forces: &[f64], count: usize) -> Vec<f64> {
    let mut loads = vec![0.0; count];
    for (row, force) in rows.iter().zip(forces) {
        for &(a, weight) in row {
            loads[a] += weight * force;
        }
    }
    loads
}

#[track_caller]
fn close(found: &[f64], expected: &[f64]) {
    assert_eq!(found.len(), expected.len());
    for (i, (f, e)) in found.iter().zip(expected).enumerate() {
        assert!((f - e).abs() < 1e-13, "{i}: {f} is not {e}");
    }
}

proptest! {
    #[test]
    fn any_two_resolutions_keep_translations_linear_fields_and_the_load_of_constant_traction(
        facets in prop::collection::vec(0.05_f64..1.0, 2..20),
        elements in prop::collection::vec(0.05_f64..1.0, 1..20),
        angle in 0.0..TAU,
    ) {
        let line = Line::new(&facets, &elements, angle);
        let (rows, count) = (line.rows(), line.structure.len());
        close(&applied(&rows, &vec![1.0; count]), &vec![1.0; line.fluid.len()]);
        close(&applied(&rows, &line.structure), &line.fluid);
        close(&returned(&rows, &line.mortar().masses(), count), &loads(&line.structure));
        prop_assert_eq!(&rows[0], &vec![(0, 1.0)]);
        prop_assert_eq!(&rows[rows.len() - 1], &vec![(count - 1, 1.0)]);
    }
}

#[test]
fn interpolation_fails_the_patch_test_that_mortar_passes() {
    let line = Line::new(&[1.0; 3], &[1.0; 7], 0.3);
    let nodal: Vec<Row> = line.fluid.iter().map(|&x| hats(&line.structure, x)).collect();
    let [by_nodes, exact] = [returned(&nodal, &line.mortar().masses(), 8), loads(&line.structure)];
    assert!((by_nodes[0] / exact[0] - 7.0 / 3.0).abs() < 1e-12, "{by_nodes:?} {exact:?}");
    close(&returned(&line.rows(), &line.mortar().masses(), 8), &exact);
}

#[test]
fn matching_meshes_exchange_values_at_the_nodes() {
    let lengths = [0.3, 0.5, 0.1, 0.4, 0.2];
    let rows = Line::new(&lengths, &lengths, 1.0).rows();
    for (i, row) in rows.iter().enumerate() {
        let off: f64 = row.iter().map(|(a, weight)| (weight - f64::from(*a == i)).abs()).sum();
        assert!(off < 1e-14, "{i}: {row:?}");
    }
}

#[test]
fn a_single_facet_is_interpolated() {
    let rows = Line::new(&[1.0], &[1.0; 4], 0.0).rows();
    assert_eq!(rows, [vec![(0, 1.0)], vec![(4, 1.0)]]);
}

/// A regular polygon on the unit circle, its first node at an angle, on one row per place.
fn ring(count: usize, start: f64) -> (Mortar<2>, impl Fn(&[f64; 2]) -> Row) {
    let place = |k: usize| {
        let angle = start + TAU * k as f64 / count as f64;
        [angle.cos(), angle.sin()]
    };
    let points: Vec<_> = (0..count).map(place).collect();
    let facets = (0..count).map(|k| [k, (k + 1) % count]).collect();
    let mortar = Mortar::new(points, facets, &vec![false; count]);
    let row = |[x, y]: &[f64; 2]| {
        let at = y.atan2(*x).rem_euclid(TAU) / TAU * 12.0;
        let k = (1_u32..12).filter(|k| f64::from(*k) <= at).count();
        vec![(k, 1.0 - (at - k as f64)), ((k + 1) % 12, at - k as f64)]
    };
    (mortar, row)
}

#[test]
fn a_closed_ring_has_no_ends() {
    let breakpoints: Vec<[f64; 2]> =
        (0..12).map(|k| TAU * f64::from(k) / 12.0).map(|angle| [angle.cos(), angle.sin()]).collect();
    for (count, start) in [(8, 0.0), (12, 0.0), (12, 0.2), (31, 0.7)] {
        let (mortar, row) = ring(count, start);
        assert!((0..count).all(|i| !mortar.is_end(i)), "{count}");
        let samples = mortar.samples(&breakpoints, &RULE);
        let sampled: Vec<Vec<Row>> =
            samples.iter().map(|samples| samples.points.iter().map(&row).collect()).collect();
        let nodal = mortar.points.iter().map(&row).collect();
        let rows = mortar.rows(nodal, &samples, &sampled);
        close(&applied(&rows, &[1.0; 12]), &vec![1.0; count]);
        let mut integrals = vec![0.0; 12];
        for (samples, sampled) in samples.iter().zip(&sampled) {
            for ((_, weight), row) in samples.rule.iter().zip(sampled) {
                for (a, value) in row {
                    integrals[*a] += weight * value;
                }
            }
        }
        close(&returned(&rows, &mortar.masses(), 12), &integrals);
    }
}

#[test]
fn chains_end_at_sharp_turns_at_named_corners_and_where_they_meet() {
    let turned = |degrees: f64| {
        let (s, c) = degrees.to_radians().sin_cos();
        let points = vec![[-1.0, 0.0], [0.0, 0.0], [c, s]];
        Mortar::new(points, vec![[0, 1], [1, 2]], &[false; 3]).is_end(1)
    };
    assert!(
        !turned(0.0) && !turned(44.9) && !turned(-45.0) && turned(45.1) && turned(-90.0) && turned(180.0)
    );
    let points = vec![[-1.0, 0.0], [0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [1.0, 1.0]];
    let facets = vec![[0, 1], [1, 2], [2, 3], [2, 4]];
    let mortar = Mortar::new(points.clone(), facets, &[false; 5]);
    assert_eq!([0, 1, 2, 3, 4].map(|i| mortar.is_end(i)), [true, false, true, true, true]);
    let named = Mortar::new(points, vec![[0, 1], [1, 2]], &[false, true, false, false, false]);
    assert!(named.is_end(1));
}

#[test]
fn facets_are_cut_at_the_breakpoints_beside_them_alone() {
    let mortar = Mortar::new(vec![[0.0, 0.0], [2.0, 0.0]], vec![[0, 1]], &[false; 2]);
    let breakpoints = [[0.5, 0.1], [0.5, 0.1], [1.5, 0.0], [1.0, 5.0], [3.0, 0.0], [2.0, 0.0]];
    let samples = mortar.samples(&breakpoints, &[(0.5, 1.0)]);
    assert_eq!(samples[0].points, [[0.25, 0.0], [1.0, 0.0], [1.75, 0.0]]);
    let length: f64 = samples[0].rule.iter().map(|(_, weight)| weight).sum();
    assert!((length - 2.0).abs() < 1e-15);
}
