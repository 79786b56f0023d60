//! Refinement keeps the map from parameters to points.

use partita_iga::{KnotError, Knots, Spline, build};
use proptest::prelude::*;

use crate::support::{distance, splines_with_parameters};

proptest! {
    #[test]
    fn knot_insertion_keeps_the_map((spline, xi) in splines_with_parameters::<3>(3), i in 0_usize..3, share in 0.01..0.99) {
        let [start, end] = spline.knots()[i].domain();
        let knot = start + share * (end - start);
        let refined = spline.insert_knot(i, knot).unwrap();
        prop_assert_eq!(refined.knots()[i].multiplicity(knot), 1);
        prop_assert!(distance(&refined.point(&xi), &spline.point(&xi)) < 1e-13);
    }

    #[test]
    fn degree_elevation_keeps_the_map((spline, xi) in splines_with_parameters::<3>(2), i in 0_usize..2, by in 0_usize..4) {
        let elevated = spline.elevate_degree(i, by);
        prop_assert_eq!(elevated.knots()[i].degree(), spline.knots()[i].degree() + by);
        prop_assert_eq!(elevated.element_count(), spline.element_count());
        prop_assert!(distance(&elevated.point(&xi), &spline.point(&xi)) < 1e-13);
    }

    #[test]
    fn subdivision_keeps_the_map((spline, xi) in splines_with_parameters::<2>(2), i in 0_usize..2, parts in 1_usize..6) {
        let fine = spline.subdivide(i, parts).unwrap();
        prop_assert_eq!(fine.element_count(), parts * spline.element_count());
        prop_assert!(distance(&fine.point(&xi), &spline.point(&xi)) < 1e-13);
    }

    /// New points are convex combinations of old ones, so nothing grows however often one refines.
    #[test]
    fn refinement_stays_in_the_hull_and_keeps_corners((spline, _) in splines_with_parameters::<2>(2)) {
        let fine = spline.elevate_degree(0, 2).subdivide(0, 7).unwrap().elevate_degree(1, 1).subdivide(1, 3).unwrap();
        let ([low, high], [fine_low, fine_high]) = (spline.bounding_box(), fine.bounding_box());
        for c in 0..2 {
            prop_assert!(low[c] - 1e-14 <= fine_low[c] && fine_high[c] <= high[c] + 1e-14);
        }
        let range = |weights: &[f64]| weights.iter().fold((f64::MAX, 0.0_f64), |(a, b), w| (a.min(*w), b.max(*w)));
        let ((least, most), (fine_least, fine_most)) = (range(spline.weights()), range(fine.weights()));
        prop_assert!(least - 1e-14 <= fine_least && fine_most <= most + 1e-14);
        prop_assert_eq!(fine.control_points()[0], spline.control_points()[0]);
        prop_assert_eq!(fine.control_points().last(), spline.control_points().last());
    }

    #[test]
    fn refinement_of_all_parameters_commutes((spline, xi) in splines_with_parameters::<3>(3)) {
        let one = spline.subdivide(0, 2).unwrap().elevate_degree(2, 1).subdivide(1, 3).unwrap();
        let other = spline.subdivide(1, 3).unwrap().subdivide(0, 2).unwrap().elevate_degree(2, 1);
        prop_assert_eq!(one.knots(), other.knots());
        for (a, b) in one.control_points().iter().zip(other.control_points()) {
            prop_assert!(distance(a, b) < 1e-13);
        }
        prop_assert!(distance(&one.point(&xi), &spline.point(&xi)) < 1e-13);
    }
}

#[test]
fn halving_a_parabola_is_de_casteljau() {
    let parabola =
        Spline::new(vec![Knots::uniform(2, 1).unwrap()], vec![[0.0, 0.0], [1.0, 2.0], [2.0, 0.0]]).unwrap();
    let halved = parabola.insert_knots(0, &[0.5, 0.5]).unwrap();
    assert_eq!(halved.control_points(), [[0.0, 0.0], [0.5, 1.0], [1.0, 1.0], [1.5, 1.0], [2.0, 0.0]]);
}

#[test]
fn elevating_a_line_spreads_its_control_points() {
    let line = build::line([0.0], [3.0], 1, 1).unwrap();
    assert_eq!(line.elevate_degree(0, 2).control_points(), [[0.0], [1.0], [2.0], [3.0]]);
}

#[test]
fn elevation_keeps_the_smoothness_at_each_knot() {
    let knots = Knots::new(3, vec![0.0, 0.0, 0.0, 0.0, 0.4, 0.7, 0.7, 1.0, 1.0, 1.0, 1.0]).unwrap();
    let spline = Spline::new(vec![knots], (0..7).map(|a| [f64::from(a * a)]).collect()).unwrap();
    let breaks: Vec<_> = spline.elevate_degree(0, 2).knots()[0].breaks().collect();
    assert_eq!(breaks, [(0.0, 6), (0.4, 3), (0.7, 4), (1.0, 6)]);
}

#[test]
fn a_polynomial_spline_stays_polynomial() {
    let patch = build::rectangle([0.0, 0.0], [1.0, 0.3], [2, 1], [3, 2]).unwrap();
    let fine = patch.subdivide(0, 3).unwrap().elevate_degree(1, 2);
    assert!(!fine.is_rational());
    assert!(fine.weights().iter().all(|w| *w == 1.0));
}

#[test]
fn very_uneven_knots_do_no_harm() {
    let knots =
        Knots::new(3, vec![0.0, 0.0, 0.0, 0.0, 1e-8, 2e-8, 0.5, 1.0 - 1e-9, 1.0, 1.0, 1.0, 1.0]).unwrap();
    let points = (0..8).map(|a| [f64::from(a), f64::from(a * a % 7)]).collect();
    let curve = Spline::new(vec![knots], points).unwrap();
    let fine = curve.elevate_degree(0, 2).subdivide(0, 2).unwrap();
    for xi in [0.0, 3e-9, 1.5e-8, 1e-4, 0.3, 0.7, 1.0 - 5e-10, 1.0] {
        assert!(distance(&fine.point(&[xi]), &curve.point(&[xi])) < 1e-14 * 8.0, "at {xi}");
    }
}

#[test]
fn impossible_refinements_are_refused() {
    let line = build::line([0.0], [1.0], 2, 2).unwrap();
    assert_eq!(line.insert_knot(0, 1.0), Err(KnotError::Outside { value: 1.0, start: 0.0, end: 1.0 }));
    assert!(matches!(line.insert_knot(0, f64::NAN), Err(KnotError::Outside { .. })));
    let twice = line.insert_knots(0, &[0.5, 0.5]);
    assert_eq!(twice, Err(KnotError::Multiplicity { value: 0.5, found: 3, degree: 2 }));
    assert_eq!(line.subdivide(0, 0), Err(KnotError::NoElements));
}
